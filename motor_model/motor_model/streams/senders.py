"""Keep apart who sends references, by the numbers that the middleware gives each publisher's messages.

What ends a reference ends it for everybody who was sending; each of them has to begin again for himself (`sequence`). A
0 of somebody else, or another's reference, lets no stream go on.

A sender whose first message is heard has just begun, and is judged by how long no other such one has come: a command
in a shell is a new sender each time. One that is first heard later was there before this controller, or began while the
middleware introduced the two: its pace tells which. Who has been there for long without a word begins with the first.

A number may be the next of several: it is theirs who were heard lately, and whose pace it fits. What may be of a stream
that goes on beyond an end is not obeyed then, but for a 0, with which nobody begins.

Where time alone ended a reference, who had been obeyed may go on: he was silent for as long as his user says. His pace
is known beyond that: whatever else ends a reference bars a stream that is slower than such a time, too.
"""

from dataclasses import dataclass, replace
from math import isnan, nan
from typing import NamedTuple

from motor_model.streams.sequence import LONGEST, LONGEST_OF_ONE, Sequence

MOST = 16  # senders that are remembered
# Times the shortest, and the usual, time between two messages: as many as are lost take longer than that each, and not
# longer; else it is somebody's who is heard for the first time.
CLOSEST, FARTHEST = 0.5, 2.0
HELD_UP, MOST_LOST = 4.0, 8.0  # [s] in which messages are lost at most, and of a slow stream so many
# A stream that overtakes another's numbers shares one or two of them; of two that are one number apart, every other
# message may be either's, and so many of the latest tell these from those.
MANY, LATEST = 3, 8
LISTENED = 0.2  # [s] after which a pace is known
YOUNG = 2.5  # [s] of messages that a sender may have sent unheard: `ros2 topic pub` waits for nobody, once a second
# [s] by which it may have begun before the controller. That takes as long to start: no controller before it has heard
# such a sender, and a launch file starts both at once.
SLACK = 1.0


class Message(NamedTuple):
    """One reference."""

    topic: str
    number: int | None  # how many its publisher has sent; None: the middleware does not count
    value: float  # [rad/s] or [rad]
    stops: bool  # it is a speed of 0
    now: float  # [s] when it came


@dataclass(frozen=True, slots=True)
class Sender:
    """One publisher of references, or all of a topic that nobody counts."""

    topic: str
    number: int | None  # of the latest message
    sequence: Sequence = Sequence()
    obeyed: int = -1  # how many references had ended when it last began
    forgiven: int = -1  # how many had, of which the last one ended by its time alone
    first: tuple[int, float] | None = None  # number and time [s] of what was first heard, until its age is known
    period: float = 0.0  # [s] the shortest between two with successive numbers; 0: not known
    shared: int = 0  # which of its latest messages may have been another stream's, a bit each

    def count_steps(self, message: Message) -> int:
        """Count the messages from the latest one to this; 0: it is not this sender's."""
        if message.topic != self.topic or (message.number is None) != (self.number is None):
            return 0
        if message.number is None or self.number is None:
            return 1
        steps = message.number - self.number
        passed = self._pass_to(message)
        longest = FARTHEST * max(self.period, self.sequence.latest if self.is_stream else 0.0)
        paced = steps > 1 and self.period > 0.0 and CLOSEST * self.period <= passed / steps <= longest
        lost = paced and passed <= max(self.sequence.needed, HELD_UP, MOST_LOST * self.sequence.latest)
        return steps if steps == 1 or lost else 0

    @property
    def is_stream(self) -> bool:
        """Whether it has sent more than one."""
        return not isnan(self.sequence.latest)

    def goes_on(self, message: Message) -> bool:
        """Tell whether a message would come without a silence: this sender was heard a moment ago.

        Who has sent one alone has no pace, and has ended, as a command in a shell does.
        """
        needed = self.sequence.needed if self.is_stream else LONGEST
        return self._pass_to(message) <= needed

    def measure_deviation(self, message: Message) -> float:
        """Measure how far from its own pace it would send a message that may be its next, in its periods.

        Of two that have none yet, who was heard first is next; unless they have fallen silent, who was heard last.
        """
        passed, latest = self._pass_to(message), self.sequence.latest
        if latest > 0.0:
            return abs(passed / self.count_steps(message) - latest) / latest
        return -passed if self.goes_on(message) else passed

    def _pass_to(self, message: Message) -> float:
        """[s] from its latest message to another."""
        return message.now - (self.sequence.heard or 0.0)

    def hear(self, message: Message, since: float) -> "Sender":
        """Take one more; since [s]: when the controller began."""
        took = message.now - (self.sequence.heard or message.now)
        follows = message.number is not None and message.number == (self.number or 0) + 1
        period = min(took, self.period or took) if follows else self.period
        sequence, first = _hear(self.sequence, message, self.count_steps(message)), self.first
        if first is not None and _is_young(first, message, since):
            sequence, first = replace(sequence, begins=True), None
        elif first is not None and message.now - first[1] > YOUNG + LISTENED:
            first = None
        return replace(self, number=message.number, sequence=sequence, first=first, period=period)


