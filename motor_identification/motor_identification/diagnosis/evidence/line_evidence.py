"""Judge a line in a spectrum over the angle: random slots have a first harmonic by chance, slow torques a few waves."""

from collections.abc import Sequence
from math import inf, tau

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.noise.slots.first_harmonic import bound_chance_eccentricity
from motor_identification.periodic.periodic_fit import LOAD_OVER_ANGLE, measure_angles
from motor_identification.periodic.ripple_spectrum import USUAL_RIPPLE
from motor_identification.periodic.sensor_line import explain_line
from motor_model.effects import EFFECT_BY_NAME


def count_waves(model: Model, effect: str) -> float:
    """Count the waves over the angle that an effect of a model has from one end of its motion to the other.

    Infinitely many of one that has none, or of which no line was found to fit. What is on the disc has one in a turn.
    Only as far as the motion was slow enough for two intervals a wave: of faster motion it is an alias.
    """
    if effect not in model.effects:
        return inf
    if EFFECT_BY_NAME[effect].on_disc:
        return model.turns
    cycles = _find_cycles(model, effect)
    return inf if cycles is None else cycles * model.turns * _find_share_seen(model, cycles)


def has_waves(test: CandidateTest) -> bool:
    """Decide whether a test's effect comes back over the angle as often as it must, if it repeats at all.

    What is on the disc moves no motor: it is in step with the angle at once, where a torque lags behind. So one turn
    is enough where it takes away most of what is left, and some turns of a load that takes away nearly all; of other
    torques some waves, if what they take nearly all of was held out, or nothing is left but what the sensor leaves.
    """
    waves = count_waves(test.model, test.effect)
    if waves > thresholds.LEAST_WAVES:
        return True
    if EFFECT_BY_NAME[test.effect].on_disc:
        return waves > thresholds.LEAST_TURNS and test.explains > thresholds.MOST_OF_GAP
    nearly_all = waves > thresholds.LEAST_TURNS_OF_LOAD and test.explains > thresholds.NEARLY_ALL_OF_GAP
    told = not test.model.held.seen or test.model.at_floor
    return nearly_all and (_goes_once_a_turn(test.model, test.effect) or told)


def drop_few_turns(tests: Sequence[CandidateTest]) -> list[CandidateTest]:
    """Drop what is on a disc of few turns, where a torque that goes with the angle is about as likely."""
    lines = [test for test in tests if EFFECT_BY_NAME[test.effect].periodic and not EFFECT_BY_NAME[test.effect].on_disc]
    most = max((test.evidence for test in lines), default=-inf) + thresholds.RIVAL_MARGIN
    return [test for test in tests if test.evidence > most or not has_few_turns(test)]


def has_few_turns(test: CandidateTest) -> bool:
    """Decide whether a test's effect is on a disc that comes round a few times only."""
    few = count_waves(test.model, test.effect) <= thresholds.LEAST_WAVES
    return EFFECT_BY_NAME[test.effect].on_disc and few


def list_unseen_disc(model: Model, effect: str) -> tuple[str, ...]:
    """List the effects on a disc that stand for a torque once a turn as well, where nothing told of a disc.

    Measured: an eccentricity of an encoder so fine that its counts look like noise, found as such a torque of 0.08 V.
    """
    counted = any(data.tells_of_disc for data in model.held.intervals)
    if counted or EFFECT_BY_NAME[effect].on_disc or not _goes_once_a_turn(model, effect):
        return ()
    return tuple(name for name, one in EFFECT_BY_NAME.items() if one.on_disc)


def _find_share_seen(model: Model, cycles: float) -> float:
    """Find the share of the travel in which an interval is at most half a wave of so many cycles a turn."""
    travels = [data.gear * data.travel for data in model.estimate.problem.intervals]
    every = sum(float(travel.sum()) for travel in travels)
    seen = sum(float(travel[cycles * travel <= 0.5 * tau].sum()) for travel in travels)
    return seen / every if every > 0.0 else 0.0


