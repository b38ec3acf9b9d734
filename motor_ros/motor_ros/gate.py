"""What a plant lets through to the motor: nothing while off, stale or not a number, and only what begins at 0 V.

    off      latched: by motor/enable with data: false, or by a stop; only motor/enable with data: true ends it
    waiting  on, but the sender began before the plant came up: 0 V until it sends 0 V, or motor/enable
    driven   the newest voltage of one sender; another's are left aside until that one has been silent for HOLD

Who was left aside beside another that drove has to begin at 0 V, too, once that one has ended: it is most often one
that was forgotten, and the motor has just been stopped. So has who went on sending while nothing of it was heard for a
second and more, because its link was away or the plant stood still: the motor has stood meanwhile, and nobody expects
it to go on by itself.

That there are two is known once the first is heard again after the other: one sender that was held up sends what it has
missed all at once, more than is kept, and its numbers jump ahead as another's would. Its next numbers go on from there.

Two that call themselves the same are told apart by their numbers alone, and only where these are so far APART that
neither can reach the other's while it is waited for. Where they are closer a message that is late, or lost, makes one
pass for the other, and nobody knows whose voltage it is: the motor gets 0 V as long as both are heard, whatever they
send and whoever switches on, and who is left has to begin at 0 V. A single 0 V that is left aside, such as the last
word of a controller, mixes nothing.

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
    "More than one node sends motor/voltage{}: only {} is obeyed, until it has been silent for {:g} s; end the others."
)
MIXED = (
    "More than one node sends motor/voltage{}, all with frame_id '{}', and whose command is whose cannot be told: the"
    " motor gets 0 V; end all but one, and {:g} s later let that one send 0 V, or call motor/enable with data: true."
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
    since: int = 0  # [ns] the plant came up, or its board did
    switched: int = 0  # [ns] the user switched the output: no voltage that was sent before acts
    stopped: str = ""  # why the output was switched off; empty: by the user, or never
    faults: RepeatedStops = RepeatedStops()  # stops for what the motor did
    begun: bool = False  # the voltages have started from 0 V, or were allowed by motor/enable
    handed: bool = False  # they have not, since one that was left aside took over
    away: bool = False  # they have not, since one that was not heard for long, or heard that late, has gone on
    first: Sender | None = None  # the sender's first command that was heard since then
    command: float = 0.0  # [V]
    received: int | None = None  # [ns]
    sender: Sender | None = None  # of that command
    aside: Sender | None = None  # what tells most of those of its name that seemed another's, until it is heard again
    beside: Sender | None = None  # likewise the latest of another name
    rival: Sender | None = None  # another sender's latest command that was left aside while both sent
    rival_at: int = 0  # [ns] when the two had both been heard, or one of them was left aside since
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
        if not isfinite(voltage):
            return self._refuse(voltage, now, name, number)
        holder, what = self.sender, (voltage, now, name, number, waited, sent)
        ours = holder is not None and holder.sent(name, number, now)
        if holder is not None and now - holder.at <= HOLD and not ours:
            return self._leave_aside(Sender(name, number, now, moves=voltage != 0.0))
        unheard = holder is not None and self._goes_on_unheard(holder, ours, number, now)
        if holder is not None and unheard and not ours:
            return replace(self.come_up(holder.at), sender=None, away=True).take(*what)
        told = self._tell_senders(number, now) if ours else replace(self, aside=None, beside=None)
        mixed = told.mixed and told.conflict(now)
        sender = holder.after(number, now) if holder is not None and ours else Sender(name, number, now)
        first = self.first if ours and self.first is not None else sender
        resumes = holder is not None and now - holder.at > HOLD and self._rivals_name(name) and self.conflict(now)
        left = resumes or (not ours and self._was_left(name, number, now))
        handed = mixed or (voltage != 0.0 and (self.handed or left))
        begun = self.begun or voltage == 0.0 or _began(first, number, now, self.since, self.sample_period * 1e9)
        begun = begun and not handed
        received = now - waited if sent is None or sent >= self.switched else None
        told = replace(told, command=voltage, received=received, sender=sender, first=first, handed=handed, mixed=mixed)
        if voltage != 0.0 and (unheard or waited > max(AWAY, self.timeout * 1e9)):  # it began before, whatever its pace
            return replace(told, first=replace(first, number=None), begun=False, away=True)
        return replace(told, begun=begun)

    def _refuse(self, voltage: float, now: int, name: str, number: int | None) -> "Gate":
        stops = self._may_be_obeyed(name, number, now)
        told = replace(self, refused=self.refused + 1, no_number=NoNumber(voltage, name, now, stops))
        return replace(told, command=0.0, received=None) if stops else told._leave_aside(Sender(name, number, now))

    def _may_be_obeyed(self, name: str, number: int | None, now: int) -> bool:
        """Whether a command may be of the sender that is obeyed, also where it came sooner than its own would."""
        holder = self.sender
        if holder is None or now - holder.at > HOLD:
            return True
        return name == holder.name and (number is None or holder.number is None or number > holder.number)

    def goes_on(self, name: str, number: int | None, now: int) -> bool:
        """Whether a command at `now` [ns] is the next one of the sender that is obeyed."""
        holder = self.sender
        return holder is not None and now - holder.at <= HOLD and holder.sent(name, number, now)

    def _goes_on_unheard(self, holder: Sender, ours: bool, number: int | None, now: int) -> bool:
        """Whether a sender, the latest or another, has sent for long while nothing was heard, and the motor stood."""
        if number is None or now - holder.at <= max(AWAY, self.timeout * 1e9):
            return False
        return number - (holder.number or 0 if ours else 0) > UNHEARD

    def _leave_aside(self, message: Sender) -> "Gate":
        """A message that does not seem the sender's is left aside; as long as that goes on, the two are in conflict."""
        seen = replace(self, rival_at=message.at if self.conflict(message.at) else self.rival_at)
        if self.sender is None or message.name != self.sender.name:  # it does not hide who has the sender's name
            return replace(seen, beside=message)
        return replace(seen, aside=max(filter(None, (self.aside, message)), key=self._tells))

    def _tells(self, message: Sender) -> tuple[bool, bool, bool, int, int]:
        """Rank what is left aside: what the sender has not sent, then what may be taken for its own, then the latest.

        Its own next number is ahead of all that it has sent before in a hurry, so that of those the last one tells.
        """
        holder = self.sender
        ahead = holder is None or holder.sent_between(message, None)
        return not ahead, self._is_close(message), message.moves, message.number or 0, message.at

    def _is_close(self, other: Sender) -> bool:
        """Whether another's messages may be taken for the sender's."""
        holder = self.sender
        if holder is None or holder.name != other.name or holder.number is None or other.number is None:
            return False
        return abs(holder.number - other.number) < APART

    def _tell_senders(self, number: int | None, now: int) -> "Gate":
        """The sender is heard again: what was left aside was another's, unless it was sent between its two commands."""
        holder, heard = self.sender, replace(self, aside=None, beside=None)
        seen = [one for one in (self.aside, self.beside) if one is not None and now - one.at <= HOLD]
        others = [one for one in seen if holder is not None and not holder.sent_between(one, number)]
        if holder is None or not others:
            return heard
        other, again = others[0], self.conflict(now)
        mixed = (self._is_close(other) and (other.moves or again)) or (self.mixed and again)
        rival = self.rival if mixed and other.name != holder.name else other  # the two that are mixed are told
        return replace(heard, rival=rival, rival_at=now, mixed=mixed)

    def _rivals_name(self, name: str) -> bool:
        return self.rival is not None and self.rival.name == name

    def _was_left(self, name: str, number: int | None, now: int) -> bool:
        """Whether who takes over was left aside before, as far as anybody can tell: just now, or by its numbers."""
        rival = self.rival
        if rival is None or self.conflict(now):
            return rival is not None
        return number is not None and rival.number is not None and rival.sent(name, number, now)

    def enable(self, on: bool, now: int = 0) -> "Gate":
        """Switch the output at `now` [ns], by the user's will; a command from before the switch never acts."""
        on_from = replace(self, enabled=on, switched=max(self.switched, now), begun=on, handed=False, away=False)
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
        return replace(self, since=now, begun=False, handed=False, away=False, first=None, command=0.0, received=None)

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
        return self.rival is not None and now - self.rival_at <= CONFLICT

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
        return MIXED.format(f" ({senders})" if senders else "", self.rival.name, CONFLICT * 1e-9)

    def _tell_of_senders(self, now: int, senders: str) -> str:
        if mixed := self.tell_mixed(now, senders):
            return mixed
        if self.conflict(now):
            among = f" ({senders})" if senders else ""
            rival, sender = self.rival, self.sender
            obeyed = f"frame_id '{sender.name}'" if sender and rival and sender.name != rival.name else "the first"
            return TWO_SENDERS.format(among, obeyed, HOLD * 1e-9)
        if self.enabled and not self.begun and self.fresh(now):
            return (HANDED if self.handed else AWAY_LINK if self.away else WAITING).format(self.command)
        return ""

    def state(self, now: int) -> str:
        """In words, for diagnostics."""
        if not self.enabled:
            return OFF
        return "driven" if self.fresh(now) else "waiting for motor/voltage, 0 V"


def _began(first: Sender, number: int | None, now: int, since: int, sample_period: float) -> bool:
    """Whether a sender sent its very first command after `since` [ns]: `number` at `now`, and `first` was heard first.

    At its pace it has sent the commands that were not heard, too.
    """
    if first.number is None or number is None:
        return now == first.at and now - since >= QUIET
    if first.number == 1:
        return True
    listened = now - first.at
    if not PACE[0] <= listened <= PACE[1]:
        return False
    pace = listened / max(number - first.number, 1)
    age = (first.number - 1) * pace
    young = YOUNG_ANSWER if pace <= ANSWERS * sample_period else YOUNG
    return age <= young and first.at - age / SLOWED >= since - SLACK