@dataclass(frozen=True, slots=True)
class Senders:
    """Who has sent references, latest last, and how many references have ended."""

    ended: int = 0
    known: tuple[Sender, ...] = ()
    longest: float = LONGEST_OF_ONE  # [s] between two messages of one that are a stream
    firsts: Sequence = Sequence()  # the first messages of senders
    began: int = -1  # how many references had ended when such a message was last obeyed
    forgiven: int = -1  # as of a sender, for such messages
    stops: bool = False  # the latest message is a speed of 0
    doubted: bool = False  # the latest message may be a stream's that is barred as well: nobody begins with it

    def hear(self, message: Message, since: float, introduced: float) -> "Senders":
        """Take a message, whose sender is the last one then.

        since [s]: when the controller began; introduced: when the latest publisher was first seen to be there.
        """
        found, shared, doubted = self._find(message)
        others = tuple(one for one in self.known if one is not found)
        firsts = self.firsts
        if found is not None:
            sender = found.hear(_without_stop(message, doubted), since)
            sender = replace(sender, shared=(sender.shared << 1 | shared) % 2**LATEST)
            if doubted and not message.stops and sender.shared.bit_count() >= MANY:
                sender = replace(sender, obeyed=-1, forgiven=-1)  # it may be the barred stream's from here on
        elif message.number == 1:
            firsts = firsts.hear(message.now, message.stops)
            sender = _start(message, firsts.begins or self.forgiven == self.ended, self.longest)
        else:
            silence = message.now - introduced
            quiet = silence > (LONGEST if message.number is None else self.longest)
            sender = _start(message, quiet, self.longest, unheard=not quiet)
        known = (*others, sender)[-MOST:]
        return replace(self, known=known, firsts=firsts, stops=message.stops, doubted=doubted)

    @property
    def latest(self) -> Sender:
        """Whose message came last."""
        return self.known[-1]

    def bars(self, driven: bool) -> bool:
        """Tell whether the latest sender goes on with what was ended; driven: what somebody asks for is in force.

        Then a sender that begins, or all those whom nobody counts, may ask for something else. A speed of 0 is obeyed,
        whoever sends it.
        """
        if self.stops or self.doubted:
            return not self.stops
        joins = driven and self.latest.number in (1, None)
        return not (self._trusts(self.latest) or self.latest.sequence.begins or joins)

    def obey(self) -> "Senders":
        """Obey the latest sender until a reference is ended; of what may be a barred stream's, nobody."""
        if self.doubted:
            return self
        began = self.ended if self.latest.number == 1 else self.began
        return replace(self, known=(*self.known[:-1], replace(self.latest, obeyed=self.ended)), began=began)

    def end(self) -> "Senders":
        """End what everybody asked for."""
        return replace(self, ended=self.ended + 1, known=tuple(replace(one, first=None) for one in self.known))

    def forgive(self) -> "Senders":
        """Let those who are obeyed go on beyond the next end, which their own silence brings, and no further.

        Their pace stays known.
        """
        after = self.ended + 1
        known = (replace(one, forgiven=after) if self._trusts(one) else one for one in self.known)
        firsts = after if self.ended in (self.began, self.forgiven) else self.forgiven
        return replace(self, known=tuple(known), forgiven=firsts)

    @property
    def forgives(self) -> bool:
        """Whether somebody may go on, since time alone has ended what he asked for."""
        return self.forgiven == self.ended or any(one.forgiven == self.ended for one in self.known)

    @property
    def streams(self) -> bool:
        """Whether what is asked for is the latest message of a stream: who is obeyed has sent more than one.

        Of those whom nobody counts two far apart are two commands in a shell.
        """
        obeyed = [one for one in self.known if one.obeyed == self.ended]
        if not obeyed or not obeyed[-1].is_stream:
            return False
        return obeyed[-1].number is not None or obeyed[-1].sequence.latest <= LONGEST

    def trust_single(self) -> "Senders":
        """Take a sender that has asked once for no stream: somebody who looks expects the same again."""
        known = (replace(one, sequence=replace(one.sequence, single=nan)) for one in self.known)
        return replace(self, known=tuple(known))

    def _find(self, message: Message) -> tuple[Sender | None, bool, bool]:
        """Find whose next message it is, whether it may be another stream's, and one's that goes on beyond an end.

        Where it may be several's, it is one's who goes on, and whose pace it fits best. A stream that was ended passes
        the number at which another one fell silent, which begins with its next message; and two of one launch file are
        at the same number all the time.
        """
        able = [one for one in self.known if one.count_steps(message)]
        found = min(able, key=lambda one: self._rank(one, message), default=None)
        others = [one for one in able if one is not found and one.is_stream and one.goes_on(message)]
        return found, bool(others), not all(self._trusts(one) for one in others)

    def _rank(self, one: Sender, message: Message) -> tuple[bool, float, int, bool]:
        pace = one.measure_deviation(message)
        return (not one.goes_on(message), pace, one.count_steps(message), self._trusts(one))

    def _trusts(self, one: Sender) -> bool:
        return self.ended in (one.obeyed, one.forgiven)


