"""Tables that LabVIEW exports from a graph."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.graph_export import name_plots
from motor_identification.logs.csv.table import Table
from motor_identification.logs.imported import import_log

COUNT = np.arange(4.0)


def _names(*names: str, shift: float = 0.0) -> list[str]:
    cells = {name: COUNT + shift * place if place % 2 == 0 else COUNT * place for place, name in enumerate(names)}
    return name_plots(Table(Path("log.txt"), np.arange(4) + 2, cells)).names


def test_plots_are_columns_and_their_times_are_one() -> None:
    given = ("Time - Speed", "Amplitude - Speed", "Time - Voltage_0", "Amplitude - Voltage_0")
    assert _names(*given) == ["Time", "Speed", "Voltage_0"]
    assert _names(*given, shift=0.01) == ["Time", "Speed", "Time - Voltage_0", "Voltage_0"]
    assert _names("Amostra - Vel", "Amplitude - Vel", "Amostra - Esf", "Amplitude - Esf") == ["Amostra", "Vel", "Esf"]


@pytest.mark.parametrize("axis", ["R (mm) ", ""])
def test_values_have_the_name_of_the_axis_that_they_share(axis: str) -> None:
    """Of a French servo's 40 columns `R (mm) - uT : tension moteur T (V)` was a position in millimetres."""
    plots = ("x : position (mm)", "u : tension moteur (V)")
    given = [f"{one}- {plot}" for plot in plots for one in ("Temps (s) ", axis)]
    assert _names(*given) == ["Temps (s)", *plots]


@pytest.mark.parametrize(
    "names",
    [
        ("Time - Speed", "Amplitude - Voltage"),
        ("Time - Speed", "Amplitude - Speed", "Temperature"),
        ("left - speed", "right - speed"),
        ("left - speed", "right - speed", "left - pwm", "right - pwm"),  # two motors
        ("t (s) - x : position", "R (mm) - x : position"),  # of one plot nobody knows
        ("Time - Speed", "Amplitude - Speed", "Time - Speed #3", "Amplitude - Speed"),
        ("t", "u", "y", "z"),
    ],
)
def test_other_tables_stay(names: tuple[str, ...]) -> None:
    assert _names(*names) == list(dict.fromkeys(names))


def test_a_graph_of_a_motor_is_read_by_its_plots(tmp_path: Path) -> None:
    """With decimal commas, and the numbers of samples for times."""
    volts = [3.0 * (k // 40 % 2) for k in range(400)]
    rows = [f"{k}\t{2.0 * u + 0.01 * (k % 7):.2f}\t{k}\t{u:.2f}".replace(".", ",") for k, u in enumerate(volts)]
    path = tmp_path / "graph.txt"
    head = "Sample - Velocity\tAmplitude - Velocity\tSample - Motor voltage\tAmplitude - Motor voltage"
    path.write_text("\n".join([head, *rows]) + "\n")
    (motor,) = import_log(path, Said(unit="rad/s", sample_period=0.01)).motors
    assert motor.log.info.sample_period == pytest.approx(0.01)
    assert max(sample.voltage for sample in motor.log.runs[0].samples) == 3.0
