"""Voltages of counted logs held until their rows where the motion says so beyond doubt, and nowhere else."""

from dataclasses import dataclass, replace
from math import tau
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from numpy.typing import NDArray
from plant import profiles, record
from recorded import as_counts, as_speed, without_count
from scipy.signal import lfilter
from swinging import RUBBING
from tiers import keep_fast

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.result import Verdict
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.request import SearchConfig
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.identify import Request, identify
from motor_identification.noise.error_model import ErrorModel
from motor_identification.recording import Recording, check, recording_of
from motor_identification.timing import held_until as module
from motor_identification.timing.held_until import _Reading, describe_untold, find_held_behind_lag
from motor_identification.timing.shaped_fit import Shaper
from motor_identification.timing.speed_filter import SpeedFilter
from motor_identification.timing.speed_timing import find_earlier_voltages, find_timing, find_voltages
from motor_identification.timing.timing import ASSUMED, OTHERS, UNTIL, Timing, is_voltage_open, read_again
from motor_model.effects import LAGGING
from motor_model.sample import Info, Measurement, Sample

Floats = NDArray[np.float64]

ROW = 0.02  # [s]
NONE = ErrorModel(0.0, 0.0, 0.0, 1.0)


def counted(assumed: bool = True, seed: int = 0, **motor: float) -> Recording:
    """Counts at rows of 20 ms, of which an import assumed that voltages hold from them on."""
    drive = profiles.random(6.0, 20.0, seed=seed)
    recording, _ = record(RUBBING | motor, *drive, seed=seed, edges=960, sample_rate=1.0 / ROW, single_channel=False)
    return assume(as_counts(recording), assumed)


def assume(recording: Recording, assumed: bool = True) -> Recording:
    info = replace(recording.info, source="import", voltage_assumed=assumed)
    return check(replace(recording, info=info))


def until(recording: Recording) -> Recording:
    """A row holds the voltage that was applied until it."""
    return replace(recording, voltage=np.append(0.0, recording.voltage[:-1]))


def timing_of(*recordings: Recording) -> Timing | None:
    estimate, _ = search_globally(make_problem(recordings, ()), SearchConfig())
    return find_timing(recordings, estimate)


@pytest.mark.slow
def test_the_voltages_that_counts_answer_are_told() -> None:
    assert timing_of(counted()) is None
    assert timing_of(until(counted())) == UNTIL
    assert timing_of(until(counted()), until(counted(seed=1))) == UNTIL


@pytest.mark.parametrize("edges", [6, 0])
def test_speeds_of_said_counts_are_those_of_rows_as_counts_are(edges: int) -> None:
    """Of six a turn, at rows that are nearly half of the motor's time constant, inertia was 44 % off otherwise."""
    motor = {"kv": 0.0514, "ka": 0.00249, "ks": 0.5}
    drive = profiles.random(10.2, 10.0, seed=3)
    recording, _ = record(motor, *drive, seed=3, edges=6, sample_rate=1.0 / ROW, single_channel=False)
    logged = assume(as_speed(recording))
    said = replace(logged, info=replace(logged.info, edges_per_revolution=edges))
    assert is_voltage_open(said) is (edges > 0)
    assert timing_of(said) is None
    found = timing_of(until(said))
    assert found == UNTIL if edges else found is None or found.lag <= ASSUMED.lag


def test_beside_all_that_was_selected_the_voltages_of_counts_alone_are_told() -> None:
    logged = counted()
    estimate, _ = search_globally(make_problem([logged], ()), SearchConfig())
    assert find_voltages([until(logged)], estimate, None, ()) == UNTIL
    assert find_voltages([logged], estimate, None, ()) is None
    assert find_voltages([until(assume(logged, False))], estimate, None, ()) is None  # it was said


def test_speeds_of_said_counts_may_have_passed_a_filter_and_be_of_earlier_voltages() -> None:
    exact = {"edges": 960, "sample_rate": 1.0 / ROW, "single_channel": False}
    logged = assume(as_speed(record(RUBBING, *profiles.random(6.0, 20.0), **exact)[0]))  # type: ignore[arg-type]
    smoothed = check(replace(logged, speed=np.round(lfilter([0.6], [1.0, -0.4], logged.speed), 6)))
    assert is_voltage_open(smoothed)
    found, early = timing_of(smoothed), timing_of(until(smoothed))
    assert found is not None and found == replace(ASSUMED, filter=found.filter)
    assert found.filter is not None and found.filter.number == pytest.approx(0.4)
    assert early is not None and early == replace(UNTIL, filter=found.filter)


