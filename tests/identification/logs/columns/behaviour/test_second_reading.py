"""Names that mean two things, by what stands beside them."""

from pathlib import Path

import log_columns
import numpy as np
import pytest
from log_columns import TIME, answer, table

from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError


def test_the_outputs_of_one_input() -> None:
    both = find_roles(table(t="t", input="u", outputL="y", outputR="y"), Said())
    assert both.pairs == (Pair("left", "input", "outputL"), Pair("right", "input", "outputR"))
    loop = find_roles(table(t="t", setpoint="r", input="y", output="u"), Said())
    assert loop.pairs == (Pair("", "output", "input"),)
    spanish = find_roles(table(Tiempo="t", Referencia="r", Entrada="y", Salida="u"), Said())
    assert spanish.pairs == (Pair("", "Salida", "Entrada"),)
    plant = find_roles(table(Zeit="t", Eingang="u", Ausgang="y"), Said())
    assert plant.pairs == (Pair("", "Eingang", "Ausgang"),)
    curve = find_roles(table(Masukan="t", Kecepatan="y"), Said())  # a static curve: its drive rises as a clock does
    assert (curve.time, curve.pairs) == (None, (Pair("", "Masukan", "Kecepatan"),))


def test_the_ends_of_a_system_that_were_normed() -> None:
    """`output_norm` is the speed again, and what drives is the input, if it is the same in every row."""
    columns = {"time_ms": "t", "speed_rpm": "y", "time_s": "t", "input_norm": "u", "output_norm": "y"}
    assert find_roles(table(**columns), Said()).pairs == (Pair("", "input_norm", "speed_rpm"),)
    told = find_roles(table(t="t", output_bridge="u", speed="y"), Said())
    assert told.pairs == (Pair("", "output_bridge", "speed"),)


def test_an_output_beside_what_drives_is_the_motors() -> None:
    effort = find_roles(table(Tempo="t", Saída="y", Erro="r", Esforço="u"), Said())
    assert effort.pairs == (Pair("", "Esforço", "Saída"),)
    assert find_roles(table(t="t", ref="r", output="y", pwm="u"), Said()).pairs == (Pair("", "pwm", "output"),)
    assert find_roles(table(t="t", output="u", speed="y"), Said()).pairs == (Pair("", "output", "speed"),)
    with pytest.raises(RecordingError, match="the duty\\? Say --voltage and one of output, pwm"):
        find_roles(table(t="t", output="u", pwm="u", speed="y"), Said())


def test_an_output_alone_is_the_motors() -> None:
    """What is missing then is what drives it."""
    roles = find_roles(table(Tempo="t", Saída="y", Erro="r", Pwm="u"), Said(voltage="Pwm"))
    assert roles.pairs == (Pair("", "Pwm", "Saída"),)
    for columns in ({"Saída": "y"}, {"Referencia": "r", "Saída": "y", "Erro": "r"}):
        with pytest.raises(RecordingError, match="no column is the voltage or duty"):
            find_roles(table(Tempo="t", **columns), Said())
    assert find_roles(table(t="t", output="u", x="y"), Said()).pairs == (Pair("", "output", "x"),)


def test_current_beside_a_target_is_what_is_present() -> None:
    roles = find_roles(table(t="t", target="r", current="y", pwm="u"), Said())
    assert (roles.pairs, roles.current) == ((Pair("", "pwm", "current"),), None)
    four = find_roles(table(t="t", CURRENT_M1="y", CURRENT_M2="y", PWM_M1="u", PWM_M2="r", DESIRED_M1="r"), Said())
    assert four.pairs == (Pair("1", "PWM_M1", "CURRENT_M1"), Pair("2", "PWM_M2", "CURRENT_M2"))
    measured = find_roles(table(t="t", target="r", current="y", pwm="u", speed="y"), Said())
    assert (measured.pairs[0].motion, measured.current) == ("speed", "current")
    with pytest.raises(RecordingError, match="which column is the motion.* one of loop"):
        find_roles(table(t="t", pwm="u", current="y", loop="r"), Said())
    with pytest.raises(RecordingError, match="no column is the motion"):
        find_roles(table(t="t", pwm="u", target="r", current_mA="y"), Said())


def test_v_beside_a_drive_is_the_velocity() -> None:
    """`vLeft` beside `powerPctLeft`: it changes while the drive stays; a voltage that was measured does not."""
    both = find_roles(
        table(t="t", powerPctLeft="u", powerPctRight="r", vLeft="y", vMouse="y", vRight="y"), Said()
    ).pairs
    assert both == (Pair("left", "powerPctLeft", "vLeft"), Pair("right", "powerPctRight", "vRight"))
    assert find_roles(table(t="t", u="u", v="y"), Said()).pairs == (Pair("", "u", "v"),)
    assert find_roles(table(t="t", pwm="u", v="u", x="y"), Said()).pairs == (Pair("", "v", "x"),)
    assert find_roles(table(t="t", pwm="u", v="u", omega="y"), Said()).pairs == (Pair("", "v", "omega"),)
    with pytest.raises(RecordingError, match="which column is the motion"):
        find_roles(table(t="t", pwm="u", v="r"), Said())
    with pytest.raises(RecordingError, match="which column is the motion"):
        find_roles(table(t="t", pwm="u", v="b"), Said())


