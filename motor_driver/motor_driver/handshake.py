"""From an opened port to a board that samples as configured, and back to the beginning when it was reset."""

from enum import Enum, auto

from motor_driver.config import Config
from motor_driver.frames.codes import ResetCause
from motor_driver.frames.from_board import Features, Hello, OtherVersion, Protection, Telemetry
from motor_driver.frames.from_host import Configure, FromHost, Identify
from motor_driver.output.agreement import LATCHES, Agreement
from motor_model.errors import MotorError

ASK_EVERY = 200_000_000  # [ns]
PATIENCE = 3_000_000_000  # [ns] that a board may take after its port was opened: an Uno is reset by that
OF_A_BOARD = {  # of a hello: what a board keeps until it is flashed, in words
    "board_id": "board_id",
    "board": "chip",
    "channels": "encoder channels",
    "edges_per_revolution": "edges per revolution",
    "tick_ns": "tick [ns]",
    "pwm_top": "steps of duty",  # which goes with its PWM: of a board that is configured as the other was
    "firmware": "firmware",
}
ANOTHER = (
    "This is another board than the one that ran ({}): plug that one in again, or start the driver again to drive this "
    "one's motor; the parameter board_id says which is meant."
)


class Phase(Enum):
    """How far it has come."""

    IDENTIFY = auto()
    SETUP = auto()  # of boards that have a choice
    PROTECT = auto()  # of boards that watch the current
    CONFIGURE = auto()
    RUN = auto()


