"""Stamps and names that serial monitors put into their lines."""

import pytest

from motor_identification.logs.csv.monitor import take_apart


def test_stamps_go_behind_the_cells() -> None:
    for rest, moved in (
        ("5,1.5", "5,1.5,12:00:00.100"),
        ("5\t1,5", "5\t1,5\t12:00:00.100"),
        ("5 2", "5 2 12:00:00.100"),
    ):
        taken = take_apart([f"12:00:00.100 -> {rest}"] * 5)
        assert taken.stamped and not taken.names and list(taken.lines) == [moved] * 5
    assert list(take_apart(["12:00:00.1 -> a,b", *["12:00:00.1 -> 1,2"] * 5]).lines)[0] == "a,b,received_time"


def test_names_go_before_all_rows_and_lines_keep_their_numbers() -> None:
    taken = take_apart(["Ready", *["pwm:5 rpm:-1.5"] * 9, "rpm:1"])
    assert taken.names == ("pwm", "rpm")
    assert list(taken.lines) == ["Ready", *["5;-1.5"] * 9, "rpm:1"]
    both = take_apart(["12:00:00.100 -> pwm:5, rpm:2"] * 5)
    assert both.names == ("pwm", "rpm", "received time") and both.lines[0] == "5;2;12:00:00.100"


def test_names_in_cells_of_their_own_go_before_all_rows() -> None:
    """As a robot's Arduino printed them: its first line is the terminal's, its last one cut off."""
    rows = ["t,340,PWM,0,Enc1,-0.50"] * 9
    taken = take_apart(["=~=~= PuTTY log 2018.05.10 =~=~=", *rows, "t,350,PW"])
    assert taken.names == ("t", "PWM", "Enc1")
    assert list(taken.lines) == ["=~=~= PuTTY log 2018.05.10 =~=~=", *["340;0;-0.50"] * 9, "t,350,PW"]
    assert take_apart(["pwm 5 rpm 1e2"] * 5).names == ("pwm", "rpm")
    for other in ("t,340,t,1", "340,t,1,x", "a,1", "a,1,b", "run,a,speed,b"):
        assert not take_apart([other] * 9).names


def test_units_that_nobody_knows_are_kept_behind_the_names() -> None:
    """As of a thrust stand: a unit stands at its number, whatever it is; words apart from it are none."""
    rows = ["PWM Percent: 5.00%, Thrust: -0.03lbs, Battery Voltage: 26.1V, RPM: 90"] * 9
    taken = take_apart(["=~=~= PuTTY log =~=~=", "P.07A, RPM: 0", *rows])
    assert taken.names == ("PWM Percent [%]", "Thrust [lbs]", "Battery Voltage [V]", "RPM")
    assert taken.lines[2] == "5.00;-0.03;26.1;90"
    assert not take_apart(["Thrust: 3 lbs, RPM: 90"] * 9).names and not take_apart(["a:1, b:2 retries"] * 9).names


def test_behind_a_tab_a_name_of_several_words_begins_and_a_unit_is_all_of_its_cell() -> None:
    """As an Arduino printed them: of `Pulsos por periodo` the first word was the unit of the number before."""
    row = "Tempo: 0.02s\tVelocidade do Motor: -77 RPM\tPWM: 236.00\t Pulsos por periodo: 4"
    taken = take_apart([row] * 9)
    assert taken.names == ("Tempo [s]", "Velocidade do Motor [rpm]", "PWM", "Pulsos por periodo")
    assert taken.lines[0] == "0.02;-77;236.00;4"
    assert take_apart(["PWM: 236\tV motor: 5"] * 9).names == ("PWM", "V motor")
    assert take_apart(["w: 3\trpm\tu: 4\tV"] * 9).names == ("w [rpm]", "u [V]")
    assert take_apart(["w: 3 rpm u: 4 V"] * 9).names == ("w [rpm]", "u [V]")
    assert not take_apart(["PWM: 236 Pulsos por periodo: 4"] * 9).names  # by blanks alone nothing tells where it begins


@pytest.mark.parametrize(
    ("row", "names"),
    [
        ("Time: 0.01\ts Speed: 100\trpm Voltage: 5\tV", ("Time [s]", "Speed [rpm]", "Voltage [V]")),
        ("Speed: 1\trpm Target: 2\trpm Voltage: 9\tV t: 0", ("Speed [rpm]", "Target [rpm]", "Voltage [V]", "t")),
        ("Command: 9\tV Battery: 12\tV Motor speed: 3", ("Command [V]", "Battery [V]", "Motor speed")),
        ("PWM: 9\t% Encoder: 3\trpm t: 1", ("PWM [%]", "Encoder [rpm]", "t")),
        ("PWM: 9\tV speed: 3", ("PWM", "V speed")),  # no share is in volts
        ("speed: 9\tV position: 3", ("speed", "V position")),  # nor a speed
        ("u: 9\tV motor: 3", ("u", "V motor")),  # a motor is nothing that is logged
        ("u: 9\tkp gain: 3", ("u", "kp gain")),  # no unit
    ],
)
def test_a_known_unit_behind_a_tab_is_one_of_what_the_name_before_it_tells(row: str, names: tuple[str, ...]) -> None:
    taken = take_apart([row] * 9)
    assert taken.names == names and len(taken.lines[0].split(";")) == len(names)


def test_other_tables_are_left_alone() -> None:
    for line in ("0,1,2", "12:00:00.5,1,2", "a:1", "a:1 b", "a=1;a=2", "x: " * 50_000):
        taken = take_apart([line] * 10)
        assert list(taken.lines) == [line] * 10 and not taken.names and not taken.stamped
