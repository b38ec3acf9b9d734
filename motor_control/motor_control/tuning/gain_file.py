"""Write gains as a ROS 2 parameter file, with comments that say how they came about."""

import json
from pathlib import Path

from motor_control.tuning.design import Tuning
from motor_control.tuning.speed_feedback import OBSERVER
from motor_model.errors import MotorError
from motor_model.regular_file import say_refusal, write_text

NODE = "/**/motor_control"  # in any namespace


def gain_text(tuning: Tuning, model: Path) -> str:
    """Format the file's content; the model is named by its absolute path, so the node may be started anywhere."""
    wish, encoder, plant = tuning.wish, tuning.sight.encoder, tuning.plant
    margins = tuning.margins
    least = max(tuning.bounds, key=lambda bound: bound.time_constant)
    how = "as requested" if wish.time_constant is not None else f"limited by {least.name}"
    lines = [
        f"# Gains for the motor of {model}, by `tune`. To use them:",
        "#   ros2 run motor_control motor_control --ros-args --params-file THIS_FILE",
        f"# kv = {plant.kv:.6g} V·s/rad, ka = {plant.ka:.6g} V·s²/rad; ki/kp = kv/ka: it cancels the motor's pole.",
        f"# Closed-loop time constant {1e3 * tuning.time_constant:.3g} ms, {how}.",
        f"# {1.0 / wish.sample_period:.6g} Hz, {encoder.edges_per_revolution} edges per revolution, "
        f"speeds from {tuning.lowest_speed:.3g} rad/s on.",
        f"# Gain margin {margins.gain_db:.1f} dB, phase margin {margins.phase:.0f} deg, "
        f"delay margin {1e3 * margins.delay:.3g} ms.",
        f"{NODE}:",
        "  ros__parameters:",
        f"    kp: {_number(tuning.gains.kp)}  # V/(rad/s)",
        f"    ki: {_number(tuning.gains.ki)}  # V/rad",
        f"    speed_source: {tuning.sight.name}",
    ]
    if tuning.sight.name == OBSERVER:
        lines.append(
            f"    model: {json.dumps(str(model.absolute()), ensure_ascii=False)}  # of observer and feed-forward"
        )
        lines.append(f"    slot_irregularity: {_number(encoder.slot_irregularity)}  # share of a slot")
        lines.append("    feedforward: true  # kv, ka, friction of the model")
    return "\n".join(lines) + "\n"


def save_gains(path: Path, tuning: Tuning, model: Path, force: bool = False) -> None:
    """Write the parameter file, over another one only by `force`.

    Raises:
        MotorError: the file exists, or cannot be written.
    """
    try:
        if path.exists() and not force:
            raise MotorError(f"{path} exists already and is left as it is: choose another name, or move it away.")
        write_text(path, gain_text(tuning, model))
    except OSError as error:
        raise MotorError(f"cannot write {path} {say_refusal(error)}.") from error


def _number(value: float) -> str:
    """Six digits, and never an integer: a parameter of type double refuses one."""
    return repr(float(f"{value:.6g}"))
