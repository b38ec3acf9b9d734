"""Logs as other people make them with any effect in the motor, simulated: does the diagnosis name it?

The motors, sensors and excitations of `foreign_logs.py` (a single step is left out, which tells next to nothing), each
with one of the effects that are rarer or harder to see than those of that page, or with one that is outside the table;
friction is beside it in four of five. The tests' independent plant moves; `import_log` is told nothing. No winding
warms up within seconds: of one that does the log lasts for twelve at least.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
from any_motor_cases import GROWTH, USUAL
from foreign_logs import run
from foreign_logs_cases import EXCITATIONS, SENSORS, Case, draw, span_of
from hidden import OUTSIDE, SIZES

RESULTS = Path(__file__).with_name("results") / "foreign_effects.md"
RARE = (
    "static_friction", "load_step", "voltage_limit", "coast_drive", "supply_sag", "armature_inductance",
    "torque_ripple", "encoder_eccentricity", "backlash", "warm_up",
)  # fmt: skip
USUAL_SPAN = 28.0  # [s] of the recordings that the sizes are made for
WARMING_SPAN = 12.0  # [s] of a log in which a winding warms up, at least


def draw_rare(seed: int) -> Case:
    """Draw a motor and its log as `foreign_logs` does, and put an effect in it."""
    case, random = draw(seed), np.random.default_rng([18, seed])
    outside = random.random() < 0.2
    sensor = str(random.choice(SENSORS))
    name = str(random.choice(list(OUTSIDE) if outside else RARE))
    if name == "warm_up":
        case = replace(case, least=WARMING_SPAN)
    if name == "encoder_eccentricity":  # of the disc that is counted
        sensor = str(random.choice(SENSORS[:2]))
    values = {key: value for key, value in case.values.items() if key in ("kv", "ka", "max_voltage") or "torque" in key}
    if random.random() < 0.8 or name == "static_friction":
        values["ks"] = random.uniform(0.02, 0.12) * case.supply
    values |= _draw_sizes(case, name, values, random)
    excitation = str(random.choice(EXCITATIONS[1:]))
    if name == "angle_friction" and excitation.endswith("one way"):  # which is what a load that ripples does
        name = "torque_ripple"
    hidden = ("coulomb_friction", name) if "ks" in values else (name,)  # what is outside the table may have its own
    return replace(case, values=values, hidden=hidden, excitation=excitation, sensor=sensor)


def _draw_sizes(case: Case, name: str, known: dict[str, float], random: np.random.Generator) -> dict[str, float]:
    """Draw how large an effect is, for a motor and a log of this size; `known` is in the motor already."""
    kv, span = case.values["kv"], span_of(case)
    ratio = np.array([case.supply, case.supply / kv, case.lag]) / USUAL
    values = {
        key: random.uniform(*bounds) * float(np.prod(ratio ** np.array(GROWTH.get(key, (0.0, 0.0, 0.0)))))
        for key, bounds in (SIZES | OUTSIDE)[name].items()
        if key not in known
    }
    if name == "static_friction":
        values["breakaway_voltage"] = known["ks"] + random.uniform(0.02, 0.06) * case.supply
    if "step_time" in values:
        values["step_time"] = random.uniform(0.2, 0.8) * span
    if "warm_up_time" in values:
        values["warm_up_time"] *= span / USUAL_SPAN / ratio[2]
    if "ripple_cycles" in values:  # four rows of a wave at half the top speed, and as many as motors have
        most = min(np.pi * case.rate * kv / case.supply, case.counts / 3.0, 60.0)
        values["ripple_cycles"] = float(max(1.0, most ** random.random()))
    return values


def main() -> None:
    """Print the cases as they come, and write the page."""
    run(draw_rare, RESULTS, __doc__ or "")


if __name__ == "__main__":
    main()
