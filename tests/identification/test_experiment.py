"""The plan of an experiment: what is applied when, on any plant's sampling grid, and what it refuses."""

import numpy as np
import pytest

from motor_identification.experiment import LEAD, make_plan, simulate_plan
from motor_model.board import BoardConfig
from motor_model.errors import MotorError
from motor_model.excitation import PROFILES
from motor_model.parameters import PAPER_KV, paper_motor


@pytest.mark.parametrize("rate", [50.0, 100.0, 150.0, 200.0, 333.0, 700.0, 1000.0])
@pytest.mark.parametrize("name", ["step", "reversals", "rich"])
def test_a_plan_rests_first_and_then_starts_on_the_sample(name: str, rate: float) -> None:
    plan = make_plan(PROFILES[name], 9.0, 12.0, 1.0 / rate)
    start = int(np.flatnonzero(plan.commands)[0])
    assert start == np.ceil(LEAD * rate - 1e-6)
    assert abs(len(plan.commands) - plan.duration * rate) <= 1.0
    assert np.max(np.abs(plan.commands)) == pytest.approx(9.0, rel=1e-12)
    assert plan.duration == pytest.approx(0.1 + PROFILES[name].duration)


def test_a_command_belongs_to_the_nearest_sample_and_ends() -> None:
    plan = make_plan(PROFILES["step"], None, 12.0, 0.005)
    assert plan.voltage == 12.0
    assert [plan.command(t) for t in (0.0, 0.0951, 0.0976, 0.1, 0.5)] == [0.0, 0.0, 12.0, 12.0, 12.0]
    assert plan.command(1.0949) == 12.0
    assert plan.command(1.105) is None and plan.command(-0.1) is None and plan.command(1e9) is None


@pytest.mark.parametrize("volts", [0.0, -3.0, 12.1, float("nan"), float("inf")])
def test_a_voltage_that_the_plant_does_not_have_is_refused(volts: float) -> None:
    with pytest.raises(MotorError, match=r"--voltage .* is not between 0 and the plant's max_voltage, 12 V\."):
        make_plan(PROFILES["step"], volts, 12.0, 0.005)


def test_offline_the_board_sees_the_plan() -> None:
    plan = make_plan(PROFILES["step"], 10.0, 12.0, 0.005)
    pairs = list(simulate_plan(plan, paper_motor(), BoardConfig(start_angle=0.0)))
    assert [command for command, _ in pairs] == [sample.voltage for _, sample in pairs] == plan.commands.tolist()
    assert all(sample.edge_count == 0 for _, sample in pairs[:21]) and pairs[-1][1].edge_count > 1900
    assert pairs[-1][1].speed == pytest.approx(10.0 / PAPER_KV, rel=0.01)
