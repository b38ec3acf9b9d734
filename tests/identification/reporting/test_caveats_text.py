"""What the numbers of a diagnosis are beside, or depend on, is said with them."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosed import BASE
from plant import profiles, record

from motor_identification.diagnosis.evidence.command_evidence import Stopped
from motor_identification.diagnosis.result import Diagnosis, Nearest, Verdict
from motor_identification.discrepancy.structure import Structure
from motor_identification.estimation.problem import make_problem
from motor_identification.measurement.intervals import index_intervals
from motor_identification.noise.error_model import Disturbance
from motor_identification.recording import check
from motor_identification.reporting import caveats_text
from motor_identification.reporting.caveats_text import MUCH, describe_cut
from motor_identification.reporting.diagnosis_text import summarize_diagnosis
from motor_model.sample import Measurement


def test_a_random_torque_is_said_with_its_strength(variants: dict[Verdict, Diagnosis]) -> None:
    torque = Disturbance(0.1503, 0.0042, 0.0512, 0.0031)
    for verdict in (Verdict.EXPLAINED, Verdict.NOTHING_MISSING, Verdict.UNDECIDED):
        said = summarize_diagnosis(replace(variants[verdict], disturbance=torque))
        assert "The rest is random: a torque of 0.1503 ± 0.0042 V RMS, correlated over 0.0512 ± 0.0031 s." in said
        assert "random" not in summarize_diagnosis(replace(variants[verdict], disturbance=None))


def test_what_is_left_of_steady_states_has_no_time(variants: dict[Verdict, Diagnosis]) -> None:
    """Rows of a static curve, each a stair of 20 s, were off by a torque that was "correlated over 110 s"."""
    one = replace(variants[Verdict.EXPLAINED], disturbance=Disturbance(0.1503, 0.0042, 110.0, 31.0))
    assert "correlated over 110 ± 31 s" in summarize_diagnosis(one)
    info = replace(one.after.recordings[0].info, sample_period=20.0, speed_window=1.0, measurement=Measurement.SPEED)
    states = tuple(replace(recording, info=info) for recording in one.after.recordings)
    said = summarize_diagnosis(replace(one, after=replace(one.after, recordings=states)))
    assert "The rest is random: 0.1503 ± 0.0042 V RMS from state to state." in said and "correlated" not in said


@pytest.mark.parametrize(("error", "rows", "apart"), [(0.09, 0.2, True), (0.11, 0.2, False), (0.11, 1.2, True)])
def test_a_torque_that_lasts_for_less_than_a_row_is_told_by_its_mean_over_one(
    variants: dict[Verdict, Diagnosis], error: float, rows: float, apart: bool
) -> None:
    """Of an independent simulator's motor without any it was "0.06 ± 0.23 V RMS, correlated over 0.0004 ± 0.0027 s"."""
    one = variants[Verdict.EXPLAINED]
    row = min(recording.sample_period for recording in one.after.recordings)
    text = summarize_diagnosis(replace(one, disturbance=Disturbance(0.1, error, rows * row, 0.1)))
    assert ("a torque of 0.1" in text) is apart
    mean = 0.1 * np.sqrt(2.0 / 5.0 * (1.0 - (1.0 - np.exp(-5.0)) / 5.0))  # of what decays five times over a row
    assert (
        f"less than a row ({row:.3g} s), of which strength and correlation time do not show apart" in text
    ) is not apart
    assert (f"its mean over a row is {mean:.2g} V RMS." in text) is not apart
    assert "rather noise of the sensor" not in text


@pytest.mark.parametrize(("share", "doubted"), [(0.9, False), (1.1, True)])
def test_a_torque_within_a_row_whose_mean_is_no_trifle_is_doubted(
    variants: dict[Verdict, Diagnosis], share: float, doubted: bool
) -> None:
    one = variants[Verdict.EXPLAINED]
    row = min(recording.sample_period for recording in one.after.recordings)
    largest = max(float(np.abs(recording.voltage).max()) for recording in one.after.recordings)
    mean = np.sqrt(2.0 / 5.0 * (1.0 - (1.0 - np.exp(-5.0)) / 5.0))
    rms = share * MUCH * largest / mean
    text = summarize_diagnosis(replace(one, disturbance=Disturbance(rms, 2.0 * rms, 0.2 * row, row)))
    assert ("rather noise of the sensor" in text) is doubted


