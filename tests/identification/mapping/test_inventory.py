"""What is in a bag."""

from pathlib import Path

import foreign_bags
import pytest

from motor_identification.mapping.inventory import take_inventory


def test_topics_rates_and_what_changes(tmp_path: Path) -> None:
    foreign_bags.write_joint_states(tmp_path / "bag", foreign_bags.move(2.0))
    states, commands = take_inventory(tmp_path / "bag")
    assert (states.name, states.messages, states.stamped, commands.stamped) == ("/joint_states", 400, True, False)
    assert states.rate == pytest.approx(200.0, rel=0.01) and commands.rate == pytest.approx(50.0, rel=0.01)
    assert 5e-5 < states.jitter < 3e-4 and commands.jitter < 1e-6
    assert [field.path.field for field in states.fields] == ["position[right_wheel]", "velocity[right_wheel]"]
    assert [str(field.path) for field in commands.fields] == ["/wheels/commands:data[1]"]


def test_a_type_without_a_definition_is_told(tmp_path: Path) -> None:
    from motor_identification.bag import BagWriter

    with BagWriter(tmp_path / "bag") as writer:
        writer.write(writer.topic("/x", "unknown_msgs/msg/Thing"), 10**18, b"\0\1\0\0" + bytes(8))
    (row,) = take_inventory(tmp_path / "bag")
    assert row.fields == () and "has no definition of unknown_msgs/msg/Thing" in row.trouble


def test_times_beyond_all_clocks_are_shown_as_the_latest(tmp_path: Path) -> None:
    from motor_identification.bag import BagWriter

    with BagWriter(tmp_path / "bag") as writer:
        topic = writer.topic("/x", "unknown_msgs/msg/Thing")
        for time in (10**18, 2**63 - 1, 2**63, 2**64 - 1):
            writer.write(topic, time, b"\0\1\0\0" + bytes(8))
    (row,) = take_inventory(tmp_path / "bag")
    assert row.messages == 4 and 0.0 <= row.rate < 1e-9
