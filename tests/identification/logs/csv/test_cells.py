"""Numbers and clock times in cells."""

import pytest

from motor_identification.logs.csv.cells import clock_nanoseconds, is_number, with_point


def test_numbers_with_points_commas_and_marks_of_thousands() -> None:
    for cell, comma, read in (
        ("-1.5e3", False, "-1.5e3"),
        ("1,5", True, "1.5"),
        ("-1.010,84", True, "-1010.84"),
        ("1,234,567.5", False, "1234567.5"),
        ("1.234", True, "1.234"),  # with one sign alone nobody knows which
    ):
        assert is_number(cell, comma)
        assert with_point(cell, comma) == read
    for cell, comma in (("1,5", False), ("1,23,4.5", False), ("1_0", False), ("12:60", False), ("٣", False)):
        assert not is_number(cell, comma) or not cell.isascii()


@pytest.mark.parametrize(
    ("cell", "seconds"),
    [
        ("12:03:04.5", 43_384.5),
        ("0:00:01", 1.0),
        ("12:03:04,250", 43_384.25),
        ("12:03:04:250", 43_384.25),
        ("12:00:01 AM", 1.0),
        ("1:00:00 pm", 46_800.0),
        ("1970-01-02T00:00:00Z", 86_400.0),
        ("1970-01-02 01:00:00+01:00", 86_400.0),
        ("02.01.1970 00:00:00", 86_400.0),
        ("1/2/1970 00:00:00", 86_400.0),
        ("31/1/1970 00:00:00", 30 * 86_400.0),
        ("02-Jan-1970 00:00:01.5", 86_401.5),
        ("1 days 00:00:02.25", 86_402.25),
        ("1 day 0:00:01", 86_401.0),
        ("61:02.500", 3662.5),
        ("0:59,125", 59.125),
    ],
)
def test_clocks(cell: str, seconds: float) -> None:
    assert is_number(cell, False)
    assert clock_nanoseconds(cell) == round(seconds * 1e9)


@pytest.mark.parametrize(
    "cell",
    ["25:00:00", "12:61:00", "13/13/2024 00:00:00", "2024-02-30 00:00:00", "12:00", "02-Xyz-1970 00:00:00", "1:60.5"],
)
def test_what_is_no_time(cell: str) -> None:
    with pytest.raises(ValueError, match=r".*"):
        clock_nanoseconds(cell)
