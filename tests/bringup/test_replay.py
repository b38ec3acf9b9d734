"""A recording beside its simulation."""

from pathlib import Path

import pytest

from motor_bringup import replay

BAGS = Path(__file__).resolve().parents[2] / "bags"


def test_replay_takes_the_motor_as_it_was_recorded() -> None:
    session = replay.session({"bag": str(BAGS / "emulated"), "loop": "true", "start": "1.5"})
    (simulated,), (play,) = session.programs, session.steps
    assert simulated.namespace == "simulated" and simulated.remappings == (("motor/voltage", "/motor/voltage"),)
    expected = {"max_voltage": 9.0, "edges_per_revolution": 96, "single_channel": True, "name": "motor_simulated"}
    assert {name: simulated.parameters[name] for name in expected} == expected
    assert simulated.parameters["sample_rate"] == pytest.approx(200.0) and play.arguments[1:] == (
        "--start-offset",
        "1.5",
        "--loop",
    )
    log = (Path(__file__).resolve().parents[2] / "motor_sim" / "motor_sim" / "node.py").read_text(encoding="utf-8")
    assert f'f"{session.ready} ' in log  # what play waits for is what motor_sim says
