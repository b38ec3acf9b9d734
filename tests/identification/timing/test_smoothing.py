"""Whether speeds were smoothed shows in their noise and in the motion, and a lag of the motor is none."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from plant import record
from recorded import as_speed, without_count
from scipy.signal import butter, lfilter
from swinging import RUBBING, held_late, noisy, recorded
from tiers import keep_fast, mark_slow

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.request import SearchConfig
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.identify import Request, identify
from motor_identification.monitoring.health import Limits
from motor_identification.monitoring.load_watch import load_watch
from motor_identification.monitoring.model_gap import Model, find_changes, measure_gap
from motor_identification.recording import Recording, check
from motor_identification.reporting.fit_model_file import save_model
from motor_identification.reporting.model_comparison import Identified
from motor_identification.sensor.speed_sensor import are_said_counts
from motor_identification.sensor.value_lattice import find_lattice
from motor_identification.timing import smoothing
from motor_identification.timing.shaped_fit import Shaper
from motor_identification.timing.smoothing import (
    CLIMB,
    Likelihood,
    _choose_poles,
    _climb,
    _find_peak,
    _list_lattices,
    find_filter,
)
from motor_identification.timing.speed_filter import BILINEAR, MEAN, MEMORY, SpeedFilter, parse_filter
from motor_identification.timing.speed_timing import find_timing
from motor_identification.timing.timing import ASSUMED, INSTANT, OTHERS, Timing
from motor_identification.uncertainty.result import Fit
from motor_model.errors import ModelError
from motor_model.model_file import load, load_errors, load_residual_rms, load_speed_filter

Program = tuple[Sequence[float], Sequence[float]]  # numerator and denominator, powers of 1/z ascending


def smoothed(recording: Recording, memory: float) -> Recording:
    """As a small program logs it, with five digits."""
    return filtered(recording, [1.0 - memory], [1.0, -memory])


def filtered(recording: Recording, numerator: Sequence[float], denominator: Sequence[float]) -> Recording:
    """By any filter."""
    return check(replace(recording, speed=np.round(lfilter(numerator, denominator, recording.speed), 5)))


def timing_of(recording: Recording) -> Timing | None:
    """As a first fit of kv and ka has it."""
    estimate, _ = search_globally(make_problem([recording], ()), SearchConfig())
    return find_timing([recording], estimate)


def memory_of(recording: Recording) -> float:
    """The share of the one before; 0 of what was not filtered."""
    found = filter_of(recording)
    assert found is None or found.kind == MEMORY
    return found.number if found else 0.0


def filter_of(recording: Recording) -> SpeedFilter | None:
    found = timing_of(recording)
    return found.filter if found else None


@pytest.mark.parametrize("memory", keep_fast([0.5, 0.85], 0.5))
def test_speeds_with_noise_show_how_they_were_smoothed(memory: float) -> None:
    assert memory_of(smoothed(noisy(0.5), memory)) == pytest.approx(memory, abs=0.03)


@pytest.mark.slow
def test_values_of_an_instant_are_told_when_smoothed_too() -> None:
    found = timing_of(smoothed(noisy(0.5, instant=True), 0.7))
    assert found is not None and (found.window, found.lag) == (INSTANT, 0.0)
    assert found.filter is not None and found.filter.number == pytest.approx(0.7, abs=0.03)


def test_each_timing_has_a_filter_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """Poles that are off make up for another timing; these numbers are of a tachogenerator behind a Butterworth's."""
    tops = {ASSUMED: (0.84, 1.7), OTHERS[0]: (0.8, 2.3)}

    def measure(likelihood: Likelihood, passed: SpeedFilter | None, _: Sequence[str] = ()) -> float:
        likelihood.count = 1000
        number, most = tops[likelihood.timing]
        if passed is None or passed.kind != "butterworth":
            return 0.0 if passed is None else 0.5 - abs(passed.number - 0.6)
        return most - 20.0 * abs(passed.number - number)

    monkeypatch.setattr(Likelihood, "_measure", measure)
    recording = noisy(0.5, instant=True)
    shaper = Shaper([recording], search_globally(make_problem([recording], ()), SearchConfig())[0], None)
    found = find_filter(shaper, (ASSUMED, OTHERS[0]))
    assert found.lag == OTHERS[0].lag
    assert found.filter is not None and found.filter.number == pytest.approx(0.8, abs=0.005)


