"""What the controller remembers, and how those who ask for a motion, a stop or a reset change it.

One source drives at a time. A stop is latched until `reset`; whoever asks meanwhile is not heard.
"""

from dataclasses import dataclass
from math import inf, nan

from motor_control.controller.faults import detection
from motor_control.controller.interruptions import Interruptions
from motor_control.controller.motion import Motion
from motor_control.controller.plant_watch import PlantWatch
from motor_control.controller.reference import position_law
from motor_control.controller.reference.demand import Demand, Kind, Source
from motor_control.controller.run import Config, Run
from motor_control.controller.timing.latency import LatencyState
from motor_control.controller.timing.timekeeping import Timekeeping
from motor_model.frozen_record import replace
from motor_model.sensing.mains_rhythm import Rhythm
from motor_model.sensing.repeated_stops import RepeatedStops
from motor_model.streams.senders import Message, Senders
from motor_model.streams.sequence import GOES_ON, LONGEST

RELEASED = "The motor was released."
CLEARED = "The stop was cleared."
OTHER_PLANT = "The plant says on motor/info that it is another one than before."
RESTARTED = "The plant was restarted."
OTHER_DRIVES = "{} is not obeyed while {} drives the motor: end that, or call motor/release."
TWO_SENDERS = "Several nodes publish motor/joint_command {}, and none is obeyed: end all but one."
BEGIN_JOINT = "motor/joint_command is not obeyed until it begins again: with 0, or after a silence of {:g} s."
BEFORE = "They began before this controller heard any of them."
EARLIER = "It was asked for before the motor was stopped or released."
PLAYED = (
    "A recording is played that asks for a motion ({}), and nothing is obeyed until that has ended. To drive a motor "
    "by a recording, use ros2 run motor_identification play BAG --topics motor/reference."
)
FIRST_JOINT = LONGEST  # [s] for which who publishes motor/joint_command is there before the first command begins
NAMES = "(names)"  # stands for who publishes motor/speed, which may be known a moment later


@dataclass(frozen=True)
class State:
    """What the controller remembers; the times are [s] on the clock of `now`."""

    since: float = 0.0  # when it began
    arrival: float | None = None  # when the latest sample came
    silent: float | None = None  # when silence was last reported; None while samples come
    run: Run | None = None
    latched: str = ""  # why the motor stays at 0 V until `reset`
    demand: Demand | None = None  # the latest one, as long as it is obeyed
    joint_heard: float | None = None  # when the latest joint command came
    joints: Senders = Senders()  # of motor/joint_command, obeyed or not
    joint_senders: str = ""  # who publishes motor/joint_command, where they are several
    players: str = ""  # of recordings, who publish demands
    refused: str = ""  # why a demand was not taken
    refused_at: float = 0.0
    begun: float = 0.0  # when what is asked for began: a stream of demands began with its first
    referred: float = 0.0  # when the latest demand came
    references: Senders = Senders()  # of motor/reference and motor/position_reference, obeyed or not
    introduced: float = -inf  # when the latest publisher of demands was first seen to be there
    dropped: str = ""  # why there is none any more
    halted: float = -inf  # when the motor was last stopped or released: what came before asks for nothing any more
    held: float | None = None  # since when something has held the motor at 0 V although there is one
    held_by: str = ""  # what, as a sentence
    drives: bool = False  # the latest voltage was ours, so the next has to be too
    plant: PlantWatch | None = None
    latency: LatencyState | None = None
    timing: Timekeeping = Timekeeping()  # whether this loop keeps its time
    rhythm: Rhythm = Rhythm()  # of the edges, whether or not the motor runs
    motion: Motion | None = None  # what is known of the motor, from run to run
    faults: detection.State | None = None  # what the latest run has seen of faults
    judged: int = 0  # [ns] its latest sample
    place: position_law.State | None = None  # what the latest run knows of an angle that was approached
    interruptions: Interruptions = Interruptions()
    stops: RepeatedStops = RepeatedStops()
    speakers: str = ""  # who publishes motor/speed, for the sentence about two plants


def refer(state: State, reference: float, now: float, kind: Kind = Kind.SPEED, number: int | None = None) -> State:
    """Take a reference, [rad/s] or as `kind` says; while a stop is latched it is not taken.

    Where an earlier one has ended, references that go on coming are not taken either, until they begin again; nor are
    those that were being sent when the controller came up; nor what came before a stop or a release and is taken late,
    since its sender was not known yet. number: of its publisher's messages; None: not counted.
    """
    if now < state.halted:
        return doubt(state, EARLIER, now, kind, number)
    state = _hear(state, reference, now, kind, number)
    if state.players:
        return refuse(state, PLAYED.format(state.players), now)
    latest = state.references.latest.sequence
    if state.references.bars(state.demand is not None) and not state.latched:
        return refuse(state, GOES_ON.format(state.dropped or BEFORE, round(latest.needed, 1)), now)
    after = _take(state, Demand(reference, kind), latest.begins, now)
    taken = after.demand is not None and not after.refused
    return replace(after, references=after.references.obey()) if taken else after


