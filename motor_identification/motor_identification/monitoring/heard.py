"""Keep what was just heard on some topics, to be read like a bag: the last seconds, and what held before them."""

from collections import Counter, deque
from collections.abc import Container, Iterator
from heapq import merge
from operator import itemgetter

from motor_identification.bag.definition import installed
from motor_identification.bag.storage import Stored
from motor_identification.bag.topic import Qos, Topic


class Heard:
    """Messages of the last `length` seconds, and the latest before them of every topic: a command that still holds."""

    def __init__(self, length: float) -> None:
        self.uri = "what was just heard"
        self.cut = False
        self.damaged = self.lost = self.garbled = 0
        self.missing: list[str] = []
        self.topics: dict[str, Topic] = {}
        self.counts: Counter[str] = Counter()  # messages by topic, since the beginning
        self._length = round(length * 1e9)  # [ns]
        self._channels: list[str] = []
        self._messages: dict[str, deque[tuple[int, bytes]]] = {}

    def topic(self, name: str, type_name: str, qos: tuple[Qos, ...] = ()) -> int:
        """Open a channel for `write`; a name that is known already keeps its own."""
        if name not in self.topics:
            self.topics[name] = Topic(name, type_name, installed(type_name).text, qos)
            self._messages[name] = deque()
            self._channels.append(name)
        return self._channels.index(name)

    def write(self, channel: int, log_time: int, data: bytes, publish_time: int | None = None) -> None:
        """Take a serialised message, received at `log_time` [ns]; forget what is too old, or before a clock's step."""
        name = self._channels[channel]
        kept = self._messages[name]
        if kept and log_time < kept[-1][0] - self._length:
            kept.clear()
        kept.append((log_time, data))
        while len(kept) > 1 and kept[1][0] < log_time - self._length:
            kept.popleft()
        self.counts[name] += 1

    def flush(self) -> None:
        """Nothing is written anywhere."""

    def latest(self, name: str) -> int | None:
        """When the latest message of a topic was received [ns]; None before the first."""
        kept = self._messages.get(name)
        return kept[-1][0] if kept else None

    def copy(self) -> "Heard":
        """What is there now, for another thread."""
        other = Heard(self._length * 1e-9)
        other.topics, other.counts, other._channels = dict(self.topics), Counter(self.counts), list(self._channels)
        other._messages = {name: deque(kept) for name, kept in self._messages.items()}
        return other

    def messages(self, wanted: Container[str] | None = None) -> Iterator[Stored]:
        """Messages of the wanted topics (None: of all) in the order in which they were received."""
        self.garbled = 0
        rows = [
            [(received, self.topics[name], data) for received, data in kept]
            for name, kept in self._messages.items()
            if wanted is None or name in wanted
        ]
        for received, topic, data in merge(*rows, key=itemgetter(0)):
            yield topic, received, data