def beside_torque(one: Diagnosis, share: float, rows: float) -> str:
    """What is said of a torque of a share of the largest voltage that lasts for so many rows."""
    largest = max(float(np.abs(recording.voltage).max()) for recording in one.after.recordings)
    row = min(recording.sample_period for recording in one.after.recordings)
    return summarize_diagnosis(replace(one, disturbance=Disturbance(share * largest, 0.001, rows * row, 1e-6)))


@pytest.mark.parametrize(("share", "said"), [(1.05, True), (0.95, False)])
def test_a_torque_above_all_that_was_applied_is_none(
    variants: dict[Verdict, Diagnosis], share: float, said: bool
) -> None:
    """Of a motor on 9 V the rest was said to be a torque of 15.6 V RMS, of a position that was a speed one of 76 V."""
    one = variants[Verdict.UNDECIDED]
    largest = max(float(np.abs(recording.voltage).max()) for recording in one.after.recordings)
    text = summarize_diagnosis(replace(one, disturbance=Disturbance(share * largest, 0.1, 0.002, 0.001)))
    assert "The rest is random" in text
    assert (f"That is more than the {largest:.3g} V that was applied: rather noise of the sensor" in text) is said


@pytest.mark.parametrize(("share", "said"), [(0.49, False), (0.51, True), (0.97, True), (1.05, False)])
def test_beside_a_torque_of_half_the_voltage_something_else_drove_the_motor(
    variants: dict[Verdict, Diagnosis], share: float, said: bool
) -> None:
    """A log said -4 V all the time, under which a robot's wheel stopped: "a torque of 3.88 V RMS", and no more."""
    one = variants[Verdict.UNDECIDED]
    largest = max(float(np.abs(recording.voltage).max()) for recording in one.after.recordings)
    large = replace(one, disturbance=Disturbance(share * largest, 0.1, 0.2, 0.1))
    words = f"That is {100.0 * share:.0f} % of the {largest:.3g} V that was applied at most"
    cause = "the voltage that was logged is probably not what drove the motor."
    assert (f"{words}: {cause}" in summarize_diagnosis(large)) is said
    driven = tuple(replace(one, voltage=np.full(len(one), largest)) for one in large.after.recordings)
    for part, longer in ((0.88, True), (0.92, False)):  # of the time, in which it turns at all
        shares = [np.cumsum(data.duration) / data.duration.sum() for data in large.after.intervals]
        speeds = [np.where(share < part, 9.0, 0.1) for share in shares]
        rows = zip(large.after.intervals, speeds, strict=True)
        stopped = replace(large.after, recordings=driven, intervals=tuple(replace(d, speed=v) for d, v in rows))
        text = summarize_diagnosis(replace(large, after=stopped))
        assert (f"{words}, under half of which and more it stood for " in text) is (said and longer)
        assert (cause in text) is said


@pytest.mark.parametrize(
    ("share", "rows", "said"),
    [(0.049, 2.0, False), (0.051, 2.0, True), (0.49, 2.0, True), (0.51, 2.0, False), (0.1, 0.9, False)],
)
def test_a_torque_that_is_large_for_one_may_hold_what_is_not_in_the_table(
    variants: dict[Verdict, Diagnosis], share: float, rows: float, said: bool
) -> None:
    """A play of gears was a torque of 11 % of the supply, and a limit of the voltage "explained" the rest."""
    text = beside_torque(variants[Verdict.UNDECIDED], share, rows)
    words = f"That is {100.0 * share:.2g} % of the voltage that was applied at most, and more than gears and loads make"
    assert (words in text) is said


@pytest.mark.parametrize(
    ("share", "rows", "said"), [(0.12, 0.99, True), (0.12, 1.01, False), (0.021, 0.5, True), (0.019, 0.5, False)]
)
def test_a_torque_that_lasts_for_less_than_a_row_is_rather_noise(
    variants: dict[Verdict, Diagnosis], share: float, rows: float, said: bool
) -> None:
    """Stamps of whole milliseconds at 1 kHz were "a torque of 5.9 V RMS, correlated over 0.6 ms", of 48 V."""
    text = beside_torque(variants[Verdict.UNDECIDED], share, rows)
    assert "The rest is random" in text
    assert (f"less than a row and is {100.0 * share:.2g} % of the voltage that was applied" in text) is said