def _without_stop(message: Message, doubted: bool) -> Message:
    """Take from a 0 that may be another's that its sender stops; it is obeyed all the same."""
    return message._replace(stops=message.stops and not doubted)


def _hear(sequence: Sequence, message: Message, steps: int = 1) -> Sequence:
    """Hear a message in a sequence, so many after the latest: who has sent some that were lost was not silent.

    What those ask for whom nobody keeps apart says nothing of a stream.
    """
    return sequence.hear(message.now, message.stops, nan if message.number is None else message.value, steps)


def _start(message: Message, begins: bool, longest: float, unheard: bool = False) -> Sender:
    """Start with the first message that is heard of a sender; unheard: it may have sent others before.

    longest: the time [s] between two that are a stream, of one sender.
    """
    empty = Sequence() if message.number is None else Sequence(longest=longest)
    sequence = replace(_hear(empty, message), begins=begins or message.stops)
    first = (message.number, message.now) if unheard and message.number is not None else None
    return Sender(message.topic, message.number, sequence, first=first)


def _is_young(first: tuple[int, float], message: Message, since: float) -> bool:
    """Tell by the pace of its messages whether a sender sent its very first one after the controller began."""
    number, then = first
    listened, steps = message.now - then, (message.number or 0) - number
    if listened < LISTENED or steps <= 0:
        return False
    age = (number - 1) * listened / steps
    return age <= YOUNG and then - age >= since - SLACK
