"""The motion column: the size of a count where it is said, seen or contradicted, and speeds out of counts."""

from dataclasses import replace
from fractions import Fraction
from math import pi, radians, tau
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs import motion as motion_module
from motor_identification.logs.count_size import FINE, MOST_EDGES
from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.motion import Motion, read_motion
from motor_identification.logs.position_lattice import position_step
from motor_identification.logs.signals import Signals
from motor_model.errors import RecordingError
from motor_model.sample import Info, Measurement

SPEED = CsvForm("t", "u", "y", Kind.SPEED, "rad/s")
DEGREES = CsvForm("t", "u", "y", Kind.POSITION, "deg")
RAMP = [3.6 * k for k in range(12)]  # one slot of 100 a row


def read(form: CsvForm, values: list[float]) -> Motion:
    count = len(values)
    unknown, time = np.full(count, np.nan), np.arange(count, dtype=np.int64) * 20_000_000
    volts, lines = np.full(count, 6.0), np.arange(2, count + 2)
    runs = {"": slice(0, count)}
    signals = Signals(Path("log.csv"), lines, time, volts, np.array(values), unknown, unknown, runs)
    return read_motion(form, Info(sample_period=0.02), signals)


def test_positions_become_counts_and_their_difference_quotient() -> None:
    motion = read(replace(DEGREES, edges_per_revolution=100), RAMP)
    assert motion.counts.tolist() == list(range(12))
    assert motion.speed == pytest.approx(np.full(12, tau / 100 / 0.02))
    assert (motion.info.measurement, motion.info.edges_per_revolution) == (Measurement.COUNTS, 100)


def test_the_size_of_a_count_is_the_smallest_step_where_nobody_said_it() -> None:
    motion = read(DEGREES, RAMP)
    assert motion.info.edges_per_revolution == 100 and "the smallest step in the data" in motion.findings[0]
    smooth = read(DEGREES, [k**1.37 for k in range(12)])
    assert FINE[0] <= smooth.info.edges_per_revolution <= FINE[1] and "show no steps" in smooth.findings[0]
    assert position_step(np.array(RAMP[:9])) == 0.0 < position_step(np.array(RAMP[:10]))  # too few to tell


def test_a_step_that_is_no_share_of_a_turn_is_the_count() -> None:
    motion = read(DEGREES, [round(3.515625 * k, 2) for k in range(30)])
    said = "one count is 3.51562 deg, 102.4 per revolution (assumed: values are multiples of it)."
    assert motion.findings[0].endswith(said) and not any("Caution" in line for line in motion.findings)
    assert motion.counts.tolist() == list(range(30))
    assert (motion.info.edges_per_revolution, motion.info.gear) == (102, Fraction(256, 255))
    assert motion.speed == pytest.approx(np.full(30, radians(3.515625) / 0.02), rel=1e-12)


def test_counts_beyond_what_can_be_counted_are_refused() -> None:
    with pytest.raises(RecordingError, match="y comes to 1e.300 counts, beyond what can be counted"):
        read(replace(DEGREES, unit="count", edges_per_revolution=360), [0.0, 1.0, 1e300])
    assert MOST_EDGES < 2**32  # what motor/info can say
    with pytest.raises(RecordingError, match="more than any encoder has"):
        read(replace(DEGREES, count_quantum=1e-9), RAMP)


def test_metres_need_to_be_told_how_far_a_turn_goes() -> None:
    metres = replace(SPEED, unit="m/s")
    with pytest.raises(RecordingError, match="how far a turn goes .--units-per-revolution"):
        read(metres, [1.0, 2.0])
    assert read(replace(metres, units_per_revolution=0.5), [1.0, 2.0]).speed == pytest.approx([2 * tau, 4 * tau])
    inch, foot = 0.0254, 0.3048  # [m]
    lengths = [("in/s", 0.5 / inch, 1.0 / inch), ("ft/s", 0.5 / foot, 1.0 / foot)]
    lengths += [("cm/s", 50.0, 100.0), ("mm/s", 500.0, 1000.0), ("km/h", 0.5, 3.6)]
    for unit, turn, speed in lengths:  # all are 1 m/s
        same = replace(metres, unit=unit, units_per_revolution=turn)
        assert read(same, [speed, 2 * speed]).speed == pytest.approx([2 * tau, 4 * tau])


