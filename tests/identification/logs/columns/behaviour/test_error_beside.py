"""What is measured, by the error beside it."""

import numpy as np
import pytest
from log_columns import columns
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.error_beside import measured_beside_error
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.vocabulary import Quantity
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]

TIME = np.arange(200) * 0.02
SEEDS = range(4_350_000, 4_350_006)


def control(seed: int, gain: float = 0.4) -> tuple[Floats, Floats, Floats]:
    """Set-points that are held, what a loop measures, and what its controller puts out, each of shape (K,)."""
    rng = np.random.default_rng(seed)
    wanted = np.repeat(rng.uniform(-90.0, 90.0, 5), 40)
    angle, output, speed = np.zeros(200), np.zeros(200), 0.0
    for k in range(200):
        output[k] = gain * (wanted[k] - angle[k])
        speed += 0.3 * (0.4 * output[k] - speed)
        if k < 199:
            angle[k + 1] = angle[k] + speed
    return wanted, angle, output


def told(table: Table) -> list[str]:
    """The columns that are read as motion."""
    found = measured_beside_error(table, [read_heading(name) for name in table.names if name != "t"])
    return [one.name for one in found or () if one.quantity is Quantity.POSITION]


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("digits", [12, 2])
def test_what_makes_a_set_point_with_its_error_is_measured(seed: int, sign: float, digits: int) -> None:
    wanted, angle, output = control(seed)
    error = np.round(sign * (wanted - angle), digits)
    for name in ("Saída Pan", "output", "z", "input"):
        table = columns(t=TIME, **{name: np.round(angle, digits), "erro": error, "command": np.round(output, digits)})
        assert told(table) == [name]
        assert find_roles(table, Said()).pairs == (Pair("", "command", name),)


def test_axes_that_have_names_are_motors() -> None:
    both = {}
    for axis, seed in (("Pan", 4_350_010), ("Tilt", 4_350_011)):
        wanted, angle, output = control(seed)
        both |= {f"Saída {axis}": angle, f"Erro {axis}": wanted - angle, f"Esforço {axis}": output}
    pairs = find_roles(columns(Tempo=TIME, **both), Said()).pairs
    assert pairs == (Pair("pan", "Esforço Pan", "Saída Pan"), Pair("tilt", "Esforço Tilt", "Saída Tilt"))


@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_controller_puts_out_is_not_measured(seed: int) -> None:
    wanted, angle, output = control(seed)
    error = wanted - angle
    assert told(columns(t=TIME, erro=error, output=output)) == []  # by a gain of 0.4
    wanted, angle, output = control(seed, 1.0)
    error = wanted - angle
    for alike in (output, np.clip(output, -60.0, 60.0), np.rint(output)):
        assert told(columns(t=TIME, erro=error, output=alike)) == []
    assert told(columns(t=TIME, erro=error, output=output + 3.0, z=angle)) == []  # both would do


def test_a_motion_with_a_name_and_a_set_point_that_never_stays_are_left() -> None:
    wanted, angle, output = control(4_350_020)
    named = columns(t=TIME, z=angle, erro=wanted - angle, output=output, speed=output)
    assert measured_beside_error(named, [read_heading(name) for name in named.names]) is None
    swept = 90.0 * np.sin(TIME * 3.0)
    assert told(columns(t=TIME, z=angle, erro=swept - angle, output=output)) == []