@pytest.mark.parametrize(("means", "found"), [((3,), True), ((4,), False), ((), False)])
def test_a_mean_that_only_the_true_timing_speaks_for_is_found(
    monkeypatch: pytest.MonkeyPatch, means: tuple[int, ...], found: bool
) -> None:
    """These numbers are of a tachogenerator's three rows' mean, in a motor of 12 ms under a random binary command.

    Four rows' mean is likely by neither timing, nor is a filter where values tell of no mean.
    """
    behind_mean = {ASSUMED: (-2.49, -2.5), OTHERS[0]: (-2.62, -1.4)}  # without and behind one of three

    def measure(likelihood: Likelihood, passed: SpeedFilter | None, beside: Sequence[str] = ()) -> float:
        likelihood.count = 1900
        without, behind = behind_mean[likelihood.timing]
        if passed is None:
            return without + (0.2 if beside else 0.0)
        return behind if passed == SpeedFilter(MEAN, 3) else -3.8

    monkeypatch.setattr(Likelihood, "_measure", measure)
    monkeypatch.setattr(smoothing, "find_means", lambda recordings: means)
    recording = noisy(0.5, instant=True)
    shaper = Shaper([recording], search_globally(make_problem([recording], ()), SearchConfig())[0], None)
    timing = find_filter(shaper, (ASSUMED, OTHERS[0]))
    assert timing == (replace(OTHERS[0], filter=SpeedFilter(MEAN, 3)) if found else ASSUMED)


@pytest.mark.parametrize(("most", "found"), [(1.77, True), (1.585, True), (1.583, False)])
def test_a_filter_that_only_the_true_timing_speaks_for_is_found(
    monkeypatch: pytest.MonkeyPatch, most: float, found: bool
) -> None:
    """These numbers are of a tachogenerator behind an RC filter of 0.93 of a row: what lags in a motor does much of it.

    By means over the row a smaller share was the top, and less likely than an inductance by the row's own instants.
    """

    def measure(likelihood: Likelihood, passed: SpeedFilter | None, beside: Sequence[str] = ()) -> float:
        likelihood.count = 5700
        is_instant = likelihood.timing is OTHERS[0]
        if passed is None:
            return (1.58 if is_instant else 0.06) if beside else 0.0
        if passed.kind != "memory":
            return -1.0
        return most - abs(passed.number - 0.35) if is_instant else 0.95 - abs(passed.number - 0.25)

    monkeypatch.setattr(Likelihood, "_measure", measure)
    monkeypatch.setattr(smoothing, "find_means", lambda recordings: ())
    recording = noisy(0.5, instant=True)
    shaper = Shaper([recording], search_globally(make_problem([recording], ()), SearchConfig())[0], None)
    timing = find_filter(shaper, (ASSUMED, OTHERS[0]))
    assert timing == (replace(OTHERS[0], filter=SpeedFilter("memory", 0.35)) if found else ASSUMED)


@pytest.mark.parametrize(
    ("kind", "number", "program"),
    [
        mark_slow("bilinear", 0.854, ([0.073, 0.073], [1.0, -0.854])),
        mark_slow("twice", 0.6, ([0.16], [1.0, -1.2, 0.36])),
        mark_slow("butterworth", 0.7, butter(2, 0.3)),
        ("mean", 7, ([1.0 / 7.0] * 7, [1.0])),
    ],
)
def test_every_kind_of_filter_is_told_from_the_others(kind: str, number: float, program: Program) -> None:
    found = filter_of(filtered(noisy(0.5), *program))
    assert found is not None and found.kind == kind
    assert found.number == pytest.approx(number, abs=0.03)


@pytest.mark.slow
def test_filtered_counts_are_told_too() -> None:
    """Behind a pole by their lattice; a mean of them lies on one itself."""
    counted = without_count(as_speed(recorded(edges=96)))
    assert filter_of(filtered(counted, [0.5, 0.5], [1.0])) == SpeedFilter(MEAN, 2)
    assert filter_of(filtered(counted, [0.0728, 0.0728], [1.0, -0.854])) == SpeedFilter("bilinear", 0.854)


