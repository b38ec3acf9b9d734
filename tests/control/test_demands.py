"""What is said of those who ask for a motion, and of who has asked and is gone."""

from collections.abc import Iterator
from dataclasses import replace

import pytest
from std_msgs.msg import Float64
from workbench import Bench

from motor_control.controller import pi
from motor_control.controller.controller import Config, State, refer, release
from motor_control.controller.reference.demand import Kind
from motor_control.demands import LEFT, Demands
from motor_ros import qos


@pytest.fixture
def bench() -> Iterator[Bench]:
    one = Bench()
    yield one
    one.close()


CONFIG = Config(pi.Config(0.2, 2.5, 12.0), 12.0, 0.1, 0.0, 0.0)


def stream(*values: float, kind: Kind = Kind.SPEED) -> State:
    """A controller that has heard these references of one sender, 0.1 s apart."""
    state = State()
    for number, value in enumerate(values, 1):
        state = refer(state, value, 1.0 + 0.1 * number, kind, number)
    return state


def test_a_motor_that_goes_on_at_the_last_of_a_joysticks_references_is_said(bench: Bench) -> None:
    """Whoever held the joystick is gone, and the motor is not."""
    demands = Demands(bench.node, CONFIG)
    publisher = bench.publisher(Float64, "motor/reference", qos.COMMANDS)
    bench.wait(lambda: bench.node.count_publishers("motor/reference") == 1, "the publisher")
    driven = stream(60.0, 80.0)
    assert demands.left(CONFIG, driven) == ""
    bench.node.destroy_publisher(publisher)
    bench.wait(lambda: demands.left(CONFIG, driven) != "", "its end")
    assert demands.left(CONFIG, driven) == LEFT.format(80.0)
    assert demands.left(replace(CONFIG, reference_timeout=0.5), driven) == ""  # which ends it


@pytest.mark.parametrize(
    "state",
    [
        stream(80.0),
        stream(80.0, 0.0),
        stream(1.0, 2.0, kind=Kind.POSITION),
        release(stream(60.0, 80.0), 2.0)[1],
        State(),
    ],
    ids=["once", "0", "angles", "released", "nothing"],
)
def test_nothing_is_said_where_that_is_meant(bench: Bench, state: State) -> None:
    assert Demands(bench.node, CONFIG).left(CONFIG, state) == ""
