"""Launch files that are started twice, for `faults_live.py`: two plants and two controllers of one motor."""

from typing import Any

from faults_live_stage import MOTOR, Stage
from std_msgs.msg import Float64
from workbench import quit_all

from motor_ros import qos


def launch(stage: Stage) -> None:
    """What a launch file starts: a plant and its controller."""
    stage.plant()
    stage.controller()


def launch_twice(stage: Stage) -> None:
    """A launch file is started once more while the motor runs, and references keep coming."""
    launch(stage)
    until_moving(stage, refer_by_stream(stage))
    launch(stage)
    stage.until(lambda: stage.bench.node.count_publishers("motor/speed") > 1, "the second plant")


def launch_both(stage: Stage) -> None:
    """A launch file is started in two shells at once, and references come then."""
    launch(stage)
    launch(stage)
    stage.until(lambda: stage.bench.node.count_publishers("motor/control_state") > 1, "both controllers")
    stage.until(lambda: stage.bench.node.count_publishers("motor/speed") > 1, "both plants")
    refer_by_stream(stage)


def end_second(stage: Stage) -> None:
    """The second of two launches is ended, and references keep coming."""
    launch_twice(stage)
    stage.hear(3.0)
    quit_all(stage.programs[2:])


def end_first(stage: Stage) -> None:
    """The first of two launches is ended, and references keep coming."""
    launch_twice(stage)
    stage.until(lambda: stage.bench.node.count_publishers("motor/control_state") > 1, "the second controller")
    stage.hear(3.0)
    quit_all(stage.programs[:2])


def until_moving(stage: Stage, reference: Any) -> None:
    """Wait for the motion that is asked for; who is not obeyed, for this machine is busy, begins again."""
    while not any(moment.speed > 0.4 * MOTOR.top for moment in stage.moments):
        reference.publish(Float64(data=0.0))
        stage.hear(0.1)
        reference.publish(Float64(data=0.5 * MOTOR.top))
        stage.hear(2.5)


def refer_by_stream(stage: Stage) -> Any:
    """Send references from now on, 20 a second."""
    reference = stage.bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    stage.bench.heard(reference)
    stage.bench.node.create_timer(0.05, lambda: reference.publish(Float64(data=0.5 * MOTOR.top)))
    return reference