@pytest.mark.parametrize("memory", keep_fast([0.35, 0.9], 0.35))
def test_counted_speeds_lie_on_a_lattice_for_the_right_share(memory: float) -> None:
    """To the last digit, though nothing but counting is their noise."""
    counted = without_count(as_speed(recorded(edges=96)))
    assert memory_of(counted) == 0.0
    assert memory_of(smoothed(counted, memory)) == memory


@pytest.mark.parametrize("share", [0.2, 0.4])
def test_levels_that_any_share_leaves_whole_do_not_hide_the_one_that_was(share: float) -> None:
    """Of two stairs seven and eight shares left a lattice of counts, by its scatter one of them at the steps too."""
    speed = np.repeat([3.0, 8.0, 14.0, 9.0, 4.0], 100)
    counts = np.rint(lfilter([0.1], [1.0, -0.9], 7.0 * speed)) * 0.383
    log = without_count(as_speed(recorded(edges=96)))
    log = replace(log.at_rows(np.arange(500)), speed=np.round(lfilter([1.0 - share], [1.0, -share], counts), 3))
    left = _list_lattices([log], MEMORY)
    assert share in left and len(left) <= 2  # 3/16 beside a fifth


def test_counts_of_rows_of_any_length_lie_on_a_lattice_by_their_rows() -> None:
    counted = without_count(as_speed(recorded(edges=96)))
    random = np.random.default_rng(5)
    rows = counted.info.sample_period * random.uniform(0.8, 1.2, len(counted))
    counts = np.rint(counted.speed * counted.info.sample_period * 96 / (2.0 * np.pi))
    speed, stamps = counts * 2.0 * np.pi / 96 / rows, np.round(1e9 * np.cumsum(rows)).astype(np.int64)
    uneven = replace(counted, speed=speed, sample_time=stamps)
    assert _list_lattices([smoothed(uneven, 0.6)], MEMORY) == [0.6]
    assert _list_lattices([check(uneven)], MEMORY) == []


def test_whole_counts_a_second_are_no_counts_that_passed_a_filter() -> None:
    """Firmware that divides counts by the row's microseconds and gives whole counts a second: undone, its digits are a
    lattice, as they are too fine to be one before. Counts that passed a filter and have such digits are told."""
    turn, row = 1792, 0.01
    counted = without_count(as_speed(recorded(edges=96)))
    time = row * np.arange(800)
    travel = 71.7 * turn / 36.0 * np.maximum(time - 1.0 - 0.02 * (1.0 - np.exp(-np.maximum(time - 1.0, 0.0) / 0.02)), 0)
    counts = np.diff(np.floor(travel), prepend=0.0)
    a_second = np.floor(counts / (row + 4e-6 * np.random.default_rng(3).integers(-4, 5, len(counts))))
    logged = replace(counted.at_rows(np.arange(len(counted)) < len(time)), speed=a_second * 2.0 * np.pi / turn)
    assert len(logged) == len(time) and find_lattice(logged.speed) == 0.0
    assert _list_lattices([logged], MEMORY) == []
    passed = np.round(lfilter([0.1], [1.0, -0.9], counted.speed), 2)
    assert find_lattice(np.diff(passed)) == pytest.approx(0.01)
    assert _list_lattices([replace(counted, speed=passed)], MEMORY) == [0.9]


@pytest.mark.parametrize(
    "lag",
    keep_fast(
        [{}, {"delay": 0.013}, {"electrical_time_constant": 0.02}, {"electrical_time_constant": 0.06}],
        {"electrical_time_constant": 0.02},
    ),
)
def test_what_lags_in_the_motor_is_no_smoothing(lag: dict[str, float]) -> None:
    assert memory_of(check(noisy(0.5, **lag))) == 0.0


