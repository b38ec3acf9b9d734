"""A line over the angle that random slots make is dropped, with the torque that does the same, only worse."""

from dataclasses import replace
from math import tau
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from stub_models import stub_model, stub_test, with_effects

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.evidence import line_evidence
from motor_identification.diagnosis.evidence.line_evidence import (
    count_waves,
    drop_chance_harmonics,
    drop_few_turns,
    has_waves,
    is_heavy_load,
    is_no_ripple,
    is_of_sensor,
    list_unseen_disc,
)
from motor_identification.estimation.estimate import Estimate
from motor_identification.measurement.intervals import Intervals, index_intervals
from motor_identification.noise.likelihood import Noise
from motor_identification.periodic.ripple_spectrum import USUAL_RIPPLE


def line(effect: str, evidence: float, **values: float) -> CandidateTest:
    """A line in the spectrum, fitted to the last of eight slots that are random by 0.4 %."""
    problem = SimpleNamespace(
        unknowns=SimpleNamespace(names=tuple(values)), intervals=(SimpleNamespace(slot=tau / 8.0, gear=1.0),)
    )
    estimate = cast(Estimate, SimpleNamespace(problem=problem, theta=np.array(list(values.values()))))
    before = stub_model(5.0)
    test = stub_test(effect, before, 1.0, evidence)
    return replace(test, model=replace(test.model, estimate=estimate, noise=Noise(0.004, 0.0)))


@pytest.mark.parametrize(
    ("eccentricity", "evidence", "cycles", "left"),
    [
        (0.0080, 30.0, 1.0, ["encoder_eccentricity", "torque_ripple"]),
        (0.0002, 30.0, 1.0, []),  # a first harmonic by chance, and a torque in its place
        (0.0002, 19.0, 1.0, ["torque_ripple"]),
        (0.0002, 30.0, 0.99 * thresholds.ONCE_A_TURN + 1.0, []),
        (0.0002, 30.0, 1.01 * thresholds.ONCE_A_TURN + 1.0, ["torque_ripple"]),
    ],
)
def test_what_random_slots_do_by_chance_is_dropped_with_the_torque_that_does_it_worse(
    eccentricity: float, evidence: float, cycles: float, left: list[str]
) -> None:
    disc = line("encoder_eccentricity", evidence, eccentricity=eccentricity, eccentricity_phase=0.0)
    ripple = line("torque_ripple", 20.0, ripple_voltage=0.1, ripple_cycles=cycles, ripple_phase=0.0)
    assert [test.effect for test in drop_chance_harmonics([disc, ripple])] == left


def test_a_line_that_was_not_found_is_no_chance() -> None:
    assert len(drop_chance_harmonics([line("encoder_eccentricity", 0.0), line("torque_ripple", 0.0)])) == 2


@pytest.mark.parametrize(
    ("speed", "cycles", "seen"),
    [
        ((10.0, 10.0), 31.0, 1.0),  # of 10 rad/s an interval of 10 ms is 0.1 rad: half a wave of 31.4 cycles a turn
        ((10.0, 10.0), 32.0, 0.0),
        ((10.0, -2.0), 32.0, 1.0 / 6.0),  # of the travel
        ((0.0, 0.0), 1.0, 0.0),
    ],
)
def test_waves_that_are_shorter_than_two_intervals_are_not_seen(
    speed: tuple[float, float], cycles: float, seen: float
) -> None:
    """A ripple of 126 cycles a turn was named in rows of 10 ms of a real motor that made 253 waves a second of it."""
    start = np.array([0.0, 0.01])
    data = index_intervals(start, start + 0.01, np.array(speed), np.zeros(2))
    names = ("ripple_voltage", "ripple_cycles", "ripple_phase")
    problem = SimpleNamespace(unknowns=SimpleNamespace(names=names), intervals=(data,))
    estimate = SimpleNamespace(problem=problem, theta=np.array([0.5, cycles, 0.0]))
    model = cast(Model, SimpleNamespace(effects=("torque_ripple",), turns=3.0, estimate=estimate))
    assert count_waves(model, "torque_ripple") == pytest.approx(3.0 * cycles * seen)