@pytest.mark.parametrize(("share", "gap", "none"), [(9e-5, 5.0, True), (1.1e-4, 5.0, False), (9e-5, 1.0, False)])
def test_a_torque_that_leaves_nothing_is_not_what_is_left(
    variants: dict[Verdict, Diagnosis], share: float, gap: float, none: bool
) -> None:
    """Steps whose starts were late by another time each left 5.7 times the floor, 'a torque of 7.193e-07 V RMS'."""
    one = variants[Verdict.EXPLAINED]
    largest = max(float(np.abs(recording.voltage).max()) for recording in one.after.recordings)
    torque = Disturbance(share * largest, 1e-6, 0.3, 0.1)
    text = summarize_diagnosis(replace(one, disturbance=torque, gap_after=gap * one.noise_floor))
    assert ("What is left is no random torque: none is found beside it" in text) is none
    assert ("The rest is random" in text) is not none
    unsure = replace(torque, rms_error=1.01 * torque.rms_voltage)
    text = summarize_diagnosis(replace(one, disturbance=unsure, gap_after=gap * one.noise_floor))
    assert ("The rest is random" in text) is (share > 1e-4)  # else the sensor leaves it


@pytest.mark.parametrize("verdict", list(Verdict))
@pytest.mark.parametrize(
    ("values", "off", "gap", "said"),
    [(2, 30.0, 5.0, True), (2, 30.0, 1.0, False), (2, 3.0, 5.0, False), (6, 30.0, 5.0, False)],
    ids=["few", "at the floor", "in all", "many"],
)
def test_a_gap_in_few_values_is_said_to_be_there(
    variants: dict[Verdict, Diagnosis], verdict: Verdict, values: int, off: float, gap: float, said: bool
) -> None:
    """Four late rows of 650 left eleven times the floor of a real motor, and 'the rest is random' alone was said."""
    start = np.arange(100.0)
    speed = 9.0 + np.where(np.arange(100) % 7 == 0, 1.0, -1.0)
    speed[10 : 10 + values] += off
    data = index_intervals(start, start + 1.0, speed, np.full(100, 0.1))
    one = variants[verdict]
    held = replace(one.after, intervals=(data,), angles=(9.0 * np.arange(101.0),), instants=(), responses=())
    held = replace(held, recordings=held.recordings[:1], scored=(np.ones(100, dtype=bool),))
    left = (Structure("spectrum", 0.41, 90.0),)  # what curves find of few values is those
    text = summarize_diagnosis(replace(one, after=held, gap_after=gap * one.noise_floor, structure=left))
    assert ("Most of that gap is in 2 of 100 values (11 s and 12 s): 1 rad/s is left without" in text) is said
    assert ("Most of that gap" in text) is said
    assert ("can be predicted from the time" in text) is (verdict is Verdict.UNEXPLAINED and not said)


def test_one_value_that_is_off_is_named_alone_and_not_the_next_worst(variants: dict[Verdict, Diagnosis]) -> None:
    speed = 9.0 + np.where(np.arange(100) % 7 == 0, 1.0, -1.0)
    speed[40], speed[5] = 99.0, 12.0
    data = index_intervals(np.arange(100.0), np.arange(1.0, 101.0), speed, np.full(100, 0.1))
    one = variants[Verdict.EXPLAINED]
    held = replace(one.after, intervals=(data,), angles=(9.0 * np.arange(101.0),), instants=(), responses=())
    held = replace(held, recordings=held.recordings[:1], scored=(np.ones(100, dtype=bool),))
    text = summarize_diagnosis(replace(one, after=held, gap_after=9.0 * one.noise_floor))
    assert "Most of that gap is in 1 of 100 values (41 s): 1.04 rad/s is left without" in text


@pytest.mark.parametrize(("error", "said"), [(0.44, True), (0.46, False)])
def test_a_breakaway_beside_a_random_torque_may_be_larger(
    variants: dict[Verdict, Diagnosis], error: float, said: bool
) -> None:
    """An independent simulator's motors held 0.84 and 0.22 V where 0.644 ± 0.031 and 0.131 ± 0.016 V were told."""
    one, torque = variants[Verdict.EXPLAINED], Disturbance(0.15, 0.004, 0.05, 0.003)
    held = replace(one.findings[0], effect="static_friction", parameters={"breakaway_voltage": (0.6, error)})
    text = summarize_diagnosis(replace(one, findings=(held,), disturbance=torque))
    assert ("breakaway_voltage may be larger by 0.45 V or so" in text) is said
    assert "breaks away" not in summarize_diagnosis(replace(one, disturbance=torque))
    assert "breaks away" not in summarize_diagnosis(replace(one, findings=(held,), disturbance=None))


