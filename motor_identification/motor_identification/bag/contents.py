"""What is in a bag, before anybody reads its messages."""

from dataclasses import dataclass, replace

from motor_identification.bag.metadata import Span
from motor_identification.bag.topic import Topic


@dataclass(frozen=True, slots=True)
class Contents:
    """Topics with their numbers of messages, and the log times they span (None without messages)."""

    topics: tuple[Topic, ...] = ()
    span: Span | None = None
    cut: bool = False  # a file ends before its end: this is what can be read

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
        return Contents(tuple(topics.values()), span, self.cut or other.cut)
