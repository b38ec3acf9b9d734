"""A program as words for a shell."""

import subprocess
from pathlib import Path

from motor_bringup import motor
from motor_bringup.program import Program


def test_the_words_for_a_shell_mean_the_same(tmp_path: Path) -> None:
    told = {"namespace": "left", "plant": "emulated", "record": "bag"}
    for program in motor.session(told).programs:
        words = " ".join(program.command)
        assert words.startswith(f"ros2 run {program.package} {program.executable}")
        assert ("--ros-args -r __ns:=/left" in words) == program.node
    control = Program("motor_control", "motor_control", parameters={"kp": -1.0})
    done = subprocess.run(control.command, capture_output=True, text=True, timeout=120.0)
    assert done.returncode == 1 and "parameter kp (proportional gain)" in done.stderr
