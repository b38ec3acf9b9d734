"""When a log's speeds were made shows in the motion, and only there where nobody said it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_speed, without_count
from swinging import RUBBING, noisy
from tiers import keep_fast

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.result import Verdict
from motor_identification.diagnosis.selection import timed_selection
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.estimation.request import SearchConfig
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.identify import Request, identify
from motor_identification.monitoring.model_gap import Model, measure_gap
from motor_identification.recording import Recording, check
from motor_identification.reporting.curves import make_fit_curves
from motor_identification.reporting.model_comparison import Identified
from motor_identification.timing import speed_timing
from motor_identification.timing.shaped_fit import Shaper, measure_gain
from motor_identification.timing.speed_filter import MEMORY, SpeedFilter
from motor_identification.timing.speed_timing import TOO_EARLY, _find_instants, _is_likelier, find_timing
from motor_identification.timing.timing import ASSUMED, INSTANT, OTHERS, UNTIL, Timing, list_readings
from motor_identification.validation.hold_out import make_hold_out


def timing_of(*recordings: Recording) -> Timing | None:
    """As a first fit of kv and ka has it."""
    estimate, _ = search_globally(make_problem(recordings, ()), SearchConfig())
    return find_timing(recordings, estimate)


def describe(recording: Recording, **info: Any) -> Recording:
    return replace(recording, info=replace(recording.info, **info))


def with_voltage_of_next_row(recording: Recording) -> Recording:
    """A row holds the voltage that was applied until it."""
    return replace(recording, voltage=np.append(0.0, recording.voltage[:-1]))


@pytest.mark.parametrize("sigma", keep_fast([0.05, 1.0], 1.0))
@pytest.mark.parametrize(
    "values", keep_fast([{}, {"reverse_gain": 0.9, "bias_voltage": 0.3}], {"reverse_gain": 0.9, "bias_voltage": 0.3})
)
def test_values_of_an_instant_are_told_from_means_over_a_row(sigma: float, values: dict[str, float]) -> None:
    """Whatever shapes the motion beside it, one way or the other."""
    found = timing_of(check(noisy(sigma, instant=True, **values)))
    assert found is not None and (found.window, found.lag) == (INSTANT, 0.0)
    assert timing_of(check(noisy(sigma, **values))) is None


def test_a_row_with_the_voltage_until_it_is_told() -> None:
    late = with_voltage_of_next_row(noisy(0.05))
    found = timing_of(check(late))
    assert found is not None and (found.window, found.lag) == (1.0, -0.5)
    unsaid = describe(late, source="import", voltage_assumed=True)
    assert timing_of(check(unsaid)) == found
    said = timing_of(check(describe(unsaid, voltage_assumed=False)))  # --no-voltage-before
    assert said is None or not said.is_early
    assert timing_of(check(with_voltage_of_next_row(late))) is None  # no log is two rows late: for another reason
    found = timing_of(check(with_voltage_of_next_row(noisy(0.05, instant=True))))
    assert found is not None and (found.window, found.lag) == (INSTANT, -1.0)  # without any dead time left


@pytest.mark.parametrize(
    ("gains", "dead", "lag"),
    [
        ((10.0, 15.0), 0.2, 0.5),
        ((19.0, 21.0), 0.2, 0.0),
        ((10.0, 45.0), 0.2, -0.5),
        ((10.0, 45.0), 0.44, -0.5),
        ((10.0, 45.0), 0.46, 0.0),  # rows, by which it is as late as the row's own instant
        ((1.0, 45.0), 0.46, 0.0),
        ((-1.0, 45.0), 0.46, -0.5),  # which is less likely than what was assumed
    ],
)
def test_speeds_are_made_no_younger_than_they_have_to_be(gains: tuple[float, float], dead: float, lag: float) -> None:
    """A dead time makes up for half a row: of two timings that are as likely the first one is meant."""
    assert _find_instants(_make_shaper(400, (*gains, 0.0), dead)).lag == lag  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("gains", "lag"),
    [((57.0, 0.0), 0.5), ((63.0, 0.0), 0.0), ((57.0, 190.0), 0.5), ((57.0, 210.0), 0.0), ((57.0, 270.0), -0.5)],
)
def test_many_rows_ask_less_of_each_for_half_a_row_than_for_a_voltage_of_the_next(
    gains: tuple[float, float], lag: float
) -> None:
    """Of 14,000 rows of a tachogenerator 270 were not enough, and a friction was made up for it."""
    assert _find_instants(_make_shaper(10_000, (*gains, 0.0), 0.2)).lag == lag  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("gains", "step", "lag"),
    [
        ((110.0, 176.0), 0.0, 0.0),  # by less than many rows ask for
        ((110.0, 176.0), 0.1, -0.5),
        ((110.0, 109.0), 0.1, 0.0),
        ((10.0, 60.0), 0.1, 0.5),  # for what is assumed is right, for counts too, where no other is much likelier
    ],
)
def test_counts_of_a_row_are_no_values_of_an_instant(
    monkeypatch: pytest.MonkeyPatch, gains: tuple[float, float], step: float, lag: float
) -> None:
    monkeypatch.setattr(speed_timing, "find_speed_sensor", lambda _: SimpleNamespace(step=step))
    assert _find_instants(_make_shaper(3900, (*gains, 0.0), 0.2)).lag == lag  # type: ignore[union-attr]


@pytest.mark.parametrize(("converted", "gain", "lag"), [(True, -2.9, 0.0), (True, -3.1, 0.5), (False, 0.1, 0.5)])
def test_a_converters_steps_are_of_an_instant_where_that_is_as_likely(
    monkeypatch: pytest.MonkeyPatch, converted: bool, gain: float, lag: float
) -> None:
    """A tachogenerator behind ten bits had a dead time of 39.6 ms, and its motor one of 44.6 ms."""
    monkeypatch.setattr(speed_timing, "is_converted", lambda _: converted)
    assert _find_instants(_make_shaper(300, (gain, 0.0, 0.0), 0.2)).lag == lag  # type: ignore[union-attr]


def _make_shaper(rows: int, gains: Sequence[float], dead: float) -> Shaper:
    """Make one whose fits by any other timing than the assumed are likelier by these, which have a dead time [rows]."""
    white = np.random.default_rng(0).standard_normal(rows)
    factors = dict(zip((ASSUMED, *OTHERS), np.exp(-np.array([0.0, *gains]) / rows), strict=True))

    @dataclass
    class Stub:
        recordings: tuple[Recording, ...] = (noisy(0.05),)

        def fit(self, timing: Timing) -> SimpleNamespace:
            early = timing in (ASSUMED, OTHERS[0])
            row = self.recordings[0].info.sample_period
            return SimpleNamespace(residuals=factors[timing] * white, delay=0.0 if early else dead * row)

    return cast(Shaper, Stub())


@pytest.mark.parametrize(("dead", "told"), [(0.0, False), (0.0005, False), (0.005, True)])
def test_a_motion_that_comes_earlier_than_any_row_tells_nothing(dead: float, told: bool) -> None:
    """It asks for no dead time even where speeds are made half a row younger than any program makes them."""
    white = np.random.default_rng(0).standard_normal(400)

    @dataclass
    class Stub:
        recordings: tuple[Recording, ...] = (noisy(0.05),)

        def fit(self, timing: Timing) -> SimpleNamespace:
            return SimpleNamespace(residuals=white, delay=dead if timing == TOO_EARLY else 0.0)

    assert (_find_instants(cast(Shaper, Stub())) is not None) == told


def test_a_dead_time_is_none_of_the_timing() -> None:
    assert timing_of(check(noisy(0.05, delay=0.015))) is None
    found = timing_of(check(noisy(0.05, delay=0.015, instant=True)))
    assert found is not None and (found.window, found.lag) == (INSTANT, 0.0)  # a mean would be less sharp


def swept() -> Recording:
    """Values of instants at 100 Hz of a motor whose supply sags by a sixth at stall, under a sine that gets faster."""
    time, span = np.arange(640) / 100.0, 6.4
    voltage = 7.2 * np.sin(np.pi * span / 1.696 * (np.exp(2.0 * time / span) - 1.0) / 3.0)
    motor = {"kv": 0.049, "ka": 0.0052, "ks": 0.63, "sag": 0.18}
    drive = profiles.pieces(voltage, np.full(len(time), 0.01))
    recording, truth = record(motor, *drive, edges=6, sample_rate=100.0, single_channel=False)
    speed = truth.speed + 0.8 * np.random.default_rng(0).standard_normal(len(truth.speed))
    return check(without_count(replace(as_speed(recording), speed=speed)))


@pytest.mark.parametrize(("known", "lag"), [((), -0.5), (("supply_sag", "transport_delay"), 0.0)])
def test_what_is_known_to_be_in_a_motor_tells_how_speeds_were_made(known: tuple[str, ...], lag: float) -> None:
    """Without the sag they seem to be half a row younger than they are."""
    recording = swept()
    estimate, _ = search_globally(make_problem([recording], known[:1]), SearchConfig())
    found = find_timing([recording], estimate, None, known)
    assert found is not None and found.lag == lag


def quick(sigma: float = 3.0, seconds: float = 4.0, seed: int = 3) -> Recording:
    """A small motor at 1 kHz whose inductance takes a third of its time constant, by a tachogenerator's instants."""
    motor = {"kv": 0.03, "ka": 1.5e-4, "ks": 1.5, "electrical_time_constant": 0.0016}
    levels = np.random.default_rng(seed).uniform(-9.0, 9.0, int(seconds * 125.0))
    drive = np.arange(len(levels)) * 0.008, levels
    recording, truth = record(motor, *drive, seed=seed, edges=6, sample_rate=1000.0, single_channel=False)
    noise = sigma * np.random.default_rng(seed).standard_normal(len(truth.speed))
    return without_count(replace(as_speed(recording), speed=truth.speed + noise))