class Handshake:
    """Asks until it is answered; time in ns is an argument."""

    def __init__(
        self, config: Config, port: str, now: int, roll_call: bool = False, before: Hello | None = None
    ) -> None:
        """`roll_call`: the board is only to say who it is; `before` is the one that ran, on a port that was closed."""
        self._config, self._port, self._roll_call, self._before = config, port, roll_call, before
        self._opened, self._asked = now, now - ASK_EVERY
        self.phase = Phase.IDENTIFY
        self.hello: Hello | None = None  # the latest
        self.refusal = ""  # why the board that answers is not to run, as a sentence
        self._told = 0  # frames since `hello` that switch the board off, each of which adds 1 to its latch
        self._spare = 0  # of those, how many have not acted yet, or are lost, once it runs

    def hear(self, frame: Hello) -> bool:
        """Take a hello; True when the board now runs as configured."""
        if self.hello is not None and frame.boot != self.hello.boot and self.phase is not Phase.IDENTIFY:
            self.begin_again()  # a reset board has forgotten what it was told, its current limits too
        if self.phase is Phase.IDENTIFY:
            self.refusal = self._refusal_of(frame)
            self.hello, self._told = frame, 0
            if not self.refusal and not self._roll_call:
                self._go(Phase.SETUP if self._config.setup(frame) else self._after_setup(frame))
        elif self.phase is Phase.CONFIGURE and self.hello is not None:
            self.refusal = self._refusal_of(frame)
            if self.refusal:  # of a board that says otherwise now
                return False
            done = (frame.sample_period, frame.command_timeout, frame.decay) == self._wanted()
            moved = (frame.latch - self.hello.latch) % LATCHES
            if done and moved >= self._steps():  # not an old answer: to tell a board anything is to switch it off
                return self._end(frame, self._told - moved)
        return False

    def _end(self, frame: Hello, spare: int) -> bool:
        """The board says that it runs as configured; it does unless somebody else has told it something meanwhile."""
        if spare < 0:
            self.begin_again()
            return False
        self.refusal = self._refusal_of(frame, configured=True)
        if self.refusal:
            return False
        self.hello, self._before, self.phase, self._spare = frame, frame, Phase.RUN, spare
        return True

    def agreement(self) -> Agreement:
        """What the board that runs now was told, to be held to.

        Raises:
            MotorError: no board has said who it is.
        """
        return Agreement(self._config, self._known(), self._spare)

    def hear_features(self, features: Features) -> None:
        """Take what holds after a setup; other features than were set up are somebody else's: told again."""
        right = (features.quadrature, features.pwm) == (self._config.quadrature, self._config.pwm)
        if self.phase is Phase.SETUP and right:
            self.refusal = self._config.refusal_of(features)
            if not self.refusal and self.hello is not None:
                self._go(self._after_setup(self.hello))
        elif self.phase in (Phase.PROTECT, Phase.CONFIGURE) and not right:
            self.begin_again()

    def hear_protection(self, held: Protection) -> None:
        """Take what holds after a protect; likewise."""
        wanted = self._config.protect(self.hello) if self.hello else None
        if wanted is None or self.phase not in (Phase.PROTECT, Phase.CONFIGURE):
            return
        right = (held.zero, held.rated, held.budget) == (wanted.zero, wanted.rated, wanted.budget)
        if self.phase is Phase.CONFIGURE and not (right and held.most == wanted.most):
            self.begin_again()
        elif self.phase is Phase.PROTECT and right:
            self.refusal = self._config.refusal_to_protect(held)
            if not self.refusal and held.most == wanted.most:
                self._go(Phase.CONFIGURE)

    def _refusal_of(self, board: Hello, configured: bool = False) -> str:
        """Why this board is not to run; "" if it may. Without a `board_id` the one that ran first is the one meant."""
        if refusal := self._config.refusal(board):
            return refusal
        if self._before is None or self._config.board_id is not None:
            return ""
        return refuse_another(self._before, board, configured)

    def _steps(self) -> int:
        """How many frames the board was told that add 1 to its latch, each counted once."""
        hello = self._known()
        return 1 + sum(told is not None for told in (self._config.setup(hello), self._config.protect(hello)))

    def _after_setup(self, hello: Hello) -> Phase:
        return Phase.PROTECT if self._config.protect(hello) else Phase.CONFIGURE

    def refuse(self, other: OtherVersion) -> None:
        """A frame of another version came."""
        self.refusal = str(other.error(self._port))

    def reset_in(self, frame: Telemetry | Hello) -> bool:
        """Whether this shows that the board was reset while it ran."""
        return self.phase is Phase.RUN and self.hello is not None and frame.boot != self.hello.boot

    def begin_again(self) -> None:
        """The board was reset."""
        self._go(Phase.IDENTIFY)

    def asks(self, now: int) -> FromHost | None:
        """What to send at `now`."""
        if self.phase is Phase.RUN or now - self._asked < ASK_EVERY:
            return None
        self._asked = now
        frame = self._next()
        self._told += not isinstance(frame, Identify)
        return frame

    def _next(self) -> FromHost | None:
        if self.phase is Phase.SETUP and self.hello is not None:
            return self._config.setup(self.hello)
        if self.phase is Phase.PROTECT and self.hello is not None:
            return self._config.protect(self.hello)
        return Configure(*self._wanted()) if self.phase is Phase.CONFIGURE else Identify()

    @property
    def matches(self) -> bool:
        """Whether a board that was only to say who it is may be the one."""
        return self._roll_call and self.hello is not None and not self.refusal

    def problem(self, now: int) -> str:
        """What keeps the board from running, as a sentence; empty if nothing does, or it is too early to say."""
        if self.matches:
            return ""
        if self.refusal or self.phase is Phase.RUN or now - self._opened < PATIENCE:
            return self.refusal
        return (
            f"Nothing on {self._port} answers as a motor board: flash it (ros2 run motor_board flash), or set the "
            f"parameter baud ({self._config.baud}) to that of its firmware."
        )

    def _wanted(self) -> tuple[int, int, int]:
        configure = self._config.configure(self._known())
        return configure.sample_period, configure.command_timeout, configure.decay

    def _known(self) -> Hello:
        if self.hello is None:
            raise MotorError("the board has not said who it is; this is a mistake in the driver: report it.")
        return self.hello

    def _go(self, phase: Phase) -> None:
        self.phase, self._asked = phase, self._asked - ASK_EVERY
        self.refusal = ""


def reset_cause(hello: Hello) -> str:
    """In words."""
    names = [cause.name.lower().replace("_", " ") for cause in ResetCause if hello.reset_cause & cause and cause.name]
    return ", ".join(names) or "unknown cause"


def refuse_another(before: Hello, board: Hello, configured: bool) -> str:
    """Say why a board is not the one that ran `before`, which drives another motor; "" if nothing tells them apart.

    Until it is `configured` as that one was, its steps of duty tell nothing: a reset board has those of its first PWM.
    """
    found = [(name, getattr(board, name), getattr(before, name)) for name in OF_A_BOARD]
    differ = {name: f"{OF_A_BOARD[name]} {now} instead of {was}" for name, now, was in found if now != was}
    if not configured and set(differ) == {"pwm_top"}:
        return ""
    return ANOTHER.format(", ".join(differ.values())) if differ else ""
