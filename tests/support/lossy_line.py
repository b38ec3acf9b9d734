"""Driver, gate and the firmware's core in lockstep over a line that loses, doubles, delays and reorders frames.

A turn is one sample tick: the board's frames go to the driver, what the driver orders goes to the board. A fault meets
the frames that leave either side in some turns. The user sends VOLTAGE all the time, and calls motor/enable at times.
"""

from ctypes import byref
from dataclasses import dataclass, field

from core_board import CoreBoard

from motor_driver.config import Config
from motor_driver.driver import Driver
from motor_driver.frames.table import Frame
from motor_driver.protocol import Arrival, Decoder, Encoder
from motor_ros.gate import Gate

TURN = 5_000_000  # [ns]
TICKS = 10_000  # of the board in a turn
TIMEOUT = 25  # [turn] 0.12 s of the board, and one until it looks
VOLTAGE, DUTY = 6.0, 128
SETTLED = 60  # [turn] after which all that a fault has left is over
KINDS = "lost", "doubled", "delayed", "held", "swapped"
ACTS = "on", "off", "trip", "reset", "plug", "hang", "wake"


@dataclass(frozen=True)
class Fault:
    """What happens to frames that leave one side in some turns."""

    kind: str = "lost"  # of KINDS
    to_board: bool = True
    first: int = 1 << 30  # [turn]
    turns: int = 1
    delay: int = 2  # [turn] of what is delayed, by so much each, or held, until then

    def meets(self, turn: int, to_board: bool) -> bool:
        """Whether it is in the way of a frame that leaves now."""
        return to_board == self.to_board and self.first <= turn < self.first + self.turns

    @property
    def age(self) -> int:
        """[turn] that a frame may come late."""
        return {"delayed": self.delay, "held": self.turns + self.delay, "swapped": 1}.get(self.kind, 0)


@dataclass
class Line:
    """Frames on their way, in the order in which they come."""

    to_board: bool
    faults: tuple[Fault, ...]
    waiting: list[tuple[int, int, Frame]] = field(default_factory=list)  # turn, number, frame
    number: int = 0

    def pass_on(self, frames: list[Frame], turn: int) -> list[Frame]:
        """What comes in this turn."""
        for frame in frames:
            self._send(frame, turn)
        self.waiting.sort(key=lambda one: one[:2])
        due = [frame for at, _, frame in self.waiting if at <= turn]
        self.waiting = [one for one in self.waiting if one[0] > turn]
        return due

    def _send(self, frame: Frame, turn: int) -> None:
        self.number += 1
        at, number, copies = turn, 2 * self.number, 1
        for fault in self.faults:
            if fault.meets(turn, self.to_board):
                copies = {"lost": 0, "doubled": 2 * copies}.get(fault.kind, copies)
                at = {"delayed": turn + fault.delay, "held": fault.first + fault.turns + fault.delay}.get(
                    fault.kind, at
                )
                number += 5 if fault.kind == "swapped" else 0  # behind the next two
        self.waiting += [(at, number, frame)] * copies


