"""Other people's logs: what is read from them, which assumptions are told, and what is refused."""

from collections.abc import Callable
from dataclasses import replace
from math import pi, radians
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs import CsvForm, Kind, Log, read_log
from motor_model.errors import RecordingError
from motor_model.sample import Measurement, Sample

DATA = Path(__file__).resolve().parents[2] / "data"
SPEED = CsvForm(time="t", voltage="u", motion="y", kind=Kind.SPEED, unit="deg/s")
ANGLE = CsvForm(time="t", voltage="u", motion="y", kind=Kind.POSITION, unit="deg")
COUNT = CsvForm(time="t", voltage="u", motion="y", kind=Kind.COUNT, unit="count", edges_per_revolution=100)

Read = Callable[..., Log]


@pytest.fixture
def read(tmp_path: Path) -> Read:
    """Reads text as a file."""

    def read(text: str | bytes, form: CsvForm = SPEED) -> Log:
        (tmp_path / "log.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_log(tmp_path / "log.csv", form)

    return read


def table(*rows: tuple[object, ...], header: str = "t,u,y") -> str:
    return "\n".join([header, *(",".join(map(str, row)) for row in rows)]) + "\n"


PLAIN = table((0, 1, 90), (0.02, 2, 180), (0.04, -3, 270))


def test_speeds_are_means_over_the_period_before_the_stamp_unless_said_otherwise(read: Read) -> None:
    log = read(PLAIN)
    (run,) = log.runs
    assert [sample.sample_time for sample in run.samples] == [0, 20_000_000, 40_000_000]
    assert [sample.voltage for sample in run.samples] == [1.0, 2.0, -3.0]
    assert [sample.speed for sample in run.samples] == pytest.approx([pi / 2, pi, 1.5 * pi])
    assert (log.info.measurement, log.info.source) == (Measurement.SPEED, "import")
    assert (log.info.sample_period, log.info.speed_window, log.info.speed_lag) == (0.02, 0.02, 0.01)
    assert (log.info.max_voltage, log.info.edges_per_revolution, log.info.single_channel) == (3.0, 0, False)
    assert run.label == "" and run.duration == pytest.approx(0.04)
    text = " ".join(log.findings)
    assert "3 rows, 0.04 s, sample period 20 ms (20 to 20 ms), up to 3 V" in text
    assert "mean over 20 ms (assumed: one sample period; otherwise: --speed-window)" in text
    assert "10 ms before the row's time (assumed" in text and "Speeds show no counts: noise of" in text


def test_what_is_said_is_not_assumed(read: Read) -> None:
    form = replace(SPEED, speed_window=0.1, speed_lag=0.0, edges_per_revolution=360, max_voltage=12.0, name="wheel")
    log = read(PLAIN, form)
    assert (log.info.speed_window, log.info.speed_lag, log.info.edges_per_revolution) == (0.1, 0.0, 360)
    assert (log.info.max_voltage, log.info.name) == (12.0, "wheel")
    assert "assumed" not in " ".join(log.findings)
    assert "One count (360 per revolution) within the window is 10 deg/s." in log.findings


def test_the_size_of_a_count_says_the_edges_behind_a_speed(read: Read) -> None:
    assert read(PLAIN, replace(SPEED, count_quantum=6.428571)).info.edges_per_revolution == 2800
    with pytest.raises(RecordingError, match="come to 2812.5 per revolution, not 2800"):
        read(PLAIN, replace(SPEED, count_quantum=6.4, edges_per_revolution=2800))


@pytest.mark.parametrize(("unit", "size"), [("rad/s", 1.0), ("deg/s", radians(1.0)), ("rpm", 2.0 * pi / 60.0)])
def test_units_of_speed(read: Read, unit: str, size: float) -> None:
    (run,) = read(PLAIN, replace(SPEED, unit=unit)).runs
    assert [sample.speed for sample in run.samples] == pytest.approx([90 * size, 180 * size, 270 * size])


@pytest.mark.parametrize(
    ("form", "values"),
    [
        (replace(ANGLE, edges_per_revolution=100), (3.6, 7.2, -3.6)),
        (replace(ANGLE, unit="rad", edges_per_revolution=100), (0.02 * pi, 0.04 * pi, -0.02 * pi)),
        (replace(ANGLE, unit="rev", edges_per_revolution=100), (0.01, 0.02, -0.01)),
        (replace(ANGLE, unit="rev", count_quantum=0.01), (0.01, 0.02, -0.01)),
        (replace(ANGLE, unit="count", edges_per_revolution=100), (1, 2, -1)),
        (COUNT, (1, 2, -1)),
        (replace(COUNT, count_quantum=4.0), (4, 8, -4)),
    ],
)
def test_positions_and_counts_are_sampled_counts(read: Read, form: CsvForm, values: tuple[float, ...]) -> None:
    log = read(table((0, 1, values[0]), (0.01, 1, values[1]), (0.03, 1, values[2])), form)
    (run,) = log.runs
    assert (log.info.measurement, log.info.edges_per_revolution) == (Measurement.COUNTS, 100)
    assert (log.info.speed_window, log.info.edge_resolution) == (0.0, 0.0)
    assert [sample.edge_count for sample in run.samples] == [1, 2, -1]
    step = 0.02 * pi
    assert [sample.speed for sample in run.samples] == pytest.approx([step / 0.01, step / 0.01, -3 * step / 0.02])
    assert all(sample.edge_time == 0 and sample.edge_period == 0.0 for sample in run.samples)
    assert not any("Caution" in finding for finding in log.findings)


def test_the_size_of_a_count_is_seen_in_positions_and_told(read: Read) -> None:
    rows = [(0.01 * k, 1, 0.9 * (k * (k + 1) // 2)) for k in range(20)]
    log = read(table(*rows), ANGLE)
    assert log.info.edges_per_revolution == 400
    assert [sample.edge_count for sample in log.runs[0].samples] == [k * (k + 1) // 2 for k in range(20)]
    assert any("one count is 0.9 deg, 400 per revolution (assumed" in finding for finding in log.findings)


def test_positions_without_steps_are_counted_finely(read: Read) -> None:
    smooth = table(*((0.01 * k, 1, 3.0 * k**1.37) for k in range(30)))
    found = read(smooth, ANGLE)
    assert found.info.edges_per_revolution >= 360 and any("show no steps" in finding for finding in found.findings)
    log = read(smooth, replace(ANGLE, edges_per_revolution=360))
    assert any("Caution" in finding and "--count-quantum" in finding for finding in log.findings)


def test_a_count_that_is_no_share_of_a_turn_is_refused(read: Read) -> None:
    with pytest.raises(RecordingError, match="514.286 per revolution, not a whole number"):
        read(PLAIN, replace(ANGLE, count_quantum=0.7))
    with pytest.raises(RecordingError, match="give --edges-per-revolution"):
        read(PLAIN, replace(COUNT, edges_per_revolution=None))


@pytest.mark.parametrize(
    "text",
    [
        "\ufeff" + PLAIN,
        PLAIN.encode("utf-16"),
        PLAIN.replace("t,u,y", "# t,u,y").encode(),
        b"logged by me \xb5C\n\n" + PLAIN.encode(),
        PLAIN.replace(",", ";"),
        PLAIN.replace(",", "\t"),
        PLAIN.replace(",", ";").replace(".", ","),
        PLAIN.replace("\n", "\r\n"),
        PLAIN.replace("\n", "  \n\n ,,\n"),
        PLAIN.replace(",", " , "),
        "\n\n" + PLAIN.rstrip("\n"),
        PLAIN.replace("t,u,y", '"t","u","y"').replace("180", '"180"'),
        table((9, 90, 1, 0), (9, 180, 2, 0.02), (9, 270, -3, "2e-2".replace("2e", "4e")), header="x,y,u,t"),
    ],
)
def test_the_same_log_in_other_clothes(read: Read, text: str | bytes) -> None:
    assert read(text).runs == read(PLAIN).runs


def test_times_since_1970_keep_their_nanoseconds(read: Read) -> None:
    (run,) = read(table(("1760000000.123456789", 1, 1), ("1760000000.133456790", 1, 1))).runs
    assert [sample.sample_time for sample in run.samples] == [1760000000123456789, 1760000000133456790]


def test_scaled_voltage(read: Read) -> None:
    log = read(table((0, -100, 1), (1, 50, 1)), replace(SPEED, voltage_scale=0.074))
    assert [sample.voltage for sample in log.runs[0].samples] == pytest.approx([-7.4, 3.7])
    assert log.info.max_voltage == pytest.approx(7.4)


DUTY = replace(SPEED, voltage="d", supply="b")


@pytest.mark.parametrize(
    ("form", "battery", "most"),
    [
        (DUTY, (12, 11.9, 12.1), 12.0),  # its largest duty is 0.82, of 11.9 V: 9.76 V
        (replace(DUTY, max_voltage=9.0), (12, 11.9, 12.1), 9.0),
        (replace(DUTY, voltage_scale=1 / 0.8), (12, 11.9, 12.1), 0.82 / 0.8 * 11.9),  # more than all of the median
        (replace(DUTY, supply_scale=1e-3), (7400, 7400, 7400), 7.4),
        (replace(DUTY, supply=None), (12, 11.9, 12.1), 0.82),
    ],
)
def test_a_duty_whose_supply_is_logged_is_a_share_of_its_median(
    read: Read, form: CsvForm, battery: tuple[float, ...], most: float
) -> None:
    """Of a motor on 12 V whose duty stayed below 0.82 the full voltage was 9.8 V, and what its bridge did was wrong."""
    rows = [(0.02 * i, duty, 90 * i, b) for i, (duty, b) in enumerate(zip((0.3, -0.82, 0.5), battery, strict=True))]
    assert read(table(*rows, header="t,d,y,b"), form).info.max_voltage == pytest.approx(most)


def test_split_makes_a_run_of_every_change_and_lets_time_start_again(read: Read) -> None:
    rows = [("a b", 0), ("a b", 1), ("7.5", 0), ("7.5", 2), ("7.5", 3), ("a b", 1), ("a b", 2)]
    log = read(table(*((time, 1, 5, value) for value, time in rows), header="t,u,y,s"), replace(SPEED, split="s"))
    assert [(run.label, len(run.samples)) for run in log.runs] == [("a_b", 2), ("7.5", 3), ("a_b_2", 2)]
    assert "7 rows in 3 runs, 5.00 s" in log.findings[0]
    assert log.info.sample_period == 1.0


# What cannot be used, and the sentence for it.


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "log.csv is empty: it needs"),
        ("\n \n", "log.csv is empty: it needs"),
        ("t,u,y\n", "log.csv has 0 rows below its column names"),
        (table((0, 1, 2)), "log.csv has 1 row below its column names"),
        (table((0, 1, 2), (1, 2, 3), header="t,u,speed"), "log.csv has no column y: name one of t, u, speed."),
        (table((0, 1, 2, 3), (1, 2, 3, 4), header="t,u,y,y"), "log.csv has 2 columns named y: rename"),
        (table((0, 1, 2), (1, "abc", 3)), "log.csv, line 3, column u: 'abc' is not a number"),
        (table((0, 1, 2), ("1 s", 2, 3)), "log.csv, line 3, column t: '1 s' is not a number"),
        (table((0, 1, 2), (1, "nan", 3)), "log.csv, line 3, column u: 'nan' is not a number"),
        (table((0, 1, 2), (1, 2, "inf")), "log.csv, line 3, column y: 'inf' is not a number"),
        (table((0, 1, 2), ("nan", 2, 3)), "log.csv, line 3, column t: 'nan' is not a number"),
        (table((0, 1, 2), ("1e99", 2, 3)), "log.csv, line 3, column t: '1e99' is not a number"),
        ("t,u,y\n0,1,2\n\n1,2\n", "log.csv, line 4, column y: the cell is empty"),
        ("t,u,y\n0,1,2\n1,,3\n", "log.csv, line 3, column u: the cell is empty"),
        (table((0, 1, 2), (2, 1, 2), (1, 1, 2)), r"line 4: time runs backwards \(t is 1 s after 2\)"),
        (table((2, 1, 2), (2, 1, 2), ("2.0", 1, 2)), "no run has two rows at different times: check --time"),
        (table((0, 0, 2), (2, 0, 2)), "u is 0 in every row: check --voltage"),
        (b"t,u,y\n0,1,\0\n", "log.csv is not text: export it again as CSV in UTF-8"),
        (b"t,u,y\n0,1,2\n0.02,1,\xb5\n", "log.csv, line 3, column y: 'µ' is not a number"),
        (PLAIN.encode("utf-16")[:-1], "log.csv is not valid UTF-16 text"),
    ],
)
def test_a_bad_file_is_refused_in_a_sentence(read: Read, text: str | bytes, complaint: str) -> None:
    with pytest.raises(RecordingError, match=complaint) as caught:
        read(text)
    assert "\n" not in str(caught.value) and str(caught.value).endswith(".")


def test_time_that_starts_again_begins_a_run(read: Read) -> None:
    rows = [(0, 1, 2, "a"), (1, 1, 2, "a"), (0, 1, 2, "b"), (1, 1, 2, "b"), (0, 1, 2, "b")]
    log = read(table(*rows, (1, 1, 3, "b"), header="t,u,y,s"), replace(SPEED, split="s"))
    assert [(run.label, len(run.samples)) for run in log.runs] == [("a", 2), ("b_1", 2), ("b_2", 2)]
    assert "t begins again once: 3 runs, a bag each." in log.findings
    alone = read(table(*rows, header="t,u,y,s"), replace(SPEED, split="s"))
    assert "2 runs, a bag each (1 row that stands alone is left out)." in " ".join(alone.findings)
    with pytest.raises(RecordingError, match="line 6: the run with s = c has a single row"):
        read(table(*rows[:4], (0, 1, 2, "c"), header="t,u,y,s"), replace(SPEED, split="s"))


REFUSED_ROWS = "the time from row to row comes to .* s, and must be from 1e-06 to 100 s: check columns and units"


@pytest.mark.parametrize(("step", "refused"), [(1.1e-6, False), (0.9e-6, True), (99.0, False), (101.0, True)])
def test_rows_that_no_plant_has(read: Read, step: float, refused: bool) -> None:
    rows = table(*((f"{k * step:.10f}", 1 + k % 2, 10 * k) for k in range(6)))
    if refused:
        with pytest.raises(RecordingError, match=REFUSED_ROWS):
            read(rows)
    else:
        assert read(rows).info.sample_period == pytest.approx(step)


def test_no_such_file_or_a_folder(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="There is no file"):
        read_log(tmp_path / "none.csv", SPEED)
    with pytest.raises(RecordingError, match="is not a regular file"):
        read_log(tmp_path, SPEED)


# Real motors.


def column(run: tuple[Sample, ...], name: str) -> "np.ndarray[tuple[int], np.dtype[np.float64]]":
    return np.array([getattr(sample, name) for sample in run], dtype=np.float64)


def test_the_prbs_of_a_gearmotor() -> None:
    log = read_log(DATA / "undc/prbs_2026-08-14.csv", replace(SPEED, edges_per_revolution=2800))
    (run,) = log.runs
    assert len(run.samples) == 4093 and run.duration == pytest.approx(81.84)
    assert (log.info.sample_period, log.info.speed_window, log.info.speed_lag) == (0.02, 0.02, 0.01)
    assert 3.08 < log.info.max_voltage < 3.09
    counts = column(run.samples, "speed") / (2.0 * pi / 2800 / 0.02)
    assert np.max(np.abs(counts - np.rint(counts))) < 1e-4  # the quantum that was said is that of the data
    assert np.degrees(column(run.samples, "speed")).max() == pytest.approx(471.4, abs=20)


def test_the_steps_of_an_ev3_motor() -> None:
    form = CsvForm("t_s", "duty_pct", "pos_deg", Kind.POSITION, "deg", voltage_scale=0.074, split="duty_pct")
    log = read_log(DATA / "ev3/steps_1s.csv", form)
    assert [run.label for run in log.runs] == [str(duty) for duty in (-100, -80, -60, -40, -20, 20, 40, 60, 80, 100)]
    assert log.info.edges_per_revolution == 360 and log.info.max_voltage == pytest.approx(7.4)
    for run in log.runs:
        assert 170 < len(run.samples) < 200 and 0.95 < run.duration < 1.0
        assert column(run.samples, "voltage") == pytest.approx(0.074 * float(run.label))
        travel = np.sum(np.diff(column(run.samples, "sample_time")) * 1e-9 * column(run.samples, "speed")[1:])
        assert travel == pytest.approx(
            radians(np.ptp(column(run.samples, "edge_count"))) * np.sign(float(run.label)), rel=0.2
        )
    final = [
        np.polyfit(*(column(run.samples[-90:], name) for name in ("sample_time", "edge_count")), 1) for run in log.runs
    ]
    first, last = (radians(final[k][0] * 1e9) for k in (0, -1))
    assert -14.2 < first < -13.6 and 14.4 < last < 14.9  # their own fit: -13.96 and 14.68 rad/s