def test_a_short_log_tells_a_filter_where_that_is_much_likelier(monkeypatch: pytest.MonkeyPatch) -> None:
    some = noisy(0.5).at_rows(np.arange(120))
    logged = smoothed(some, 0.7)
    assert memory_of(logged) == pytest.approx(0.7, abs=0.1)
    assert memory_of(check(some)) == 0.0
    monkeypatch.setattr(smoothing, "LEAST_GAIN_OF_FEW", 1e3)
    assert memory_of(logged) == 0.0
    monkeypatch.setattr(smoothing, "MANY", 100)
    assert memory_of(logged) > 0.0


@pytest.mark.parametrize("memory", keep_fast([0.0, 0.8], 0.0))
def test_printed_digits_are_no_counts_that_passed_no_filter(memory: float) -> None:
    """A slow motor's speeds of two decimals lie on a lattice of these, smoothed or not."""
    slow = noisy(0.5)
    slow = replace(slow, speed=0.05 * slow.speed)
    passed = replace(slow, speed=np.round(lfilter([1.0 - memory], [1.0, -memory], slow.speed), 2))
    assert find_lattice(passed.speed) == pytest.approx(0.01)
    assert memory_of(check(passed)) == pytest.approx(memory, abs=0.05)


def test_hardly_smoothed_or_held_speeds_are_left_as_they_are() -> None:
    assert memory_of(smoothed(noisy(0.5), 0.1)) == 0.0  # worth less than the least that is asked for
    assert memory_of(smoothed(noisy(0.5), 0.35)) == pytest.approx(0.35, abs=0.05)  # and more
    assert memory_of(check(held_late(smoothed(noisy(0.5), 0.8), 4, 0))) == 0.0  # shown four times each


@pytest.mark.slow
def test_every_limit_decides(monkeypatch: pytest.MonkeyPatch) -> None:
    logged = smoothed(noisy(0.5), 0.7)
    estimate, _ = search_globally(make_problem([logged], ()), SearchConfig())
    assert find_timing([logged], estimate) is not None
    limits = {"LEAST_GAIN": 1e4, "LEAST_PART": 10.0, "LEAST_SPEEDS": 2000, "LEAST_SHARE": 0.75, "LONGEST": 0.002}
    for limit, value in limits.items():
        with monkeypatch.context() as patched:
            patched.setattr(smoothing, limit, value)
            found = find_timing([logged], estimate)
            assert found is None or found.filter is None, limit


def test_a_climb_ends_at_the_first_top() -> None:
    """Behind it the motor's own lag is taken for the filter's."""
    tops = [(0.55, 100.0), (0.95, 200.0)]

    def value(memory: float) -> float:
        return float(sum(height * np.exp(-(((memory - top) / 0.1) ** 2)) for top, height in tops))

    assert CLIMB[_climb(value)] in (0.5, 0.6) and CLIMB[_climb(value, CLIMB.index(0.85))] in (0.94, 0.96)
    assert CLIMB[_climb(lambda memory: -memory)] == 0.0 and CLIMB[_climb(lambda memory: memory)] == 0.98


@pytest.mark.parametrize("steep", [1e2, 1e4, 1e6])
def test_the_top_is_found_however_sharp_it_is(steep: float) -> None:
    """A round share, where that is as likely."""

    def find(value: Callable[[float], float]) -> float:
        return _find_peak(value, _climb(value))

    found = find(lambda memory: -steep * abs(memory - 0.577) ** 1.5)
    assert found == pytest.approx(0.577, abs=(3.0 / steep) ** (2.0 / 3.0) + 1e-3)
    assert find(lambda memory: -steep * (memory - 0.854) ** 2) == pytest.approx(0.854, abs=(3.0 / steep) ** 0.5 + 1e-9)
    assert find(lambda memory: 100.0 * (memory == 0.5) - (memory - 0.4) ** 2) == 0.5  # counts are whole there alone


