"""Every public log of tests/data by one line, and logs in other clothes."""

from pathlib import Path

import numpy as np
import pytest
from recorded import as_period_speed
from swinging import recorded

from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.imported import Imported, import_log
from motor_identification.recording import check, recording_of
from motor_model.errors import RecordingError
from motor_model.sample import Measurement

DATA = Path(__file__).resolve().parents[2] / "data"
MOUSE = {"supply_voltage": 7.9, "unit": "rpm"}
# What has to be said of each file beyond its name, the motors and runs that come out, and how it was measured.
LINES: dict[str, tuple[dict[str, object], int, int, str]] = {
    "undc/prbs_2026-08-14.csv": ({}, 1, 1, "speed"),
    "undc/prbs_2026-08-18.csv": ({}, 1, 1, "speed"),
    "undc/prbs_coast_2024-08-03.csv": ({}, 1, 1, "speed"),
    "undc/prbs_coast_2024-08-05.csv": ({}, 1, 1, "speed"),
    "undc/step_open_2026-08-18.csv": ({}, 1, 1, "speed"),
    "undc/step_closed_2026-08-11.csv": ({}, 1, 1, "speed"),
    "undc/stairs_closed_2026-08-11.csv": ({}, 1, 1, "speed"),
    "undc/profile_closed_2026-08-18.csv": ({}, 1, 1, "counts"),
    "undc/static_2026-08-17.csv": ({"unit": "deg/s"}, 1, 1, "speed"),
    "undc/static_coast_2024-08-05.csv": ({"unit": "deg/s"}, 1, 1, "speed"),
    "esp32/step_response.csv": ({}, 1, 1, "speed"),
    "ev3/steps_1s.csv": ({"supply_voltage": 7.4}, 1, 10, "counts"),
    "micromouse/testPid1.csv": (MOUSE, 2, 1, "speed"),
    "micromouse/testPid3.csv": (MOUSE, 2, 1, "speed"),
    "micromouse/controllerDelayImpact1ms.csv": (MOUSE, 2, 1, "speed"),
    "micromouse/controllerDelayImpact10ms.csv": (MOUSE, 2, 1, "speed"),
    "micromouse/wheelSpeedCalibration3.csv": ({}, 2, 1, "speed"),
    "frc/drivetrain_sysid.json": ({}, 2, 4, "counts"),
}


def read(name: str, **said: object) -> Imported:
    return import_log(DATA / name, Said(**said))  # type: ignore[arg-type]


def test_the_edges_that_were_said_do_not_make_counts_of_the_times_between_them(tmp_path: Path) -> None:
    """Of 12 a turn one count within a row is 500 rpm, and "nothing is missing" was said of speeds of 188 and 243."""
    timed = as_period_speed(recorded(edges=12, sample_rate=50.0))
    uneven = timed.speed * (1.0 + 0.02 * np.sin(1e3 * timed.speed))  # of a disc whose slots are not alike
    rows = zip(timed.time, timed.voltage, uneven, strict=True)
    path = tmp_path / "log.csv"
    path.write_text("t_s,u_V,w_rad_s\n" + "\n".join(f"{t:.6f},{u:.4f},{w:.2f}" for t, u, w in rows) + "\n")
    plain, told = import_log(path, Said()), import_log(path, Said(edges_per_revolution=12))
    assert told.motors[0].log.info == plain.motors[0].log.info and told.motors[0].log.info.edges_per_revolution == 0
    said = "Speeds in w_rad_s stay as long as a slot of 12 per revolution takes at them: they were timed between edges"
    assert any(one.startswith(said) for one in told.motors[0].log.findings)
    for edges in (8, 17):  # of another encoder
        other = import_log(path, Said(edges_per_revolution=edges)).motors[0].log
        assert not any("stay as long" in one for one in other.findings)


