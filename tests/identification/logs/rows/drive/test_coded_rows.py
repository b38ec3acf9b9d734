"""Rows whose duty is a code."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log

DUTY = np.repeat([0, 120, 255, 1000, -255, 60, 1000, 0], 40)
SPEED = np.where(DUTY == 1000, 5.0, DUTY / 10.0)


@pytest.mark.parametrize(("code", "runs", "most"), [(1000, 2, 12.0), (-1023, 1, 12.0)])
def test_a_log_with_a_code_for_a_free_motor(tmp_path: Path, code: int, runs: int, most: float) -> None:
    """The plainest line: 255 is full, and what the motor does while it runs free is no answer to 47 V."""
    rows = zip(0.01 * np.arange(len(DUTY)), np.where(DUTY == 1000, code, DUTY), SPEED, strict=True)
    (tmp_path / "log.csv").write_text("t,pwm,rpm\n" + "".join(f"{t:.2f},{u},{w:g}\n" for t, u, w in rows))
    (motor,) = import_log(tmp_path / "log.csv", Said(supply_voltage=12.0)).motors
    volts = [sample.voltage for run in motor.log.runs for sample in run.samples]
    assert len(motor.log.runs) == runs and max(map(abs, volts)) == pytest.approx(most)
    told = [line for line in motor.log.findings if "a code and no duty" in line]
    assert len(told) == (runs > 1) == (len(volts) < len(DUTY))
    if told:
        assert told[0].startswith("Left out: 80 rows where pwm is 1000, a code and no duty: 3 runs, a bag each")
