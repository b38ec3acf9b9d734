"""From an opened port to a board that samples as configured, and back to the beginning when it was reset."""

from enum import Enum, auto

from motor_driver.config import Config
from motor_driver.frames.codes import ResetCause
from motor_driver.frames.from_board import Features, Hello, OtherVersion, Protection, Telemetry
from motor_driver.frames.from_host import Configure, FromHost, Identify
from motor_model.errors import MotorError

ASK_EVERY = 200_000_000  # [ns]
PATIENCE = 3_000_000_000  # [ns] that a board may take after its port was opened: an Uno is reset by that
OF_A_BOARD = {  # of a hello: what a board keeps until it is flashed, in words
    "board_id": "board_id",
    "board": "chip",
    "channels": "encoder channels",
    "edges_per_revolution": "edges per revolution",
    "tick_ns": "tick [ns]",
    "pwm_top": "steps of duty",
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

    def hear(self, frame: Hello) -> bool:
        """Take a hello; True when the board now runs as configured."""
        if self.hello is not None and frame.boot != self.hello.boot and self.phase is not Phase.IDENTIFY:
            self.begin_again()  # a reset board has forgotten what it was told, its current limits too
        if self.phase is Phase.IDENTIFY:
            self.refusal = self._refusal_of(frame)
            self.hello = frame
            if not self.refusal and not self._roll_call:
                self._go(Phase.SETUP if self._config.setup(frame) else self._after_setup(frame))
        elif self.phase is Phase.CONFIGURE and self.hello is not None:
            self.refusal = self._refusal_of(frame)
            if self.refusal:  # of a board that says otherwise now
                return False
            done = (frame.sample_period, frame.command_timeout, frame.decay) == self._wanted()
            if done and frame.latch != self.hello.latch:  # not an old answer: to configure is to switch off
                self.hello, self._before, self.phase = frame, frame, Phase.RUN
                return True
        return False

    def hear_features(self, features: Features) -> None:
        """Take what holds after a setup."""
        if self.phase is Phase.SETUP and features.quadrature == self._config.quadrature:
            self.refusal = self._config.refusal_of(features)
            if not self.refusal and self.hello is not None:
                self._go(self._after_setup(self.hello))

    def hear_protection(self, held: Protection) -> None:
        """Take what holds after a protect."""
        wanted = self._config.protect(self.hello) if self.phase is Phase.PROTECT and self.hello else None
        if wanted is None or (held.zero, held.rated, held.budget) != (wanted.zero, wanted.rated, wanted.budget):
            return
        self.refusal = self._config.refusal_to_protect(held)
        if not self.refusal and held.most == wanted.most:
            self._go(Phase.CONFIGURE)

    def _refusal_of(self, board: Hello) -> str:
        """Why this board is not to run; "" if it may. Without a `board_id` the one that ran first is the one meant."""
        if refusal := self._config.refusal(board):
            return refusal
        return refuse_another(self._before, board) if self._before and self._config.board_id is None else ""

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
        if self.hello is None:
            raise MotorError("the board has not said who it is; this is a mistake in the driver: report it.")
        configure = self._config.configure(self.hello)
        return configure.sample_period, configure.command_timeout, configure.decay

    def _go(self, phase: Phase) -> None:
        self.phase, self._asked = phase, self._asked - ASK_EVERY
        self.refusal = ""


def reset_cause(hello: Hello) -> str:
    """In words."""
    names = [cause.name.lower().replace("_", " ") for cause in ResetCause if hello.reset_cause & cause and cause.name]
    return ", ".join(names) or "unknown cause"


def refuse_another(before: Hello, board: Hello) -> str:
    """Say why a board is not the one that ran `before`, which drives another motor; "" if nothing tells them apart."""
    found = ((words, getattr(board, name), getattr(before, name)) for name, words in OF_A_BOARD.items())
    other = ", ".join(f"{words} {now} instead of {was}" for words, now, was in found if now != was)
    return ANOTHER.format(other) if other else ""
