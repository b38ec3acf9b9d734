"""Whatever says that it is a board: none ends the driver, and another one on the same port is read by what it says."""

from dataclasses import dataclass, field, replace

from board_frames import HELLO, TELEMETRY
from hypothesis import given
from hypothesis import strategies as st

from motor_driver.config import Config
from motor_driver.driver import Driver, Reading
from motor_driver.frames.codes import Flag
from motor_driver.frames.from_board import Hello
from motor_driver.frames.from_host import Configure, Enable, Identify
from motor_driver.frames.table import Frame
from motor_driver.protocol import Arrival, Decoder, pack

ODD = st.sampled_from((0, 1, 127, 255, 32_767, 32_768, 65_535))


@dataclass
class Board:
    """Answers a driver with one hello, and samples once it is configured."""

    driver: Driver
    hello: Hello
    now: int = 1_000_000_000
    time: int = 10_000
    enabled: bool = False
    decoder: Decoder = field(default_factory=Decoder)
    readings: list[Reading] = field(default_factory=list)

    def plug(self) -> None:
        self.driver.opened("the port", self.now)

    def say(self, frame: Frame) -> None:
        self.readings += self.driver.received(pack(frame, 0), self.now)

    def run(self, samples: int) -> None:
        for _ in range(samples):
            self.now, self.time = self.now + 5_000_000, self.time + 10_000
            for event in self.decoder.receive(self.driver.step(self.now, True, 6.0).data):
                if isinstance(event, Arrival):
                    self.answer(event.frame)
            flags = Flag.ENABLED if self.enabled else 0
            latch = self.hello.latch
            self.say(replace(TELEMETRY, time=self.time, duty=128, flags=flags, boot=self.hello.boot, latch=latch))

    def answer(self, frame: Frame) -> None:
        if isinstance(frame, Configure):
            asked = (frame.sample_period, frame.command_timeout, frame.decay)
            names = ("sample_period", "command_timeout", "decay")
            self.hello = replace(self.hello, latch=(self.hello.latch + 1) % 256, **dict(zip(names, asked, strict=True)))
        if isinstance(frame, Configure | Identify):
            self.say(self.hello)
        self.enabled = bool(frame.on) if isinstance(frame, Enable) else self.enabled


@given(tick=ODD, top=ODD, shortest=ODD, edges=ODD, changed=st.booleans())
def test_no_hello_ends_the_driver(tick: int, top: int, shortest: int, edges: int, changed: bool) -> None:
    board = Board(Driver(Config()), HELLO)
    board.plug()
    board.run(1 if changed else 0)
    told = {"tick_ns": tick, "pwm_top": top, "shortest_period": shortest, "edges_per_revolution": edges % 97}
    board.hello = replace(board.hello, **told)
    board.run(60)
    assert all(abs(reading.sample.voltage) <= 12.0 * 128 / max(top, 1) for reading in board.readings)


def test_another_board_of_the_same_number_is_read_by_what_it_says() -> None:
    """It has begun as often as the one before, and has twice as many steps of duty: half of the voltage at the same."""
    board = Board(Driver(Config(board_id=0)), HELLO)
    board.plug()
    board.run(100)
    assert board.readings[-1].sample.voltage == 6.0
    board.driver.closed("unplugged")
    board.hello = replace(board.hello, pwm_top=512)
    board.plug()
    board.run(100)
    assert board.readings[-1].sample.voltage == 3.0


def test_another_board_than_the_one_that_ran_is_refused() -> None:
    board = Board(Driver(Config()), HELLO)
    board.plug()
    board.run(100)
    readings = len(board.readings)
    board.driver.closed("unplugged")
    board.hello = replace(board.hello, firmware_minor=4, pwm_top=512, boot=8)
    board.enabled = False
    board.plug()
    board.run(100)
    session = board.driver.session
    assert session is not None and len(board.readings) == readings
    told = "(steps of duty 512 instead of 256, firmware 1.4.3 instead of 1.1.3)"
    assert told in session.handshake.problem(board.now) and not board.enabled


def test_the_same_board_on_a_port_that_was_away_goes_on() -> None:
    board = Board(Driver(Config()), HELLO)
    board.plug()
    board.run(100)
    board.driver.closed("unplugged")
    board.plug()
    board.run(100)
    assert not any(reading.restarted for reading in board.readings)


def said_by(board: Board, time: int, command: int) -> str:
    """Why the driver stops at a sample of a time [tick] that names the command that was obeyed; "" if it goes on."""
    board.now += 5_000_000
    board.say(replace(TELEMETRY, time=time, duty=128, flags=Flag.ENABLED, boot=board.hello.boot, command=command))
    order = board.driver.step(board.now, True, 6.0)
    sent = [event.frame for event in board.decoder.receive(order.data) if isinstance(event, Arrival)]
    assert not (order.stop and Enable(1, board.hello.boot, TELEMETRY.latch) in sent)  # a stop switches nothing on
    return order.stop


def driven_board() -> tuple[Board, int]:
    """A board whose motor is driven, and the number of the latest command that it was sent."""
    board = Board(Driver(Config(stall_time=0.0)), HELLO)
    board.plug()
    board.run(100)
    assert board.driver.session is not None and board.enabled
    return board, board.driver.session.encoder.seq - 1


def test_a_board_that_obeys_an_old_command_again_is_a_stop() -> None:
    """What the driver had sent before was written to the port once more, and the motor followed that."""
    board, latest = driven_board()
    assert said_by(board, board.time + 10_000, latest) == ""
    assert said_by(board, board.time + 20_000, latest) == ""  # none came since
    assert "obeyed a command that this driver had not sent, or an old one" in said_by(
        board, board.time + 30_000, latest - 3
    )


def test_a_board_whose_clock_starts_anew_is_a_stop_though_it_says_that_it_is_the_same_start() -> None:
    """So is what a board has said, if it is read again."""
    board, latest = driven_board()
    assert said_by(board, board.time + 10_000, latest) == ""
    assert said_by(board, 10_000, latest) == "the board was reset (its clock started anew)"
    assert not board.driver.runs and board.driver.resets == 1
