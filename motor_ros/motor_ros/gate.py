"""What a plant lets through to the motor: nothing while off, stale or not a number, and only what begins at 0 V.

    off      latched: by motor/enable with data: false, or by a stop; only motor/enable with data: true ends it
    waiting  on, but the sender began before the plant came up: 0 V until it sends 0 V, or motor/enable
    driven   the newest voltage of one sender; another's are left aside until that one has been silent for HOLD

Whoever then takes its place is heard to begin, by its numbers, or has to begin at 0 V: it is most often one that was
forgotten, and the motor has just been stopped. What was left aside of it until then is heard, too. So has who was left
aside beside another that drove, and who went on sending while nothing of it was heard for a second and more, because
its link was away or the plant stood still: the motor has stood meanwhile, and nobody expects it to go on by itself.

That there are two is known once the first is heard again after the other: one sender that was held up sends what it has
missed all at once, more than is kept, and its numbers jump ahead as another's would. Its next numbers go on from there.
Two that send so seldom that each takes the other's place are known as soon as one of them comes back: none drives.

Two that call themselves the same are told apart by their numbers alone, and only where these are so far APART that
neither can reach the other's while it is waited for. Where they are closer a message that is late, or lost, makes one
pass for the other, and nobody knows whose voltage it is: the motor gets 0 V as long as both are heard, whatever they
send and whoever switches on, and who is left has to begin at 0 V. A single 0 V that is left aside, such as the last
word of a controller, mixes nothing.

A program that is ended and started again has its old name, and numbers that go back. They are left aside until the old
one has been silent for HOLD, and where they pass the old one's they are still its own: unless they come when the
old one's would, or go back again to one that was not heard, which no program's do. Then there are two; in doubt the
motor gets 0 V.

Where the motor itself was the reason of a stop, it is let on again later and later: see `RepeatedStops`. Who goes on
calling motor/enable with data: true through a stop, or somebody else's data: false, has not seen it.

Times are ns on a clock that is never set.
"""

from dataclasses import dataclass, replace
from math import isfinite

from motor_model.sensing.repeated_stops import RepeatedStops
from motor_ros.sender import CLOSEST, QUICKEST, Sender

QUIET = 2_000_000_000  # [ns] without any voltage; where nobody counts, who sent before would have been heard by then
PACE = 50_000_000, 500_000_000  # [ns] after its first command within which a sender's pace is judged
SLOWED = 2.0  # a busy computer may let commands come so many times slower than they were sent before
SLACK = 100_000_000  # [ns] by which a sender may have begun too early: nobody starts a plant again so quickly
# [ns] of commands that a sender may have sent unheard, before plant and sender found each other. One at the pace of the
# samples may be answering them: it sends nothing while there is no plant, so that its numbers say little of its age.
YOUNG, YOUNG_ANSWER = 1_000_000_000, 100_000_000
ANSWERS = 2.0  # sample periods from command to command, up to which a sender may be answering samples
HOLD = 500_000_000  # [ns] of silence after which another sender is obeyed: longer than a busy computer holds one up
APART = round(HOLD / (CLOSEST * QUICKEST))  # numbers that no sender goes on by while another is waited for
AWAY = 1_000_000_000  # [ns] without a voltage, after which a motor that goes on by itself is a surprise
UNHEARD = 10  # commands more than that are not lost to a plant that looks less often than they come: it heard none
CALLS, PAUSE = 3, 500_000_000  # to switch on what is on, each within a PAUSE [ns] of the one before: no hand does that
SELDOM = 10_000_000_000  # [ns] between two commands of a sender: two that send by turns are said for twice as long
CONFLICT = 1_500_000_000  # [ns] for which a second sender is reported: longer than from one diagnostic to the next