@pytest.mark.parametrize(("rows", "said"), [(1.01, True), (0.99, False)])
def test_a_torque_that_lasts_for_less_than_a_row_holds_no_motor_at_its_peaks(
    variants: dict[Verdict, Diagnosis], rows: float, said: bool
) -> None:
    """Beside a breakaway of 1.207 ± 0.021 V, of 1.2 V, which noise of 0.214 V over 3 ms made "larger by 0.64 V"."""
    one = variants[Verdict.EXPLAINED]
    row = min(recording.sample_period for recording in one.after.recordings)
    held = replace(one.findings[0], effect="static_friction", parameters={"breakaway_voltage": (1.207, 0.021)})
    torque = Disturbance(0.214, 0.043, rows * row, 0.1 * row)
    text = summarize_diagnosis(replace(one, findings=(held,), disturbance=torque))
    assert ("breakaway_voltage may be larger by 0.64 V or so" in text) is said


@pytest.mark.parametrize(
    ("effect", "least", "levels", "said"),
    [
        ("static_friction", 1.5, [4.0, 1.0, 4.0, -1.0, -4.0], True),
        ("static_friction", 0.0, [4.0, 1.0, 4.0, -1.0, -4.0], False),  # it runs on at 1 V, with its friction of 0.4 V
        ("static_friction", 1.5, [4.0, 2.0, 4.0, -2.0, -4.0], False),  # no voltage tells
        ("coulomb_friction", 1.5, [4.0, 1.0, 4.0, -1.0, -4.0], False),
    ],
)
def test_a_breakaway_may_be_a_voltage_that_firmware_does_not_put_out(
    variants: dict[Verdict, Diagnosis], effect: str, least: float, levels: list[float], said: bool
) -> None:
    """Firmware that put out nothing below 1.5 V was named a static friction of 1.03 ± 0.17 V, and nothing else."""
    one = variants[Verdict.EXPLAINED]
    time, volts = profiles.pieces(levels, 0.6)
    motion = record(BASE | {"ks": 0.4}, time, np.where(np.abs(volts) < least, 0.0, volts), seed=1)[0]
    recording = replace(check(motion), voltage=volts)
    after = replace(one.after, recordings=(recording,), intervals=make_problem([recording], ()).intervals)
    parameters = {"breakaway_voltage": (1.4, 0.1)} if effect == "static_friction" else {}
    found = replace(one.findings[0], effect=effect, parameters=parameters)
    assert ("below 1.4 V or so: firmware" in describe_cut(replace(one, findings=(found,), after=after))) is said


@pytest.mark.parametrize("source", ["import", "hardware"])
@pytest.mark.parametrize(
    ("effect", "rivals", "of_supply"),
    [
        ("coast_drive", (), True),
        ("supply_sag", (), True),
        ("dead_zone", ("coast_drive",), True),
        ("dead_zone", (), False),
    ],
)
def test_the_supply_that_a_log_does_not_tell_is_said_where_it_matters(
    variants: dict[Verdict, Diagnosis], source: str, effect: str, rivals: tuple[str, ...], of_supply: bool
) -> None:
    one = variants[Verdict.EXPLAINED]
    (found,) = one.findings
    told = [replace(r, info=replace(r.info, source=source, max_voltage=9.6)) for r in one.after.recordings]
    after = replace(one.after, recordings=tuple(told))
    said = summarize_diagnosis(
        replace(one, findings=(replace(found, effect=effect, ambiguous_with=rivals),), after=after)
    )
    assert ("A supply of 9.6 V is assumed" in said) is (of_supply and source == "import")
    assert ("magnets saturate weakens with the current" in said) is (effect == "supply_sag")
    assert ("brakes a motor that coasts, too" in said) is (effect == "coast_drive")


