"""Judge an effect by most of the time alone: outside of the few moments in which most is left, whatever does that.

When a robot starts its wheels slip, the play of its gears is taken up and its mass sways. What every model leaves in
those moments, a hundredth of the time, is more than what friction does in all the rest, which it explains.
"""

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model, find_lasting_interval


def explains_calm(without: Model, model: Model) -> bool:
    """Decide whether a model takes away nearly all that lasts outside of the few moments in which it leaves most."""
    return measure_calm_share(without, model) > thresholds.CALM_SHARE


def measure_calm_share(without: Model, model: Model) -> float:
    """Measure the share of the excess over the floor that a model takes away outside of where it leaves most.

    In squares, in lasting intervals; 0 near the floor, where the smallest of what is left is so by chance, and where
    the two are not judged by the same intervals.
    """
    if not without.held.has_intervals_of(model.held):
        return 0.0
    length = find_lasting_interval(without.held)
    before, after = without.held.leave_out(model.held.instants).joined(length), model.held.joined(length)
    if before.residuals.shape != after.residuals.shape:
        return 0.0
    calm = after.list_calm(thresholds.WILD_TIME)
    parts = (before.residuals, after.residuals, after.floors(model.noise.share))
    was, rest, noise = (float(after.weight[calm] @ part[calm] ** 2) for part in parts)
    return (was - rest) / (was - noise) if was > thresholds.NEAR_FLOOR_SEEN**2 * noise else 0.0
