"""Settings of a running controller: changes that work, changes that do not, what the plant says, a model on the way."""

import time
from pathlib import Path

import pytest
from bench_board import DEFAULTS, motor

from motor_control.settings import Settings
from motor_model.errors import MotorError
from motor_model.model_file import save
from motor_model.sample import Info


def test_a_change_that_does_not_work_leaves_everything() -> None:
    settings = Settings(DEFAULTS)
    settings.change({"kp": 0.5})
    with pytest.raises(MotorError, match="kp"):
        settings.change({"kp": -1.0, "ki": 9.0})
    assert (settings.config.gains.kp, settings.config.gains.ki) == (0.5, DEFAULTS["ki"])


def test_the_plant_bounds_the_voltage() -> None:
    settings = Settings(DEFAULTS)
    assert not settings.meet(Info(max_voltage=6.0)) and not settings.meet(Info(max_voltage=6.0))
    assert settings.config.voltage_limit == 6.0
    assert settings.meet(Info(max_voltage=24.0))  # it is another one
    assert settings.config.voltage_limit == 12.0


@pytest.mark.parametrize(
    ("info", "words"),
    [
        (Info(edges_per_revolution=0), "edges_per_revolution = 0"),
        (Info(sample_period=0.0), "sample_period = 0"),
        (Info(sample_period=float("nan")), "sample_period = nan"),
        (Info(max_voltage=0.0), "max_voltage = 0"),
        (Info(edge_resolution=-1.0), "edge_resolution = -1"),
    ],
)
def test_what_a_plant_cannot_be_is_a_sentence(info: Info, words: str) -> None:
    settings = Settings(DEFAULTS)
    settings.meet(info)
    assert words in settings.config.unusable and settings.config.unusable.endswith("then.")
    settings.meet(Info())
    assert settings.config.unusable == ""


def test_what_was_refused_is_0_volt_until_the_plant_says_otherwise() -> None:
    settings = Settings(DEFAULTS)
    settings.meet(Info())
    settings.refuse("It cannot be.")
    assert settings.config.unusable == "It cannot be."
    settings.change({"kp": 0.3})
    assert settings.config.unusable == "It cannot be." and settings.config.gains.kp == 0.3
    settings.meet(Info())
    assert settings.config.unusable == "" and settings.config.gains.kp == 0.3


def test_a_model_named_in_a_running_loop_is_taken_once_it_is_ready(tmp_path: Path) -> None:
    path = tmp_path / "model.yaml"
    save(path, motor())
    settings = Settings({**DEFAULTS, "speed_source": "observer"})
    settings.meet(Info())
    settings.change({"model": str(path)})
    deadline = time.monotonic() + 120.0
    while settings.config.observer is None and time.monotonic() < deadline:
        assert "prepared" in settings.config.note
        settings.refresh()
        time.sleep(0.01)
    assert settings.config.observer is not None and settings.config.note == ""
    with pytest.raises(MotorError, match="cannot read the model file"):
        settings.change({"model": str(tmp_path / "nowhere.yaml")})
    assert settings.config.observer is not None


def test_nothing_is_driven_before_the_plant_has_said_what_it_is() -> None:
    """With stray edges on a lost line a motor ran for ever, since nobody knew how wide a slot is."""
    settings = Settings(DEFAULTS)
    settings.change({"kp": 0.5})
    assert "No motor/info has come yet" in settings.config.unusable
    settings.meet(Info())
    assert settings.config.unusable == ""


def test_who_else_is_there_can_bar_it() -> None:
    settings = Settings(DEFAULTS)
    settings.meet(Info())
    settings.bar("Another motor would be driven.")
    settings.change({"kp": 0.5})
    settings.meet(Info(max_voltage=6.0))
    assert settings.config.unusable == "Another motor would be driven." and settings.config.voltage_limit == 6.0
    settings.bar("")
    assert settings.config.unusable == ""