@pytest.mark.slow
def test_instants_are_found_beside_an_inductance_that_hides_them() -> None:
    """Read as means over their rows, both effects were found, and neither left less than something structured."""
    log = check(quick())
    assert timing_of(log) is None
    found = diagnose([log])
    assert {one.effect for one in found.findings} == {"coulomb_friction", "armature_inductance"}
    fit = identify([log], Request(("coulomb_friction", "armature_inductance")))
    for values in (found.model.parameters.values, fit.parameters.values):
        assert values["electrical_time_constant"] == pytest.approx(0.0016, rel=0.03)
        assert values["ks"] == pytest.approx(1.5, rel=0.02) and values["ka"] == pytest.approx(1.5e-4, rel=0.02)


@pytest.mark.slow
def test_a_diagnosis_finds_the_timing_again_where_a_lag_undoes_it(monkeypatch: pytest.MonkeyPatch) -> None:
    timings = iter((OTHERS[1], OTHERS[0]))
    monkeypatch.setattr(timed_selection, "find_timing_beside", lambda *_, **__: next(timings))
    heard: list[float] = []
    found = diagnose([swept()], progress=lambda stage: heard.append(stage.share))
    assert heard == sorted(heard) and heard.count(0.95) > 3
    assert {finding.effect for finding in found.findings} == {"coulomb_friction", "supply_sag"}
    assert found.verdict is Verdict.EXPLAINED and found.model.timing == OTHERS[0]