def is_of_sensor(test: CandidateTest) -> bool:
    """Decide whether the line of a load over the angle is rather one of a sensor that errs with the angle.

    Of logged speeds only: slots that are counted are learned. Measured: of 11 slots 1 % off, the times between which
    were logged as speeds, a load of 2.00 cycles was likelier than none by 82, and such errors by 124. Of a load in
    motion to and fro at one speed, errors explained 38 and a load 14 by a fit without it; fitted, that was 94 likelier.
    """
    if test.effect != LOAD_OVER_ANGLE:
        return False
    cycles, problem = _find_cycles(test.model, test.effect), test.before.estimate.problem
    if cycles is None or any(data.slot > 0.0 for data in problem.intervals):
        return False
    tracks = test.model.estimate.problem.tracks or measure_angles(test.before.estimate, problem.unknowns.effects)
    load, sensor = explain_line(test.before.estimate, tracks, cycles)
    return sensor > max(load, test.evidence_of_all) + thresholds.RIVAL_MARGIN


def adds_only_lines(model: Model, start: Model) -> bool:
    """Whether all that a model has beyond another is lines of many waves over the angle, each its own evidence."""
    added = [effect for effect in model.effects if effect not in start.effects]
    periodic = all(EFFECT_BY_NAME[name].periodic for name in added)
    return bool(added) and periodic and all(count_waves(model, name) > thresholds.MANY_WAVES for name in added)


def is_heavy_load(model: Model, effect: str) -> bool:
    """Whether an effect is a load that goes once a turn and is larger than ripples are, such as an arm that hangs down.

    It tells of itself by how it accelerates the motor, however small a part of a turn that swings.
    """
    return _is_too_large_a_ripple(model, effect) and _goes_once_a_turn(model, effect)


def is_no_ripple(model: Model, effect: str) -> bool:
    """Whether an effect is larger than ripples are, and none that goes once a turn."""
    return _is_too_large_a_ripple(model, effect) and not _goes_once_a_turn(model, effect)


def _is_too_large_a_ripple(model: Model, effect: str) -> bool:
    if _find_cycles(model, effect) is None:
        return False
    size = _fitted(model, EFFECT_BY_NAME[effect].parameters[0].name)
    return size is not None and size > USUAL_RIPPLE * model.estimate.problem.unknowns.extent.voltage


def drop_chance_harmonics(tests: Sequence[CandidateTest]) -> list[CandidateTest]:
    """Drop tests of the first harmonic that random slots have by chance: of the disc, and of a torque less likely."""
    chance = [test for test in tests if EFFECT_BY_NAME[test.effect].on_disc and _is_by_random_slots(test)]
    most = max((test.evidence for test in chance), default=-inf)
    chance += [test for test in tests if test.evidence < most and _goes_once_a_turn(test.model, test.effect)]
    return [test for test in tests if not any(test is one for one in chance)]


def _is_by_random_slots(test: CandidateTest) -> bool:
    size = _fitted(test.model, EFFECT_BY_NAME[test.effect].parameters[0].name)
    slot = max(data.slot * data.gear for data in test.model.estimate.problem.intervals)  # of the encoder's shaft
    share = test.model.noise.share if test.model.learned is None else test.model.learned.share
    return size is not None and size <= bound_chance_eccentricity(slot, share)


def _goes_once_a_turn(model: Model, effect: str) -> bool:
    """Whether an effect has cycles in a turn of the encoder's shaft, and they are one."""
    cycles = _find_cycles(model, effect)
    return cycles is not None and abs(cycles - 1.0) < thresholds.ONCE_A_TURN


def _find_cycles(model: Model, effect: str) -> float | None:
    """Find the cycles in a turn of the encoder's shaft that an effect has; None if it has none, as `_fitted`."""
    names = [spec.name for spec in EFFECT_BY_NAME[effect].parameters if spec.of_encoder]
    return _fitted(model, names[0]) if names else None


def _fitted(model: Model, parameter: str) -> float | None:
    """Look up the value that a model was fitted to have of a parameter; None where no line was found to fit."""
    names = model.estimate.problem.unknowns.names
    return float(model.estimate.theta[names.index(parameter)]) if parameter in names else None