@pytest.mark.parametrize(("best", "found"), [(0.94, True), (0.96, True), (0.98, False), (1.2, False)])
def test_a_filter_that_goes_on_where_the_search_ends_is_none(best: float, found: bool) -> None:
    """The mean of six rows of a coasting motor was undone as a filter of 198 ms: more motion than the log has."""
    silent = cast(Shaper, SimpleNamespace(recordings=[without_count(as_speed(recorded(edges=96)))]))

    class Peak(Likelihood):
        def _measure(self, passed: SpeedFilter | None, beside: Sequence[str] = ()) -> float:
            number = 0.0 if passed is None or passed.kind != MEMORY else passed.number
            return -1e4 * (number - best) ** 2

        def keep_of_motor(self, passed: SpeedFilter | None) -> float:
            return 0.5

    likelihood = Peak(silent, ASSUMED)
    likelihood.count = 1
    passed, sure = _choose_poles(likelihood, MEMORY, are_open=True)
    assert (passed is not None) is found and not sure
    assert passed is None or passed.number == pytest.approx(best, abs=0.01)


def test_no_memory_at_all_is_no_filter_behind_means_of_two_rows_that_are_less_likely() -> None:
    """It was taken for a memory of 0, whose length in time has no logarithm: a mistake of the workbench."""
    silent = cast(Shaper, SimpleNamespace(recordings=[without_count(as_speed(recorded(edges=96)))]))

    class FewZeros(Likelihood):
        def _measure(self, passed: SpeedFilter | None, beside: Sequence[str] = ()) -> float:
            return 0.0 if passed is None else -1e3 * (1.0 + (passed.kind != MEMORY)) * passed.number

        def keep_of_motor(self, passed: SpeedFilter | None) -> float:
            assert passed is not None and passed.number > 0.0
            return 0.5

    likelihood = FewZeros(silent, ASSUMED)
    likelihood.count = 1
    assert _choose_poles(likelihood, BILINEAR, are_open=True) == (None, False)


@pytest.mark.parametrize(("gain", "keeps", "share"), [(22.0, 0.8, 0.789), (18.0, 0.8, 0.42), (22.0, 0.3, 0.42)])
def test_the_filter_is_the_one_of_two_lags_that_is_far_likelier(gain: float, keeps: float, share: float) -> None:
    """Of speeds that kept 0.79, of a motor that keeps 0.42 in a row, the other way about was found: ka 3.4 times."""

    class TwoTops(Likelihood):
        def _measure(self, passed: SpeedFilter | None, beside: Sequence[str] = ()) -> float:
            number = 0.0 if passed is None or passed.kind != MEMORY else passed.number
            tops = ((0.42, 100.0, 0.2), (0.789, 100.0 + gain, 0.1))
            return max(height - 1e3 * ((number - top) / width) ** 2 * 0.04 for top, height, width in tops)

        def keep_of_motor(self, passed: SpeedFilter | None) -> float:
            return keeps

    likelihood = TwoTops(cast(Shaper, SimpleNamespace(recordings=[])), ASSUMED)
    likelihood.count = 1
    assert smoothing._swap_poles(likelihood, 0.42) == pytest.approx(share, abs=0.02)


def test_a_quick_motor_behind_a_slow_filter_is_no_slow_motor_behind_a_quick_one() -> None:
    levels, motor = np.random.default_rng(760_100).uniform(-9.0, 9.0, 50), {"kv": 0.168, "ka": 0.0077, "ks": 0.3}
    drive = np.arange(50) * 0.16, levels
    plain, _ = record(motor, *drive, seed=1, edges=2000, sample_rate=25.0, single_channel=False)
    log = without_count(as_speed(plain))
    noise = 0.3 * np.random.default_rng(760_101).standard_normal(len(log))
    found = filter_of(smoothed(replace(log, speed=log.speed + noise), 0.789))
    assert found is not None and found.kind == MEMORY and found.number == pytest.approx(0.789, abs=0.03)


