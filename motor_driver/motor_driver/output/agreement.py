"""Whether a board that runs still does as this driver told it: before it is switched on, that has to be sure.

Nothing on the line says whose a frame is: what another program, or a device that sends old bytes again, tells the board
of decay, PWM, time-out or current limits acts, and the next voltage would be another one than was asked for. Each such
frame switches off and adds 1 to the board's latch, as ours do. So an enable names the latch with which the board said
that all is as this driver told it: a board that has been told anything since does not switch on. Where the latch has
moved since for any reason, the board is told everything again, in one breath, before the next enable.
"""

from dataclasses import replace

from motor_driver.config import Config
from motor_driver.frames.from_board import Features, Hello, Protection, Telemetry
from motor_driver.frames.from_host import Configure, FromHost, Protect, Setup

LATCHES = 256
TRIES = 4  # times that the board is told within what an answer may take


class Agreement:
    """Follows what the board says that it was told; times in ns are arguments."""

    def __init__(self, config: Config, board: Hello, spare: int = 0) -> None:
        """`board` is the hello by which it runs as told; `spare` frames that switch it off may still be under way."""
        told: tuple[FromHost | None, ...] = (config.setup(board), config.protect(board), config.configure(board))
        self._told = [frame for frame in told if frame is not None]
        self._board, self._spare = board, spare
        self.named: Hello | None = board  # whose boot and latch an enable may name; None: what it was told is not sure
        self.disturbed = False  # somebody else has told the board something, and it was not told again since
        self._every = round(config.round_trip * 1e9 / TRIES)
        self._latest: int | None = None  # [ns] when it was told again
        self._from, self._sent = 0, 0  # latch before that, and frames that may have acted since
        self._heard: set[type] = set()  # answers that are as they should be

    @property
    def latch(self) -> int | None:
        """The latch that an enable may name; None: not yet."""
        return self.named.latch if self.named is not None else None

    def hear_telemetry(self, frame: Telemetry) -> bool:
        """Take the latch that a sample names; True if the board was switched on by somebody else."""
        if self.named is not None and frame.latch == self.named.latch:
            return False
        if frame.enabled:
            return True
        if self.named is None:
            self._from = self._from if self._sent else frame.latch
            return False
        if not self._explain(frame.latch):
            self._doubt(frame.latch)
        return False

    def hear(self, frame: Hello | Features | Protection) -> bool:
        """Take what the board says that it was told; True if somebody else has told it otherwise."""
        if not self._agrees(frame):
            known = self._from if self.latch is None else self.latch
            self._doubt(frame.latch if isinstance(frame, Hello) else known)
            self.disturbed = True
            return True
        self._heard.add(type(frame))
        if isinstance(frame, Hello):
            self._hear_hello(frame)
        return False

    def asks(self, now: int, wish: bool, took: int = 0) -> list[FromHost]:
        """What to tell the board again at `now`: before it is switched on, or where somebody has told it otherwise.

        The latest answer `took` so long [ns]: what is under way is not sent again, and what is lost is, soon after.
        """
        sure = self.named is not None or not (wish or self.disturbed)
        if sure or (self._latest is not None and now - self._latest < self._every + took):
            return []
        self._latest = now
        self._sent += len(self._told)
        return self._told

    def _hear_hello(self, hello: Hello) -> None:
        if self.named is not None:
            self._explain(hello.latch)
            return
        moved = (hello.latch - self._from) % LATCHES
        if moved == 0:  # of before any of it acted
            return
        ours = moved <= self._sent and moved % len(self._told) == 0
        if ours and self._answered():
            self.named, self._spare, self.disturbed = hello, self._sent - moved, False
            return
        # Somebody else's frames among ours, or the switch's own from before, or some of ours are lost: once more.
        self._from, self._sent = hello.latch, max(self._sent - moved, 0)
        self._latest, self._heard = None, set()

    def _answered(self) -> bool:
        kinds = {Setup: Features, Protect: Protection, Configure: Hello}
        return all(kinds[type(frame)] in self._heard for frame in self._told if type(frame) in kinds)

    def _agrees(self, frame: Hello | Features | Protection) -> bool:
        if isinstance(frame, Hello):
            return replace(frame, latch=self._board.latch, reset_cause=self._board.reset_cause) == self._board
        for told in self._told:
            if isinstance(told, Setup) and isinstance(frame, Features):
                return (frame.quadrature, frame.pwm) == (told.quadrature, told.pwm)
            if isinstance(told, Protect) and isinstance(frame, Protection):
                held = (frame.zero, frame.most, frame.rated, frame.budget)
                return held == (told.zero, told.most, told.rated, told.budget)
        return True  # of what this driver leaves alone

    def _explain(self, latch: int) -> bool:
        """Whether frames of our own that were under way explain that the latch has moved on, which it then has."""
        if self.named is None or (moved := (latch - self.named.latch) % LATCHES) > self._spare:
            return False
        self.named, self._spare = replace(self.named, latch=latch), self._spare - moved
        return True

    def _doubt(self, latch: int) -> None:
        self.named, self._latest = None, None
        self._from, self._sent, self._heard = latch, 0, set()
