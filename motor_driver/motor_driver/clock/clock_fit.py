"""The board's clock on the host's clock: a line between what must have been before and what must have been after.

Let h(b) be the host's time at the board's time b. Bytes travel forward in time only, so whatever was sent by the board
at b and read by the host at y shows h(b) ≤ y, and whatever was sent by the host at x and there at b shows h(b) ≥ x.
The line runs in the middle of the widest straight gap between the two clouds. Delays of any size and distribution only
leave slack; equal least delays both ways cancel, as in NTP (RFC 5905, section 8, with its minimum filter); the slope is
that of the convex hulls (Zhang, Liu, Xia: Clock synchronization algorithms for network measurements, INFOCOM 2002).

What all lines through the gap leave open is the stated bound. It holds for a rate that changes by up to WANDER; for
that, constraints loosen with age by WANDER·age²/2.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

WINDOW = 30_000_000_000  # [ns]
BUCKET = 500_000_000  # [ns] the tightest of each kind stays
MOST_DRIFT = 0.02  # ceramic resonators are off by up to 0.005
WANDER = 0.2e-6  # [1/s] change of rate per second, 12 ppm a minute: more than a warming crystal shows
ARM = 2.0  # [s] constraints closer together in time do not change the slope
TORN = 5_000_000  # [ns] beyond the bound: a clock has stood still or was set
STEADY = 0.5  # [s] between fits, once the window is long
GOLDEN, STEPS = 0.6180339887498949, 50  # of searches for a slope: to 2e-12


@dataclass(frozen=True, slots=True)
class Fit:
    """host = board + offset + drift·(board − at), all in ns but `drift`."""

    at: int
    offset: int
    drift: float
    bound: float  # [ns] the line is not further off than this, up to STEADY after `at`

    def host(self, board: int) -> int:
        """[ns] the host's clock at the board's time [ns]."""
        return board + self.offset + round(self.drift * (board - self.at))


class ClockFit:
    """Collects constraints and fits the line when enough new ones have come."""

    def __init__(self, drift: float = 0.0) -> None:
        """`drift` is where to start from."""
        self._after: deque[tuple[int, int]] = deque()  # board, host [ns]
        self._before: deque[tuple[int, int]] = deque()
        self._drift = drift
        self._next = 0  # [ns] board's time of the next fit
        self.fit: Fit | None = None

    def after(self, board: int, host: int) -> None:
        """What left the board at `board` was read at `host`."""
        self._doubt(board, host, 1)
        self._keep(self._after, board, host, 1)
        if self._before and board >= self._next:
            self._fit(board)

    def before(self, board: int, host: int) -> None:
        """What left the host at `host` was there at `board`."""
        self._doubt(board, host, -1)
        self._keep(self._before, board, host, -1)

    def _doubt(self, board: int, host: int, sign: int) -> None:
        """Start anew if this cannot be: then what was before says nothing any more."""
        if self.fit and sign * (host - self.fit.host(board)) < -self.fit.bound - TORN:
            self._after.clear()
            self._before.clear()
            self.fit = None

    def _keep(self, kept: deque[tuple[int, int]], board: int, host: int, sign: int) -> None:
        """Keep the tightest of each bucket, and none older than the window."""
        if not kept or board // BUCKET > kept[-1][0] // BUCKET:
            kept.append((board, host))
        elif sign * (self._residual(board, host) - self._residual(*kept[-1])) < 0:
            kept[-1] = (board, host)
        while kept[0][0] < board - WINDOW:
            kept.popleft()

    def _residual(self, board: int, host: int) -> float:
        return host - board - self._drift * (board - self._after[0][0] if self._after else 0)

    def _fit(self, board: int) -> None:
        start = min(self._after[0][0], self._before[0][0])
        horizon = min(STEADY, max(0.02, (board - start) * 1e-9 / 20.0))  # [s] the fit is used up to here
        at, base = board + round(horizon * 1e9), self._after[-1][1] - self._after[-1][0]
        gap = _Gap(_relative(self._after, at, base), _relative(self._before, at, base))
        self._drift = gap.best(self._drift)
        offset, bound = gap.middle(self._drift)
        self.fit = Fit(at, base + round(offset * 1e9), self._drift, bound * 1e9)
        self._next = at


def _relative(points: deque[tuple[int, int]], at: int, base: int) -> tuple[Floats, Floats]:
    """Board time [s] before `at` and host − board − base [s]."""
    rows = np.array([(board - at, host - board - base) for board, host in points], dtype=np.float64)
    return rows[:, 0] * 1e-9, rows[:, 1] * 1e-9


class _Gap:
    """Lines a + d·t (t ≤ 0, the present at 0) below `after` and above `before`."""

    def __init__(self, after: tuple[Floats, Floats], before: tuple[Floats, Floats]) -> None:
        self._after = _hull(after[0], after[1] + 0.5 * WANDER * after[0] ** 2)
        self._before = _hull(before[0], -(before[1] - 0.5 * WANDER * before[0] ** 2))  # upside down

    def top(self, drift: float) -> float:
        """The highest line of this slope: its value now."""
        return min([y - drift * s for s, y in self._after])

    def bottom(self, drift: float) -> float:
        """The lowest one."""
        return -min([x + drift * t for t, x in self._before])

    def width(self, drift: float) -> float:
        """Room between both; a concave function of the slope, negative if there is none."""
        return self.top(drift) - self.bottom(drift)

    def best(self, prior: float) -> float:
        """The slope at which the gap is widest; the prior one if that is as good."""
        return _highest(lambda d: self.width(d) - ARM * abs(d - prior))

    def middle(self, drift: float) -> tuple[float, float]:
        """Value now, and bound of its error, for the line of this slope in the middle of the gap."""
        lacking = max(0.0, -self.width(drift)) + 1e-9  # where no line fits, all constraints give way alike
        top = self.top(_edge(lambda d: self.width(d) + lacking, drift, MOST_DRIFT)) + 0.5 * lacking
        bottom = self.bottom(_edge(lambda d: self.width(d) + lacking, drift, -MOST_DRIFT)) - 0.5 * lacking
        value = 0.5 * (self.top(drift) + self.bottom(drift))
        return value, max(top - value, value - bottom) + lacking


def _hull(time: Floats, height: Floats) -> list[tuple[float, float]]:
    """The few points, times ascending, that a line can touch from below (Andrew's monotone chain)."""
    hull: list[tuple[float, float]] = []
    for t, y in zip(time.tolist(), height.tolist(), strict=True):
        while len(hull) > 1:
            (a, at_a), (b, at_b) = hull[-2:]
            if (b - a) * (y - at_a) > (at_b - at_a) * (t - a):
                break
            hull.pop()
        hull.append((t, y))
    return hull


def _highest(function: Callable[[float], float]) -> float:
    """Where a concave function of the drift is highest (golden section)."""
    low, high = -MOST_DRIFT, MOST_DRIFT
    a, b = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_a, at_b = function(a), function(b)
    for _ in range(STEPS):
        if at_a < at_b:
            low, a, at_a = a, b, at_b
            b = low + GOLDEN * (high - low)
            at_b = function(b)
        else:
            high, b, at_b = b, a, at_a
            a = high - GOLDEN * (high - low)
            at_a = function(a)
    return 0.5 * (low + high)


def _edge(function: Callable[[float], float], inside: float, limit: float) -> float:
    """How far a concave function stays positive from `inside` toward `limit` (bisection)."""
    if function(limit) >= 0.0:
        return limit
    outside = limit
    for _ in range(STEPS):
        middle = 0.5 * (inside + outside)
        inside, outside = (middle, outside) if function(middle) >= 0.0 else (inside, middle)
    return outside
