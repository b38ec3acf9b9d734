"""A file's format is found from its content."""

from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from motor_identification.logs.columns.said import Said
from motor_identification.logs.formats.source import read_source
from motor_model.errors import RecordingError

DATA = Path(__file__).resolve().parents[3] / "data"


def test_formats_whatever_the_name(tmp_path: Path) -> None:
    savemat(tmp_path / "log.txt", {"t": np.arange(9.0), "u": np.arange(9.0)})
    assert read_source(tmp_path / "log.txt").format == "MATLAB 5 file"
    (tmp_path / "log.dat").write_bytes((DATA / "frc/drivetrain_sysid.json").read_bytes())
    source = read_source(tmp_path / "log.dat")
    assert source.format == "SysId JSON" and source.said == Said(split="test", units_per_revolution=0.4878)
    assert read_source(DATA / "undc/static_2026-08-17.csv").format == "text table"


def test_what_a_user_says_comes_before_what_the_file_says() -> None:
    source = read_source(DATA / "frc/drivetrain_sysid.json")
    said = source.with_said(Said(units_per_revolution=0.5, unit="m"))
    assert (said.units_per_revolution, said.split, said.unit) == (0.5, "test", "m")


@pytest.mark.parametrize(
    ("head", "complaint"),
    [
        (b"\x89HDF\r\n\x1a\n", "is an HDF5 file: save its arrays as CSV"),
        (b"PK\x03\x04", "is a ZIP or spreadsheet file: unpack it, or export it as CSV"),
        (b"PK\x03\x04\x14\0[Content_Types].xml", "is a spreadsheet: save its sheet as CSV"),
        (
            b"PK\x03\x04mimetypeapplication/vnd.oasis.opendocument.spreadsheet",
            "is a spreadsheet: save its sheet as CSV",
        ),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "is an old Excel file: save its sheet as CSV"),
        (b"\x93NUMPY\1\0", "is a damaged NumPy file"),
        (b"PK\x03\x04\x14\0u.npy", "is a damaged"),
        (b"# Created by Octave 6.4.0\n# name: u\n# type: matrix\n1 2\n3\n", "is a damaged Octave file"),
        (b"#ROSBAG V2.0\n", "is a bag of ROS 1: convert it \\(rosbags-convert"),
        (b"TDSm\x0e\0", "is a TDMS file of LabVIEW: export it as CSV"),
        (b"PAR1", "is a Parquet or Feather file: export it as CSV"),
        (b"\x89MCAP0\r\n", "is a bag: give it to identify, diagnose or inspect"),
        (b"SQLite format 3\0", "is a bag: give it to identify"),
    ],
)
def test_formats_that_are_not_read_are_named(tmp_path: Path, head: bytes, complaint: str) -> None:
    (tmp_path / "log").write_bytes(head + b"\0" * 100)
    with pytest.raises(RecordingError, match=complaint):
        read_source(tmp_path / "log")
