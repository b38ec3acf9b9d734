"""Tell the senders of one topic apart: by what they call themselves, and by the numbers of their messages.

rclpy passes on no identity of a publisher, but the number that the middleware has given each of its messages. One
sender's numbers go up by one with each message it sends; a message whose number does not fit is somebody else's.
"""

from dataclasses import dataclass, replace

CLOSEST = 0.5  # of the time that as many messages took when they came quickest: they come no closer together
DUE = 0.8, 2.0  # of that time: a message that comes then comes as the sender's would
QUICKEST = 1_000_000  # [ns] between two commands, while that time is not known: no plant samples faster


@dataclass(frozen=True, slots=True)
class Sender:
    """The latest message of a sender; `number` is None where the middleware does not count."""

    name: str
    number: int | None
    at: int  # [ns] when it came
    period: int = 0  # [ns] the shortest between two with successive numbers; 0: not known
    moves: bool = True  # what it asks for moves something
    first: "Sender | None" = None  # its first message that was heard, if another, and it has gone on from there
    passed: int = 0  # while it is left aside: the latest of its numbers that the one that is obeyed had sent before

    def sent(self, name: str, number: int | None, now: int) -> bool:
        """Whether a message that comes at `now` [ns] is this sender's next one, or a later one."""
        if name != self.name:
            return False
        if number is None or self.number is None:
            return True
        steps = number - self.number
        return steps > 0 and now - self.at >= CLOSEST * (self.period or QUICKEST) * (steps if steps > 1 else 0)

    def sent_between(self, message: "Sender", number: int | None) -> bool:
        """Whether this sender may have sent a message that seemed another's, before its own one with this number."""
        if message.name != self.name:
            return False
        if self.number is None or message.number is None:
            return True
        return self.number < message.number and (number is None or message.number < number)

    def goes_on_in(self, message: "Sender") -> bool:
        """Whether a message is this sender's next one, or a later one."""
        return self.sent(message.name, message.number, message.at)

    def is_before(self, other: "Sender | None", message: "Sender") -> bool:
        """Whether another of this sender's name is nearer to a message, by its numbers."""
        if other is None or other.name != message.name:
            return False
        return (self.number or 0) < (other.number or 0) < (message.number or 0)

    def has_sent(self, message: "Sender") -> bool:
        """Whether this sender's numbers are past a message's: under its name, that is another one's."""
        both = message.name == self.name and message.number is not None and self.number is not None
        return both and (message.number or 0) <= (self.number or 0)

    def is_before_by(self, steps: int, message: "Sender") -> bool:
        """Whether a message is so many numbers on at most."""
        return 0 < (message.number or 0) - (self.number or 0) <= steps

    def is_due(self, message: "Sender") -> bool:
        """Whether a message comes when this sender's with that number would, by its pace; not if that is not known."""
        due = self.period * ((message.number or 0) - (self.number or 0))
        return due > 0 and DUE[0] * due <= message.at - self.at <= DUE[1] * due

    def follow(self, before: "Sender | None") -> "Sender":
        """This message, with what was heard first, where it goes on from the one before."""
        goes_on = before is not None and before.goes_on_in(self)
        return replace(self, first=before.first or before) if before is not None and goes_on else self

    def after(self, number: int | None, now: int) -> "Sender":
        """This sender after one more message.

        Of the times between two messages the shortest counts: a busy computer that has held a sender up lets its next
        messages come as quickly as ever, and some of them are lost.
        """
        if number is None or self.number is None or number != self.number + 1:
            return replace(self, number=number, at=now)
        took = max(now - self.at, QUICKEST)
        return replace(self, number=number, at=now, period=min(took, self.period or took))