OFF = "The output is off: call motor/enable with data: true."
STOPPED = "The output is off ({}): call motor/enable with data: true."
WAITING = (
    "{:.3g} V was already being sent on motor/voltage when the plant came up: the motor gets 0 V until 0 V is sent, or"
    " motor/enable is called with data: true."
)
HANDED = (
    "{:.3g} V was already being sent on motor/voltage beside another node that drove the motor and has ended: the motor"
    " gets 0 V until 0 V is sent, or motor/enable is called with data: true."
)
AWAY_LINK = (
    "{:.3g} V went on being sent on motor/voltage while the plant heard none of it for more than 1 s, as over a link "
    "that is away, or to a plant that stands still: the motor gets 0 V until 0 V is sent, or motor/enable is called "
    "with data: true."
)
INSISTED = (
    "motor/enable was being called with data: true, again and again, when the output was switched off: pause for "
    "{:g} s, then call it."
)
TWO_SENDERS = (
    "More than one node sends motor/voltage{}: only {} is obeyed, until it has been silent for {:.3g} s; end the"
    " others."
)
MIXED = (
    "More than one node sends motor/voltage{}, all with frame_id '{}', and whose command is whose cannot be told: the"
    " motor gets 0 V; end all but one, and {:.3g} s later let that one send 0 V, or call motor/enable with data: true."
)
NONE_OBEYED = (
    "More than one node sends motor/voltage{}: the motor gets 0 V; end all but one, and let that one send 0 V, or call"
    " motor/enable with data: true."
)
NO_NUMBER = "{:g} on motor/voltage is not a number (frame_id '{}'{}): {}; send numbers, or end who sends it."
GETS_NOTHING = "the motor gets 0 V until the next number"
LEFT_ASIDE = "it is left aside beside the sender that is obeyed"


@dataclass(frozen=True, slots=True)
class NoNumber:
    """A command that was not a number."""

    voltage: float
    name: str  # its frame_id
    at: int  # [ns] when it came
    stops: bool  # it was, or may have been, of the sender that is obeyed