def test_a_motor_that_is_not_driven_is_left_out(tmp_path: Path) -> None:
    rows = [f"{10 * k},200,{round(30 * (1 - np.exp(-k / 9)))},0,0" for k in range(99)]
    (tmp_path / "log.csv").write_text("\n".join(["t,pwmL,velL,pwmR,velR", *rows]) + "\n")
    imported = import_log(tmp_path / "log.csv", Said(supply_voltage=7.4, unit="rad/s"))
    assert [motor.label for motor in imported.motors] == ["left"]
    assert imported.findings[-1] == "Left out: motor right, which is not driven and hardly moves."
    begun = [row if k else row[:-1] + "90" for k, row in enumerate(rows)]  # what a board sent before it began
    (tmp_path / "log.csv").write_text("\n".join(["t,pwmL,velL,pwmR,velR", *begun]) + "\n")
    assert [motor.label for motor in import_log(tmp_path / "log.csv", Said(supply_voltage=7.4, unit="rpm")).motors] == [
        "left"
    ]
    pushed = [row[:-1] + str(k % 30) for k, row in enumerate(rows)]  # not driven, and moves
    (tmp_path / "log.csv").write_text("\n".join(["t,pwmL,velL,pwmR,velR", *pushed]) + "\n")
    assert len(import_log(tmp_path / "log.csv", Said(supply_voltage=7.4, unit="rpm")).motors) == 2
    stuck = [row[:-1].replace(",0,", ",90,") + "0" for row in rows]  # driven, and does not move: worth a word
    (tmp_path / "log.csv").write_text("\n".join(["t,pwmL,velL,pwmR,velR", *stuck]) + "\n")
    assert len(import_log(tmp_path / "log.csv", Said(supply_voltage=7.4, unit="rad/s")).motors) == 2


def test_what_is_full_is_the_same_for_both_motors(tmp_path: Path) -> None:
    rows = [f"{10 * k},{200 * (k > 9)},{round(30 * (1 - np.exp(-k / 9)))},{k % 2},{k % 7}" for k in range(99)]
    (tmp_path / "log.csv").write_text("\n".join(["t,pwmL,velL,pwmR,velR", *rows]) + "\n")
    imported = import_log(tmp_path / "log.csv", Said(supply_voltage=10.2, unit="rad/s"))
    top = [max(one.voltage for run in motor.log.runs for one in run.samples) for motor in imported.motors]
    assert top == pytest.approx([8.0, 0.04])


def test_the_table_names_every_log() -> None:
    there = {path.relative_to(DATA).as_posix() for path in DATA.glob("*/*") if path.suffix in (".csv", ".json")}
    assert there == set(LINES)
    assert sum(not said for said, *_ in LINES.values()) >= 11  # need no option at all


@pytest.mark.parametrize("name", LINES)
def test_every_public_log_by_one_line(name: str) -> None:
    said, motors, runs, measurement = LINES[name]
    imported = read(name, **said)
    assert len(imported.motors) == motors
    for motor in imported.motors:
        assert len(motor.log.runs) == runs and motor.log.info.measurement is Measurement(measurement)
        for run in motor.log.runs:
            check(recording_of(run.samples, motor.log.info, name))
        assert any(line.startswith("Excitation: ") for line in motor.log.findings)
    if said:
        missing = next(iter(said))
        with pytest.raises(RecordingError, match=f"--{missing.replace('_', '-')}"):
            read(name, **{key: value for key, value in said.items() if key != missing})


def test_two_motors_by_columns_that_no_name_tells(tmp_path: Path) -> None:
    time = np.arange(100) * 0.01
    volts = np.repeat([1.0, 3.0, -2.0, 4.0], 25)
    rows = [
        f"{t:.2f},{u:.1f},{30 * u + k % 3:.2f},{-u:.1f},{-29 * u - k % 2:.2f}"
        for k, (t, u) in enumerate(zip(time, volts, strict=True))
    ]
    (tmp_path / "log.csv").write_text("\n".join(["t,lc,ls,rc,rs", *rows]))
    said = Said(motors=(Pair("left", "lc", "ls"), Pair("right", "rc", "rs")), unit="rpm")
    left, right = import_log(tmp_path / "log.csv", said).motors
    assert (left.label, right.label, left.log.info.name) == ("left", "right", "left")
    assert [motor.log.runs[0].samples[30].voltage for motor in (left, right)] == [3.0, -3.0]
    assert right.log.runs[0].samples[30].speed == pytest.approx(-87.0 * 2 * np.pi / 60)
