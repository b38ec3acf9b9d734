"""What a monitor is told by its parameters: a model, and the topics of a motor of ours or of another robot's."""

from pathlib import Path

import pytest

from motor_identification.monitoring.health import Limits
from motor_identification.monitoring.load_watch import load_watch
from motor_model.errors import MotorError
from motor_model.model_file import save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

MAPPING = "voltage: '/commands:effort[wheel]'\nposition: '/joint_states:position[wheel]'\n"


@pytest.fixture
def model(tmp_path: Path) -> str:
    path = tmp_path / "model.yaml"
    save(path, Parameters({"kv": PAPER_KV, "ka": PAPER_KA}, (), name="wheel"), {"kv": 0.01 * PAPER_KV})
    return str(path)


def test_a_motor_of_ours_is_watched_on_its_own_topics(model: str) -> None:
    watch = load_watch(model, "", "/left", Limits(3.0, 2.0))
    assert set(watch.motor.topics) > {"/left/motor/speed"} and watch.limits == Limits(3.0, 2.0)
    assert watch.model.parameters.name == "wheel" and watch.model.parameters.value("kv") == PAPER_KV


def test_another_robots_on_those_of_its_mapping(model: str, tmp_path: Path) -> None:
    (tmp_path / "mapping.yaml").write_text(MAPPING)
    watch = load_watch(model, str(tmp_path / "mapping.yaml"), "/", Limits())
    assert set(watch.motor.topics) == {"/commands", "/joint_states"}


def test_what_is_missing_is_one_sentence(model: str, tmp_path: Path) -> None:
    with pytest.raises(MotorError, match="There is no model to compare with: name one"):
        load_watch("", "", "/", Limits())
    with pytest.raises(MotorError, match="nowhere.yaml"):
        load_watch(str(tmp_path / "nowhere.yaml"), "", "/", Limits())
    with pytest.raises(MotorError, match="nothing.yaml"):
        load_watch(model, str(tmp_path / "nothing.yaml"), "/", Limits())
