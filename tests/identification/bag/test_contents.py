"""Contents of the files of one bag are added up."""

import pytest

from motor_identification.bag.contents import Contents, Span
from motor_identification.bag.topic import Topic

SPEED, INFO = Topic("/motor/speed", "S", message_count=100), Topic("/motor/info", "I", message_count=1)


def test_two_files_of_a_bag_are_joined() -> None:
    first = Contents((SPEED, INFO), Span(10, 2_000_000_010), custom_data={"profile": "step"})
    second = Contents((SPEED,), Span(5, 1_000_000_000), cut=True)
    both = first.joined(second)
    assert {topic.name: topic.message_count for topic in both.topics} == {"/motor/speed": 200, "/motor/info": 1}
    assert both.message_count == 201 and both.cut and both.custom_data == {"profile": "step"}
    assert both.span == Span(5, 2_000_000_010) and both.duration == pytest.approx(2.000000005, abs=1e-12)


def test_a_file_without_messages_adds_nothing() -> None:
    first = Contents((SPEED,), Span(10, 20))
    assert first.joined(Contents()) == first and Contents().joined(first) == first
    assert Contents().duration == 0.0 and Contents().message_count == 0


def test_a_span_is_stretched_to_both_sides() -> None:
    assert Span(10, 20).including(5).including(30).including(12) == Span(5, 30)
