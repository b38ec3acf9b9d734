"""What the driver does with a board: bytes and time in, samples and bytes out; no port, no clock, no ROS.

The output is on only while the user wants it. Whatever ends the board's running (a lost port, a reset, silence, its own
time-out) is a stop: the user's wish is void then, and nothing but the user's next wish switches the output on again.
"""

from dataclasses import dataclass, replace

from motor_driver.config import Config
from motor_driver.exchange import Exchange
from motor_driver.frames.codes import Flag
from motor_driver.frames.from_board import Features, Hello, OtherVersion, Pong, Protection, Telemetry
from motor_driver.handshake import Handshake, reset_cause
from motor_driver.output.switch import reason_off
from motor_driver.protocol import Event, LinkCounters
from motor_driver.readout import Readout
from motor_driver.session import Session
from motor_model.sample import Info, Sample
from motor_model.sensing.motion_check import MotionCheck
from motor_model.sensing.shed_edges import ShedEdges

NO_LINK = "There is no link to the board yet."
LATE = (
    "the board on {} answers later than {:.0f} ms, so that the motor does what was right a while ago: the link holds "
    "bytes back (a wireless adapter, a network, a hub)"
)
REPLAYED = (
    "the board on {} obeyed a command that this driver had not sent, or an old one again: see who else writes to that "
    "port, or what repeats bytes on the way"
)
OTHERS = (
    "somebody else tells the board on {} how to drive, or switches it on: see who else writes to that port, or what "
    "repeats bytes on the way"
)
DEAF = (
    "the board on {} says what it measures and does nothing that it is told, as if it heard nothing: see the wire or "
    "the adapter from the computer to the board"
)
ASKED = ("sample_period", "command_timeout", "decay", "latch", "reset_cause")  # of a hello: they change without a reset
LOST = "the link to the board on {} was lost"


@dataclass(frozen=True, slots=True)
class Reading:
    """A sample and its instant on the host's monotonic clock."""

    sample: Sample
    host: int  # [ns]
    restarted: bool  # the board counts edges from 0 again since this one


@dataclass(frozen=True, slots=True)
class Order:
    """What is to be done now."""

    data: bytes  # to the port
    stop: str  # not empty: the user's wish is void, for this reason, a clause
    motor: bool = False  # which is what the motor did, and not the link


