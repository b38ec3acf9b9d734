"""See a winding warm up: the resistance that the current shows in one part of a recording after the other."""

from collections.abc import Iterator

import numpy as np
from scipy.special import stdtrit

from motor_identification.physical.joint_fit import JointFit
from motor_identification.physical.residuals import simulate_currents
from motor_identification.recording import Floats
from motor_model.effects import EFFECTS

PARTS = 10  # of equal time; their scatter about a line says how sure its slope is
LEAST_SIGNIFICANCE = 0.999  # that the slope is no chance, two-sided
LEAST_CHANGE = 0.01  # of the resistance: a copper winding does that within 2.6 K, which is nothing to model
(WARM_UP,) = (effect for effect in EFFECTS if any(spec.name == "resistance_rise" for spec in effect.parameters))
CHANGES = "The resistance {} by {:.1f} ± {:.1f} % from the start of {} to its end: {}."
RISES = "the winding warms up, fit with --effects " + WARM_UP.name
FALLS = "which no warm winding does; the load, the supply or the sensor drifts"


def describe_warm_winding(fit: JointFit) -> Iterator[str]:
    """Write a sentence for each recording in which the resistance changes, where the model has it constant."""
    if WARM_UP.name in fit.problem.unknowns.effects:
        return
    simulated = simulate_currents(fit.problem, fit.residuals.currents, fit.theta[None])[0]
    row = 0
    for recording, samples in zip(fit.problem.recordings, fit.residuals.currents, strict=True):
        own = simulated[row : row + len(samples.time)]
        row += len(samples.time)
        change, error = measure_change(samples.time, own, samples.current)
        sure = abs(change) > float(stdtrit(PARTS - 2, 0.5 + 0.5 * LEAST_SIGNIFICANCE)) * error
        if sure and abs(change) > LEAST_CHANGE:
            what, why = ("rises", RISES) if change > 0.0 else ("falls", FALLS)
            yield CHANGES.format(what, 100.0 * abs(change), 100.0 * error, recording.uri, why)


def measure_change(time: Floats, simulated: Floats, measured: Floats) -> tuple[float, float]:
    """Relative change of the resistance from start to end, and its standard error, from currents [A] at times [s].

    In each part the measured current is the simulated one over 1 + δ; δ follows a line over the time.
    """
    part = np.minimum(PARTS * (time - time[0]) / (time[-1] - time[0]), PARTS - 1).astype(np.int64)
    weight = np.bincount(part, simulated**2, PARTS)
    rise = np.bincount(part, (simulated - measured) * simulated, PARTS) / np.maximum(weight, 1e-300)
    middle = (np.arange(PARTS) + 0.5) / PARTS
    design = np.column_stack([np.ones(PARTS), middle]) * np.sqrt(weight)[:, None]
    target = rise * np.sqrt(weight)
    inverse = np.linalg.pinv(design.T @ design)
    line = inverse @ (design.T @ target)
    variance = float(np.sum((target - design @ line) ** 2)) / (PARTS - 2)
    return float(line[1]), float(np.sqrt(variance * inverse[1, 1]))
