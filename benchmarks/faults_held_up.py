"""Programs that are held up while the motor runs, and go on, for `faults_live.py`: Ctrl-Z, a laptop that sleeps."""

import signal
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from faults_live_stage import Stage
from faults_twice import refer_by_stream, until_moving
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from std_msgs.msg import Float64

from motor_ros import qos

SHORT, LONG = 0.3, 3.0  # [s]
OFTEN, APART = 0.045, 0.3  # [s] of a controller that is held up now and then, and between
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


def cut_supply(stage: Stage) -> None:
    """The motor's supply is cut for 2 s, and comes back, while the controller is held up again and again."""
    stage.board()
    stage.controller("", "-p", "reference_timeout:=0.0", "-p", "latency_limit:=0.02")
    run_loop(stage, False)
    hold_up_often(stage, 2.0)
    set_value(stage, "board_emulator", "powered", False)
    hold_up_often(stage, 2.0)
    set_value(stage, "board_emulator", "powered", True)


def hold_up_often(stage: Stage, seconds: float) -> None:
    """Hold the latest program up, as a busy computer does."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        stand_still(stage.programs[-1:], lambda: stage.hear(OFTEN))
        stage.hear(APART)


def set_value(stage: Stage, node: str, name: str, value: bool) -> None:
    """Set a parameter of a running node."""
    client = stage.bench.node.create_client(SetParameters, f"{node}/set_parameters")
    stage.until(client.service_is_ready, f"the parameters of {node}")
    new = Parameter(name=name, value=ParameterValue(type=ParameterType.PARAMETER_BOOL, bool_value=value))
    answer = client.call_async(SetParameters.Request(parameters=[new]))
    stage.until(answer.done, "the answer")


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