def doubt(state: State, why: str, now: float, kind: Kind = Kind.SPEED, number: int | None = None) -> State:
    """Take no notice of a reference that may be an old one but to say why; those that go on after it are not taken."""
    return refuse(_hear(state, nan, now, kind, number), why, now)


def _hear(state: State, reference: float, now: float, kind: Kind, number: int | None) -> State:
    """Hear a reference, whether or not it is obeyed."""
    message = Message(kind.value, number, reference, kind is Kind.SPEED and reference == 0.0, now)
    return replace(state, references=state.references.hear(message, state.since, state.introduced))


def introduce(state: State, now: float) -> State:
    """Note that a publisher of demands is there that was not before."""
    return replace(state, introduced=now)


def meet_players(state: State, players: str) -> State:
    """Note who plays a recording that asks for a motion; from then on nothing is obeyed that was asked for before."""
    if players and not state.players and state.demand is not None:
        state = drop(state, PLAYED.format(players))
    return replace(state, players=players)


def command_joint(config: Config, state: State, demand: Demand | str, now: float, number: int | None = None) -> State:
    """Take one command of a stream that is meant for this motor; a text says why it cannot be obeyed: 0 V.

    A stream begins with 0, or after a silence that is long beside the time between its commands. One that goes on
    through a stop, or was there before the controller, has not seen it, and nobody knows what it would do. number: of
    its publisher's messages; None: not counted.
    """
    stops = isinstance(demand, Demand) and demand.value == 0.0
    message = Message(Source.JOINT.value, number, nan, stops, now)
    state = replace(state, joints=state.joints.hear(message, state.since, -inf))
    heard, silence = state.joint_heard, config.joint_timeout
    if heard is None:
        heard = max(state.since, state.introduced)
        silence = max(silence, FIRST_JOINT) if (number or 0) > 1 else silence
    silent = config.joint_timeout > 0.0 and now - heard > silence and not state.joints.bars(False)
    drives = state.demand is not None and state.demand.source is Source.JOINT
    state = replace(state, joint_heard=now)
    if state.players:
        demand = PLAYED.format(state.players)
    elif state.joint_senders:
        demand = TWO_SENDERS.format(state.joint_senders)
    elif now < state.halted:
        demand = EARLIER
    if isinstance(demand, str):
        return replace(drop(state, demand) if drives else state, refused=demand, refused_at=now)
    if state.demand is None and not (silent or demand.value == 0.0):
        needed = max(config.joint_timeout, round(state.joints.latest.sequence.needed, 1))
        return replace(state, refused=BEGIN_JOINT.format(needed), refused_at=now)
    after = _take(state, demand, silent or demand.value == 0.0, now)
    taken = after.demand is not None and not after.refused
    return replace(after, joints=after.joints.obey()) if taken else after


def _take(state: State, demand: Demand, begins: bool, now: float) -> State:
    """Take a demand, unless a stop is latched or another source drives; `begins`: it does not go on with another."""
    if state.latched:
        return state
    before = state.demand
    if before is not None and before.source is not demand.source:
        why = OTHER_DRIVES.format(demand.source.value, before.source.value)
        return replace(state, refused=why, refused_at=now)
    run = state.run
    if run is not None and (before is None or before.kind is not demand.kind):
        run = replace(run, place=position_law.leave(run.place, 0.0))
    begun = now if begins or before is None else state.begun
    return replace(state, demand=demand, begun=begun, referred=now, dropped="", refused="", run=run)


def refuse(state: State, why: str, now: float) -> State:
    """Take no notice of a reference but to say why."""
    return replace(state, refused=why, refused_at=now)


def release(state: State, now: float) -> tuple[str, State]:
    """Let go of the motor: no reference, and after one last 0 V no voltage. What to say stands beside the state."""
    return RELEASED, replace(drop(state, RELEASED), halted=now)


def stop(state: State, reason: str, now: float) -> State:
    """Latch 0 V from the next sample on, until `reset`; `reason` is a sentence."""
    state = replace(drop(state, CLEARED), faults=None, place=None, interruptions=Interruptions())
    return replace(state, latched=reason, stops=state.stops.stop(now), halted=now)


def reset(state: State, now: float) -> tuple[str, State]:
    """Clear the latched stop, but later and later where one follows the other; what to say stands beside the state.

    The motor waits for a fresh reference then.
    """
    if not state.latched:
        return "No stop was latched.", state
    if refusal := state.stops.refuse(now):
        return f"Not cleared: {state.latched.replace(NAMES, state.speakers)} {refusal}", state
    said = f"Cleared: {state.latched.replace(NAMES, state.speakers)}"
    return said, replace(state, latched="", references=state.references.trust_single())


def drop(state: State, why: str) -> State:
    """End what is asked for, and say why."""
    references, joints = state.references.end(), state.joints.end()
    return replace(state, run=None, demand=None, dropped=why, references=references, joints=joints)


def meet_other_plant(state: State, why: str = OTHER_PLANT) -> State:
    """Forget what was asked of a plant that is another one now: edges, limits, all that a reference was for."""
    state = replace(state, motion=None, faults=None, place=None, rhythm=Rhythm())
    waits = state.demand is None and not (state.references.forgives or state.joints.forgives)
    return state if waits else drop(state, why)
