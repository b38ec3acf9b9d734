"""What is in a bag, before anybody reads its messages."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from motor_identification.bag.topic import Topic


@dataclass(frozen=True, slots=True)
class Span:
    """The earliest and the latest log time [ns since 1970]."""

    first: int
    last: int

    def including(self, log_time: int) -> "Span":
        """The span stretched to another message."""
        return Span(min(self.first, log_time), max(self.last, log_time))


@dataclass(frozen=True, slots=True)
class Contents:
    """Topics with their numbers of messages, and the log times they span (None without messages)."""

    topics: tuple[Topic, ...] = ()
    span: Span | None = None
    cut: bool = False  # a file ends before its end: this is what can be read
    custom_data: Mapping[str, str] = field(default_factory=dict)  # what the recorder noted, such as experiment.profile

    @property
    def message_count(self) -> int:
        """Messages on all topics."""
        return sum(topic.message_count for topic in self.topics)

    @property
    def duration(self) -> float:
        """[s] from the earliest log time to the latest."""
        return (self.span.last - self.span.first) * 1e-9 if self.span else 0.0

    def joined(self, other: "Contents") -> "Contents":
        """The contents of two files of one bag."""
        topics = {topic.name: topic for topic in self.topics}
        for topic in other.topics:
            before = topics[topic.name].message_count if topic.name in topics else 0
            topics[topic.name] = replace(topic, message_count=before + topic.message_count)
        span = self.span or other.span
        if span and other.span:
            span = span.including(other.span.first).including(other.span.last)
        noted = {**self.custom_data, **other.custom_data}
        return Contents(tuple(topics.values()), span, self.cut or other.cut, noted)