@dataclass(frozen=True, slots=True)
class Gate:
    """The newest command and whether it may act; every method returns the next gate."""

    enabled: bool
    timeout: float  # [s] after which a command is stale
    sample_period: float = 0.0  # [s] of the plant; 0: not known
    since: int = 0  # [ns] the plant came up, or its board did, or who drove it before was heard for the last time
    switched: int = 0  # [ns] the user switched the output: no voltage that was sent before acts
    stopped: str = ""  # why the output was switched off; empty: by the user, or never
    faults: RepeatedStops = RepeatedStops()  # stops for what the motor did
    begun: bool = False  # the voltages have started from 0 V, or were allowed by motor/enable
    barred: bool = False  # they have not, and only those two let them: of one that went on unheard, or left aside
    waits: str = WAITING  # what is said of voltages that have not begun
    first: Sender | None = None  # the sender's first command that was heard since then
    command: float = 0.0  # [V]
    received: int | None = None  # [ns]
    sender: Sender | None = None  # of that command
    former: Sender | None = None  # whose place the sender took just now: if it is heard again, both are there
    aside: Sender | None = None  # what tells most of those of its name that seemed another's, until it is heard again
    beside: Sender | None = None  # likewise the latest of another name
    rival: Sender | None = None  # another sender's latest command, while both sent
    rival_until: int = 0  # [ns] so long both are taken to be there: they have been heard, or one was left aside since
    mixed: bool = False  # since both are heard, they have one name and close numbers
    refused: int = 0  # commands that were not numbers
    no_number: NoNumber | None = None  # the latest of those
    calls: int = 0  # to switch on what was on, one soon after the other
    called: int = 0  # [ns] the latest call to switch on

    def take(
        self,
        voltage: float,
        now: int,
        name: str = "",
        number: int | None = None,
        waited: int = 0,
        sent: int | None = None,
    ) -> "Gate":
        """A command [V] of a sender is taken at `now` [ns]; one that is not a number stops the motor.

        Another sender's, beside the one that is obeyed, is left aside as its numbers are; in doubt it stops the motor.
        `name` is the message's frame_id, `number` how many messages its publisher has sent, None if unknown; `waited`
        [ns] how long ago it was received: a plant that is held up takes it late, and it is as old as it is. `sent` [ns]
        is when it was sent, if known: what was on its way when the output was switched does not act.
        """
        message = Sender(name, number, now, moves=voltage != 0.0)
        if not isfinite(voltage):
            return self._refuse(voltage, message)
        holder = self.sender
        if holder is None:
            told, bar = replace(self, sender=message), ""
        elif self._is_ours(message):
            told, bar = self._go_on(holder, message), self._bar_own(holder, message)
        elif self.waits_for_sender(now):
            left, its_own = self._leave_aside(message), holder.goes_on_in(message) and not self.conflict(now)
            return replace(left, command=0.0) if its_own else left  # or it may be
        else:
            told, bar = self._hand_over(holder, message)
        late = waited > max(AWAY, self.timeout * 1e9)
        received = now - waited if sent is None or sent >= self.switched else None
        return replace(told, command=voltage, received=received)._begin(message, AWAY_LINK if late else bar)

    def _begin(self, message: Sender, bar: str) -> "Gate":
        """Whether the voltages have begun, once the sender's latest is this one; `bar`: why they have not."""
        first = self.first or message
        if self.mixed and self.conflict(message.at):
            return replace(self, first=first, mixed=True, begun=False, barred=True, waits=HANDED)
        told = replace(self, first=first, mixed=False)
        if not message.moves:
            return replace(told, begun=True, barred=False)
        if bar:
            return replace(told, begun=False, barred=True, waits=bar)
        begins = not self.barred and _began(first, message, self.since, self.sample_period * 1e9)
        return replace(told, begun=self.begun or begins)

    def waits_for_sender(self, now: int) -> bool:
        """Whether another's command at `now` [ns] is left aside: the sender may be heard again."""
        return self.sender is not None and now - self.sender.at <= HOLD

    def _is_ours(self, message: Sender) -> bool:
        """Whether a message is the next one of the sender, and no likelier the next of another one that is known."""
        holder = self.sender
        if holder is None or not holder.goes_on_in(message):
            return False
        former = self.former
        if self.conflict(message.at):
            return not any(holder.is_before(other, message) for other in (former, self.rival))
        if holder.is_before(former, message) and not (holder.is_due(message) or self._has_ended(former, message)):
            return False
        return not self._restarted(holder, message)

    def _has_ended(self, former: Sender | None, message: Sender) -> bool:
        """Whether whose place the sender took has been silent for long, by its pace; the message is one of a few on."""
        if former is None or self.sender is None or not self.sender.is_before_by(UNHEARD, message):
            return False
        return 0 < former.period * UNHEARD < message.at - former.at > AWAY

    def _restarted(self, holder: Sender, message: Sender) -> bool:
        """Whether a message goes on from one that was left aside with a number which the sender had sent before.

        That is another of its name: most often the same program, ended and started again, whose numbers pass in the end
        those of before. If it is another one beside it, one of the two is soon behind the other: see `_leave_aside`.
        """
        other = self.aside
        if other is None or not holder.has_sent(other.first or other) or not other.goes_on_in(message):
            return False
        if (other.first or other).at < holder.at + QUICKEST:  # nobody starts a program again so quickly
            return False
        nearer = holder.is_before(other, message) or (other.first is not None and other.is_before_by(1, message))
        return other.is_before_by(UNHEARD, message) and (nearer or not holder.is_due(message))

    def _bar_own(self, holder: Sender, message: Sender) -> str:
        """Why the sender that is obeyed has to begin again with a message; empty if it need not."""
        if message.at - holder.at > HOLD and self._rivals_name(message.name) and self.conflict(message.at):
            return HANDED
        return AWAY_LINK if self._goes_on_unheard(holder.number or 0, message) else ""

    def _goes_on_unheard(self, number: int, message: Sender) -> bool:
        """Whether a sender, since its message of that number, has sent for long while nothing was heard."""
        if self.sender is None or message.number is None:
            return False
        return message.at - self.sender.at > max(AWAY, self.timeout * 1e9) and message.number - number > UNHEARD

    def _hand_over(self, holder: Sender, message: Sender) -> tuple["Gate", str]:
        """Another takes the place of a sender that has been silent, and why it has to begin; empty if it is seen to.

        Where the two have sent in turn, they are told as two that send at once.
        """
        now, former = message.at, self.former
        newcomer = message.follow(self.aside).follow(self.beside)
        first = newcomer.first or newcomer
        since, period = now if message.number is None else max(self.since, holder.at), self.sample_period * 1e9
        told = replace(
            self,
            # whoever comes first after motor/enable, or was heard to begin while it was left aside
            begun=self.begun and holder.at <= self.switched or _began(first, message, since, period, heard=True),
            barred=False,
            waits=AWAY_LINK if self._goes_on_unheard(0, first) else HANDED,
            since=since,
            first=first,
            sender=newcomer,
            former=holder,
            aside=None,
            beside=None,
        )
        alike = former is not None and former.name == holder.name
        if former is not None and former.goes_on_in(message) and (message.moves or alike):
            until = now + max(CONFLICT, 2 * min(now - former.at, SELDOM))
            return replace(told, rival=holder, rival_until=until, mixed=self._is_close(message)), HANDED
        return told, HANDED if self._was_left(message) else ""

    def _refuse(self, voltage: float, message: Sender) -> "Gate":
        stops = self._may_be_obeyed(message)
        told = replace(self, refused=self.refused + 1, no_number=NoNumber(voltage, message.name, message.at, stops))
        return replace(told, command=0.0, received=None) if stops else told._leave_aside(message)

    def _may_be_obeyed(self, message: Sender) -> bool:
        """Whether a command may be of the sender that is obeyed, also where it came sooner than its own would."""
        holder = self.sender
        if holder is None or not self.waits_for_sender(message.at):
            return True
        both = message.number is not None and holder.number is not None
        return message.name == holder.name and (not both or (message.number or 0) > (holder.number or 0))

    def goes_on(self, name: str, number: int | None, now: int) -> bool:
        """Whether a command at `now` [ns] is the next one of the sender that is obeyed."""
        return self.waits_for_sender(now) and self._is_ours(Sender(name, number, now))

    def _leave_aside(self, message: Sender) -> "Gate":
        """A message that does not seem the sender's is left aside; as long as that goes on, the two are in conflict."""
        again = max(self.rival_until, message.at + CONFLICT)
        seen = replace(self, rival_until=again if self.conflict(message.at) else self.rival_until)
        if self.sender is None or message.name != self.sender.name:  # it does not hide who has the sender's name
            return replace(seen, beside=message.follow(self.beside))
        before, holder, latest = self.aside, self.sender, message.follow(self.aside)
        if before is None or not holder.has_sent(before.first or before):
            return replace(seen, aside=max(filter(None, (before, latest)), key=self._tells))
        if latest.first is not None:  # from numbers that the sender has sent before, maybe past them
            passed = latest.number if holder.has_sent(latest) else before.passed or before.number
            return replace(seen, aside=replace(latest, moves=before.moves or latest.moves, passed=passed or 0))
        if before.has_sent(message) and not holder.has_sent(before) and (message.number or 0) > before.passed:
            return replace(seen, aside=message)._go_on(holder, before)  # one of the sender's own was among them
        return replace(seen, aside=max(message, before, key=lambda one: self._tells(one)[:3]))

    def _tells(self, message: Sender) -> tuple[bool, bool, bool, int, int]:
        """Rank what is left aside: what the sender has not sent, then what may be taken for its own, then the latest.

        Its own next number is ahead of all that it has sent before in a hurry, so that of those the last one tells.
        """
        ahead = self.sender is None or self.sender.sent_between(message.first or message, None)
        return not ahead, self._is_close(message), message.moves, message.number or 0, message.at

    def _is_close(self, other: Sender) -> bool:
        """Whether another's messages may be taken for the sender's."""
        holder = self.sender
        if holder is None or holder.name != other.name or holder.number is None or other.number is None:
            return False
        return abs(holder.number - other.number) < APART

    def _go_on(self, holder: Sender, message: Sender) -> "Gate":
        """The sender is heard again: what was left aside was another's, unless it was sent between its two commands."""
        now = message.at
        heard = replace(self, sender=holder.after(message.number, now), aside=None, beside=None)
        if self.first and (message.number or 0) - (self.first.number or 0) > UNHEARD:
            heard = replace(heard, former=None)  # it has ended: of two that send by turns one is soon heard again
        left, former = [one for one in (self.aside, self.beside) if one is not None], self.former
        seen = [one for one in left if now - one.at <= HOLD or (former is not None and former.goes_on_in(one))]
        others = [one for one in seen if not holder.sent_between(one, message.number)]
        if not others:
            return heard
        other, again = others[0], self.conflict(now)
        mixed = (self._is_close(other) and (other.moves or again)) or (self.mixed and again)
        rival = self.rival if mixed and other.name != holder.name else other  # the two that are mixed are told
        return replace(heard, rival=rival, rival_until=now + max(CONFLICT, 2 * (now - holder.at)), mixed=mixed)

    def _rivals_name(self, name: str) -> bool:
        return self.rival is not None and self.rival.name == name

    def _was_left(self, message: Sender) -> bool:
        """Whether who takes over was left aside before, as far as anybody can tell: just now, or by its numbers."""
        rival = self.rival
        if rival is None or self.conflict(message.at):
            return rival is not None
        return message.number is not None and rival.number is not None and rival.goes_on_in(message)

    def enable(self, on: bool, now: int = 0) -> "Gate":
        """Switch the output at `now` [ns], by the user's will; a command from before the switch never acts."""
        on_from = replace(self, enabled=on, switched=max(self.switched, now), begun=on, barred=False)
        return replace(on_from, stopped="", command=0.0, received=None, no_number=None)

    def stop(self, why: str) -> "Gate":
        """Switch the output off for a reason, until the user switches it on."""
        return replace(self.enable(False), stopped=why)

    def stop_motor(self, why: str, now: int) -> "Gate":
        """The same for what the motor did, at `now` [ns]; while the output is off already, it is no further stop."""
        return replace(self.stop(why), faults=self.faults.stop(now * 1e-9) if self.enabled else self.faults)

    def call(self, now: int) -> "Gate":
        """Somebody calls at `now` [ns] to switch on, whether or not that is done."""
        before = self.calls if now - self.called <= PAUSE else 0
        return replace(self, calls=before + self.enabled, called=now)

    def refusal(self, now: int) -> str:
        """Why the output may not be switched on yet at `now` [ns], as a sentence; empty if it may."""
        if not self.enabled and self.calls >= CALLS and now - self.called <= PAUSE:
            return INSISTED.format(PAUSE * 1e-9)
        return self.faults.refuse(now * 1e-9)

    def come_up(self, now: int) -> "Gate":
        """The plant can drive the motor from now [ns] on: voltages have to begin at 0 V again."""
        told = replace(self, since=now, begun=False, barred=False, waits=WAITING, first=None)
        return replace(told, command=0.0, received=None)

    def fresh(self, now: int) -> bool:
        """Whether there is a command at `now` [ns] that is not too old."""
        return self.received is not None and now - self.received <= self.timeout * 1e9

    def voltage(self, now: int) -> float:
        """[V] to apply at `now` [ns]."""
        if self.mixed and self.conflict(now):
            return 0.0
        return self.command if self.enabled and self.begun and self.fresh(now) else 0.0

    def conflict(self, now: int) -> bool:
        """Whether two senders have been heard just now [ns]."""
        return self.rival is not None and now <= self.rival_until

    def problem(self, now: int, senders: str = "") -> str:
        """What is wrong, as a sentence; empty if nothing is. `senders` names the nodes that can send."""
        if self.stopped:
            return " ".join(filter(None, (STOPPED.format(self.stopped), self.refusal(now))))
        return " ".join(filter(None, (self.tell_no_number(now, senders), self._tell_of_senders(now, senders))))

    def tell_no_number(self, now: int, senders: str = "") -> str:
        """Say that what is not a number has come just now [ns]; empty if it has not."""
        odd = self.no_number
        if odd is None or now - odd.at > CONFLICT:
            return ""
        among = f"; {senders}" if senders else ""
        return NO_NUMBER.format(odd.voltage, odd.name, among, GETS_NOTHING if odd.stops else LEFT_ASIDE)

    def tell_mixed(self, now: int, senders: str = "") -> str:
        """Say that whose command is whose cannot be told at `now` [ns]; empty if it can."""
        if not self.mixed or not self.conflict(now) or self.rival is None:
            return ""
        among, until = f" ({senders})" if senders else "", self.rival_until - (self.sender.at if self.sender else now)
        return MIXED.format(among, self.rival.name, max(until, CONFLICT) * 1e-9)

    def _tell_of_senders(self, now: int, senders: str) -> str:
        if mixed := self.tell_mixed(now, senders):
            return mixed
        if self.conflict(now):
            among = f" ({senders})" if senders else ""
            rival, sender = self.rival, self.sender
            if self.enabled and not self.begun:
                return NONE_OBEYED.format(among)
            obeyed = f"frame_id '{sender.name}'" if sender and rival and sender.name != rival.name else "the first"
            return TWO_SENDERS.format(among, obeyed, HOLD * 1e-9)
        if self.enabled and not self.begun and self.fresh(now):
            return self.waits.format(self.command)
        return ""

    def state(self, now: int) -> str:
        """In words, for diagnostics."""
        if not self.enabled:
            return OFF
        if not self.fresh(now):
            return "waiting for motor/voltage, 0 V"
        return f"driven, and for {self.timeout:g} s more once who sends has died" if self.outlasts else "driven"

    @property
    def outlasts(self) -> bool:
        """Whether a voltage acts for longer than any sender is held up: a motor runs on as long when one has died."""
        return self.timeout * 1e9 > HOLD


def _began(first: Sender, message: Sender, since: int, sample_period: float, heard: bool = False) -> bool:
    """Whether a sender sent its very first command after `since` [ns]: `first` was heard first, and then a message.

    At its pace it has sent the commands that were not heard, too: that of its first moments, or, where it was `heard`
    all the time while it was left aside, of the whole of that.
    """
    if first.number is None or message.number is None:
        return message.number is None and message.at == first.at and message.at - since >= QUIET
    if first.number == 1:
        return True
    listened, steps = message.at - first.at, max(message.number - first.number, 1)
    if listened < PACE[0] or (listened > PACE[1] and steps > 1 and not heard):
        return False
    pace = listened / steps
    age = (first.number - 1) * pace
    young = max(YOUNG_ANSWER if pace <= ANSWERS * sample_period else YOUNG, pace)
    return age <= young and first.at - age / SLOWED >= since - SLACK
