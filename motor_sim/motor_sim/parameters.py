"""The simulated motor's parameters as a table, and the board that they make."""

from collections.abc import Mapping

from motor_model.gearing.encoder_count import read_encoder_count
from motor_model.sensing.board import BoardConfig
from motor_model.sensing.encoder import Lines
from motor_ros.parameters import SHARED_PARAMETERS, Row, Value, max_voltage_row
from motor_ros.program import PLANT_PUBLISHES, PLANT_SUBSCRIBES, Program

PARAMETERS = (
    Row("model", "", "model file (YAML) to simulate; empty: the paper's motor", read_only=True),
    Row("edge_resolution", 4e-6, "tick of the timer that stamps edges; 0: exact", "s", 0.0, 1e-3, read_only=True),
    Row(
        "slot_irregularity",
        0.0,
        "scatter of the disc's flanks, share of a slot",
        "",
        0.0,
        0.2,
        read_only=True,
    ),
    Row(
        "resistance",
        0.0,
        "of the cold armature; with it motor/speed has a current; 0: the model file's, or none",
        "Ω",
        0.0,
        1000.0,
        read_only=True,
    ),
    Row(
        "torque_constant",
        0.0,
        "also the back-EMF constant: the rest of kv is viscous friction; 0: the model file's, or all of kv",
        "N·m/A",
        0.0,
        100.0,
        read_only=True,
    ),
    Row(
        "duty_cycle",
        0.5,
        "with quadrature 2 or 4: share of a period that a channel is high",
        "",
        0.3,
        0.7,
        read_only=True,
    ),
    Row(
        "channel_phase",
        0.25,
        "with quadrature 4: share of a period by which B is behind A",
        "",
        0.1,
        0.29,
        read_only=True,
    ),
    Row("seed", 0, "of the disc, its starting angle and missed edges", "", 0, 2**31 - 1, read_only=True),
)
PROGRAM = Program(
    "motor_sim",
    "motor_sim",
    "A simulated motor in real time, with an encoder as honest as the board's: start it instead of motor_driver.",
    (*SHARED_PARAMETERS, max_voltage_row(), *PARAMETERS),
    "ros2 run motor_sim motor_sim --ros-args -p model:=model.yaml -p sample_rate:=500.0 -r __ns:=/left",
    publishes=PLANT_PUBLISHES,
    subscribes=PLANT_SUBSCRIBES,
    services=("motor/enable",),
)


def board_config_of(values: Mapping[str, Value]) -> BoardConfig:
    """Return the simulated board.

    Raises:
        MotorError: the encoder's parameters contradict each other.
    """
    fields = ("name", "sample_rate", "edge_resolution", "slot_irregularity", "seed")
    encoder = read_encoder_count(values)
    return BoardConfig(
        **{field: values[field] for field in fields},  # type: ignore[arg-type]
        edges_per_revolution=encoder.edges_per_revolution,
        single_channel=encoder.single_channel,
        quadrature=encoder.quadrature,
        gear=encoder.gear if encoder.gear != 1 else None,
        lines=Lines(float(values["duty_cycle"]), float(values["channel_phase"])),
    )
