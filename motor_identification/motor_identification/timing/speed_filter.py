"""Filters that programs log speeds through, and what went into them.

    y = B(1/z)/A(1/z)·x,   both of the same gain at rest

A has the poles: one, m, of y = m·y' + (1 − m)·x; the same twice; or those of a Butterworth filter. B has running means
of N rows, Σ z^−k/N, of which the bilinear transform makes one of 2 rows for every pole. Poles are taken back exactly. A
mean has zeros on the unit circle, where what was in it before the log and the last printed digit would stay for ever:
it is taken back with zeros that are pulled in to a radius r, so that both are forgotten. What is left of it is late by
(1 − r)·(N² − 1)/12 rows.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from math import atan, log, pi, tan

import numpy as np

from motor_identification.recording import Floats, Integers
from motor_identification.sensor.row_clock import number_rows
from motor_identification.sensor.running_mean import take_single_rows
from motor_identification.timing.whole_rows import undo_on_whole_rows
from motor_model.errors import ModelError

FORGOTTEN = 0.05  # of what is wrong, within a mean's length: 1 − r^N
WALK = 1.1  # times as far from the mean around: what is farther is no count. Measured: 0.99 to 1.05 of counts
LASTING = 2000  # rows after which nothing is left of an impulse: the 0.99 of one of them is 2e-9
LEAST_ROWS, MOST_ROWS = 2, 64  # of a mean


@dataclass(frozen=True)
class Kind:
    """A kind of filter, which has a number: from 0 (hardly a filter) to below 1, or of a mean's rows."""

    poles: Callable[[float], Floats]  # A, by the number
    means: Callable[[float], tuple[int, ...]]  # the rows of each in B, by the number
    describe: Callable[[float, float], str]  # what it does, by the number and the length of a row [s]


def _place_pole(number: float) -> Floats:
    return np.array([1.0, -number])


def _place_two_poles(number: float) -> Floats:
    return np.array([1.0, -2.0 * number, number**2])


def _place_butterworth(number: float) -> Floats:
    """Of second order, its corner at 1 − number of half the rate (Oppenheim, Discrete-Time Signal Processing, 7.2)."""
    c = tan(0.5 * pi * (1.0 - number))
    poles = np.array([1.0 + 2.0**0.5 * c + c**2, 2.0 * c**2 - 2.0, 1.0 - 2.0**0.5 * c + c**2])
    return np.asarray(poles / poles[0])


def _describe_pole(number: float, row: float) -> str:
    return f"each keeps {number:.3g} of the one before, a filter of {-1e3 * row / log(number):.3g} ms"


def _describe_bilinear(number: float, row: float) -> str:
    corner = atan((1.0 - number) / (1.0 + number)) / (pi * row)
    return f"each keeps {number:.3g} of the one before, a low-pass of {corner:.3g} Hz by the bilinear transform"


MEMORY, TWICE, BILINEAR, BUTTERWORTH, MEAN = "memory", "twice", "bilinear", "butterworth", "mean"
KINDS = {
    MEMORY: Kind(_place_pole, lambda _: (), _describe_pole),
    TWICE: Kind(_place_two_poles, lambda _: (), lambda m, row: f"twice, and {_describe_pole(m, row)}"),
    BILINEAR: Kind(_place_pole, lambda _: (LEAST_ROWS,), _describe_bilinear),
    BUTTERWORTH: Kind(
        _place_butterworth,
        lambda _: (LEAST_ROWS, LEAST_ROWS),
        lambda m, row: f"by a Butterworth filter of second order with a corner of {0.5 * (1.0 - m) / row:.3g} Hz",
    ),
    MEAN: Kind(
        lambda _: np.ones(1),
        lambda rows: (round(rows),),
        lambda rows, row: f"each is the mean of {rows:g} rows, over {1e3 * rows * row:.3g} ms",
    ),
}


