"""The driver's parameters as a table, and the configuration they make."""

from collections.abc import Mapping

from motor_driver.config import Config
from motor_driver.current_limits import CurrentLimits
from motor_driver.frames.codes import BAUD, Decay, Pwm
from motor_model.errors import MotorError
from motor_model.gearing.encoder_count import read_encoder_count
from motor_ros.parameters import SHARED_PARAMETERS, Row, Value, max_voltage_row
from motor_ros.program import PLANT_PUBLISHES, PLANT_SUBSCRIBES, Program

MOST_ID = 65535

ROWS = (
    *SHARED_PARAMETERS,
    max_voltage_row(),
    Row(
        "port",
        "",
        "the board's serial port, such as /dev/ttyACM0, or a pattern; empty: the only one on USB",
        read_only=True,
    ),
    Row(
        "board_id",
        "",
        "number the board was flashed with; another is refused; empty: any board",
        read_only=True,
        any_kind=True,
    ),
    Row("baud", BAUD, "of the serial port; the firmware's", "", 9600, 4_000_000, read_only=True),
    Row("reverse_motor", False, "true: makes up for exchanged wires of the motor", read_only=True),
    Row("reverse_encoder", False, "true: makes up for exchanged channels of the encoder, A and B", read_only=True),
    Row(
        "silent_pwm",
        False,
        "PWM above hearing: 20 kHz in 100 steps on the bridge's enable, 62.5 kHz in 256 on its inputs; false: 7.8 kHz",
        read_only=True,
    ),
    Row("current_gain", 0.0, "of the current sensor on the board's A1; 0: none", "V/A", -10.0, 10.0, read_only=True),
    Row("current_offset", 2.5, "of that sensor without a current", "V", 0.0, 5.0, read_only=True),
    Row(
        "current_limit",
        0.0,
        "current that switches the board's output off, within three samples and 0.35 ms, with a sensor; 0: none does",
        "A",
        0.0,
        100.0,
        read_only=True,
    ),
    Row(
        "continuous_current",
        0.0,
        "current the motor bears for ever; more switches off after a time that goes with its square; 0: current_limit",
        "A",
        0.0,
        100.0,
        read_only=True,
    ),
    Row("overload_time", 1.0, "for which a cold motor bears current_limit", "s", 0.01, 8.0, read_only=True),
    Row("decay", "brake", "what the bridge does in the off part of a PWM period: brake or coast", read_only=True),
)
PROGRAM = Program(
    "motor_driver",
    "motor_driver",
    "The real motor: speaks to the board on a serial port, and has the topics and services of motor_sim.",
    ROWS,
    "ros2 run motor_driver motor_driver --ros-args -p port:=/dev/ttyACM0 -p edges_per_revolution:=96",
    publishes=PLANT_PUBLISHES,
    subscribes=PLANT_SUBSCRIBES,
    services=("motor/enable",),
)


def config_of(values: Mapping[str, Value]) -> Config:
    """Return the driver's configuration.

    Raises:
        MotorError: there is no such decay or board_id, the encoder's parameters or the current's limits contradict each
            other, or the current's sensor does not show the limits.
    """
    names = [decay.name.lower() for decay in Decay]
    if values["decay"] not in names:
        raise MotorError(f"there is no decay '{values['decay']}': choose {' or '.join(names)}.")
    count = read_encoder_count(values)
    return Config(
        name=str(values["name"]),
        sample_rate=float(values["sample_rate"]),
        edges_per_revolution=count.edges_per_revolution,
        single_channel=count.single_channel,
        quadrature=count.quadrature,
        gear=count.gear,
        max_voltage=float(values["max_voltage"]),
        supply_voltage=float(values["supply_voltage"]),
        board_id=_board_id(str(values["board_id"]).strip()),
        reverse_motor=bool(values["reverse_motor"]),
        reverse_encoder=bool(values["reverse_encoder"]),
        current_gain=float(values["current_gain"]),
        current_offset=float(values["current_offset"]),
        current_limits=CurrentLimits(
            float(values["current_limit"]),
            float(values["continuous_current"]),
            float(values["overload_time"]),
        ),
        stall_time=float(values["stall_time"]),
        command_timeout=float(values["command_timeout"]),
        decay=Decay[str(values["decay"]).upper()],
        pwm=Pwm.SILENT if values["silent_pwm"] else Pwm.STANDARD,
        baud=int(values["baud"]),
    )


def _board_id(text: str) -> int | None:
    if text and not (text.isascii() and text.isdigit() and int(text) <= MOST_ID):
        raise MotorError(
            f"board_id '{text}' is no number from 0 to {MOST_ID}: say the one that the board was flashed with."
        )
    return int(text) if text else None
