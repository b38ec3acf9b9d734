"""Pings and pongs: the two-way exchange that ties the board's clock to the host's, and shows a link that is late.

A link that holds bytes back for a second (a wireless adapter, a network, buffers that fill up) loses nothing, so that
no time-out sees it: the motor does what was right a second ago, and goes on for a second after its driver has died.
"""

from dataclasses import dataclass
from math import inf

from motor_driver.clock.board_clock import BoardClock
from motor_driver.clock.clock_fit import ClockFit
from motor_driver.frames.from_board import Pong, Telemetry
from motor_driver.frames.from_host import Ping
from motor_driver.frames.table import Frame
from motor_driver.protocol import LEAST

PING_EVERY = 20_000_000  # [ns]
MEMORY = 64  # pings that may still be answered
# Answers that took too long in a row; a driver that was held up finds one or two. Those that take too long already
# count beside two that have come: who waits for all five stops a motor a third later. Alone they do not, for a noisy
# line loses some; what it does not lose comes in time.
LATE, COME = 5, 2
DEAF = (
    500_000_000  # [ns] of pings without any answer beyond what one may take: no noise that lets a motor run does that
)
BITS = 10  # a byte on the line, start and stop bit included


@dataclass(frozen=True, slots=True)
class BoardCounters:
    """What the board has counted, modulo 2^16."""

    bad_frames: int = 0  # from the host
    dropped_samples: int = 0


class Exchange:
    """Feeds a clock fit with when frames were sent and read; host times in ns of a monotonic clock."""

    def __init__(self, baud: int, drift: float = 0.0, longest: float = inf) -> None:
        """`longest` [s]: what an answer may take."""
        self._longest, self._late, self._overdue = longest * 1e9, 0, 0
        self._byte = BITS * 1e9 / baud  # [ns]
        self.fit = ClockFit(drift)
        self.board = BoardCounters()
        self.round_trip: int | None = None  # [ns] latest
        self._sent: dict[int, int] = {}
        self._token, self._latest = 0, -PING_EVERY
        self._answered = 0  # the token of the newest answer
        self.answered_at: int | None = None  # [ns] when that was read

    @property
    def late(self) -> bool:
        """Whether the link holds back what goes over it."""
        return self._late >= COME and self._late + self._overdue >= LATE

    @property
    def deaf(self) -> bool:
        """Whether the board answers nothing, as where what is sent does not reach it; of a driver that asks."""
        return (self._token - self._answered) * PING_EVERY > self._longest + DEAF

    def look(self, now: int) -> None:
        """Look which pings after the newest answer take too long at `now` already."""
        self._overdue = sum(token > self._answered and now - at > self._longest for token, at in self._sent.items())

    def asks(self, now: int) -> Ping | None:
        """A ping, if one is due at `now`, which is taken for when it is written."""
        if now - self._latest < PING_EVERY:
            return None
        self._token, self._latest = (self._token + 1) & 0xFFFFFFFF, now
        self._sent[self._token] = now
        if len(self._sent) > MEMORY:
            del self._sent[next(iter(self._sent))]
        return Ping(self._token)

    def hear_pong(self, pong: Pong, clock: BoardClock, host: int) -> None:
        """Take an answer read at `host`."""
        sent = self._sent.pop(pong.token, None)
        self._answered, self.answered_at = pong.token, host
        self.look(host)
        self.board = BoardCounters(pong.bad_frames, pong.dropped_samples)
        if sent is None:
            self._late += pong.token <= self._token  # of ours, and given up long ago
            return
        received, answered = clock.near(pong.received), clock.near(pong.sent)
        self.round_trip = host - sent - (answered - received)
        self._late = self._late + 1 if self.round_trip > self._longest else 0
        self.fit.before(received, sent + self._line_time(Ping))
        self.fit.after(answered, host - self._line_time(Pong))

    def hear_telemetry(self, board: int, host: int) -> int:
        """Take a sample's time [ns] and when it was read; the sample's instant on the host's clock."""
        read = host - self._line_time(Telemetry)
        self.fit.after(board, read)
        return self.fit.fit.host(board) if self.fit.fit else read

    def _line_time(self, kind: type[Frame]) -> int:
        """[ns] that a frame takes on the line, from the start of its first byte to the start of its last."""
        return round((LEAST + kind.BODY.size + 1) * self._byte)
