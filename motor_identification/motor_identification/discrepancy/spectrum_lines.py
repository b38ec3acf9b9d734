"""Find lines in the spectrum of what a model leaves: a load, or a supply, that is periodic in time."""

from collections.abc import Sequence

import numpy as np

from motor_identification.discrepancy.rest import ROBUST, Rest
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.recording import Floats

LINES = 3  # of a spectrum that are taken together
SMOOTHED = 20_000  # intervals that a spectrum is taken of at most


def find_lines(rests: Sequence[Rest], model: ErrorModel, lag: Lag) -> tuple[float, ...]:
    """Find the frequencies [Hz] of a load, or a supply, that is periodic in time: lines in the residual's spectrum.

    The white residual is summed into even bins of time, as it is and times the command, and both are transformed.
    """
    longest = max(float(rest.history.time[-1]) for rest in rests)
    step = float(np.median(np.concatenate([rest.errors.duration for rest in rests])))
    bins = int(min(max(longest / step, 64), SMOOTHED))
    power: Floats = np.zeros(bins + 1)
    for rest in rests:
        used = rest.learnt & ~rest.errors.still
        _value, white = rest.errors.whiten(model, lag)
        z = np.clip(white[0, used], -ROBUST, ROBUST)
        middle = np.minimum((rest.history.at_start + rest.history.at_end) // 2, len(rest.history.time) - 1)[used]
        index = np.minimum((rest.history.time[middle] / longest * bins).astype(np.int64), bins - 1)
        command = rest.history.voltage[middle]
        for factor in (np.ones(len(z)), command / (float(np.abs(command).max(initial=0.0)) or 1.0)):
            even = np.bincount(index, factor * z, bins) / max(float(np.sum(factor**2)), 1e-9) ** 0.5
            power = np.maximum(power, np.abs(np.fft.rfft(even, 2 * bins)) ** 2)
    frequency = np.fft.rfftfreq(2 * bins, longest / bins)
    power = np.where(frequency * longest < 2.0, 0.0, power)  # slower is what changes over time
    chosen: list[float] = []
    for k in np.argsort(-power):
        if all(abs(frequency[k] - line) * longest > 1.5 for line in chosen):
            chosen.append(float(frequency[k]))
        if len(chosen) == LINES:
            break
    return tuple(chosen)
