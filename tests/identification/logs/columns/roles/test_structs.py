"""A log of several experiments, each a struct: the one that was named has its own voltage and times."""

import pytest
from log_columns import table

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.roles.structs import keep_struct, times_of_struct
from motor_identification.logs.columns.said import Pair, Said

FIELDS = {"t": "t", "th_ref": "r", "th_meas": "y", "w_meas": "y", "u": "u"}
EXPERIMENTS = {f"data.{one}.{field}": kind for one in ("slow", "samplingT1") for field, kind in FIELDS.items()}


@pytest.mark.parametrize("one", ["slow", "samplingT1"])
@pytest.mark.parametrize("said", [{"motion": "data.{}.th_meas"}, {"motion": "data.{}.th_meas", "voltage": "data.{}.u"}])
def test_its_motion_tells_an_experiment(one: str, said: dict[str, str]) -> None:
    roles = find_roles(table(**EXPERIMENTS), Said(**{key: name.format(one) for key, name in said.items()}))
    assert roles.time == f"data.{one}.t"
    assert roles.pairs == (Pair("", f"data.{one}.u", f"data.{one}.th_meas"),)


def test_its_voltage_tells_an_experiment() -> None:
    alone = {name: kind for name, kind in EXPERIMENTS.items() if not name.endswith("w_meas")}
    roles = find_roles(table(**alone), Said(voltage="data.samplingT1.u"))
    assert roles.pairs == (Pair("", "data.samplingT1.u", "data.samplingT1.th_meas"),)
    assert roles.time == "data.samplingT1.t"


def test_a_struct_that_is_one_signal_keeps_those_of_others() -> None:
    headings = [read_heading(name) for name in ("motor.voltage", "motor.current", "encoder.angle", "t")]
    assert keep_struct(headings, "motor.voltage") == headings
    assert keep_struct(headings, "encoder.angle") == headings
    assert keep_struct(headings, "t") == headings, "no path"
    assert times_of_struct(["a.t", "b.t"], "b.u") == ["b.t"] and times_of_struct(["a.t", "t"], "c.u") == ["a.t", "t"]