@pytest.mark.slow
def test_a_timing_by_which_more_is_left_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    timings = iter((OTHERS[1], Timing(1.0, 9.5, "")))
    monkeypatch.setattr(timed_selection, "find_timing_beside", lambda *_, **__: next(timings))
    found = diagnose([swept()])
    assert next(timings, None) is None and found.model.timing == OTHERS[1]
    assert {"supply_sag", "transport_delay"} < {finding.effect for finding in found.findings}


def test_what_was_said_is_believed() -> None:
    early = check(noisy(0.05, instant=True))
    row = early.info.sample_period
    assert timing_of(early) is not None
    assert timing_of(describe(early, speed_window=0.5 * row)) is None
    assert timing_of(describe(early, speed_lag=0.0)) is None
    assert timing_of(describe(early, speed_window=row, speed_lag=0.5 * row)) is not None
    assert timing_of(describe(early, speed_window=row, speed_lag=0.5 * row, speed_said=True)) is None
    assert timing_of(describe(early, edges_per_revolution=96)) is None
    assert timing_of(early, describe(early, speed_lag=0.0)) is None
    assert timing_of(early.between(0.0, 0.8)) is None  # too few to tell
    assert identify([early.between(0.0, 0.2)], Request()).timing is None  # and to fit what shapes a motion


def test_another_timing_is_not_likelier_by_no_numbers() -> None:
    flat, zero, none = (np.full(100, value) for value in (1.0, 0.0, np.nan))
    assert not _is_likelier(none, flat) and not _is_likelier(flat, none) and not _is_likelier(zero, zero)
    assert not _is_likelier(flat, zero) and not _is_likelier(flat, flat)


@pytest.mark.parametrize(("rows", "likelier"), [(0, True), (5, False)])
def test_a_few_rows_do_not_decide(rows: int, likelier: bool) -> None:
    """Five of 2,000 sizes of means, of rows in which a motor turned over, made them instants, and an inductance up."""
    white = np.random.default_rng(0).standard_normal(2000)
    other = 0.95 * white if rows else 1.1 * white
    other[:rows] = 30.0
    assert measure_gain(other, white) > 150.0
    assert _is_likelier(white, other) is likelier


