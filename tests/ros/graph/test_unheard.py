"""Publishers that no reliable subscription hears are named: in what is said of them, and once each in the log."""

from types import SimpleNamespace
from typing import Any, cast

import pytest
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float64
from workbench import Bench

from motor_ros import qos
from motor_ros.graph.publishers import UNKNOWN
from motor_ros.graph.unheard import Unheard

BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


def publisher(number: int, name: str, reliability: ReliabilityPolicy = ReliabilityPolicy.BEST_EFFORT) -> Any:
    profile = SimpleNamespace(reliability=reliability)
    return SimpleNamespace(endpoint_gid=[number], node_namespace="/", node_name=name, qos_profile=profile)


def test_each_publisher_is_logged_once_and_said_while_it_is_there() -> None:
    there: list[Any] = []
    logged: list[str] = []
    told = SimpleNamespace(
        get_publishers_info_by_topic=lambda topic: there,
        count_publishers=lambda topic: len(there),
        resolve_topic_name=lambda topic: f"/{topic}",
        get_logger=lambda: SimpleNamespace(warning=logged.append),
    )
    unheard = Unheard(cast(Node, told), "motor/reference")
    assert unheard.look() == ""
    there += [publisher(1, "good", ReliabilityPolicy.RELIABLE), publisher(2, "teleop"), publisher(3, UNKNOWN)]
    for _ in range(3):
        assert unheard.look().startswith("What /teleop sends on /motor/reference is not heard, nor would a 0 be: it is")
    assert len(logged) == 1
    there[2] = publisher(3, "other")
    for _ in range(2):
        assert unheard.look().startswith("What /other and /teleop sends on /motor/reference")
    assert [text.split()[1] for text in logged] == ["/teleop", "/other"]
    del there[1:]
    assert unheard.look() == ""


@pytest.mark.parametrize("profile", [BEST_EFFORT, qos.REFERENCE])
def test_the_middleware_tells_who_publishes_best_effort(bench: Bench, profile: QoSProfile) -> None:
    unheard = Unheard(bench.node, "motor/reference")
    heard = bench.hear(Float64, "motor/reference", qos.COMMANDS)
    sends = bench.publisher(Float64, "motor/reference", profile)
    name = bench.node.get_fully_qualified_name()
    if profile is BEST_EFFORT:
        bench.wait(lambda: unheard.look().startswith(f"What {name} sends on /motor/reference is not heard"), "it")
        assert sends.get_subscription_count() == 0
    else:
        bench.heard(sends)
        sends.publish(Float64(data=1.0))
        bench.wait(lambda: bool(heard), "a reference")
        assert unheard.look() == ""
