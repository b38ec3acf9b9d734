"""Reads any topic of a bag: what is in it, and its messages as they were serialised."""

from collections.abc import Callable, Container, Iterable, Iterator
from heapq import heappop, heappush
from pathlib import Path

from motor_identification.bag.contents import Contents
from motor_identification.bag.storage import Bag, tell_damage
from motor_identification.bag.topic import Topic
from motor_model.errors import RecordingError

Message = tuple[str, str, int, bytes]  # topic, type, log time [ns since 1970], CDR with its encapsulation header

_LOOK_AHEAD = 20_000  # messages: recorders write in the order of arrival, which is nearly that of the log times


def contents(uri: str | Path) -> Contents:
    """Topics, counts and times of a bag.

    Raises:
        RecordingError: no such bag, or not a bag.
    """
    return Bag(uri).contents()


def topics(uri: str | Path) -> tuple[Topic, ...]:
    """List the topics of a bag, with type, offered QoS and number of messages.

    Raises:
        RecordingError: no such bag, or not a bag.
    """
    return contents(uri).topics


def messages(
    uri: str | Path, topics: Container[str] | None = None, tell: Callable[[str], object] = lambda damage: None
) -> Iterator[Message]:
    """Messages on the topics (None: on all) in the order of the file; a bag that is cut off ends at the cut.

    Args:
        uri: the bag.
        topics: whose messages are wanted.
        tell: hears at the end what is damaged, if anything is.

    Raises:
        RecordingError: no such bag, or not a bag.
    """
    bag = Bag(uri)
    for topic, log_time, data in bag.messages(topics):
        yield topic.name, topic.type_name, log_time, data
    if damage := tell_damage(bag, str(uri), "read"):
        tell(damage)


def in_time_order(stored: Iterable[Message], uri: str | Path) -> Iterator[Message]:
    """Return the same messages by log time, with memory for a few of them only.

    Raises:
        RecordingError: a message stands more than 20,000 messages behind its place.
    """
    waiting: list[tuple[int, int, Message]] = []
    latest = 0
    for number, message in enumerate(stored):
        if message[2] < latest:
            raise RecordingError(
                f"{uri}: the messages are not in the order of their log times; sort it, for example with `mcap sort`."
            )
        heappush(waiting, (message[2], number, message))
        if len(waiting) > _LOOK_AHEAD:
            latest, _, first = heappop(waiting)
            yield first
    while waiting:
        yield heappop(waiting)[2]