def test_a_count_that_does_not_divide_a_turn_is_refused() -> None:
    assert read(replace(DEGREES, count_quantum=3.6003), RAMP).info.edges_per_revolution == 100  # 0.8e-4 off
    with pytest.raises(RecordingError, match=r"The counts come to 99\.9\d+ per revolution, not a whole number"):
        read(replace(DEGREES, count_quantum=3.6005), RAMP)  # 1.4e-4
    with pytest.raises(RecordingError, match="not 96"):
        read(replace(DEGREES, count_quantum=3.6, edges_per_revolution=96), RAMP)


def test_positions_beside_whole_counts_are_told() -> None:
    form = replace(DEGREES, edges_per_revolution=100)
    on, off = ([value + 3.6 * share * (k % 2) for k, value in enumerate(RAMP)] for share in (0.04, 0.06))
    assert len(read(form, on).findings) == 2
    assert "Caution: values are up to 0.06 counts off" in read(form, off).findings[2]


def test_counts_need_to_be_told_how_many_there_are_in_a_turn() -> None:
    counts = CsvForm("t", "u", "y", Kind.COUNT, "count")
    with pytest.raises(RecordingError, match="The size of a count is unknown: give --edges-per-revolution"):
        read(counts, [0.0, 1.0, 2.0])
    assert read(replace(counts, edges_per_revolution=12), [0.0, 1.0, 2.0]).speed[1] == pytest.approx(tau / 12 / 0.02)


def test_a_counter_that_begins_again_and_again_is_refused_with_its_line() -> None:
    """Unless the motor goes on meanwhile: then it wraps."""
    counts = CsvForm("t", "u", "y", Kind.COUNT, "count", edges_per_revolution=100)
    begun = [0.0, *[float(10 * k) for k in range(19)]] * 3
    with pytest.raises(RecordingError, match=r"line 42: y jumps from 180 to 0, and not for the first time"):
        read(counts, begun)
    assert read(counts, [float(10 * k % 190) for k in range(60)]).counts[-1] == 590


def test_speeds_say_what_they_are_the_mean_of() -> None:
    motion = read(SPEED, [1.0, 2.0, 4.0])
    assert motion.speed.tolist() == [1.0, 2.0, 4.0] and motion.counts.tolist() == [0, 0, 0]
    assert (motion.info.speed_window, motion.info.speed_lag, motion.info.edges_per_revolution) == (0.02, 0.01, 0)
    said = read(replace(SPEED, speed_window=0.1, speed_lag=0.02, edges_per_revolution=100), [1.0, 2.0, 4.0])
    assert (said.info.speed_window, said.info.speed_lag, said.info.edges_per_revolution) == (0.1, 0.02, 100)
    assert read(replace(SPEED, unit="rpm"), [60.0, 30.0]).speed == pytest.approx([tau, pi])


@pytest.mark.parametrize(("typical", "coarse"), [(1.0, True), (40.0, False)])
def test_speeds_of_a_few_last_digits_are_said_to_be_too_coarse(typical: float, coarse: bool) -> None:
    rows = np.arange(300)
    values = np.rint(typical + 0.6 * np.maximum(typical, 1.0) * np.sin(rows / 30.0) + 0.4 * np.sin(7.0 * rows))
    *_, said = read(SPEED, values.tolist()).findings
    assert said.startswith("Speeds are multiples of 1 rad/s, too coarse to tell much") == coarse
    assert said.startswith("Speeds show no counts: noise") != coarse and "is assumed (otherwise: --edges" in said


@pytest.mark.parametrize(("rows", "window"), [(1, None), (5, None), (5, 0.02)])
def test_counts_are_those_of_the_time_for_which_a_value_is_held(rows: int, window: float | None) -> None:
    """A bus of 1 ms in rows of 0.2 ms said 40,960 counts a turn here, and 8,192 in a diagnosis."""
    counts = np.rint(30.0 + 25.0 * np.sin(np.arange(200) / 9.0) + 3.0 * np.sin(np.arange(200) * 2.3))
    values = np.repeat(counts * tau / 96 / (0.02 * rows), rows)
    *_, said = read(replace(SPEED, speed_window=window), values.tolist()).findings
    held = rows > 1 and window is None
    assert f"if the encoder has {96 if held or rows == 1 else 96 * rows} per revolution (assumed" in said
    assert ("a new one every 100 ms: one count within that if" in said) == held