@dataclass
class LossyLink:
    """The whole of it; `run` it turn by turn."""

    faults: tuple[Fault, ...] = ()
    turn: int = 0

    def __post_init__(self) -> None:
        self.board, self.driver = CoreBoard(), Driver(Config(stall_time=0.0))
        self.gate = Gate(True, 0.1, TURN * 1e-9).come_up(self.now)
        self.to_board, self.from_board = Line(True, self.faults), Line(False, self.faults)
        self.stops: list[tuple[int, str]] = []
        self.hung = False  # the driver's computer
        self._encoder, self._decoder = Encoder(), Decoder()  # between lists of frames and the driver's bytes
        self._begun, self._ordered = 0, b""
        self.driver.opened("the port", self.now)

    @property
    def now(self) -> int:
        """[ns] the host's clock."""
        return 10**15 + self.turn * TURN

    @property
    def duty(self) -> int:
        """At the pins."""
        return int(self.board.device.output.duty)

    def enable(self, on: bool) -> bool:
        """Call motor/enable, as the plant answers it."""
        was_on = self.gate.enabled
        self._order()
        refusal = (self.gate.refusal(self.now) or self.driver.refusal()) if on else ""
        if refusal or (on and was_on and not self.gate.enabled):
            return False
        self.gate = self.gate.enable(on)
        self._order()
        return True

    def trip(self) -> None:
        """The board switches off, as for too much current."""
        if self.board.device.output.on:
            self.board.lib.output_off(byref(self.board.device.output))
            self.board.device.guard.tripped = 1

    def reset(self) -> None:
        """The board starts anew."""
        boot, seq = (self.board.device.output.boot + 1) % 256, self.board.seq
        self.board.lib.device_start(byref(self.board.device), byref(self.board.config), boot, 1)
        self.board.now, self.board.compare, self.board.seq = 0, TICKS, seq

    def plug(self) -> None:
        """The port is gone, and open again."""
        self.to_board.waiting, self.from_board.waiting = [], []
        self.driver.closed("the port is gone")
        self._order()
        self.driver.opened("the port", self.now)

    def run(self) -> None:
        """One turn."""
        self.turn += 1
        self.board.step()
        heard = self.from_board.pass_on(self.board.hear(), self.turn)
        self.gate = self.gate.take(VOLTAGE if self.gate.begun else 0.0, self.now, "user", self.turn)
        if not self.hung:
            self.driver.received(b"".join(self._encoder.send(frame) for frame in heard), self.now)
            self._order()
        said, self._ordered = self._decoder.receive(self._ordered), b""
        frames = [event.frame for event in said if isinstance(event, Arrival)]
        for frame in self.to_board.pass_on(frames, self.turn):
            self.board.send(frame)

    def _order(self) -> None:
        if self.driver.runs_begun > self._begun:
            self._begun = self.driver.runs_begun
            self.gate = self.gate.come_up(self.now)
        order = self.driver.step(self.now, self.gate.enabled, self.gate.voltage(self.now))
        self._ordered += order.data
        if order.stop:
            self.stops.append((self.turn, order.stop))
            self.gate = self.gate.stop_motor(order.stop, self.now) if order.motor else self.gate.stop(order.stop)

    def do(self, act: str) -> None:
        """What a user or the world does: one of ACTS."""
        match act:
            case "trip":
                self.trip()
            case "reset":
                self.reset()
            case "plug":
                self.plug()
            case "hang" | "wake":
                self.hung = act == "hang"
            case _:
                self.enable(act == "on")

    @property
    def wants_on(self) -> bool:
        """Whether the driver has asked the board on, or is about to hear that it is."""
        session = self.driver.session
        return session is not None and session.latest is not None and session.switch.listening


def faulty_turn(acts: dict[int, list[str]], faults: tuple[Fault, ...], turns: int) -> str:
    """Run it; the first turn in which the motor is driven that should not be, in words, or how it ends wrongly.

    After the user's or the driver's stop there is 0 V within the board's time-out; after the board's own at once; and
    both last until motor/enable says on. When all faults are over the pins are as the gate says.
    """
    link = LossyLink(faults)
    age = max((fault.age for fault in faults), default=0)
    void: int | None = None  # [turn] since which there is no wish that the motor be driven
    fell: int | None = None  # likewise, since which the board is off by itself
    for turn in range(1, turns):
        for act in acts.get(turn, []):
            was_on = bool(link.board.device.output.on) and link.wants_on
            link.do(act)
            void = None if act == "on" and link.gate.enabled else turn if act == "off" and void is None else void
            fell = None if void is None and act == "on" else turn if act in ("trip", "reset") and was_on else fell
        was_on, stops = bool(link.board.device.output.on) and link.wants_on, len(link.stops)
        link.run()
        void = turn if len(link.stops) > stops and void is None else void
        fell = turn if was_on and link.board.device.output.timed_out else fell
        if link.duty not in (0, DUTY):
            return f"turn {turn}: a duty of {link.duty}, which nobody asked for"
        if link.duty and void is not None and turn > void + TIMEOUT + age:
            return f"turn {turn}: driven, though stopped in turn {void}"
        if link.duty and fell is not None and turn > fell:
            return f"turn {turn}: driven, though the board went off in turn {fell}"
    for _ in range(SETTLED):
        link.run()
    return "" if link.duty == DUTY * link.gate.enabled else f"in the end {link.duty}, gate {link.gate.enabled}"