@pytest.mark.parametrize(
    ("beside", "moves"),
    [
        ({"seg": np.arange(200) // 40, "a": None}, True),  # parts of a log, and the velocity's derivative
        ({"seg": np.arange(200) // 15}, False),  # thirteen changes: a coarse position may be as slow
        ({"q": np.sin(TIME * 31.0)}, False),
    ],
)
def test_v_beside_what_is_no_motion_is_the_velocity(beside: dict[str, np.ndarray | None], moves: bool) -> None:
    drive = np.repeat([3.0, -2.0, 5.0, 1.0], 50)
    speed = answer(drive)
    others = {name: np.gradient(speed) / 0.01 if cells is None else cells for name, cells in beside.items()}
    log = log_columns.columns(t=TIME, u=drive, v=speed, **others)
    if moves:
        assert find_roles(log, Said()).pairs == (Pair("", "u", "v"),)
        return
    with pytest.raises(RecordingError, match="which column is the|voltage"):
        find_roles(log, Said())


def sine_driven(tau: float, rough: float) -> Table:
    """A sine of 1 Hz, and two speeds of a motor with this time constant [s], or the voltage itself for 0."""
    drive = 3.0 * np.sin(2.0 * np.pi * TIME)
    phase = np.arctan(2.0 * np.pi * tau)
    noise = np.random.default_rng(4).normal(0.0, rough, (2, 200))
    one, other = 5.0 * np.cos(phase) * np.sin(2.0 * np.pi * TIME - phase) + noise
    return log_columns.columns(t=TIME, u=drive, v1=one, v2=other)


@pytest.mark.parametrize(("tau", "rough", "moves"), [(0.06, 0.1, True), (0.03, 0.1, False), (0.0, 1.0, False)])
def test_v_under_a_sine_is_the_velocity_where_it_goes_its_own_way(tau: float, rough: float, moves: bool) -> None:
    """It is late by more than a measured voltage could be, which may be noisy besides."""
    log = sine_driven(tau, rough)
    if moves:
        assert find_roles(log, Said()).pairs == (Pair("1", "u", "v1"), Pair("2", "u", "v2"))
        assert find_roles(log, Said(motion="v2")).pairs == (Pair("", "u", "v2"),)
        return
    with pytest.raises(RecordingError, match="which column is the motion"):
        find_roles(log, Said())


def test_a_voltage_that_sags_and_comes_some_rows_late_is_no_velocity() -> None:
    log = sine_driven(0.0, 0.0)
    volts = np.roll(log.numbers("u"), 2)
    volts *= 1.0 - 0.2 * np.abs(volts) / 3.0
    with pytest.raises(RecordingError, match="which column is the motion"):
        find_roles(log_columns.columns(t=TIME, u=log.numbers("u"), v=volts), Said())


def test_a_name_with_an_r_behind_that_of_a_motion_is_its_reference() -> None:
    assert find_roles(table(t="t", u="u", x="y", xr="n"), Said()).pairs == (Pair("", "u", "x"),)
    assert find_roles(table(t="t", u="u", theta="y", rtheta="r"), Said()).pairs == (Pair("", "u", "theta"),)
    for others in ({"xl": "n"}, {"lx": "n"}):  # left and right
        with pytest.raises(RecordingError, match="one of x, xr"):
            find_roles(table(t="t", u="u", x="y", xr="n", **others), Said())
    assert find_roles(table(t="t", u="u", xr="y"), Said()).pairs == (Pair("", "u", "xr"),)


def test_v_is_the_velocity_of_a_position_beside_it() -> None:
    drive = np.repeat([3.0, -2.0, 5.0, 1.0], 50)
    speed = answer(drive)
    cells = {"t": TIME, "u": drive, "v": speed, "theta": np.cumsum(speed) * 0.01}
    assert find_roles(log_columns.columns(**cells), Said()).pairs == (Pair("", "u", "theta"),)
    with pytest.raises(RecordingError, match="which column is the voltage"):
        find_roles(log_columns.columns(**{**cells, "v": np.flip(speed)}), Said())
    still = {**cells, "v": np.zeros(200)}
    assert find_roles(log_columns.columns(**still), Said()).pairs == (Pair("", "u", "theta"),)


def test_a_pulse_of_two_levels_drives_and_counts_nothing() -> None:
    pulse = np.where(np.sin(TIME * 3.0) > 0.0, 12.0, 0.0)
    cells = {"t": TIME, "pulse": pulse, "rad": answer(pulse)}
    assert find_roles(Table(Path("log.csv"), np.arange(2, 202), cells), Said()).pairs == (Pair("", "pulse", "rad"),)
    counted = {**cells, "pulse": np.arange(200.0)}
    with pytest.raises(RecordingError):
        find_roles(Table(Path("log.csv"), np.arange(2, 202), counted), Said())


def test_a_bare_input_beside_a_control_signal_is_what_the_controller_is_told() -> None:
    loop = find_roles(table(time="t", encoder="y", inputSignal="r", controlSignal="u"), Said())
    assert loop.pairs == (Pair("", "controlSignal", "encoder"),)
    assert find_roles(table(time="t", encoder="y", inputSignal="u"), Said()).pairs[0].voltage == "inputSignal"
    volts = find_roles(table(time="t", encoder="y", **{"input voltage": "u"}, control="r"), Said())
    assert volts.pairs[0].voltage == "input voltage"
    still = find_roles(table(time="t", encoder="y", input="u", control="0"), Said())
    assert still.pairs[0].voltage == "input"