def test_running_means_of_counts_are_taken_back_to_single_rows() -> None:
    """Whose counts share no error with each other; a window that is said stays."""
    angles = np.cumsum(np.where(np.arange(3000) < 100, 0.0, 6.3 + 4.0 * np.sin(np.arange(3000) / 70.0)))
    single = np.diff(np.floor(angles), prepend=0.0) * tau / 100 / 0.02
    means = np.convolve(single, np.full(10, 0.1))[:3000].tolist()
    motion = read(SPEED, means)
    assert motion.speed == pytest.approx(single, abs=1e-9)
    assert (motion.info.speed_window, motion.info.speed_lag) == (0.02, 0.01)
    assert any(line.startswith("Speeds are running means of 10 rows, as their counts") for line in motion.findings)
    assert read(replace(SPEED, speed_window=0.2), means).speed.tolist() == means


@pytest.mark.parametrize(("gain", "taken"), [(3.1, True), (2.9, False)])
def test_counts_that_are_less_likely_as_means_are_those_of_their_rows(
    gain: float, taken: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """75 rows of plain counts were taken for means of two, and a friction was named that there was not."""
    monkeypatch.setattr(motion_module, "measure_gain_of_mean", lambda *_: gain)
    angles = np.cumsum(np.where(np.arange(900) < 50, 0.0, 6.3 + 4.0 * np.sin(np.arange(900) / 30.0)))
    means = np.convolve(np.diff(np.floor(angles), prepend=0.0), np.full(4, 0.25))[:900] * tau / 100 / 0.02
    assert any(line.startswith("Speeds are running means") for line in read(SPEED, means.tolist()).findings) is taken


@pytest.mark.parametrize("digits", [9, 1])
def test_single_rows_of_few_counts_are_an_angle(digits: int) -> None:
    """Rounded speeds give it too: a speed of one count, or none, is little but rounding, and the angle is exact."""
    angles = np.cumsum(np.where(np.arange(3000) < 100, 0.0, 0.4 + 0.2 * np.sin(np.arange(3000) / 70.0)))
    counts = np.floor(angles)
    means = np.convolve(np.diff(counts, prepend=0.0) / 48.4 / 0.02, np.full(32, 1.0 / 32.0))[:3000]
    motion = read(replace(SPEED, unit="rpm"), np.round(60.0 * means, digits).tolist())
    assert motion.counts.tolist() == counts.tolist() and motion.info.measurement is Measurement.COUNTS
    assert motion.info.edges_per_revolution == 48
    assert float(motion.info.edges_per_revolution * motion.info.gear) == pytest.approx(48.4, rel=3e-4)
    assert motion.findings[0].startswith("Speeds are running means of 32 rows") and "48.4" in motion.findings[1]
    said = read(replace(SPEED, unit="rpm", edges_per_revolution=48), np.round(60.0 * means, digits).tolist())
    assert (said.counts.tolist(), said.info.edges_per_revolution) == (counts.tolist(), 48)
    assert said.info.gear == 1


def test_how_many_counts_a_row_are_few() -> None:
    for counts, kind in ((3.4, Measurement.COUNTS), (4.6, Measurement.SPEED)):
        angles = np.cumsum(np.where(np.arange(3000) < 100, 0.0, counts + 0.3 * np.sin(np.arange(3000) / 70.0)))
        single = np.diff(np.floor(angles), prepend=0.0) * tau / 100 / 0.02
        assert read(SPEED, np.convolve(single, np.full(10, 0.1))[:3000].tolist()).info.measurement is kind


@pytest.mark.parametrize(("factor", "refused"), [(1.0, False), (5.0, False), (0.2, False), (6.0, True), (0.15, True)])
def test_steps_of_speeds_that_are_no_counts_show_a_mistaken_unit(factor: float, refused: bool) -> None:
    one = tau / 100 / 0.02  # [rad/s] a count within 20 ms
    values = [factor * one * k for k in range(12)]
    form = replace(SPEED, edges_per_revolution=100)
    if refused:
        with pytest.raises(RecordingError, match="check --unit, --edges-per-revolution and --speed-window"):
            read(form, values)
    else:
        assert len(read(form, values).speed) == 12


@pytest.mark.parametrize(
    ("unit", "digit", "refused"),
    [
        (tau / 360, 1.0, False),
        (1.0, 0.01, False),
        (tau / 360, tau / 100 / 0.02 / (tau / 360) / 57.3, True),
        (1.0, 0.1, True),
    ],
    ids=["whole degrees a second", "hundredths of rad/s", "a count in another unit", "a tenth of said counts"],
)
def test_digits_of_speeds_that_were_smoothed_are_no_mistaken_unit(unit: float, digit: float, refused: bool) -> None:
    """Whoever knew his counts had his log refused: one of whole degrees a second, 44 times finer than a count.

    Of a unit that makes a count too large, speeds are few counts, whatever the last digit hides of them.
    """
    form = replace(SPEED, unit="deg/s" if unit < 1.0 else "rad/s", edges_per_revolution=100)
    speed = (20.0 + 15.0 * np.sin(np.arange(400) / 30.0)) * (0.8 if digit == 0.1 else 1.0)
    values = digit * np.rint(speed / unit / digit)
    if refused:
        with pytest.raises(RecordingError, match="or leave the second away if speeds were smoothed or timed"):
            read(form, values.tolist())
    else:
        motion = read(form, values.tolist())
        assert motion.info.edges_per_revolution == 0 and motion.speed == pytest.approx(values * unit)


@pytest.mark.parametrize(("share", "smoothed"), [(1.0 / 128.0, True), (1.0, False)])
def test_counts_a_second_in_far_finer_steps_are_smoothed_ones(share: float, smoothed: bool) -> None:
    """A short step in 128ths of a count was refused: leave the counts away, it said, which are its unit's."""
    count = 1.0 / 0.02
    values = share * count * np.round(np.linspace(0.0, 9.0, 64) / share)
    form = replace(SPEED, unit="count/s", edges_per_revolution=200)
    motion = read(form, values.tolist())
    assert motion.info.edges_per_revolution == (0 if smoothed else 200)
    assert any("they were smoothed, or timed" in line for line in motion.findings) is smoothed


@pytest.mark.parametrize(
    ("weights", "kept"),
    [
        ((1.0,), True),
        ((0.4, 0.24, 0.144, 0.0864, 0.0518, 0.0311), False),
        ((-2.0, 3.0, 6.0, 7.0, 6.0, 3.0, -2.0), False),
    ],
    ids=["as counted", "a memory of 0.6", "Savitzky-Golay, whose steps are a 21st of a count"],
)
def test_counts_a_second_that_were_smoothed_are_no_counts(weights: tuple[float, ...], kept: bool) -> None:
    """What a turn has is said for the unit's sake; counting is not what is known of such speeds."""
    angle = np.cumsum(20.0 + 15.0 * np.sin(np.arange(400) / 30.0))
    counted = np.diff(np.floor(angle), prepend=0.0) / 0.02
    values = np.convolve(counted, np.array(weights) / sum(weights))[: len(counted)]
    motion = read(replace(SPEED, unit="count/s", edges_per_revolution=500), values.tolist())
    assert motion.info.edges_per_revolution == (500 if kept else 0)
    assert any("they were smoothed, or timed" in line for line in motion.findings) != kept
    assert motion.speed == pytest.approx(values * tau / 500)


@pytest.mark.parametrize(
    ("unit", "ratio", "said", "window"),
    [
        ("count/s", 5.0, None, 0.004),
        ("count/s", 2.0, None, 0.01),  # whatever a turn has
        ("rad/s", 5.0, None, 0.004),
        ("rad/s", 2.0, None, 0.02),  # or a turn has half the edges
        ("rad/s", 1.0, None, 0.02),
        ("rad/s", 5.0, 0.02, 0.02),
    ],
)
def test_speeds_of_said_counts_were_counted_for_as_long_as_their_steps_say(
    unit: str, ratio: float, said: float | None, window: float
) -> None:
    """Counts of 10 ms in rows of 50 were read as means over the row, and as smoothed for 983 ms then."""
    random = np.random.default_rng(4)
    counts = np.floor(40.0 / ratio * (1.0 - np.exp(-np.arange(60) / 2.0)) * 5.0 + random.uniform(0.0, 1.0, 60))
    counts[20:40] = np.floor(0.55 * counts[20:40])
    step = ratio / 0.02 * (1.0 if unit == "count/s" else tau / 1320)
    form = replace(SPEED, unit=unit, edges_per_revolution=1320, speed_window=said)
    motion = read(form, [float(one) for one in step * counts * (1.0 - 1e-4 * random.random(60))])
    assert motion.info.speed_window == pytest.approx(window, rel=0.002) and motion.info.edges_per_revolution == 1320
    assert motion.info.speed_lag == pytest.approx(0.5 * window, rel=0.002)
    told = " ".join(motion.findings)
    assert ("one count within that is the step of the values" in told) is (window < 0.02)
    assert ("2 counts of 1320 per revolution within a row: there are 660" in told) is (unit == "rad/s" and ratio == 2.0)
    other = unit == "rad/s" and ratio == 5.0 and said is None
    assert ("Or there are 264 counts per revolution, and not 1320 (--edges-per-revolution)" in told) is other
