"""Programs that Linux kills, or stops, while the motor has all its voltage: real processes, firmware, want of memory.

The simulated motor (174 rad/s, 12 V) is on the emulated board's pins, and time is that board's clock. A program that is
killed by a signal is killed at 0 ms; of those that run out of memory, the first has been seen to be dead at 0 ms.
"""

import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from subprocess import Popen

import faults_live_stage  # noqa: F401  (knows where `workbench` is)
from faults_loop import Moment, Outcome, outcome
from faults_motor import MOTORS
from memory_group import eat_until_dead, memory_group
from std_msgs.msg import Float64
from std_srvs.srv import SetBool
from workbench import Bench, quit_all, start

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.emulator import Emulator
from motor_board.emulation.live import LiveBoard
from motor_board.emulation.port import Port
from motor_board.emulation.shaft import EncoderConfig
from motor_ros import qos

MOTOR = MOTORS[2]
BEYOND = 1.2  # of the top speed: the loop gives all the voltage for it
KNOWN, WATCHED, ASK_AGAIN = 0.15, 3.0, 2.5  # [s]
HEAD = "| fault | may take | ms | speed | voltage |\n|---|---|---|---|---|"


@dataclass
class Loop:
    """A board, its driver, a controller and a user who asks for more than the motor can."""

    folder: Path
    bench: Bench = field(default_factory=Bench)
    moments: list[Moment] = field(default_factory=list)

    def __post_init__(self) -> None:
        elf, port = firmware(FirmwareConfig(edges_per_revolution=96)), self.folder / "port"
        self.board = LiveBoard(Emulator(elf, MOTOR.parameters(), EncoderConfig(seed=3)), Port(port))
        self.driver = start("motor_driver", "motor_driver", "--ros-args", "-p", f"port:={port}")
        self.controller = start("motor_control", "motor_control", "--ros-args", "-p", "latency_limit:=10.0")
        reference = self.bench.publisher(Float64, "motor/reference", qos.REFERENCE)
        self.bench.heard(reference)
        while not self._runs():  # a busy machine holds the board up, which is a stop: enable, and ask again
            self.bench.call(SetBool, "motor/enable", SetBool.Request(data=True))
            reference.publish(Float64(data=0.0))  # who asks again begins again
            self._hear(0.2)
            reference.publish(Float64(data=BEYOND * MOTOR.top))
            self._hear(ASK_AGAIN)

    def _hear(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.bench.executor.spin_once(timeout_sec=0.02)

    def _runs(self) -> bool:
        truth = self.board.truth()
        return truth.voltage == MOTOR.voltage and truth.speed > 0.9 * MOTOR.top

    @property
    def time(self) -> float:
        """[s] on the board's clock."""
        return self.board.truth().cycle / FREQUENCY

    def watch(self, until: Callable[[], bool]) -> None:
        """Look at the pins every millisecond; the user has nothing to say any more."""
        while not until():
            truth = self.board.truth()
            self.moments.append(Moment(truth.cycle / FREQUENCY, truth.voltage, truth.speed, ""))
            time.sleep(0.001)

    def close(self) -> None:
        """End it all."""
        self.bench.close()
        quit_all([self.driver, self.controller])
        self.board.close()


@contextmanager
def loop() -> Iterator[Loop]:
    """A loop that runs at full voltage."""
    with tempfile.TemporaryDirectory() as folder:
        one = Loop(Path(folder))
        try:
            yield one
        finally:
            one.close()


def kill(one: Loop, victims: list["Popen[str]"]) -> float:
    """By signal, at once; when [s]."""
    begin = one.time
    for victim in victims:
        victim.send_signal(signal.SIGKILL)
    return begin


def starve(one: Loop, victims: list["Popen[str]"]) -> float:
    """By the kernel, for want of memory; when the first is seen to be dead [s]."""
    with memory_group([victim.pid for victim in victims]) as group, eat_until_dead(group):
        one.watch(lambda: any(victim.poll() is not None for victim in victims))
        begin = one.time
        one.watch(lambda: all(victim.poll() is not None for victim in victims))
        return begin


def pause(seconds: float) -> Callable[[Loop, list["Popen[str]"]], float]:
    """Stop them as Ctrl-Z does, and let them go on."""

    def act(one: Loop, victims: list["Popen[str]"]) -> float:
        begin = one.time
        for number in (signal.SIGSTOP, signal.SIGCONT):
            for victim in victims:
                victim.send_signal(number)
            one.watch(lambda: one.time > begin + seconds)
        return begin

    return act


HOW = {"killed (SIGKILL)": kill, "killed for want of memory": starve}
WHOM: dict[str, Callable[[Loop], list["Popen[str]"]]] = {
    "driver": lambda one: [one.driver],
    "controller": lambda one: [one.controller],
    "driver and controller": lambda one: [one.driver, one.controller],
}


def run_killed(how: Callable[[Loop, list["Popen[str]"]], float], whom: Callable[[Loop], list["Popen[str]"]]) -> Outcome:
    """What becomes of the motor."""
    with loop() as one:
        begin = how(one, whom(one))
        end = one.time + WATCHED
        one.watch(lambda: one.time > end)
        return outcome(one.moments, begin)


FAULTS = {
    **{f"{whom} {how}": (act, find) for how, act in HOW.items() for whom, find in WHOM.items()},
    **{
        f"{whom} stopped for {seconds:g} s (SIGSTOP), and goes on": (pause(seconds), WHOM[whom])
        for whom in ("driver", "driver and controller")
        for seconds in (0.3, 3.0)
    },
}


def killed() -> list[tuple[str, bool]]:
    """The rows, and whether each is met."""
    rows = []
    for name, (act, find) in FAULTS.items():
        try:
            one = run_killed(act, find)
        except OSError as error:  # such groups take the rights of root
            print(f"left out: {name}: {error}", file=sys.stderr)
            continue
        met = one.after is not None and one.after <= KNOWN
        took = "never" if one.after is None else f"{1e3 * one.after:.0f}"
        mark = "" if met else " **no**"
        share = f"{one.speed / MOTOR.top:.0%} | {one.voltage / MOTOR.voltage:.0%}"
        rows.append((f"| {name} | {1e3 * KNOWN:.0f}{mark} | {took} | {share} |", met))
        print(rows[-1][0], file=sys.stderr)
    return rows


if __name__ == "__main__":
    killed()
