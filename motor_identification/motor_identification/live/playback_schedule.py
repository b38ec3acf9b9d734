"""When each message of a bag is due: on one time line from the start, so that no error adds up."""

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

_SLICE = 0.1  # [s] how long a pause takes at most to notice Ctrl-C
_LONE_ROUND = 1.0  # [s] a round with a single message


@dataclass
class Schedule:
    """Round after round; a round ends one mean spacing behind its last message, so that the next one continues it."""

    rate: float  # times as fast
    played: int = 0
    late: deque[float] = field(default_factory=lambda: deque(maxlen=100_000))  # [s] of the latest messages
    _started: float | None = None  # [s] on the monotonic clock, of this round
    _first: int = 0  # [ns] log time
    _last: int = 0
    _count: int = 0  # messages of this round

    def begin(self, first: int) -> None:
        """The first message of a round is here."""
        self._started = time.monotonic() if self._started is None else self._started + self._round() / self.rate
        self._first, self._count = first, 0

    def wait(self, log_time: int, interrupted: Callable[[], bool]) -> bool:
        """Sleep until the message is due, and count it; False where Ctrl-C came first."""
        due = (self._started or 0.0) + self.elapsed(log_time) / self.rate
        while (left := due - time.monotonic()) > 0.0:
            if interrupted():
                return False
            time.sleep(min(left, _SLICE))
        if interrupted():
            return False
        self.late.append(time.monotonic() - due)
        self._last = log_time
        self._count += 1
        self.played += 1
        return True

    def elapsed(self, log_time: int) -> float:
        """[s] since the first message of the round, as recorded."""
        return (log_time - self._first) * 1e-9

    def gap(self, log_time: int) -> float:
        """[s] since the message before in this round, as recorded; 0 for its first."""
        return (log_time - self._last) * 1e-9 if self._count else 0.0

    @property
    def held_up(self) -> float:
        """[s] by which the latest message was later than the one before: playing stood still."""
        return self.late[-1] - self.late[-2] if len(self.late) > 1 else 0.0

    def late_at_most(self, share: float) -> float:
        """[s] by which that share of the latest messages was late at most; 0 without any."""
        late = sorted(self.late)
        return late[min(len(late) - 1, int(share * len(late)))] if late else 0.0

    def _round(self) -> float:
        length = self.elapsed(self._last)
        return length * self._count / (self._count - 1) if self._count > 1 and length else _LONE_ROUND