def test_a_timing_is_judged_by_what_a_fit_may_see() -> None:
    recordings = [check(noisy(0.05, instant=True))]
    estimate, _ = search_globally(make_problem(recordings, ()), SearchConfig())
    seen: list[int] = []
    hold_out = make_hold_out(recordings, [])

    def restrict(problem: Problem) -> Problem:
        kept = hold_out.restrict(problem)
        seen.append(len(kept.weight))
        return kept

    assert find_timing(recordings, estimate, restrict) is not None
    assert 0.6 < max(seen) / len(recordings[0]) < 0.9


@pytest.mark.slow
def test_a_fit_and_a_diagnosis_use_what_was_found() -> None:
    """Read as means, kv or ka would be wrong, and half a row of lead missing."""
    early = check(noisy(0.05, instant=True))
    fit = identify([early], Request(("coulomb_friction",)))
    for name, value in RUBBING.items():
        assert fit.parameters.values[name] == pytest.approx(value, rel=0.003)
        assert fit.parameters.values[name] != pytest.approx(value, rel=1e-7)
    assert fit.residual_rms < 0.06 and any("rows' own instants" in note for note in fit.notes)
    curves = make_fit_curves(early, fit)  # of a report, which reads the recording again
    assert float(np.sqrt(np.mean((curves.simulated - curves.measured) ** 2))) < 0.06
    watched = measure_gap(check(noisy(0.05, 1, instant=True)), Model(Identified("model", fit.parameters, {}), 0.05))
    assert watched.rms < 0.1 and len(list_readings(early)) == 2
    found = diagnose([early])
    assert [one.effect for one in found.findings] == ["coulomb_friction"] and found.verdict is Verdict.EXPLAINED
    assert any("rows' own instants" in note for note in found.model.notes)


@pytest.mark.parametrize(
    ("likelier", "confirmed", "found"),
    [
        (UNTIL, True, replace(UNTIL, filter=SpeedFilter(MEMORY, 0.5))),
        (UNTIL, False, replace(ASSUMED, filter=SpeedFilter(MEMORY, 0.4))),  # its own, of voltages as they are logged
        (ASSUMED, False, replace(ASSUMED, filter=SpeedFilter(MEMORY, 0.4))),
        (ASSUMED, True, replace(UNTIL, filter=SpeedFilter(MEMORY, 0.4))),
    ],
)
def test_voltages_of_smoothed_counts_held_until_their_rows_only_where_the_motion_confirms_it(
    monkeypatch: pytest.MonkeyPatch, likelier: Timing, confirmed: bool, found: Timing
) -> None:
    """A filter and a row of voltage do each other's work: both are looked for, and the voltage again behind it."""
    poles = {UNTIL: SpeedFilter(MEMORY, 0.5), ASSUMED: SpeedFilter(MEMORY, 0.4)}

    def find(shaper: Shaper, timings: Sequence[Timing]) -> Timing:
        best = likelier if likelier in timings else ASSUMED
        return replace(best, filter=poles[best])

    monkeypatch.setattr(speed_timing, "find_filter", find)
    monkeypatch.setattr(speed_timing, "held_until", lambda shaper: confirmed)
    said = describe(check(noisy(0.05)), edges_per_revolution=960)
    assert speed_timing._find_voltages(Shaper([said], cast(Estimate, None), None)) == found


@pytest.mark.parametrize(("rows", "beaten"), [(0, True), (5, False)])
def test_a_few_rows_do_not_rule_instants_of_counts_out(rows: int, beaten: bool) -> None:
    white = np.random.default_rng(0).standard_normal(2000)
    other = 0.95 * white if rows else 1.1 * white
    other[:rows] = 30.0
    instants: Any = (OTHERS[0], SimpleNamespace(residuals=other))
    assert measure_gain(other, white) > 150.0
    assert speed_timing._beats(white, instants, counted=True) is beaten


@pytest.mark.parametrize(
    ("factor", "rows", "likelier"), [(1.1, 0, True), (0.9, 0, False), (0.95, 5, False), (1.001, -5, False)]
)
def test_instants_are_likelier_by_all_rows_and_not_by_a_few(factor: float, rows: int, likelier: bool) -> None:
    """Neither where few rows speak for them nor where few speak against them by as much as all others do for."""
    white = np.random.default_rng(0).standard_normal(2000)
    own, before = white.copy(), factor * white
    if rows > 0:
        before[:rows] = 30.0
    elif rows < 0:
        own[:-rows] = 30.0
    fits = {OTHERS[0]: own, ASSUMED: before}
    shaper: Any = SimpleNamespace(fit=lambda timing: SimpleNamespace(residuals=fits[timing]))
    assert speed_timing._is_likelier_by_all(shaper, OTHERS[0], ASSUMED) is likelier
