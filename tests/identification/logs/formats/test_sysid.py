"""SysId's own log."""

import json
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.formats.sysid import read_sysid
from motor_model.errors import RecordingError

LOG = Path(__file__).resolve().parents[3] / "data" / "frc" / "drivetrain_sysid.json"
SINGLE = [[0.0, 1.0, 0.0, 0.0], [0.005, 1.0, 0.1, 2.0]]


def write(path: Path, **changed: object) -> Path:
    log = {"sysid": True, "test": "Simple", "units": "Rotations", "unitsPerRotation": 1.0, "slow-forward": SINGLE}
    (path / "log.json").write_text(json.dumps({**log, **changed}))
    return path / "log.json"


def test_a_drivetrain() -> None:
    table, turn = read_sysid(LOG)
    assert turn == 0.4878 and table.notes == (
        "SysId log of Drivetrain: slow-forward, slow-backward, fast-forward, fast-backward.",
    )
    assert table.names[:4] == ["test", "time [s]", "left voltage [V]", "right voltage [V]"]
    assert np.max(table.numbers("left voltage [V]")) == pytest.approx(8.14, abs=0.05)
    left, right = (table.numbers(f"{side} velocity [m/s]") for side in ("left", "right"))
    assert 0.99 < np.corrcoef(left, right)[0, 1] <= 1.0


@pytest.mark.parametrize(
    ("unit", "names"), [("Rotations", ("rev", "rev/s")), ("Radians", ("rad", "rad/s")), ("Degrees", ("deg", "deg/s"))]
)
def test_a_single_mechanism(tmp_path: Path, unit: str, names: tuple[str, str]) -> None:
    table, turn = read_sysid(write(tmp_path, units=unit))
    assert turn is None
    assert table.names == ["test", "time [s]", "voltage [V]", f"position [{names[0]}]", f"velocity [{names[1]}]"]
    assert table.numbers(f"velocity [{names[1]}]").tolist() == [0.0, 2.0]


def test_a_length_without_its_turn_is_asked_for_later(tmp_path: Path) -> None:
    assert read_sysid(write(tmp_path, units="Meters", unitsPerRotation=0.5))[1] == 0.5
    table, turn = read_sysid(write(tmp_path, units="Inches", unitsPerRotation=13.35))
    assert turn == 13.35 and table.names[3:] == ["position [in]", "velocity [in/s]"]
    for turn in (0, -1.0, "wide", True, 1e7, None):
        assert read_sysid(write(tmp_path, units="Meters", unitsPerRotation=turn))[1] is None


@pytest.mark.parametrize("width", [9, 10])  # with a gyro's angle, or without
def test_a_log_of_frc_characterization(tmp_path: Path, width: int) -> None:
    """Before SysId: battery and share of the voltage behind the time, two sides whatever the mechanism."""
    row = [0.02, 12.4, 0.25, 3.0, 2.9, 0.5, 0.6, 1.5, 1.6, 0.7][:width]
    path = write(tmp_path, sysid=False, test="Drivetrain", units="Feet", **{"slow-forward": [row, row]})
    table, turn = read_sysid(path)
    assert turn == 1.0 and table.notes == ("frc-characterization's log of Drivetrain: slow-forward.",)
    assert table.names[2:] == [
        "left voltage [V]", "right voltage [V]", "left position [ft]", "right position [ft]",
        "left velocity [ft/s]", "right velocity [ft/s]",
    ]  # fmt: skip
    assert [table.numbers(name)[0] for name in table.names[1:]] == [0.02, *row[3:9]]
    path = write(tmp_path, sysid=False, test="Elevator", **{"slow-forward": [row, row]})
    single = read_sysid(path)[0]
    assert single.names[2:] == ["voltage [V]", "position [rev]", "velocity [rev/s]"]
    assert [single.numbers(name)[0] for name in single.names[1:]] == [0.02, 3.0, 0.5, 1.5]
    path.write_text(json.dumps({"fast-forward": [row, row]}))  # those of 2019 say nothing else
    first = read_sysid(path)[0]
    assert first.names[2:6] == ["left voltage [V]", "right voltage [V]", "left position", "right position"]
    back = [0.02, 12.4, -0.25, 3.0, -2.9, -0.5, -0.6, -1.5, -1.6, 0.7][:width]  # a side that logged no sign
    path.write_text(json.dumps({"fast-backward": [back, back]}))
    assert [read_sysid(path)[0].numbers(name)[0] for name in ("left voltage [V]", "right voltage [V]")] == [-3.0, -2.9]
    path.write_text(json.dumps({"fast-forward": [row[:8]] * 2}))
    with pytest.raises(
        RecordingError, match=r"has \[8\] numbers|have \[8\] numbers, where frc-characterization writes 9"
    ):
        read_sysid(path)


@pytest.mark.parametrize(
    ("changed", "complaint"),
    [
        ({"sysid": False, "slow-forward": 7}, "is JSON, and no log of SysId"),
        ({"units": "Furlongs"}, "its units, Furlongs, are none that SysId has"),
        ({"slow-forward": []}, "has none of SysId's tests"),
        ({"slow-forward": [[1, 2], [3, 4]]}, r"its rows have \[2\] numbers, where SysId writes 4 or 9"),
        ({"fast-forward": [[1] * 9]}, r"its rows have \[4, 9\] numbers"),
        ({"slow-forward": [[1, 2, 3, 4], [1, 2]]}, "the rows of slow-forward are no numbers, or not equally many"),
        ({"slow-forward": [[1, 2, 3, "x"]]}, "the rows of slow-forward are no numbers"),
        ({"slow-forward": [[1, 2, 3, float("nan")]]}, "the rows of slow-forward are no numbers"),
        ({"slow-forward": 7}, "the rows of slow-forward are no numbers"),
    ],
)
def test_what_is_no_such_log(tmp_path: Path, changed: dict[str, object], complaint: str) -> None:
    with pytest.raises(RecordingError, match=complaint) as caught:
        read_sysid(write(tmp_path, **changed))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("text", ["{", "[1]", '{"a": ', "{" * 100_000, '{"sysid": true'])
def test_damaged_json(tmp_path: Path, text: str) -> None:
    (tmp_path / "log.json").write_text(text)
    with pytest.raises(RecordingError, match="is no complete JSON|no log of SysId"):
        read_sysid(tmp_path / "log.json")