@pytest.mark.parametrize(
    ("size", "cycles", "heavy", "no_ripple"),
    [
        (0.99 * USUAL_RIPPLE, 1.0, False, False),
        (1.01 * USUAL_RIPPLE, 1.0, True, False),
        (1.01 * USUAL_RIPPLE, 0.99 * thresholds.ONCE_A_TURN + 1.0, True, False),
        (1.01 * USUAL_RIPPLE, 1.01 * thresholds.ONCE_A_TURN + 1.0, False, True),
        (0.99 * USUAL_RIPPLE, 7.0, False, False),
    ],
)
def test_what_is_larger_than_ripples_are_is_a_load_once_a_turn_or_nothing(
    size: float, cycles: float, heavy: bool, no_ripple: bool
) -> None:
    values = {"ripple_voltage": 12.0 * size, "ripple_cycles": cycles, "ripple_phase": 0.0}
    unknowns = SimpleNamespace(names=tuple(values), extent=SimpleNamespace(voltage=12.0))
    estimate = SimpleNamespace(problem=SimpleNamespace(unknowns=unknowns), theta=np.array(list(values.values())))
    model = replace(stub_model(5.0), estimate=cast(Estimate, estimate))
    assert is_heavy_load(model, "torque_ripple") is heavy and is_no_ripple(model, "torque_ripple") is no_ripple
    assert not is_heavy_load(model, "coulomb_friction") and not is_no_ripple(model, "coulomb_friction")


@pytest.mark.parametrize(
    ("turns", "lead", "stays"),
    [
        (0.99, 1.01, True),
        (0.99, 0.99, False),  # a torque that goes with the angle is about as likely
        (1.01, -9.0, True),
    ],
)
def test_of_few_turns_a_disc_is_likelier_than_a_torque_that_goes_with_the_angle(
    turns: float, lead: float, stays: bool
) -> None:
    before = stub_model(5.0)
    ripple = stub_test("torque_ripple", before, 1.0, 100.0)
    disc = stub_test("encoder_eccentricity", before, 1.0, 100.0 + lead * thresholds.RIVAL_MARGIN)
    disc = replace(disc, model=with_effects(disc.model, "encoder_eccentricity"))
    disc.model.__dict__["turns"] = turns * thresholds.LEAST_WAVES
    assert (disc in drop_few_turns([disc, ripple])) is stays and ripple in drop_few_turns([disc, ripple])
    assert drop_few_turns([disc]) == [disc]


@pytest.mark.parametrize(
    ("turns", "cycles", "explains", "seen", "comes_back"),
    [
        (1.01 * thresholds.LEAST_TURNS_OF_LOAD, 1.0, 1.01, True, True),
        (0.99 * thresholds.LEAST_TURNS_OF_LOAD, 1.0, 1.01, True, False),
        (1.01 * thresholds.LEAST_TURNS_OF_LOAD, 1.0, 0.99, True, False),
        (0.5 * thresholds.LEAST_WAVES, 1.5, 1.01, True, False),  # any slow torque, with a frequency of its own
        (0.5 * thresholds.LEAST_WAVES, 1.5, 1.01, False, True),  # that is no chance of motion that was held out
        (0.5 * thresholds.LEAST_WAVES, 1.5, 0.99, False, False),
        (1.01 * thresholds.LEAST_WAVES, 1.0, 0.0, True, True),
    ],
)
@pytest.mark.parametrize("at_floor", [False, True])
def test_a_load_of_some_turns_takes_away_nearly_all(
    monkeypatch: pytest.MonkeyPatch,
    turns: float,
    cycles: float,
    explains: float,
    seen: bool,
    comes_back: bool,
    at_floor: bool,
) -> None:
    """A friction that goes with the angle, in steps one way of a slow motor, was likelier by 564 in 3.9 turns.

    A ripple of four a turn that a motor went to and fro over, in one turn, by 819, and was "not in the table".
    What leaves no more than the sensor, in three waves, is no slow torque: of three a turn beside a coasting bridge.
    """
    test = line("torque_ripple", 500.0, ripple_voltage=0.1, ripple_cycles=cycles, ripple_phase=0.0)
    floor, share = 1.0, explains * thresholds.NEARLY_ALL_OF_GAP
    gap = np.sqrt(25.0 - share * (25.0 - floor))
    start = np.array([0.0, 0.01])
    data = index_intervals(start, start + 0.01, np.full(2, 1.0), np.zeros(2))
    unknowns = SimpleNamespace(names=("ripple_voltage", "ripple_cycles", "ripple_phase"), effects=("torque_ripple",))
    problem = SimpleNamespace(unknowns=unknowns, intervals=(data,))
    estimate = SimpleNamespace(problem=problem, theta=np.array([0.1, cycles, 0.0]))
    model = replace(test.model, estimate=cast(Estimate, estimate), held=replace(stub_model(gap).held, seen=seen))
    model.__dict__["turns"] = turns
    test = replace(test, model=model)
    assert test.explains == pytest.approx(share)
    monkeypatch.setattr(type(model), "at_floor", at_floor)
    enough = turns * cycles > thresholds.LEAST_TURNS_OF_LOAD and explains > 1.0
    assert has_waves(test) is (comes_back or (at_floor and enough))


