"""The plan of an experiment: what is applied when, on any plant's sampling grid, and what it refuses."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.bag import contents, read_recording
from motor_identification.cli import experiment
from motor_identification.experiment import LEAD, announce, make_plan, simulate_plan, slowed
from motor_model.errors import MotorError
from motor_model.excitation import PROFILES
from motor_model.model_file import save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters, paper_motor
from motor_model.sensing.board import BoardConfig


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


@pytest.mark.parametrize(
    ("name", "volts", "limit", "said"),
    [
        ("step", 5.0, None, "for 1.1 s: up to 5 V, one way (of 12 V). The speed is not limited (--speed)."),
        (
            "staircase",
            None,
            40.0,
            "for 5.8 s: -12 to 12 V, both ways (all that the plant has; less with --voltage). "
            "The speed is limited to 40 rad/s.",
        ),
    ],
)
def test_it_says_what_will_happen_and_what_limits_it(
    name: str, volts: float | None, limit: float | None, said: str
) -> None:
    plan = make_plan(PROFILES[name], volts, 12.0, 0.005)
    assert announce(plan, "wheel", 12.0, limit) == f"Driving 'wheel' through '{name}' {said} Ctrl-C stops the motor."


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


STICKY = Parameters(
    {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4, "breakaway_voltage": 1.5, "stribeck_speed": 4.0}, ("static_friction",)
)


@pytest.mark.parametrize("name", list(PROFILES))
@pytest.mark.parametrize("motor", [paper_motor(), STICKY], ids=["paper", "sticky"])
def test_a_speed_limit_takes_the_peak_down_as_far_as_needed_and_no_further(name: str, motor: Parameters) -> None:
    plan = slowed(make_plan(PROFILES[name], None, 12.0, 0.005), motor, 40.0)
    samples = [sample for _, sample in simulate_plan(plan, motor, BoardConfig(start_angle=0.0))]
    fastest = max(abs(sample.speed) for sample in samples)
    assert 39.0 < fastest < 40.01  # the board's speed is a mean over a slot
    assert 40.0 * PAPER_KV - 1e-3 < plan.voltage < 12.0 and plan.voltage == round(plan.voltage, 3)


def test_a_limit_that_is_not_reached_changes_nothing_and_one_that_stops_everything_is_refused() -> None:
    plan = make_plan(PROFILES["step"], 6.0, 12.0, 0.005)
    assert slowed(plan, paper_motor(), 1.01 * 6.0 / PAPER_KV) is plan
    fierce = Parameters(
        {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.1, "breakaway_voltage": 2.0, "stribeck_speed": 0.5},
        ("static_friction",),
    )
    with pytest.raises(MotorError, match=r"--speed 5 rad/s leaves nothing of 'step': .* hardly moves up to 2 V, and"):
        slowed(plan, fierce, 5.0)


def test_offline_the_bag_carries_the_plan(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    save(tmp_path / "sticky.yaml", STICKY)
    arguments = ["step", "--model", str(tmp_path / "sticky.yaml"), "--output", str(tmp_path / "bag")]
    assert experiment.main([*arguments, "--speed", "30", "--voltage", "11"]) == 0
    noted = contents(tmp_path / "bag").custom_data
    volts = float(noted["experiment.voltage"])
    assert capsys.readouterr().out.rstrip().endswith(f"peak {volts:g} V")
    recording = read_recording(tmp_path / "bag")
    assert recording.voltage.max() == volts == pytest.approx(30.0 * PAPER_KV + 0.4, abs=0.1)
    assert noted["experiment.profile"] == "step" and float(noted["experiment.lead"]) == LEAD
    assert experiment.main([*arguments[:-1], str(tmp_path / "other"), "--speed", "0.001"]) == 1
    assert "allow more speed" in capsys.readouterr().err and not (tmp_path / "other").exists()
