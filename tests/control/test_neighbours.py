"""Who is missing around a controller, in a sentence; and no motor is driven by what another one does."""

from collections.abc import Callable, Iterator

import pytest
import rclpy
from rclpy.node import Node
from workbench import Bench

from motor_control.neighbours import Neighbours
from motor_msgs.msg import MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.graph.publishers import count_publishers

MakeNode = Callable[..., Node]


@pytest.fixture
def bench() -> Iterator[Bench]:
    bench = Bench()
    yield bench
    bench.close()


@pytest.fixture
def make(bench: Bench) -> Iterator[MakeNode]:
    """Makes nodes in a namespace, some of whose topics are renamed."""
    made: list[Node] = []

    def make(name: str, namespace: str = "", *renamed: str) -> Node:
        words = ["--ros-args", *(word for one in renamed for word in ("-r", one))]
        namespaced = {"namespace": namespace} if namespace else {}
        made.append(rclpy.create_node(name, context=bench._context, cli_args=words, **namespaced))
        return made[-1]

    yield make
    for node in made:
        node.destroy_node()


def be_plant(node: Node, *topics: str) -> Node:
    """Publish and hear what a plant does, or only some of it."""
    for kind, topic, profile in ((MotorSpeed, "motor/speed", qos.SPEED), (MotorInfo, "motor/info", qos.INFO)):
        if not topics or topic in topics:
            node.create_publisher(kind, topic, profile)
    if not topics or "motor/voltage" in topics:
        node.create_subscription(MotorVoltage, "motor/voltage", lambda message: None, qos.VOLTAGE)
    return node


def test_who_is_missing_is_said_and_where_a_plant_is(bench: Bench, make: MakeNode) -> None:
    neighbours = Neighbours(make("controller", "right"))
    assert neighbours.missing() == (
        "Nobody publishes /right/motor/speed: start motor_sim or motor_driver in this namespace."
    )
    be_plant(make("plant", "left"))
    bench.wait(lambda: "/left/motor/speed, whose namespace this node would need" in neighbours.missing(), "the other")
    right = be_plant(make("plant", "right"), "motor/speed")
    told = "Nobody publishes /right/motor/info, which says what the samples on /right/motor/speed mean, but /left/motor"
    bench.wait(lambda: neighbours.missing().startswith(told), "its samples")
    be_plant(right, "motor/info")
    bench.wait(lambda: neighbours.missing().startswith("Nobody hears /right/motor/voltage, on which"), "its info")
    be_plant(right, "motor/voltage")
    bench.wait(lambda: neighbours.missing() == "", "all of it")
    assert neighbours.another_driven() == ""


@pytest.mark.parametrize("renamed", ["motor/voltage:=/right/motor/voltage", "motor/speed:=/right/motor/speed"])
def test_a_plant_is_not_driven_by_what_another_one_does(bench: Bench, make: MakeNode, renamed: str) -> None:
    for side in ("left", "right"):
        be_plant(make("plant", side))
    neighbours, straight = Neighbours(make("one", "left", renamed)), Neighbours(make("other", "left"))
    driven = "right" if "voltage" in renamed else "left"
    bench.wait(lambda: neighbours.another_driven().startswith(f"/{driven}/plant would be driven on"), "both plants")
    bench.wait(lambda: straight.missing() == "", "its plant")
    assert straight.another_driven() == ""


def test_a_plant_is_not_told_of_by_another_one(bench: Bench, make: MakeNode) -> None:
    for side in ("left", "right"):
        be_plant(make("plant", side))
    neighbours = Neighbours(make("one", "left", "motor/info:=/right/motor/info"))
    bench.wait(lambda: neighbours.crossed() != "", "both plants")
    assert neighbours.crossed() == (
        "What the samples on /left/motor/speed mean is said on /right/motor/info by another plant, /right/plant, whose "
        "own samples are on /right/motor/speed: see remappings and namespaces. The motor gets 0 V until then."
    )
    straight = Neighbours(make("other", "left"))
    bench.wait(lambda: straight.missing() == "", "its plant")
    assert straight.crossed() == ""


def test_a_plant_may_be_two_nodes_and_others_may_listen(bench: Bench, make: MakeNode) -> None:
    neighbours = Neighbours(make("controller", "two"))
    be_plant(make("sensor", "two"), "motor/speed", "motor/info")
    be_plant(make("bridge", "two"), "motor/voltage")
    be_plant(make("recorder", "two"), "motor/voltage")
    bench.wait(lambda: neighbours.missing() == "", "the plant")
    assert neighbours.crossed() == ""


def test_a_simulation_may_follow_the_voltages_of_a_motor(bench: Bench, make: MakeNode) -> None:
    neighbours = Neighbours(make("controller", "wheel"))
    be_plant(make("motor_driver", "wheel"))
    be_plant(make("motor_sim", "twin", "motor/voltage:=/wheel/motor/voltage"))
    both = {"/wheel/motor_driver", "/twin/motor_sim"}
    bench.wait(lambda: neighbours.hearers() == both and neighbours.missing() == "", "both")
    assert neighbours.crossed() == ""


def test_renamed_topics_are_counted_by_their_new_names(bench: Bench, make: MakeNode) -> None:
    controller = make("controller", "", "motor/speed:=speed_of_wheel")
    make("plant").create_publisher(MotorSpeed, "speed_of_wheel", qos.SPEED)
    bench.wait(lambda: count_publishers(controller, "motor/speed") == 1, "the plant")
    assert controller.count_publishers("motor/speed") == 0  # which is what rclpy counts
