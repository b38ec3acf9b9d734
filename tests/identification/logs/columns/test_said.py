"""What a user said of columns: by name, or by place."""

from motor_identification.logs.columns.said import Pair, Said

NAMES = ["time", "3", "column 3", "Channel 4"]


def test_a_number_that_is_no_name_is_a_place() -> None:
    said = Said(time="1", voltage="4", motion="3", supply="Channel 4").with_names(NAMES)
    assert (said.time, said.voltage, said.motion, said.supply) == ("time", "Channel 4", "3", "Channel 4")
    assert Said(motors=(Pair("left", "4", "column 3"),)).with_names(NAMES).motors == (
        Pair("left", "Channel 4", "column 3"),
    )


def test_what_is_neither_name_nor_place_stays_and_is_complained_of() -> None:
    for odd in ("5", "0", "-1", "²", "999999999", "voltage", ""):
        assert Said(voltage=odd).with_names(NAMES).voltage == odd
    assert Said().with_names(NAMES) == Said()