def test_what_was_said_is_believed() -> None:
    assert timing_of(until(counted(assumed=False))) is None
    assert timing_of(until(counted()), until(counted(assumed=False, seed=1))) is None
    assert timing_of(until(counted()).between(0.0, 0.8)) is None  # too few to tell


@pytest.mark.parametrize(("rows", "told"), [(0.3, True), (0.7, False), (1.5, False)])
def test_a_dead_time_is_no_later_row(rows: float, told: bool) -> None:
    """By either reading it is late; what is left of it with voltages a row later says which is meant."""
    late = counted(delay=rows * ROW)
    assert timing_of(late) is None
    assert (timing_of(until(late)) == UNTIL) == told


def test_no_motion_is_late_by_a_sensor_or_a_winding_that_comes_early() -> None:
    assert timing_of(counted(electrical_time_constant=0.01)) is None
    late = counted()
    smoothed = np.round(np.convolve(late.edge_count, [0.25, 0.5, 0.25])[: len(late)]).astype(np.int64)
    smoothed[:2] = late.edge_count[0]
    assert timing_of(check(replace(late, edge_count=smoothed))) is None


def earlier_of(recording: Recording, known: Timing | None = None, beside: tuple[str, ...] = ()) -> Timing | None:
    estimate, _ = search_globally(make_problem([recording], beside), SearchConfig())
    return find_earlier_voltages([recording], estimate, None, beside, known)


def test_behind_a_lag_of_the_sensor_voltages_that_held_until_their_rows_are_found() -> None:
    """A filter of a row and a half and a voltage that is a row early are half a row, as far as a dead time goes."""
    drive = profiles.random(6.0, 20.0)
    exact, _ = record(RUBBING, *drive, edges=9600, sample_rate=1.0 / ROW, single_channel=False)
    share = 1.0 - np.exp(-1.0 / 1.5)
    lagging = lfilter([share], [1.0, share - 1.0], as_speed(exact).speed)
    noise = 0.05 * np.random.default_rng(7).standard_normal(len(lagging))
    logged = without_count(assume(replace(as_speed(exact), speed=lagging + noise)))
    early = until(logged)
    for known in (None, ASSUMED, OTHERS[0]):
        found = earlier_of(early, known, ("coulomb_friction",))
        assert found in (UNTIL, OTHERS[2]) and earlier_of(logged, known, ("coulomb_friction",)) is None
    for known in (UNTIL, replace(ASSUMED, slot=0.1), replace(ASSUMED, filter=SpeedFilter("once", 0.4))):
        assert earlier_of(early, known, ("coulomb_friction",)) is None
    assert earlier_of(assume(early, False)) is None and earlier_of(early.between(0.0, 0.8)) is None
    assert earlier_of(until(counted(electrical_time_constant=0.01))) == UNTIL
    assert earlier_of(counted(electrical_time_constant=0.01)) is None


