"""Tabulate the controller's parameters."""

from motor_control.configuration import MEASURED, OBSERVER
from motor_ros.parameters import Row
from motor_ros.program import Program

# ki / kp = kv/ka of the paper's motor: the zero of the law cancels its pole. Simulated at 200 Hz with 0.4 V of
# friction, 0 -> 100, 100 -> 40 and 0 -> 3 rad/s settle within 3 % in 0.21, 0.24 and 0.30 s, and a load of 1 V at 100
# rad/s costs 3.3 rad/s. Half the gains let it cost 4.8; twice the gains keep 3 rad/s swinging by 3 rad/s, because below
# 5 rad/s the encoder is later than such a loop is fast.
ROWS = (
    Row("kp", 0.2, "proportional gain", "V/(rad/s)", 0.0, 1000.0),
    Row("ki", 2.5, "integral gain", "V/rad", 0.0, 10_000.0),
    Row("voltage_limit", 12.0, "largest voltage to ask for, if max_voltage is not less", "V", 0.0, 100.0, checked=True),
    Row(
        "sample_timeout",
        0.1,
        "silence on motor/speed that stops the motor; at least two samples",
        "s",
        0.002,
        10.0,
        checked=True,
    ),
    Row(
        "reference_rate_limit",
        -1.0,
        "slope at which a new reference is approached; 0: at once; -1: at once without a model, and with one no faster "
        "than full voltage brakes the motor at top speed",
        "rad/s^2",
        -1.0,
        1e6,
    ),
    Row(
        "reversal_speed",
        0.0,
        "single channel, measured: no voltage against a faster motion; 0: 6 % of the top speed, or 150 edges/s",
        "rad/s",
        0.0,
        1e4,
        checked=True,
    ),
    Row(
        "stall_time",
        0.5,
        "full voltage without an edge for this long stops the motor; 0: never",
        "s",
        0.0,
        60.0,
        checked=True,
    ),
    Row(
        "slot_irregularity",
        0.01,
        "scatter of the disc's slots that the observer assumes, share of a slot",
        "-",
        0,
        0.2,
        checked=True,
    ),
    Row(
        "plug_limit",
        1.0,
        "voltage against the back-EMF in a reversal, share of voltage_limit; 2: any",
        "-",
        0.0,
        2.0,
        checked=True,
    ),
    Row(
        "latency_limit",
        0.02,
        "age of a sample that is too old to act on; at least two samples",
        "s",
        0.002,
        10.0,
        checked=True,
    ),
    Row("reference_timeout", 0.0, "age at which a reference is dropped; 0: it holds", "s", 0.0, 3600.0, checked=True),
    Row(
        "joint_command_timeout",
        0.5,
        "silence on motor/joint_command that stops the motor; 0: it holds",
        "s",
        0.0,
        60.0,
        checked=True,
    ),
    Row(
        "speed_source",
        MEASURED,
        f"speed that the law uses: {MEASURED} (by the plant) or {OBSERVER} (by the model)",
        checked=True,
    ),
    Row(
        "model", "", "model file (YAML) for observer and feed-forward, as identify writes it; empty: none", checked=True
    ),
    Row("feedforward", False, "add the voltage that the model needs for the reference"),
    Row("joint", "", "name of this motor in motor/joint_command; empty: the motor's own, as motor/info says it"),
    Row(
        "effort_as_voltage", False, "efforts of motor/joint_command are voltages [V]; false: its velocities are obeyed"
    ),
)
PROGRAM = Program(
    "motor_control",
    "motor_control",
    "Holds the speed on motor/reference: answers every sample of a plant with a voltage (PI, observer, feed-forward).\n"
    "Also takes JointState commands, as ros2_control sends them, and with observer and two channels an angle.\n"
    "Without a reference it leaves the motor alone; Ctrl-C leaves the motor at 0 V.",
    ROWS,
    "ros2 run motor_control motor_control --ros-args -p kp:=0.1 -p model:=model.yaml -p speed_source:=observer",
    publishes=("motor/voltage", "motor/control_state", "/diagnostics"),
    subscribes=("motor/speed", "motor/info", "motor/reference", "motor/position_reference", "motor/joint_command"),
    services=("motor/reset", "motor/release"),
)