@pytest.mark.parametrize(("strength", "found"), [(0.9, True), (1.1, False)])
def test_a_filter_behind_which_a_torque_beyond_the_voltage_moves_the_motor_is_none(
    strength: float, found: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of 63 % of a step in 150 ms a filter of 983 ms was made, and a random torque of 4.8 V under a voltage of 3 V."""
    log = without_count(as_speed(recorded(edges=96)))
    most = float(np.max(np.abs(log.voltage)))
    likelihood = Likelihood(cast(Shaper, SimpleNamespace(recordings=[log])), ASSUMED)
    passed = SpeedFilter(MEMORY, 0.95)
    likelihood._known[passed], likelihood._torque[passed] = 0.0, strength * most
    assert likelihood.is_driven(passed) is found
    monkeypatch.setattr(smoothing, "_choose_filter", lambda *_: (passed, True))
    assert (smoothing._choose_by_timing([likelihood], (), True) is not None) is found


@pytest.mark.parametrize(("window", "counts"), [(0.02, True), (0.0137, False)])
def test_said_counts_within_their_window_passed_no_filter(window: float, counts: bool) -> None:
    """Though the time that was measured for each blurs them, so that they lie on no lattice to the digit."""
    log = as_speed(recorded(edges=96))
    blur = 1.0 - 0.002 * np.random.default_rng(5).random(len(log))
    log = replace(log, speed=log.speed * blur, info=replace(log.info, speed_window=window))
    assert are_said_counts(log) is counts and not are_said_counts(without_count(log))
    assert smoothing._are_counts([replace(log, speed=log.speed + 0.0)]) or not counts


def test_a_few_values_lie_on_any_lattice() -> None:
    """Of three levels of counts nothing is learned of a filter."""
    counted = without_count(as_speed(recorded(edges=96)))
    few = replace(counted, speed=np.repeat([200.3, 203.3, 206.3, 203.3], len(counted) // 4 + 1)[: len(counted)])
    assert _list_lattices([few], MEMORY) == []


@cache
def fit_of_smoothed() -> Fit:
    return identify([smoothed(noisy(0.5), 0.8)], Request(("coulomb_friction",)))


@cache
def diagnosis_of_smoothed() -> Diagnosis:
    return diagnose([smoothed(noisy(0.5), 0.8)])


@pytest.mark.slow
def test_a_model_is_watched_on_speeds_that_are_smoothed_the_same_way(tmp_path: Path) -> None:
    """By fit and by diagnosis, through its file: no change is seen where there is none."""
    for number, one in enumerate((fit_of_smoothed(), diagnosis_of_smoothed().model)):
        path = tmp_path / f"model_{number}.yaml"
        save_model(path, one, "2026-01-01T00:00:00")
        passed = parse_filter(load_speed_filter(path))
        assert passed is not None and passed.number == pytest.approx(0.8, abs=0.02)
        model = Model(Identified("model", load(path), load_errors(path)), load_residual_rms(path), passed)
        gap = measure_gap(smoothed(noisy(0.5, 1), 0.8), model)
        assert gap.rms < 1.3 * gap.expected and find_changes(gap, model) == ()
        assert measure_gap(smoothed(noisy(0.5, 1), 0.8), replace(model, speed_filter=None)).rms > 3.0 * gap.rms
    save_model(tmp_path / "plain.yaml", identify([check(noisy(0.5))], Request(("coulomb_friction",))), "now")
    assert load_speed_filter(tmp_path / "plain.yaml") == ""
    text = (tmp_path / "model_0.yaml").read_text().replace("speed_filter: memory 0.8", "speed_filter: memory 1")
    (tmp_path / "model_0.yaml").write_text(text)
    with pytest.raises(ModelError, match=r"model_0.yaml: speed_filter is 'memory 1', and must be"):
        load_watch(str(tmp_path / "model_0.yaml"), "", "", Limits())


@pytest.mark.slow
def test_a_fit_and_a_diagnosis_use_what_was_smoothed() -> None:
    """Read as they are, the motor would be slower by the filter, and a lag missing."""
    fit = fit_of_smoothed()
    for name, value in RUBBING.items():
        assert fit.parameters.values[name] == pytest.approx(value, rel=0.03)
    assert any(note.startswith("The speeds are smoothed: each keeps 0.8") for note in fit.notes)
    assert_only_friction(diagnosis_of_smoothed())


@pytest.mark.slow
def test_what_a_tutorial_filters_by_is_no_inductance() -> None:
    """By v = 0.854*v + 0.0728*x + 0.0728*x_before, as many small robots have it."""
    assert_only_friction(diagnose([filtered(noisy(0.5), [0.0728, 0.0728], [1.0, -0.854])]))


def assert_only_friction(found: Diagnosis) -> None:
    assert [one.effect for one in found.findings] == ["coulomb_friction"] and found.verdict is Verdict.EXPLAINED
