"""Messages of any topic, in the order of the file and in that of their log times."""

from pathlib import Path

import pytest
from motor_bags import SAMPLES, write_bag

from motor_identification.bag import contents, in_time_order, messages, topics
from motor_model.errors import RecordingError


def test_messages_come_in_time_order_and_disorder_beyond_repair_is_told() -> None:
    def message(time: int) -> tuple[str, str, int, bytes]:
        return ("/a", "t", time, b"")

    times = [3, 1, 2, 2, 5, 4]
    assert [row[2] for row in in_time_order(map(message, times), "bag")] == [1, 2, 2, 3, 4, 5]
    with pytest.raises(RecordingError, match="bag: the messages are not in the order of their log times"):
        list(in_time_order(map(message, [*range(1, 30_000), 0]), "bag"))


def test_topics_contents_and_messages_of_a_bag(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:200])
    assert {topic.name: topic.message_count for topic in topics(bag)} == {"/motor/info": 1, "/motor/speed": 200}
    assert contents(str(bag)).topics == topics(bag) and contents(bag).duration == pytest.approx(199 * 0.005)
    assert [row[0] for row in messages(bag, ["/motor/info"])] == ["/motor/info"]
    rows = list(messages(bag))
    assert len(rows) == 201 and {row[1] for row in rows} == {"motor_msgs/msg/MotorInfo", "motor_msgs/msg/MotorSpeed"}
    assert list(in_time_order(rows, bag)) == rows
