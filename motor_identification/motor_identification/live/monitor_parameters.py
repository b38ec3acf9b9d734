"""The monitor's parameters as a table, and what it says of itself."""

from motor_identification.monitoring.health import Limits
from motor_ros.parameters import Row
from motor_ros.program import Program

LIMITS = Limits()
PARAMETERS = (
    Row("model", "", "model file of the motor (YAML), as identify or diagnose writes it", read_only=True),
    Row(
        "mapping",
        "",
        "file that says where voltage and motion stand on the topics of another robot (YAML); empty: motor/speed",
        read_only=True,
    ),
    Row("window", LIMITS.window, "motion that is compared at a time", "s", 1.0, 600.0, read_only=True),
    Row(
        "tolerance",
        LIMITS.tolerance,
        "residual as a share of the RMS speed, up to which the motor fits however quiet its sensor is",
        "",
        0.0,
        0.4,
        read_only=True,
    ),
)
PROGRAM = Program(
    "motor_identification",
    "monitor",
    "Watches a running motor, ours or another robot's by a mapping: says on motor/health and /diagnostics whether it\n"
    "still moves as its model says, and which parameters have changed. It commands nothing.",
    PARAMETERS,
    "ros2 run motor_identification monitor --ros-args -p model:=model.yaml -p mapping:=mapping.yaml",
    publishes=("motor/health", "/diagnostics"),
    subscribes=("motor/speed", "motor/info"),
)
