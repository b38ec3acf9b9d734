"""Who publishes samples is named where their number changes, and once more where one had no name yet."""

from types import SimpleNamespace
from typing import cast

from rclpy.node import Node

from motor_control.controller.state import State
from motor_control.speakers import Speakers
from motor_ros.graph.publishers import NAMELESS, UNKNOWN


def test_a_publisher_is_named_as_soon_as_the_middleware_knows_its_name() -> None:
    names, asked = ["motor_sim"], list[str]()

    def infos(topic: str) -> list[SimpleNamespace]:
        asked.append(topic)
        return [SimpleNamespace(endpoint_gid=[1], node_namespace="/", node_name=name) for name in names]

    node = SimpleNamespace(
        resolve_topic_name=lambda topic: f"/{topic}",
        count_publishers=lambda topic: len(names),
        get_publishers_info_by_topic=infos,
    )
    speakers = Speakers(cast(Node, node))
    one = speakers.name(State())
    assert one.speakers == "(/motor_sim)" and speakers.name(one) is one and len(asked) == 1
    names.append(UNKNOWN)
    two = speakers.name(one)
    assert two.speakers == f"(/motor_sim, {NAMELESS})"
    names[1] = "another"
    three = speakers.name(two)
    assert three.speakers == "(/another, /motor_sim)" and speakers.name(three) is three and len(asked) == 3
