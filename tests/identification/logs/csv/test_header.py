"""Names of columns: the line above the rows, a line of units below it, names over their cells."""

from pathlib import Path

import pytest

from motor_identification.logs.csv.dialect import find_dialect
from motor_identification.logs.csv.header import find_header, say_names_without_cells
from motor_identification.logs.csv.reader import read_table

FIRST = "0;0;0,2;0;21,1"
SPREAD = "         5      10.6       0.0      21.1      4700                "
ABOVE = "     Temps  Consigne  Position  Commande   Courant  Vit. Axe    Moteur"
UNITS = "        ms    degrés    degrés     Volts        mA     rad/s     rad/s"


@pytest.mark.parametrize(
    ("before", "header"),
    [
        (("Index;Tps;CONSIGNE;POSITION;COMMANDE", ";ms;dégrés;degrés;Volts"),
         ("Index", "Tps [ms]", "CONSIGNE [dégrés]", "POSITION [degrés]", "COMMANDE [Volts]")),
        (("Index;Tps;ref;pos;u", ";ms;deg;deg;"), ("Index", "Tps [ms]", "ref [deg]", "pos [deg]", "u")),
        (("Rig 3", "a;t;b;c;u", "[-];[s];[deg];[deg];[V]"), ("a [-]", "t [s]", "b [deg]", "c [deg]", "u [V]")),
        (("count;rpm;deg;ms;V",), ("count", "rpm", "deg", "ms", "V")),  # units alone, which are the names
        (("a;b;c;d;e", "t;ref;pos;u;y"), ("t", "ref", "pos", "u", "y")),  # no units: the last line
        (("1;2;3;4;5", "ms;deg;deg;V;V"), ("ms", "deg", "deg", "V", "V")),  # numbers are no names
        (("x-axis;1;2;3;4", "second;Volt;Volt;Volt;Volt"),  # an oscilloscope's channels
         ("x-axis [second]", "channel 1 [Volt]", "channel 2 [Volt]", "channel 3 [Volt]", "channel 4 [Volt]")),
        (("x-axis;1;2;3;4", "second;a;b;c;d"), ("second", "a", "b", "c", "d")),
        (("t;u;y;v;w", '""', '""'), ("t", "u", "y", "v", "w")),  # lines without anything
        (("1;2;3;4;5",), ()),
        (("Time;Position;Delta;366;Velocity",), ("Time", "Position", "Delta", "366", "Velocity")),  # a sheet's cell
        (("t;u;y;v;w", "Kp;of;the;loop;2"), ("t", "u", "y", "v", "w")),
        (("Time;Position;12;366;Velocity",), ()),
        (("366;Position;Delta;v;Velocity",), ()),
    ],
)  # fmt: skip
def test_units_stand_below_the_names_or_are_the_names(before: tuple[str, ...], header: tuple[str, ...]) -> None:
    assert find_header(before, FIRST, ";", True, 5, 5) == header


def test_names_stand_over_their_cells_where_the_last_columns_are_empty() -> None:
    found = find_header((ABOVE, UNITS), SPREAD, " ", False, 5, 5)
    assert found == ("Temps [ms]", "Consigne [degrés]", "Position [degrés]", "Commande [Volts]", "Courant [mA]")
    shifted = SPREAD.replace("         5", "5         ")
    assert find_header((ABOVE,), shifted, " ", False, 5, 5) == ()  # which name is whose, cannot be told


def test_a_french_servo_log_as_a_whole() -> None:
    rows = [SPREAD.replace("        5 ", f"{5 + 10 * k:9d} ") for k in range(6)]
    found = find_dialect([ABOVE, UNITS, *rows])
    assert found is not None and found.named and found.header[3] == "Commande [Volts]" and found.first_row == 2


REGBOT = [
    "%% logfile from a robot of a course",
    "% Robot 81 (PCB version 6.3, battery 5.0 V)",
    "%  1    time 3.0440 sec, from it (81)",
    "%  2  3 (mission 0), state 8",
    "%  4  5 Motor voltage [V] left, right: 1.26 1.25",
    "%  6  9 Wheel velocity [m/s] left, right: 0.0702 0.0890 delay 0.0050 0.0049 (sec)",
    "% 10 11 Pose x,y [m,m]: 0.838524 -3.78631e-05",
    "% 12    Battery voltage [V]",
]
LISTED = ["# Column 1: Time (s)", "# Column 2: PWM", "# Column 3: Speed (rpm)", "# gain = 3"]