@pytest.mark.parametrize(
    ("gain", "delay", "timing"),
    [(21.0, 0.49, OTHERS[2]), (19.0, 0.49, None), (21.0, 0.51, None), (0.0, 0.0, None)],
)
def test_every_limit_of_what_is_looked_for_behind_a_lag_decides(
    gain: float, delay: float, timing: Timing | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    shaper = cast(Shaper, SimpleNamespace(recordings=[assume(without_count(as_speed(counted())))], fit=fit_nothing))
    values = {ASSUMED: (0.0, 0.0), UNTIL: (18.0, 0.0), OTHERS[2]: (gain, delay)}
    readings = {one: SimpleNamespace(likelihood=gain, delay=late) for one, (gain, late) in values.items()}
    monkeypatch.setattr(module, "_fit_beside_torque", readings.__getitem__)
    assert find_held_behind_lag(shaper, ASSUMED) == timing


def fit_nothing(timing: Timing, beside: tuple[str, ...]) -> SimpleNamespace:
    assert beside == LAGGING
    return SimpleNamespace(estimate=timing)


@pytest.mark.parametrize(
    ("logged", "later", "gain", "rows", "told"),
    [
        (0.04, 0.0, 21.0, 500, True),
        (0.06, 0.0, 21.0, 500, False),
        (0.0, 0.49, 21.0, 500, True),
        (0.0, 0.51, 21.0, 500, False),
        (0.0, 0.0, 19.0, 500, False),
        (0.0, 0.0, 41.0, 2000, True),
        (0.0, 0.0, 39.0, 2000, False),
    ],
)
def test_every_limit_decides(
    logged: float, later: float, gain: float, rows: int, told: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    @dataclass
    class Reading:
        delay: float
        likelihood: float

    first = SimpleNamespace(problem=SimpleNamespace(sample_period=ROW))
    fitted = SimpleNamespace(delay=0.0, estimate=first)

    monkeypatch.setattr(module, "count_intervals", lambda estimate: rows)
    monkeypatch.setattr(module, "_read_later", lambda estimate: None)
    readings = {True: Reading(later, gain), False: Reading(logged, 0.0)}
    monkeypatch.setattr(module, "_fit_beside_torque", lambda estimate: readings[estimate is None])
    assert module.held_until(cast(Shaper, SimpleNamespace(fit=lambda timing: fitted))) == told
    beside_all = module.held_until(cast(Shaper, SimpleNamespace(fit=lambda timing: fitted)), complete=True)
    assert beside_all == (told or gain == 39.0)  # where nothing is left, so much is enough of any number of rows
    fitted.delay = 0.06 * ROW  # late, before any torque is looked at
    assert not module.held_until(cast(Shaper, SimpleNamespace(fit=lambda timing: fitted)))


def looped(before: bool, seed: int = 0) -> Recording:
    """A loop that holds speeds by counts, beside a random torque that it answers, in rows of 20 ms."""
    random = np.random.default_rng(seed)
    rows, fine, lag, size = 1500, 20, 0.1, 2.0 * np.pi / 2000
    wanted = np.repeat(random.uniform(-40.0, 40.0, rows // 50), 50)
    angle = speed = torque = old = 0.0
    samples = []
    applied = 0.0
    for k in range(rows):
        count = int(np.floor(angle / size))
        moved = (count - old) * size / ROW
        volts = float(np.clip(0.1 * (wanted[k] - moved) + 0.08 * wanted[k], -6.0, 6.0))
        samples.append(Sample(round(k * ROW * 1e9), moved, applied if before else volts, count))
        old, applied = count, volts
        for _ in range(fine):
            torque += 0.02 * (-torque) + 0.1 * 0.2 * random.standard_normal()
            speed += ROW / fine * ((volts + torque) / 0.1 - speed) / lag
            angle += ROW / fine * speed
    info = Info("loop", "import", Measurement.COUNTS, 2000, False, 0.0, ROW, max_voltage=6.0, voltage_assumed=True)
    return check(recording_of(samples, info, "loop"))


@pytest.mark.parametrize("seed", keep_fast([0, 1], 0))
def test_a_loop_that_answers_a_random_torque_is_not_answered_before(seed: int) -> None:
    assert timing_of(looped(before=False, seed=seed)) is None
    assert timing_of(looped(before=True, seed=seed)) == UNTIL


def test_a_timing_of_counts_is_that_of_their_voltages_alone() -> None:
    logged = counted()
    read = read_again(until(logged), UNTIL)
    assert read.voltage[:-1] == pytest.approx(logged.voltage[:-1])
    assert read.info == replace(logged.info, voltage_assumed=False)  # it is found
    assert "taken as those that held until their rows" in read.notes[-1]
    said = counted(assumed=False)
    assert read_again(said, UNTIL).voltage is said.voltage and read_again(said, UNTIL).notes == ()


@pytest.mark.slow
def test_a_fit_and_a_diagnosis_use_what_was_found() -> None:
    late = until(counted())
    fit = identify([late], Request(("coulomb_friction",)))
    for name, value in RUBBING.items():
        assert fit.parameters.values[name] == pytest.approx(value, rel=0.01)
    assert fit.timing == UNTIL and any("held until their rows" in note for note in fit.notes)
    found = diagnose([late])
    assert [one.effect for one in found.findings] == ["coulomb_friction"] and found.verdict is Verdict.EXPLAINED
    assert any("held until their rows" in note for note in found.model.notes)


@pytest.mark.parametrize(
    ("times", "gain", "error", "said"),
    [
        (1.06, 9.9, 0.0, True),
        (1.06, 0.0, 0.0, True),
        (0.94, 19.0, 0.0, True),
        (1.04, 0.0, 0.0, False),  # much the same
        (1.3, -9.9, 0.09, True),
        (1.3, -9.9, 0.11, False),  # as far as its standard error goes
        (1.3, -10.1, 0.0, False),  # the log tells
        (1.6, -19.9, 0.05, True),  # hardly, of quite another one
        (1.4, -19.9, 0.01, False),
        (1.6, -19.9, 0.07, False),
        (1.6, -20.1, 0.05, False),
    ],
)
def test_what_inertia_would_be_by_the_other_voltages_is_said_where_nothing_tells(
    times: float, gain: float, error: float, said: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was 43 % off, and 56 of its standard errors, without a word."""
    estimate, _ = search_globally(make_problem([counted()], ()), SearchConfig())
    ka = estimate.parameters.value("ka")
    other = SimpleNamespace(parameters=SimpleNamespace(value=lambda name: {"ka": times * ka}[name]))
    readings = iter([_Reading(estimate, NONE, 0.0), _Reading(cast(Estimate, other), NONE, gain)])
    monkeypatch.setattr(module, "_fit_beside_torque", lambda one: next(readings))
    notes = describe_untold(estimate, {"ka": error * ka})
    assert bool(notes) is said and all(("this log does not tell" in note) is (-10.0 <= gain <= 10.0) for note in notes)
    assert all(("this log hardly tells" in note) is (gain < -10.0) for note in notes)


def test_a_quick_motor_on_a_coarse_encoder_has_two_inertias_by_when_its_voltages_hold() -> None:
    """Whichever the log is read by, and right by the one that is true; one that was told, or is slow, has one."""
    drive = profiles.ramps(6.0, 8.0)
    fast = {"kv": 0.05, "ka": 0.001}
    recording, _ = record(fast, *drive, seed=0, edges=12, sample_rate=1.0 / ROW, single_channel=False)
    logged = assume(as_counts(recording))
    (note,) = list_untold(until(logged))
    assert float(note.split("ka would be ")[1].split()[0]) == pytest.approx(fast["ka"], rel=0.05)
    (note,) = list_untold(logged)
    assert float(note.split("instead of ")[1].split()[0]) == pytest.approx(fast["ka"], rel=0.05)
    assert list_untold(assume(as_counts(recording), False)) == [] and list_untold(counted()) == []


@pytest.mark.parametrize(("digits", "counts", "said"), [(9, 0, True), (2, 0, True), (0, 60, False), (0, 3000, True)])
def test_a_quick_motor_has_two_inertias_by_when_its_speeds_were_made(digits: int, counts: int, said: bool) -> None:
    """A converter's steps are as fine as no encoder's, or far finer than noise; 60 counts a turn are those of a row."""
    drive, fast = profiles.ramps(6.0, 2.0), {"kv": 0.05, "ka": 0.001}
    recording, truth = record(fast, *drive, seed=0, edges=960, sample_rate=1.0 / ROW, single_channel=False)
    noisy = truth.speed + 1.0 * np.random.default_rng(0).standard_normal(len(truth.speed))
    logged = replace(without_count(as_speed(recording)), speed=np.round(noisy, digits) if digits else noisy)
    if not digits:
        step = tau / counts / ROW
        logged = replace(logged, speed=step * np.round(noisy / step))
    untold = list_untold(assume(logged))
    notes = [note for note in untold if note.startswith("When speeds")]
    assert bool(notes) is said
    if said:
        assert "--speed-lag 0" in notes[0] and "--voltage-before" not in notes[0]
        assert float(notes[0].split("ka would be ")[1].split()[0]) == pytest.approx(fast["ka"], rel=0.05)
    others = [note for note in untold if note not in notes]
    assert len(others) == (counts == 60) and all("--voltage-before" in note for note in others)


@pytest.mark.parametrize(("counts", "option"), [(60, "(import_log --voltage-before)"), (0, "--speed-lag 0 --voltage")])
def test_a_quick_motor_has_two_inertias_by_when_the_voltages_of_speeds_held(counts: int, option: str) -> None:
    """A ka of speeds that were counted was 12 % off, and 9 of its standard errors, without a word; a filter's 30 %."""
    drive, fast = profiles.ramps(6.0, 2.0), {"kv": 0.05, "ka": 0.001}
    recording, truth = record(fast, *drive, seed=0, edges=960, sample_rate=1.0 / ROW, single_channel=False)
    logged = without_count(as_speed(recording))
    if counts:
        step = tau / counts / ROW
        logged = replace(logged, speed=step * np.round(logged.speed / step))
    else:
        noise = 1.0 * np.random.default_rng(0).standard_normal(len(truth.speed))
        logged = replace(logged, speed=truth.speed + noise)
    (note,) = [note for note in untold_of(until(assume(logged))) if option in note]
    assert float(note.split("ka would be ")[1].split()[0]) == pytest.approx(fast["ka"], rel=0.1)
    assert not any("--voltage-before" in note for note in list_untold(until(assume(logged, False))))


def test_what_is_said_of_two_readings_begins_with_the_value_that_a_user_is_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A table said a dead time of 1.23 ms, and the sentence below it 1.07 ms."""
    estimate, _ = search_globally(make_problem([counted()], ()), SearchConfig())
    ka = estimate.parameters.value("ka")
    values = (SimpleNamespace(parameters=SimpleNamespace(value=lambda name, t=t: t * ka)) for t in (0.9, 1.5))
    readings = iter([_Reading(cast(Estimate, one), NONE, 0.0) for one in values])
    monkeypatch.setattr(module, "_fit_beside_torque", lambda one: next(readings))
    (note,) = describe_untold(estimate, {"ka": 0.01 * ka})
    assert f"ka would be {1.5 * ka:.3g} instead of {ka:.3g}" in note


@pytest.mark.parametrize(("delay", "said"), [(0.012, True), (0.0, False)])
def test_a_dead_time_is_another_by_when_speeds_were_made(delay: float, said: bool) -> None:
    """It was half a row off, and 190 of its standard errors, of a slow motor's tachogenerator; the log cannot tell."""
    motor = {"ka": 0.01, "delay": delay} if delay else {"ka": 0.01}
    logged = make_converted(*profiles.reversals(6.0), sigma=0.1, **motor)
    fit = identify([logged], Request(("transport_delay",) if delay else ()))
    notes = [note for note in fit.notes if "delay would be" in note]
    assert bool(notes) is said
    if said:
        theirs, ours = (float(notes[0].split(word)[1].split()[0]) for word in ("delay would be ", "instead of "))
        assert theirs == pytest.approx(delay, abs=5e-4)
        assert ours == pytest.approx(fit.parameters.value("delay"), rel=1e-2)
        assert ours == pytest.approx(delay - 0.5 * ROW, abs=5e-4)


def make_converted(*drive: Floats, sigma: float = 1.0, **motor: float) -> Recording:
    """Speeds of a converter, of rows that are as long as a quick motor's time constant."""
    exact = {"edges": 960, "sample_rate": 1.0 / ROW, "single_channel": False}
    recording, truth = record({"kv": 0.05, "ka": 0.001} | motor, *drive, **exact)  # type: ignore[arg-type]
    noise = sigma * np.random.default_rng(0).standard_normal(len(truth.speed))
    return assume(replace(without_count(as_speed(recording)), speed=truth.speed + noise))


@pytest.mark.parametrize("seconds", keep_fast([2.0, 30.0], 2.0))
def test_a_diagnosis_compares_the_same_rows_by_both_readings(seconds: float) -> None:
    """Those that were held out, and those that were joined in a long log, were in one of them: nothing was said."""
    drive = profiles.joined(*[profiles.ramps(6.0, seconds)] * 4)
    found = diagnose([make_converted(*drive, ks=0.4)])
    assert any("ka would be" in note for note in found.model.notes)


def test_both_readings_are_fitted_on_the_measured_angle(monkeypatch: pytest.MonkeyPatch) -> None:
    read = list[Estimate]()
    monkeypatch.setattr(module, "_compare", lambda here, there, *_: read.extend([here, there]) or [])
    identify([make_converted(*profiles.ramps(6.0, 4.0))], Request(("torque_ripple",)))
    assert len(read) >= 2 and read[0].problem.tracks != ()
    assert all(one.problem.tracks == read[0].problem.tracks for one in read)


def untold_of(recording: Recording) -> list[str]:
    """What is said of a fit by the assumed timing."""
    estimate, _ = search_globally(make_problem([recording], ()), SearchConfig())
    return describe_untold(estimate, {"ka": 0.01 * estimate.parameters.value("ka")})


def list_untold(recording: Recording) -> list[str]:
    return [note for note in identify([recording], Request()).notes if "ka would be" in note]