class Driver:
    """All logic of the driver; times are the host's monotonic clock in ns."""

    def __init__(self, config: Config) -> None:
        self.config = config
        self.session: Session | None = None  # while a port is open
        self.trouble = NO_LINK  # while there is no port
        self.board: Hello | None = None  # the latest that ran
        self.motion, self.shed = self._nothing_seen(), ShedEdges()
        self.readings = self.resets = self.openings = 0
        self.runs_begun = 0  # boards that have begun to run: each time voltages have to begin at 0 V
        self._readout: Readout | None = None
        self._anew = False  # the board that runs now was reset since the one before
        self._drift = 0.0
        self._counted = LinkCounters()  # of ports that were closed
        self._stop, self._by_motor = "", False

    @property
    def info(self) -> Info:
        """What `motor/info` says."""
        return self.config.info(self.board)

    @property
    def counters(self) -> LinkCounters:
        """Frames, over all ports that were opened."""
        now = self.session.decoder.counters if self.session else LinkCounters()
        was = self._counted
        return LinkCounters(was.good + now.good, was.bad + now.bad, was.lost + now.lost)

    def _nothing_seen(self) -> MotionCheck:
        config = self.config
        return MotionCheck(config.max_voltage, config.single_channel, config.stall_time)

    @property
    def runs(self) -> bool:
        """Whether a board samples and is heard."""
        return self.session is not None and self.session.runs and not self.session.silent

    @property
    def supply(self) -> float:
        """[V] at full duty, measured where the board can."""
        return self._readout.supply if self._readout else self.config.full_voltage

    @property
    def highest_supply(self) -> float:
        """[V] that the supply may have, where what is measured is not to be believed; 0: it is."""
        return self._readout.highest_supply if self._readout else 0.0

    @property
    def measures_supply(self) -> bool:
        """Whether that is, or was, what the board measures."""
        return self._readout is not None and self._readout.measured

    @property
    def assumed_supply(self) -> float:
        """[V] that full duty is taken for, where the board measures no supply and none was said; 0: it is known."""
        return self.config.max_voltage if self.measures_none and not self.config.supply_voltage else 0.0

    @property
    def measures_none(self) -> bool:
        """Whether the board that runs is known to measure no supply."""
        return self._readout is not None and self._readout.measures_none

    @property
    def encoder_errors(self) -> int:
        """Transitions of both encoder lines at once, which no motion makes."""
        return self._readout.errors if self._readout else 0

    def refusal(self) -> str:
        """Why the output cannot be switched on now; empty if it can."""
        if self.session is None:
            return self.trouble
        if self.session.silent:
            return f"No telemetry comes from {self.session.port}."
        if self.session.exchange and self.session.exchange.late:
            return f"No voltage acts in time: {self._lateness(self.session.port)}."
        if self.session.exchange and self.session.exchange.deaf:
            return f"No voltage acts: {DEAF.format(self.session.port)}."
        if self.session.runs:
            return ""
        return self.session.handshake.refusal or f"The board on {self.session.port} has not answered yet."

    def unsuitable(self, now: int) -> bool:
        """Whether the open port has no board that can be used."""
        return self.session is not None and (self.matches or bool(self.session.handshake.problem(now)))

    @property
    def matches(self) -> bool:
        """Whether the open port's board, which was only to say who it is, may be the one that is searched for."""
        return self.session is not None and self.session.handshake.matches

    def opened(self, port: str, now: int, roll_call: bool = False) -> None:
        """A port was opened; at a roll call its board only says who it is."""
        self.session = Session(port, Handshake(self.config, port, now, roll_call, self.board))
        self.openings += 1

    def closed(self, why: str) -> None:
        """The port is gone, or cannot be opened."""
        self.trouble = why
        if self.session and self.session.runs:
            self._halt(LOST.format(self.session.port))
        self._counted, self.session = self.counters, None

    def received(self, data: bytes, now: int) -> list[Reading]:
        """Bytes were read at `now`: the samples in them."""
        if self.session is None:
            return []
        readings: list[Reading] = []
        for event in self.session.decoder.receive(data):
            readings += self._hear(self.session, event, now)
        self.readings += len(readings)
        return readings

    def step(self, now: int, wish: bool, voltage: float) -> Order:
        """What to send at `now`, while the user wants the output on or not, and this voltage [V]."""
        session = self.session
        if session and self.runs and now - session.heard > self.config.silence * 1e9:
            session.silent = True
            self._halt(f"no telemetry from {session.port} for {self.config.silence * 1e3:.0f} ms")
        elif session:
            self._check_lateness(session, now)
            longest = self.config.confirmation * 1e9
            if session.switch.unheard(now, longest, session.telling(now, longest)):
                self._halt((OTHERS if session.disturbed else DEAF).format(session.port))
        (stop, motor), self._stop, self._by_motor = (self._stop, self._by_motor), "", False
        wish = wish and not stop
        duty = self._readout.duty(voltage) if self._readout else 0
        return Order(session.due(now, wish, duty) if session else b"", stop, motor)

    def _lateness(self, port: str) -> str:
        return LATE.format(port, 1e3 * self.config.round_trip)

    def _halt(self, why: str, motor: bool = False) -> None:
        self._stop, self._by_motor = why, motor

    def _hear(self, session: Session, event: Event, now: int) -> list[Reading]:
        if isinstance(event, OtherVersion):
            session.handshake.refuse(event)
        elif isinstance(event.frame, Hello):
            self._hear_hello(session, event.frame, now)
        elif isinstance(event.frame, Features):
            session.handshake.hear_features(event.frame)
            self._hear_told(session, event.frame)
        elif isinstance(event.frame, Protection):
            session.handshake.hear_protection(event.frame)
            self._hear_told(session, event.frame)
        elif isinstance(event.frame, Telemetry):
            return self._hear_telemetry(session, event.frame, now)
        elif isinstance(event.frame, Pong) and session.exchange and session.latest and self._readout:
            session.exchange.hear_pong(event.frame, self._readout.clock, now)
            self._check_lateness(session, now)
        return []

    def _check_lateness(self, session: Session, now: int) -> None:
        if session.exchange is None or session.latest is None:
            return
        session.exchange.look(now)
        if session.exchange.late and session.latest.enabled:
            self._halt(self._lateness(session.port))

    def _hear_hello(self, session: Session, hello: Hello, now: int) -> None:
        if session.handshake.reset_in(hello):
            self._reset(session, reset_cause(hello))
        if session.handshake.hear(hello):
            self._anew = self.board is not None and _is_other(self.board, hello)
            self.board = hello
            self.runs_begun += 1
            session.begin(Exchange(self.config.baud, self._drift, self.config.round_trip), now)
        else:
            self._hear_told(session, hello)

    def _hear_told(self, session: Session, frame: Hello | Features | Protection) -> None:
        if session.hear_told(frame):
            self._halt(OTHERS.format(session.port))

    def _reset(self, session: Session, cause: str) -> None:
        self.resets += 1
        self._halt(f"the board was reset ({cause})")
        session.end()

    def _hear_telemetry(self, session: Session, frame: Telemetry, now: int) -> list[Reading]:
        if session.handshake.reset_in(frame):
            self._reset(session, "unknown cause")
        if session.exchange is None or self.board is None:
            return []
        restarted = False
        if self._readout is None:
            self._readout = Readout(self.config, self.board)
            self._readout.clock.hear(frame.time, now)
        elif session.latest is None:
            restarted = self._anew or not self._readout.clock.hear(frame.time, now, resumed=True)
        elif not self._readout.clock.hear(frame.time, now):
            self._reset(session, "its clock started anew")
            return []
        if restarted:
            self._readout.restart(frame, self.board, now)
            self.motion, self.shed = self._nothing_seen(), ShedEdges()
        session.latest, session.heard, session.silent = frame, now, False
        if session.hear_another(frame):
            self._halt(REPLAYED.format(session.port))
        if session.hear_switched(frame):
            self._halt(OTHERS.format(session.port))
        if session.switch.hear(frame, now, self.config.confirmation * 1e9):
            why = OTHERS.format(session.port) if session.disturbed else reason_off(frame)
            self._halt(why, motor=bool(frame.flags & Flag.OVERCURRENT))
        return [self._reading(session.exchange, self._readout, frame, now, restarted)]

    def _reading(self, exchange: Exchange, readout: Readout, frame: Telemetry, now: int, restarted: bool) -> Reading:
        host = exchange.hear_telemetry(readout.clock.newest, now)
        if exchange.fit.fit:
            self._drift = exchange.fit.fit.drift
        errors = readout.errors
        sample = readout.sample(frame)
        self.motion = self.motion.see(sample)
        self.shed = self.shed.see(sample.sample_time, readout.errors - errors, frame.enabled and sample.voltage != 0.0)
        if (stop := self.motion.stop or self.shed.stop) and frame.enabled:
            self._halt(stop, motor=True)
        return Reading(sample, host, restarted)


def _is_other(board: Hello, hello: Hello) -> bool:
    """Tell whether a hello is of a board that was reset since, or of another one on the same port."""
    return replace(hello, **{name: getattr(board, name) for name in ASKED}) != board
