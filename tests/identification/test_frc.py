"""An FRC robot's drivetrain out of SysId's own log, beside what SysId's regression makes of it (benchmarks/frc.py)."""

from math import tau
from pathlib import Path

import pytest
from tiers import mark_slow

from motor_identification.identify import Request, identify
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.recording import check, recording_of

LOG = Path(__file__).resolve().parents[1] / "data" / "frc" / "drivetrain_sysid.json"
TURN = 0.4878  # [m]


@pytest.mark.parametrize(
    ("side", "kv", "ka", "ks", "regression"),
    [("left", 1.210, 0.293, 0.718, 1.197), mark_slow("right", 1.201, 0.259, 0.710, 1.161)],
)
def test_either_side_of_a_drivetrain(side: str, kv: float, ka: float, ks: float, regression: float) -> None:
    motor = next(one for one in import_log(LOG, Said()).motors if one.label == side)
    assert [run.label for run in motor.log.runs] == ["slow-forward", "slow-backward", "fast-forward", "fast-backward"]
    runs = [check(recording_of(run.samples, motor.log.info, run.label)) for run in motor.log.runs]
    fit = identify(runs, Request(("coulomb_friction",)))
    values = fit.parameters.values
    assert values["kv"] * tau / TURN == pytest.approx(kv, rel=0.01) == pytest.approx(regression, rel=0.04)
    assert values["ka"] * tau / TURN == pytest.approx(ka, rel=0.05)
    assert values["ks"] == pytest.approx(ks, rel=0.03)
    assert any("the recordings disagree" in note for note in fit.notes)
