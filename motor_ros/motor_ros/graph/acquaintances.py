"""Know those who may command a motor before anything counts that they send, and those who only play a recording.

The middleware tells of a publisher first, then of its node's name, and then of the node's services; messages may come
before all of that. So a message waits until the node of everybody who publishes there is known, and has been for long
enough to be recognised as a player. One that was sent while a player was there, or somebody whose node was never known,
is not obeyed: nobody can tell whose it was. Nor is a request that was sent while somebody was there who has ended
before it was known for long enough, for who asks waits for the answer; who publishes once may end at once.

Who was not there at a look after a message had come, has not sent it: a message waits for no newcomers of later, which
would be for ever beside nodes that come and go. When somebody was first seen says nothing of that: a busy program looks
seldom. A request waits for all of them, for it may come before its sender is listed.

Times are ns on a clock that is never set.
"""

from collections.abc import Iterable, Set
from dataclasses import dataclass, field
from enum import Enum, auto

from motor_ros.graph.publishers import Id, Publisher

# [ns] for which a publisher's node is known before what it sends counts: its services are known by then. They are
# announced within a few ms of its publishers; a tenth of a second was seen on a busy computer.
SETTLED = 200_000_000
WATCHED = 10_000_000_000  # [ns] for which its services are looked at all the same
LISTED = 100_000_000  # [ns] after a message by which its publisher is listed: it is before, on a computer that has time
PATIENCE = 2_000_000_000  # [ns] for which a message waits: what comes later than that is no answer to anybody any more


class Verdict(Enum):
    """What becomes of a message."""

    OBEYED = auto()
    WAITS = auto()
    REFUSED = auto()


@dataclass(frozen=True, slots=True)
class Acquaintances:
    """Who publishes some topics, since when their nodes are known, and who of them plays a recording."""

    listed: dict[Id, int] = field(default_factory=dict)  # [ns] the latest look at which each was not there yet
    known: dict[Id, int] = field(default_factory=dict)  # [ns] since when
    unknown: frozenset[Id] = frozenset()
    players: str = ""  # their nodes' names
    doubted: int | None = None  # [ns] the latest look at which nobody could tell whose a message was
    newest: int | None = None  # [ns] when the latest node came to be known
    looked: int = 0  # [ns] the latest look, as it began
    awaited: bool = False  # who sends waits for an answer: one that ends before it has settled may be no hand

    def look(
        self, publishers: Iterable[Publisher], players: Set[str], now: int, begun: int | None = None
    ) -> "Acquaintances":
        """See at `now` who publishes; players: names of all nodes that play recordings.

        begun: when they began to be listed, if before `now`: who is not among them may have come since.
        """
        there = list(publishers)
        listed = {one.id: self.listed.get(one.id, self.looked) for one in there}
        known = {one.id: self.known.get(one.id, now) for one in there if one.node}
        unknown = frozenset(one.id for one in there if not one.node)
        playing = ", ".join(sorted({one.node for one in there if one.node in players}))
        left = self.unknown - unknown - known.keys()
        if self.awaited:
            left |= {one for one in self.known.keys() - known.keys() if self.looked - self.known[one] < SETTLED}
        came = known.keys() - self.known.keys()
        doubted = now if playing or self.players or left else self.doubted  # who has just gone may have sent before
        newest = now if came else self.newest
        looked = now if begun is None else begun
        return Acquaintances(listed, known, unknown, playing, doubted, newest, looked, self.awaited)

    def watches(self, now: int) -> bool:
        """Whether somebody may still turn out to be a player."""
        return bool(self.unknown or self.players) or (self.newest is not None and now - self.newest <= WATCHED)

    def judge(self, at: int, now: int) -> Verdict:
        """Judge at `now` a message that came at `at`."""
        if self.players or (self.doubted is not None and self.doubted >= at):
            return Verdict.REFUSED
        senders = [one for one, absent in self.listed.items() if self.awaited or absent <= at + LISTED]
        if all(one in self.known and now - self.known[one] >= SETTLED for one in senders):
            return Verdict.OBEYED
        return Verdict.WAITS if now - at <= PATIENCE else Verdict.REFUSED