@pytest.mark.parametrize(
    ("counted", "cycles", "rival"),
    [(False, 1.01, True), (True, 1.01, False), (False, 1.06, False), (False, 3.0, False)],
)
def test_a_torque_once_a_turn_may_be_a_disc_where_nothing_tells_of_one(
    counted: bool, cycles: float, rival: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An eccentric disc of so many counts that they look like noise was a ripple with certainty."""
    test = line("torque_ripple", 500.0, ripple_voltage=0.1, ripple_cycles=cycles, ripple_phase=0.0)
    monkeypatch.setattr(Intervals, "tells_of_disc", counted)
    assert list_unseen_disc(test.model, "torque_ripple") == (("encoder_eccentricity",) if rival else ())
    assert list_unseen_disc(test.model, "encoder_eccentricity") == ()


@pytest.mark.parametrize(
    ("load", "slot", "cycles", "sensor"),
    [
        (50.0 - 1.01 * thresholds.RIVAL_MARGIN, 0.0, 2.0, True),
        (50.0 - 0.99 * thresholds.RIVAL_MARGIN, 0.0, 2.0, False),
        (1.0, 0.1, 2.0, False),  # counted slots are learned
        (1.0, 0.0, None, False),  # no line was found to fit
    ],
)
@pytest.mark.parametrize("fitted", [True, False])
def test_a_line_of_logged_speeds_is_the_sensors_where_that_explains_it_better(
    monkeypatch: pytest.MonkeyPatch, load: float, slot: float, cycles: float | None, sensor: bool, fitted: bool
) -> None:
    """Than a load beside the fit without it, and than one that was fitted."""
    asked: list[tuple[object, object, float]] = []

    def explain(estimate: object, tracks: object, cycles: float) -> tuple[float, float]:
        asked.append((estimate, tracks, cycles))
        return 1.0 if fitted else load, 50.0

    monkeypatch.setattr(line_evidence, "explain_line", explain)
    problem = SimpleNamespace(intervals=(SimpleNamespace(slot=slot, gear=1.0),), unknowns=SimpleNamespace(effects=()))
    without = cast(Estimate, SimpleNamespace(problem=problem))
    values = {} if cycles is None else {"ripple_voltage": 0.1, "ripple_cycles": cycles, "ripple_phase": 0.0}
    test = line("torque_ripple", load if fitted else 1.0, **values)
    cast(SimpleNamespace, test.model.estimate.problem).tracks = ("the measured angles",)
    test = replace(test, before=replace(test.before, estimate=without))
    assert is_of_sensor(test) is sensor
    assert asked == ([(without, ("the measured angles",), cycles)] if slot == 0.0 and cycles is not None else [])


def test_no_other_effect_is_a_sensors_line() -> None:
    assert not is_of_sensor(line("encoder_eccentricity", 20.0, eccentricity=0.01, eccentricity_phase=0.0))
    assert not is_of_sensor(line("coulomb_friction", 20.0, ks=0.1))