def test_comments_that_say_which_column_is_what() -> None:
    assert find_header(REGBOT, "0 " * 12, " ", False, 12, 12) == (
        "time sec", "column 2", "column 3", "Motor voltage left [V]", "Motor voltage right [V]",
        "Wheel velocity left [m/s]", "Wheel velocity right [m/s]", "column 8", "column 9", "Pose x", "Pose y",
        "Battery voltage [V]",
    )  # fmt: skip
    assert find_header(LISTED, "0,0,0", ",", False, 3, 3) == ("Time (s)", "PWM", "Speed (rpm)")
    from_0 = [line.replace("Column 1", "0").replace("Column 2", "1").replace("Column 3", "2") for line in LISTED]
    assert find_header(from_0, "0,0,0", ",", False, 3, 3) == ("Time (s)", "PWM", "Speed (rpm)")
    assert find_header(["% 1 Time (sec)", "% 2 \tMotor voltage (V)"], "0,0", ",", False, 2, 2) == (
        "Time (sec)",
        "Motor voltage (V)",
    )


@pytest.mark.parametrize(
    "comments",
    [
        ("% 1 run of a motor", "t,u,y"),  # one alone
        ("% 3 runs", "% 1 motor", "t,u,y"),
        ("% 1 run", "% 12 volts", "t,u,y"),  # there is no column 12
        ("1 run", "2 motors", "t,u,y"),  # no comments
        ("% 5 runs", "% 6 motors", "t,u,y"),
    ],
)
def test_comments_that_begin_with_other_numbers(comments: tuple[str, ...]) -> None:
    assert find_header(comments, "0,0,0", ",", False, 3, 3) == ("t", "u", "y")


def test_units_of_numbers_without_one() -> None:
    found = find_header(("%n,voltage,position", "%[#],[V],[turns]"), "0,1,2", ",", False, 3, 3)
    assert found == ("n [#]", "voltage [V]", "position [turns]")
    assert find_header(("n,u,y", "nan,nan,nan"), "0,1,2", ",", False, 3, 3) == ("n", "u", "y")


@pytest.mark.parametrize(
    ("names", "kept"),
    [
        ("t,u,y,state", "t,u,y"),
        ("t,u,y,state,mode", "t,u,y"),
        ("t,u,y,state,mode,name", ""),  # of another table
        ("t,,y,state", ""),
        ("t,u,y,4", ""),
    ],
)
def test_names_behind_the_cells_of_all_rows(names: str, kept: str) -> None:
    header = find_header(("# a log", names), "0,1,2", ",", False, 3, 3)
    assert ",".join(header) == kept
    said = say_names_without_cells(("# a log", names), ",", header or ("a", "b", "c"))
    assert bool(said) == bool(kept)
    assert find_header((names,), "0,1", ",", False, 2, 2) == ()  # of two columns nobody knows


@pytest.mark.parametrize(("names", "told"), [("t,u,y,,,", ""), ("t,u,y,,J,", "the names J, below"), ("t,u,y", "")])
def test_empty_cells_behind_the_names_are_no_names(names: str, told: str) -> None:
    """A sheet of which somebody saved more columns than it has."""
    (said,) = say_names_without_cells((names,), ",", ("t", "u", "y")) or ("",)
    assert told in said and bool(told) == bool(said)


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("Tempo,Saída,Esforço", True),
        ("t,u,y", True),  # two of three are known
        ("Pins,set,now", False),
        ("t,speed", False),
        ("t,u,u", False),
        ("t,u,5", False),
        ("nan,nan,nan", False),
    ],
)
def test_names_below_the_first_rows(tmp_path: Path, line: str, found: bool) -> None:
    """A capture that began before its board printed them."""
    rows = [f"{0.01 * k:.2f},{k % 3},{2 * k}" for k in range(40)]
    (tmp_path / "log.csv").write_text("\n".join([*rows[:2], line, *rows[2:]]) + "\n")
    (tmp_path / "named.csv").write_text("\n".join(["a,b,c", *rows[:2], "t,u,y", *rows[2:]]) + "\n")
    table = read_table(tmp_path / "log.csv")
    assert (table.names == line.split(",")) == found and (len(table) == 40 or not found)
    assert read_table(tmp_path / "named.csv").names == ["a", "b", "c"]
