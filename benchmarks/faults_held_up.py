"""Programs that are held up while the motor runs, and go on, for `faults_live.py`: Ctrl-Z, a laptop that sleeps."""

import signal
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from faults_live_stage import Stage
from faults_twice import refer_by_stream, until_moving
from std_msgs.msg import Float64

from motor_ros import qos

SHORT, LONG = 0.3, 3.0  # [s]
PLANT, CONTROLLER, BOTH = slice(0, 1), slice(1, 2), slice(0, 2)  # of the programs on the stage


@dataclass(frozen=True)
class HeldUp:
    """Some programs stand still for a time, and references keep coming meanwhile, came once, or sleep as well."""

    which: slice
    seconds: float
    stream: bool

    def __call__(self, stage: Stage) -> None:
        """Let a loop run, and hold it up."""
        stage.plant()
        stage.controller("", "-p", "reference_timeout:=0.0")
        run_loop(stage, self.stream)
        stand_still(stage.programs[self.which], lambda: stage.hear(self.seconds))
        stage.since = stage.bench.node.get_clock().now().nanoseconds  # not one that a plant was making when it stopped


def run_loop(stage: Stage, stream: bool) -> None:
    """Drive a plant by a controller to which references keep coming, or came once."""
    if stream:
        reference = refer_by_stream(stage)
    else:
        reference = stage.bench.publisher(Float64, "motor/reference", qos.REFERENCE)
        stage.bench.heard(reference)
        stage.until(lambda: bool(stage.said) and len(stage.moments) > 50, "the loop")
    until_moving(stage, reference)
    stage.hear(1.0)


def stand_still(programs: Sequence[Any], meanwhile: Callable[[], None]) -> None:
    """Stop programs as Ctrl-Z does, and let them go on."""
    for one in programs:
        one.send_signal(signal.SIGSTOP)
    meanwhile()
    for one in programs:
        one.send_signal(signal.SIGCONT)
