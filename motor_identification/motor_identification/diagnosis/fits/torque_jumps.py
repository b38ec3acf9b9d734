"""Scan for jumps of the load: what a step of the torque at every interval gains beside a random torque.

Beside a slow random torque a step shows in the few intervals in which no such torque changes as fast: of log likelihood
it gains hundreds at its instant and next to nothing a time constant before, so that no grid of instants that a motion
is simulated for finds it. The generalised likelihood ratio (A. Willsky, H. Jones, IEEE Trans. Autom. Control 21, 1976)
of all instants is one pass of the whitening filter each, over the intervals in which the motor answers; beyond them the
answer is that to a torque that has always been there, which is the same for all.
"""

from typing import NamedTuple

import numpy as np

from motor_identification.diagnosis.fits.disturbed_fit import make_disturbed_residuals
from motor_identification.estimation.estimate import Estimate
from motor_identification.noise.error_data import TorqueWhitening
from motor_identification.noise.error_filter import whiten_next
from motor_identification.noise.error_model import ErrorModel
from motor_identification.recording import Bools, Floats, Integers
from motor_model.compiled import compiled

ANSWER = 6.0  # time constants after which a motor has answered a step: e^−6 is left
LONGEST_ANSWER = 400  # intervals that are looked at one by one, at most
# Of a time constant, between instants that are tried. Measured: half of the gain is left 0.05 of one beside the instant
# of a step where rows are many.
STRIDE = 0.02
APART = 0.5  # time constants between two jumps of a list: nearer is the same one


class Jumps(NamedTuple):
    """Steps of the torque that were tried, each from the beginning of an interval on; arrays (S,)."""

    time: Floats  # [s]
    gain: Floats  # of log likelihood, all other unknowns as they are
    size: Floats  # [V] of the likeliest step, against the motor

    def list_best(self, count: int, apart: float) -> list[int]:
        """List the numbers of the likeliest, best first, which are so much time [s] apart at least."""
        best: list[int] = []
        for number in np.argsort(-self.gain, kind="stable"):
            if len(best) == count:
                break
            if all(abs(self.time[number] - self.time[other]) >= apart for other in best):
                best.append(int(number))
        return best

    def find_like(self, size: float) -> float:
        """Find when [s] the likeliest step in the direction of a size [V] is; 0 where none was tried."""
        if len(self.time) == 0:
            return 0.0
        return float(self.time[np.argmax(np.where(self.size * size > 0.0, self.gain, -1.0))])


def list_likely_jumps(estimate: Estimate, errors: ErrorModel, count: int) -> list[tuple[float, list[float]]]:
    """List likely steps of the load beside the random torque of an error model, likeliest first.

    Each a size [V], and an instant [s] for every training recording; an instant is another from step to step.
    """
    lag, kv = estimate.lag, float(estimate.parameters.values["kv"])
    filters = make_disturbed_residuals(estimate, errors).filters
    rows = zip(filters, estimate.problem.intervals, estimate.increments, strict=True)
    scans = [
        scan_jumps(one, one.white(increments), data.time[data.first], data.time[data.last], lag.rate, kv)
        for one, data, increments in rows
    ]
    likeliest = max(scans, key=lambda scan: float(scan.gain.max(initial=0.0)))
    sizes = [float(likeliest.size[best]) for best in likeliest.list_best(count, APART / lag.rate)]
    return [(size, [scan.find_like(size) for scan in scans]) for size in sizes]


def scan_jumps(whitening: TorqueWhitening, white: Floats, begin: Floats, end: Floats, rate: float, kv: float) -> Jumps:
    """Scan a recording's white residuals (I,) for steps of the torque.

    begin, end: [s] of every interval, shape (I,); rate: kv/ka [1/s]; kv [V·s/rad].
    """
    forever = whitening.white(np.where(whitening.still, 0.0, (end - begin) / kv))
    behind = _sum_up(forever * white), _sum_up(forever**2)
    rows = STRIDE / rate * len(white) / max(float(np.sum(end - begin)), 1e-300)
    tried = np.arange(0, len(white), max(1, int(rows)))
    along, power = np.zeros(len(tried)), np.zeros(len(tried))
    _correlate(
        whitening.fresh, whitening.still, whitening.gains, white, begin, end, rate, kv, tried, *behind, along, power
    )
    size = np.divide(along, power, out=np.zeros(len(tried)), where=power > 0.0)
    return Jumps(begin[tried], 0.5 * along * size, size)


def _sum_up(values: Floats) -> Floats:
    """Sum up values (I,) from each to the last, and nothing behind that: shape (I + 1,)."""
    return np.append(np.cumsum(values[::-1])[::-1], 0.0)


@compiled
def _correlate(
    fresh: Bools,
    still: Bools,
    gains: Floats,
    white: Floats,
    begin: Floats,
    end: Floats,
    rate: float,
    kv: float,
    tried: Integers,
    along_behind: Floats,
    power_behind: Floats,
    along: Floats,
    power: Floats,
) -> None:
    """Fill the correlation of white residuals with the answer to each step of 1 V, and that answer's power, (S,)."""
    for number, first in enumerate(tried):
        start, k, last = begin[first], first, min(first + LONGEST_ANSWER, len(white))
        level = b = d = t = 0.0
        while k < last and begin[k] <= start + ANSWER / rate:
            if not still[k]:
                since, until = begin[k] - start, end[k] - start
                travel = (until - since + (np.exp(-rate * until) - np.exp(-rate * since)) / rate) / kv
                answer, level, b, d, t = whiten_next(gains, k, fresh[k], travel, level, b, d, t)
                along[number] += answer * white[k]
                power[number] += answer * answer
            k += 1
        along[number] += along_behind[k]
        power[number] += power_behind[k]
