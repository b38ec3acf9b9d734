"""Measurement files of LabVIEW."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.formats.lvm import read_lvm
from motor_identification.logs.formats.source import read_source
from motor_model.errors import RecordingError

END = "***End_of_Header***"
VOLTS, SPEED = np.repeat([0.0, 3.0, -2.5], 4), np.arange(12) * 0.75


def file_header(columns: str = "One", decimal: str = ".") -> list[str]:
    return [
        "LabVIEW Measurement\t", "Writer_Version\t2", "Reader_Version\t2", "Separator\tTab",
        f"Decimal_Separator\t{decimal}", "Multi_Headings\tNo", f"X_Columns\t{columns}", "Time_Pref\tRelative",
        "Date\t2019/07/22", "Time\t17:18:18,938945770263671875", END, "\t",
    ]  # fmt: skip


def segment(rows: range, names: str, columns: str = "One", decimal: str = ".") -> list[str]:
    x = {k: f"{0.02 * k:.6f}" for k in rows}
    cells = {
        "One": [f"{x[k]}\t{VOLTS[k]:.4f}\t{SPEED[k]:.4f}" for k in rows],
        "Multi": [f"{x[k]}\t{VOLTS[k]:.4f}\t{x[k]}\t{SPEED[k]:.4f}" for k in rows],
        "No": [f"\t{VOLTS[k]:.4f}\t{SPEED[k]:.4f}" for k in rows],
    }[columns]
    start = 0.02 * rows[0]
    above = [
        "Channels\t2\t\t", f"Samples\t{len(rows)}\t{len(rows)}\t", "Date\t2019/07/22\t2019/07/22\t",
        "Time\t17:18:18.9389\t17:18:18.9389\t", "Y_Unit_Label\tVolts\trad/s\t", "X_Dimension\tTime\tTime\t",
        f"X0\t{start:.4E}\t{start:.4E}\t", "Delta_X\t0.020000\t0.020000\t",
    ]  # fmt: skip
    return [
        *(one.replace(".", decimal) for one in above),
        f"{END}\t\t\t",
        names,
        *(c.replace(".", decimal) for c in cells),
    ]


@pytest.mark.parametrize("columns", ["One", "Multi", "No"])
@pytest.mark.parametrize("decimal", [".", ","])
def test_channels_and_their_times(tmp_path: Path, columns: str, decimal: str) -> None:
    names = "X_Value\tVoltage\tX_Value\tTacho\tComment" if columns == "Multi" else "X_Value\tVoltage\tTacho\tComment"
    path = tmp_path / "log.lvm"
    path.write_text("\n".join([*file_header(columns, decimal), *segment(range(12), names, columns, decimal)]) + "\n")
    source = read_source(path)
    assert source.format == "file of LabVIEW (LVM)"
    assert source.table.names == ["time [s]", "Voltage [Volts]", "Tacho [rad/s]"]
    assert source.table.numbers("time [s]") == pytest.approx(np.arange(12) * 0.02)
    assert source.table.numbers("Voltage [Volts]").tolist() == VOLTS.tolist()
    assert source.table.numbers("Tacho [rad/s]").tolist() == SPEED.tolist()
    assert source.table.lines[0] == 23  # as the file counts


def test_segments_follow_each_other(tmp_path: Path) -> None:
    names, path = "X_Value\tVoltage\tTacho\tComment", tmp_path / "log.lvm"
    for columns in ("One", "No"):
        parts = [segment(rows, names, columns) for rows in (range(5), range(5, 12))]
        path.write_text("\n".join([*file_header(columns), *parts[0], "", *parts[1]]) + "\n")
        table = read_lvm(path)
        assert table.numbers("time [s]") == pytest.approx(np.arange(12) * 0.02)
        assert table.numbers("Voltage [Volts]").tolist() == VOLTS.tolist()


def test_a_damaged_file_is_a_sentence(tmp_path: Path) -> None:
    path = tmp_path / "log.lvm"
    whole = [*file_header(), *segment(range(12), "X_Value\tVoltage\tTacho\tComment")]
    for kept, complaint in (
        (5, "its header has no end"),
        (12, "without channels"),
        (22, "0 rows below its column names"),
    ):
        path.write_text("\n".join(whole[:kept]) + "\n")
        with pytest.raises(RecordingError, match=complaint):
            read_lvm(path)
