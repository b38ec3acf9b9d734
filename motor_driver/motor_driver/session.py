"""One opened port: what is known of the board on it, and what is due to be sent to it."""

from dataclasses import dataclass, field

from motor_driver.exchange import Exchange
from motor_driver.frames.from_board import Features, Hello, Protection, Telemetry
from motor_driver.frames.from_host import Command, FromHost
from motor_driver.handshake import Handshake, Phase
from motor_driver.output.agreement import Agreement
from motor_driver.output.commands import Commands
from motor_driver.output.switch import Output, Switch
from motor_driver.protocol import Decoder, Encoder

REPEAT = 10_000_000  # [ns] after which an unchanged command is sent again
NUMBERS = 1 << 16  # of frames, which wrap
# Samples, and [ns], for which a board that was switched on may name a command that is not ours: until 1.4.3 an enable
# did not count as one, and what a driver before had sent was the latest until the first command of ours had come.
STRANGE, STRANGE_TIME = 3, 50_000_000


@dataclass
class Session:
    """Lives as long as its port is open; times in ns are arguments."""

    port: str
    handshake: Handshake
    decoder: Decoder = field(default_factory=Decoder)
    encoder: Encoder = field(default_factory=Encoder)
    switch: Switch = field(default_factory=Switch)
    exchange: Exchange | None = None  # while the board runs
    agreement: Agreement | None = None  # likewise
    commands: Commands = field(default_factory=Commands)
    latest: Telemetry | None = None  # since it runs
    heard: int = 0  # [ns] when `latest` was read
    silent: bool = False
    sent: tuple[int, int] | None = None  # latest duty, and when [ns]
    greeted: bool = False
    count: int = 0  # frames sent since it runs
    obeyed: int | None = None  # number of the newest command that it had, while the output is on
    strange: int = 0  # samples since the output is on that name another's command, and none of ours
    strange_since: int = 0  # [ns] when the first of those was read

    @property
    def runs(self) -> bool:
        """Whether the board samples as configured."""
        return self.handshake.phase is Phase.RUN

    @property
    def disturbed(self) -> bool:
        """Whether somebody else has told the board something, and this driver has not made that good yet."""
        return self.agreement is not None and self.agreement.disturbed

    def telling(self, now: int, longest: float) -> float:
        """Find how long [ns] the board may take to say that it does as told, which is twice the `longest` [ns] to obey.

        For an off of the switch's may be under way, or a frame may be lost. 0: it has answered nothing for as long.
        """
        at = self.exchange.answered_at if self.exchange else None
        return 2.0 * longest if at is not None and now - at <= longest else 0.0

    def begin(self, exchange: Exchange, now: int) -> None:
        """The board runs from now on."""
        self.exchange, self.heard, self.silent = exchange, now, False
        self.switch, self.latest, self.sent = Switch(), None, None
        self.count, self.obeyed = 0, None
        self.agreement = self.handshake.agreement()

    def end(self) -> None:
        """The board was reset."""
        self.handshake.begin_again()
        self.exchange = self.agreement = None

    def due(self, now: int, wish: bool, duty: int) -> bytes:
        """What to send now, while the user wants the output on or not, and this duty."""
        frames: list[FromHost | None] = [self.handshake.asks(now)]
        if self.exchange and self.agreement:
            frames.append(self.switch.asks(wish, self.agreement.named, now))
            waits = self.switch.output is Output.TURNING_ON
            frames += self.agreement.asks(now, waits, self.exchange.round_trip or 0)
            frames.append(self.exchange.asks(now))
            if self.switch.listening:
                frames.append(self._command(duty, now))
        due = [frame for frame in frames if frame is not None]
        self.count += len(due)
        data = b""
        for frame in due:
            self.commands.send(frame, self.encoder.seq)
            data += self.encoder.send(frame)
        if not self.greeted:
            self.greeted, data = True, b"\0" + data
        return data

    def hear_told(self, frame: Hello | Features | Protection) -> bool:
        """Take what a board that runs says that it was told; True if somebody else has told it otherwise."""
        return self.agreement is not None and self.agreement.hear(frame)

    def hear_switched(self, frame: Telemetry) -> bool:
        """Tell whether a board that this driver wants on was switched on by somebody else: nobody knows how."""
        return self.agreement is not None and self.agreement.hear_telemetry(frame) and self.switch.listening

    def hear_another(self, frame: Telemetry) -> bool:
        """Tell whether the board has obeyed a command that is not ours, or an old one again: a line keeps the order."""
        before, self.obeyed = self.obeyed, None
        if not (frame.enabled and self.switch.listening):
            self.strange = 0
            return False
        ours = (self.encoder.seq - 1 - frame.command) % NUMBERS < min(self.count, NUMBERS // 2)
        if ours and self.commands.disagree(frame):
            return True
        self.obeyed = frame.command if ours else before
        if before is None:
            return self._is_strange(ours)
        return not (ours and (frame.command - before) % NUMBERS < NUMBERS // 2)

    def _is_strange(self, ours: bool) -> bool:
        """Tell whether the board has obeyed another's commands alone ever since it was switched on, for too long."""
        self.strange_since = self.strange_since if self.strange else self.heard
        self.strange = 0 if ours else self.strange + 1
        return self.strange >= STRANGE and self.heard - self.strange_since >= STRANGE_TIME

    def _command(self, duty: int, now: int) -> Command | None:
        """Say a new duty at once, and go on saying it: the board stops without."""
        if self.sent is not None and self.sent[0] == duty and now - self.sent[1] < REPEAT:
            return None
        self.sent = (duty, now)
        return Command(duty)
