"""Names of columns: the line above the rows, a line of units below it, names over their cells."""

import pytest

from motor_identification.logs.csv.dialect import find_dialect
from motor_identification.logs.csv.header import find_header

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
        (("1;2;3;4;5",), ()),
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
