"""Judge a torque ripple by a friction that goes with the angle, which holds back whichever way the motor turns.

A friction with a tight spot in every turn is a ripple that changes its sign with the speed. It is not in the table; a
ripple that is a hundredth of a cycle off a whole turn stands in for it, which is of the other sign some tens of turns
later, when the motor has turned back. Both are fitted to what the model leaves that lacks the ripple, by linear least
squares, with kv, friction, gain and load again, under the errors of the model that has it.
"""

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.evidence.presliding_evidence import fit_torques
from motor_identification.diagnosis.fits.disturbed_fit import list_error_data
from motor_identification.discrepancy.free_curves import respond
from motor_identification.discrepancy.motion_history import MotionHistory
from motor_identification.discrepancy.rest import Rest
from motor_identification.discrepancy.rests import list_training_rests
from motor_identification.discrepancy.structure import Structure
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME

CAUSE = "a friction that goes with the angle (a tight spot in every turn)"
VARIABLE = "angle"
WINDOW, STEPS = 3.0, 12  # cycles over all turns about the ripple's own that are looked at, and in how many steps


def find_angle_friction(effect: str, without: Model, current: Model) -> Structure | None:
    """Find the friction over the angle that a torque ripple stands in for; None where it does not.

    Nor where the ripple leaves no more than the sensor: what stands in leaves some, unless nothing tells the two apart.
    without: the model that lacks the ripple.
    """
    row = EFFECT_BY_NAME[effect]
    if not row.periodic or row.on_disc or current.at_floor:
        return None
    ripple_size, own_cycles = (current.estimate.parameters.value(spec.name) for spec in row.parameters[:2])
    rests = list_training_rests(without.estimate, list_error_data(without.estimate))
    about = own_cycles + WINDOW * np.linspace(-1.0, 1.0, 2 * STEPS + 1) / max(current.turns, 1.0)
    ripple, _ = max(_fit_line(current, rests, float(cycles), holds=False) for cycles in about)
    friction, size = max(_fit_line(current, rests, float(cycles), holds=True) for cycles in about)
    gain = friction - ripple
    if gain <= thresholds.ANGLE_FRICTION_GAIN or size <= thresholds.ANGLE_FRICTION_SIZE * ripple_size:
        return None
    count = sum(len(rest.errors.increments) for rest in rests)
    share = -np.expm1(-2.0 * friction / count)
    return Structure(VARIABLE, float(share), gain, relevant=True, cause=CAUSE)


def _fit_line(model: Model, rests: list[Rest], cycles: float, holds: bool) -> tuple[float, float]:
    """Fit a line of so many cycles a turn to what a model leaves: its gain in log likelihood, and its size [V].

    holds: it is a friction's, against the motion.
    """
    responses = [respond(rest.history, _list_torques(rest.history, cycles, holds), model.lag) for rest in rests]
    sizes, moment = fit_torques(model, [rest.errors for rest in rests], responses)
    return 0.5 * float(moment @ sizes), float(np.hypot(*sizes[-2:]))


def _list_torques(motion: MotionHistory, cycles: float, holds: bool) -> Floats:
    """List torques [V] of unit size, shape (S, 6): friction, kv, gain and load, then both phases of a line."""
    way = np.sign(motion.speed)
    sign, phase = way if holds else 1.0, cycles * motion.angle
    line = [sign * np.cos(phase), sign * np.sin(phase)]
    return np.stack([way, motion.speed, motion.voltage, np.ones_like(way), *line], axis=1)