@pytest.mark.parametrize("verdict", list(Verdict))
def test_a_motor_that_was_switched_off_is_said_whatever_the_verdict(
    monkeypatch: pytest.MonkeyPatch, variants: dict[Verdict, Diagnosis], verdict: Verdict
) -> None:
    one, said = variants[verdict], "the motor stands under voltages that moved it before: switched off, blocked"
    (recording,) = one.after.recordings
    assert said not in summarize_diagnosis(one)
    stopped = Stopped(replace(recording, uri="logs/right"), 45.014)
    monkeypatch.setattr(caveats_text, "find_stopped", lambda recordings: stopped)
    text = summarize_diagnosis(one)
    assert text.startswith(f"From 45.01 s on {said}") and "Leave that part out (--stop 45.01)." in text
    two = caveats_text.describe_stopped(replace(one, after=replace(one.after, recordings=(recording, recording))))
    assert two.startswith(f"From 45.01 s on in right {said}") and "out (--stop 45.01, of right alone)." in two
    slash = Stopped(replace(recording, uri="logs/right/"), 45.014)  # as a shell completes a directory's name
    monkeypatch.setattr(caveats_text, "find_stopped", lambda recordings: slash)
    assert two == caveats_text.describe_stopped(replace(one, after=replace(one.after, recordings=(recording,) * 2)))


@pytest.mark.parametrize(
    ("source", "nearest", "said"),
    [
        ("import", ("dead_zone", "coast_drive"), True),
        ("import", ("dead_zone",), False),
        ("", ("coast_drive",), False),
        ("import", (), False),
    ],
)
def test_another_supply_may_explain_what_comes_nearest_by_it(
    variants: dict[Verdict, Diagnosis], source: str, nearest: tuple[str, ...], said: bool
) -> None:
    """A coasting bridge on 5 V was outside of the table on 4.66 V, the most that its log had of them."""
    one = variants[Verdict.UNEXPLAINED]
    told = [replace(r, info=replace(r.info, source=source, max_voltage=4.66)) for r in one.after.recordings]
    after, near = replace(one.after, recordings=tuple(told)), Nearest(nearest, 11.2) if nearest else None
    text = summarize_diagnosis(replace(one, after=after, nearest=near))
    assert ("A supply of 4.66 V is assumed" in text) is said
    assert ("(import_log --max-voltage) coast drive may explain what is missing." in text) is said


@pytest.mark.parametrize("logged", [True, False])
def test_a_supply_of_a_column_is_said_to_be_its_median(variants: dict[Verdict, Diagnosis], logged: bool) -> None:
    """Of a duty beside a battery of 12 V, "A supply of 9.798 V is assumed", the most that the duty had come to."""
    one = variants[Verdict.EXPLAINED]
    told = [
        replace(
            r,
            info=replace(r.info, source="import", max_voltage=12.0),
            supply_voltage=np.full(len(r), 12.0 if logged else np.nan),
        )
        for r in one.after.recordings
    ]
    after = replace(one.after, recordings=tuple(told))
    said = summarize_diagnosis(replace(one, findings=(replace(one.findings[0], effect="coast_drive"),), after=after))
    assert ("A supply of 12 V is taken, the supply column's median unless" in said) is logged
    assert ("A supply of 12 V is assumed, the most that was applied" in said) is not logged


@pytest.mark.parametrize(
    ("levels", "shared"),
    [
        ((3.0, 6.0, 9.0), False),
        ((3.0, -3.0), False),  # one way and the other: a bridge may differ
        ((3.0, 6.0, 3.1), True),
        ((6.0,), False),
    ],
)
def test_gains_of_runs_at_voltages_of_their_own_may_be_a_curve(
    variants: dict[Verdict, Diagnosis], levels: tuple[float, ...], shared: bool
) -> None:
    """Steps of one level each, every run another, were said to differ at the same voltage, which none of them had."""
    one = replace(variants[Verdict.NOTHING_MISSING], gain_scatter=0.076)
    base = one.after.recordings[0]
    first = np.arange(len(base)) < len(base) // 4
    runs = [replace(base, voltage=np.where(first, 0.002, level)) for level in levels]  # a duty of 1 at rest
    said = summarize_diagnosis(replace(one, after=replace(one.after, recordings=tuple(runs))))
    assert ("the speed at the same voltage differed by 7.6 % (RMS)" in said) is shared
    assert ("but no two runs were at the same voltage" in said) is not shared
    swings = [
        replace(base, voltage=np.where(first, 0.0, level * np.linspace(-1.0, 1.0, len(base)))) for level in levels
    ]
    said = summarize_diagnosis(replace(one, after=replace(one.after, recordings=tuple(swings))))
    assert ("the speed at the same voltage differed" in said) is (len(levels) > 1)
