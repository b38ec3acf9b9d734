"""The board's wrapping counter as continuous nanoseconds, exact, that go on through wraps, gaps and resets."""

WRAP = 1 << 32  # [tick]
POWER_UP = 1_000_000_000  # [ns] at tick 0, as in the simulation: no edge can be at 0, which means "none yet"
FUTURE = 1_000_000_000  # [ns] by which the board's time may run ahead of what the host's clock lets expect
RATE = 0.02  # likewise, share of the time since the reference: more than any resonator is off
LATE = 500_000_000  # [ns] times read later than this after they were said are no reference
STALE = 600_000_000_000  # [ns] but a reference is not to become older than this


class BoardClock:
    """Unwraps 32-bit times. Its nanoseconds count the board's ticks: the crystal's error is in them, jitter is not."""

    def __init__(self, tick: int) -> None:
        """`tick` is in ns."""
        self._tick = tick
        self._zero = POWER_UP  # [ns] at the board's tick 0
        self._ticks: int | None = None  # newest time heard, unwrapped [tick]
        self._reference = (0, 0)  # a time [tick] and the host's clock [ns] when it was read, not late

    @property
    def newest(self) -> int:
        """[ns] the newest time heard."""
        return self._zero + (self._ticks or 0) * self._tick

    def hear(self, time: int, host: int, resumed: bool = False) -> bool:
        """Take a time [tick] that was read at `host` [ns]; False, and nothing is taken, if it does not go on.

        That is, it would lie before the newest or in the future. Bytes may be read late, even very late, so a time may
        be old; but not the first one from a port that was just opened (`resumed`): that is how a board is found out
        that has started anew meanwhile.
        """
        if self._ticks is None:
            self._take(time, host)
            return True
        ticks, elapsed = self._reference[0], host - self._reference[1]
        slack = FUTURE + round(RATE * abs(elapsed))
        latest = ticks + (elapsed + slack) // self._tick
        first = self._ticks + 1 + (time - self._ticks - 1) % WRAP  # the earliest it can be
        ticks = first + max(0, (latest - first) // WRAP) * WRAP
        if ticks > latest or (resumed and ticks < latest - 2 * slack // self._tick):
            return False
        self._take(ticks, host)
        return True

    def restart(self, time: int, host: int, tick: int) -> None:
        """The board, or another with ticks of `tick` ns, counts anew: the nanoseconds go on by the host's clock."""
        if self._ticks is not None:
            ticks, then = self._reference
            expected = self._zero + ticks * self._tick + host - then
            now = max(expected // tick * tick, self.newest + tick)
            self._zero = now - time * tick
        self._ticks, self._tick = None, tick
        self._take(time, host)

    def near(self, time: int) -> int:
        """[ns] of an instant [tick] less than 2^31 ticks from the newest."""
        ahead = (time - (self._ticks or 0) + WRAP // 2) % WRAP - WRAP // 2
        return self.newest + ahead * self._tick

    def before(self, time: int) -> int:
        """[ns] of an instant [tick] that is the newest or up to 2^32 − 1 ticks before it."""
        return self.newest - ((self._ticks or 0) - time) % WRAP * self._tick

    def _take(self, ticks: int, host: int) -> None:
        begun, then = self._reference
        late = (host - then) - (ticks - begun) * self._tick
        if self._ticks is None or late < LATE + RATE * (host - then) or host - then > STALE:
            self._reference = (ticks, host)
        self._ticks = ticks
