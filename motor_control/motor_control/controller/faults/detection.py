"""Detect whether the motor has to stop for good: every check is asked at every sample."""

from dataclasses import dataclass, replace

from motor_control.controller.faults import (
    acceleration,
    contradiction,
    dropouts,
    few_edges,
    held_speed,
    hum,
    insensitive_speed,
    irregular_edges,
    overspeed,
    push_at_rest,
    repetition,
    stall,
    unexpected_edges,
)
from motor_control.controller.faults.direction import implied_load, plugging, pulses, runaway, to_and_fro, unslowed
from motor_control.controller.faults.evidence import Config, Seen


@dataclass(frozen=True, slots=True)
class State:
    """What each check remembers."""

    stalled: stall.State = stall.State()
    missing: few_edges.State = few_edges.State()
    periods: irregular_edges.State = irregular_edges.State()
    unexpected: unexpected_edges.State = unexpected_edges.State()
    undriven: runaway.State = runaway.State()
    too_fast: float = 0.0  # [s]
    pushed: pulses.State = pulses.State()
    plugged: plugging.State = plugging.State()
    driven: implied_load.State = implied_load.State()
    unrest: push_at_rest.State = push_at_rest.State()
    contradicted: contradiction.State = contradiction.State()
    insensitive: insensitive_speed.State = insensitive_speed.State()
    dropped: dropouts.State = dropouts.State()
    hums: hum.State = hum.State()
    repeated: repetition.State = repetition.State()
    gaining: acceleration.State = acceleration.State()
    trembling: to_and_fro.State = to_and_fro.State()
    left: held_speed.State = held_speed.State()
    coasting: unslowed.State = unslowed.State()

    @property
    def warning(self) -> str:
        """What speaks for a fault, and not as clearly as a stop needs, as a sentence."""
        return self.coasting.warning


def begin(speed: float, before: State | None = None) -> State:
    """Begin with a motor that turns at a speed [rad/s].

    before: of a run that has ended a moment ago; what spoke against that one speaks against this one, too. Only what
    the speed should have done meanwhile is not known: the motor had 0 V, or was somebody else's.
    """
    if before is None:
        return State(missing=few_edges.State(expected=speed), contradicted=contradiction.begin(speed))
    missing, stalled = replace(before.missing, expected=speed), replace(before.stalled, speed=0.0)
    before = replace(before, missing=missing, stalled=stalled)
    return replace(before, undriven=runaway.State(), driven=implied_load.State(), gaining=acceleration.State())


def find_fault(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Find a fault: a sentence if the motor has to stop, else ""."""
    regular = not state.periods.irregular
    still, stalled = stall.check(config, state.stalled, seen)
    few, missing = few_edges.check(config, state.missing, seen, regular)
    irregular, periods = irregular_edges.check(config, state.periods, seen)
    odd, unexpected = unexpected_edges.check(config, state.unexpected, seen)
    away, undriven = runaway.check(config, state.undriven, seen)
    fast, too_fast = overspeed.check(config, state.too_fast, seen)
    wrong, pushed = pulses.check(config, state.pushed, seen)
    kept, plugged = plugging.check(config, state.plugged, seen)
    heavy, driven = implied_load.check(config, state.driven, seen)
    restless, unrest = push_at_rest.check(config, state.unrest, seen)
    false, contradicted = contradiction.check(config, state.contradicted, seen)
    same, insensitive = insensitive_speed.check(config, state.insensitive, seen)
    loose, dropped = dropouts.check(config, state.dropped, seen)
    humming, hums = hum.check(config, state.hums, seen)
    again, repeated = repetition.check(config, state.repeated, seen)
    quick, gaining = acceleration.check(config, state.gaining, seen)
    nowhere, trembling = to_and_fro.check(config, state.trembling, seen)
    slower, left = held_speed.check(config, state.left, seen)
    on, coasting = unslowed.check(config, state.coasting, seen)
    found = (
        quick,
        nowhere,
        still,
        few,
        irregular,
        odd,
        away,
        fast,
        wrong,
        kept,
        heavy,
        restless,
        again,
        false,
        humming,
        same,
        loose,
        slower,
        on,
    )
    return next((one for one in found if one), ""), State(
        stalled,
        missing,
        periods,
        unexpected,
        undriven,
        too_fast,
        pushed,
        plugged,
        driven,
        unrest,
        contradicted,
        insensitive,
        dropped,
        hums,
        repeated,
        gaining,
        trembling,
        left,
        coasting,
    )