@dataclass(frozen=True)
class SpeedFilter:
    """A filter that speeds passed before they were logged: a row of `KINDS`, and its number."""

    kind: str
    number: float

    def __str__(self) -> str:
        return f"{self.kind} {self.number:.6g}"

    @property
    def poles(self) -> Floats:
        """The polynomial A, powers of 1/z ascending."""
        return KINDS[self.kind].poles(self.number)

    @property
    def zeros(self) -> Floats:
        """The polynomial B with zeros pulled in, and A's gain at rest."""
        return reduce(np.convolve, map(_make_zeros, KINDS[self.kind].means(self.number)), np.array([self.poles.sum()]))

    def undo(self, speed: Floats, time: Floats | None = None) -> Floats:
        """Compute the speeds (K,) that went in, of those that came out: the first one had long been as it is.

        time: [s] of their rows, shape (K,), of which some may be missing; without, none is.
        """
        number = None if time is None else number_rows(time)
        return self._undo_all(speed) if number is None else self.undo_whole(speed, number)[number]

    def undo_whole(self, speed: Floats, number: Integers) -> Floats:
        """Compute the speeds (R,) that went in at all rows, of those (K,) that were logged of rows of these numbers."""
        kept = max(KINDS[self.kind].means(self.number), default=0)
        return undo_on_whole_rows(self._undo_plainly, speed, number, self.delay, kept)

    def _undo_all(self, speed: Floats) -> Floats:
        return reduce(undo_mean, KINDS[self.kind].means(self.number), self._undo_poles(speed))

    def _undo_plainly(self, speed: Floats) -> Floats:
        """Undo by the polynomials alone, without what was in a mean before the first row."""
        return reduce(_undo_pulled_in, KINDS[self.kind].means(self.number), self._undo_poles(speed))

    def _undo_poles(self, speed: Floats) -> Floats:
        poles = self.poles
        return np.asarray(_filter(poles, [np.sum(poles)], speed - speed[0]) + speed[0])

    def measure_delay_left(self, speed: Floats) -> float:
        """Measure how late [rows] what is computed back of speeds (K,) is, but for counts: zeros are pulled in."""
        means = KINDS[self.kind].means(self.number)
        if all(_count_single_rows(speed, rows) is not None for rows in means):
            return 0.0
        return sum(0.5 * (rows - 1) - float(np.arange(rows) @ _make_zeros(rows)) for rows in means)

    @property
    def log_first(self) -> float:
        """The logarithm of what a speed counts in its own row: the density of what came out is that of x over it."""
        return log(self.zeros[0])

    @property
    def log_likeness(self) -> float:
        """The logarithm of how much larger white noise is behind it than what is new of it in every row."""
        return 0.5 * log(float(self._response @ self._response) / self._response[0] ** 2)

    @property
    def delay(self) -> float:
        """How late it makes slow motion [rows]."""
        return float(np.arange(LASTING) @ self._response)

    @cached_property
    def _response(self) -> Floats:
        """The response (LASTING,) to an impulse."""
        impulse = np.zeros(LASTING)
        impulse[0] = 1.0
        return _filter(self.zeros, self.poles, impulse)

    def describe(self, row: float) -> str:
        """Say what it does in rows of some length [s]."""
        return KINDS[self.kind].describe(self.number, row)


def _filter(zeros: Sequence[float] | Floats, poles: Sequence[float] | Floats, values: Floats) -> Floats:
    """Pass values (K,) through a filter, powers of 1/z ascending; SciPy's takes long to import, and few need it."""
    from scipy.signal import lfilter

    return np.asarray(lfilter(zeros, poles, values))


def undo_mean(values: Floats, rows: int) -> Floats:
    """Compute what went in (K,), of means of so many rows each.

    Counts are whole. Of others, what was in the first rows, before the log, is missing in every so many rows, less from
    time to time. How much shows beside the mean around each row. Rounded digits that are taken for counts walk away.
    """
    counted = _count_single_rows(values, rows)
    return _undo_forgetting(values, rows, _find_around(values, rows)) if counted is None else counted


def _count_single_rows(values: Floats, rows: int) -> Floats | None:
    """Compute the counts of single rows (K,), in the values' unit, of means of so many rows each; None of others."""
    counted = take_single_rows(values, rows)
    if counted is None:
        return None
    around = _find_around(values, rows)
    walks = np.std(counted - around) > WALK * np.std(_undo_forgetting(values, rows, around) - around)
    return None if walks else counted


def _find_around(values: Floats, rows: int) -> Floats:
    """Find the mean around each row (K,), of means of so many rows before each."""
    return np.asarray(np.interp(np.arange(len(values)) + 0.5 * (rows - 1), np.arange(len(values)), values))


def _undo_pulled_in(values: Floats, rows: int) -> Floats:
    """Undo a mean of so many rows by its zeros that are pulled in, as if the first value had long been there, (K,)."""
    return np.asarray(_filter([1.0], _make_zeros(rows), values - values[0]) + values[0])


def _undo_forgetting(values: Floats, rows: int, around: Floats) -> Floats:
    """Compute what went in (K,) with zeros that are pulled in; around: the mean around each row."""
    went_in = _undo_pulled_in(values, rows)
    if np.ptp(values[:rows]) == 0.0:  # it stood
        return went_in
    left = (1.0 - FORGOTTEN) ** (np.arange(len(values)) / rows)
    number = np.arange(len(values)) % rows
    missing = np.bincount(number, left * (went_in - around)) / np.bincount(number, left**2)
    return np.asarray(went_in - missing[number] * left)


def measure_part(rows: int) -> float:
    """Measure which part of a mean of so many rows is its latest one's."""
    return float(_make_zeros(rows)[0])


def _make_zeros(rows: int) -> Floats:
    """Make the polynomial of a mean of so many rows, its zeros pulled in and its gain at rest 1."""
    weights = (1.0 - FORGOTTEN) ** (np.arange(rows) / rows)
    return np.asarray(weights / weights.sum())


def parse_filter(text: str) -> SpeedFilter | None:
    """Read a filter as a model file says it, a kind and its number; None where it says none.

    Raises:
        ModelError: there is no such filter.
    """
    if not text:
        return None
    kind, _, word = text.partition(" ")
    try:
        number = float(word)
    except ValueError:
        number = -1.0
    if (
        kind == MEAN
        and number in range(LEAST_ROWS, MOST_ROWS + 1)
        or kind in KINDS
        and kind != MEAN
        and 0.0 < number < 1.0
    ):
        return SpeedFilter(kind, number)
    raise ModelError(
        f"speed_filter is '{text}', and must be '{MEAN}' and {LEAST_ROWS} to {MOST_ROWS} rows, or one of "
        f"{', '.join(kind for kind in KINDS if kind != MEAN)} and a number between 0 and 1."
    )
