"""The controller's parameters as a table, and the configuration they make with what the plant says of itself."""

from collections.abc import Mapping
from dataclasses import replace

from motor_control.controller import controller, faults, pi
from motor_model.errors import MotorError
from motor_model.model_file import load
from motor_model.parameters import Parameters
from motor_model.sample import Info, Measurement
from motor_ros.parameters import Row, Value
from motor_ros.program import Program

MEASURED, OBSERVER = "measured", "observer"

# ki / kp = kv / ka of the paper's motor: the zero of the law cancels its pole. Simulated at 200 Hz with 0.4 V of
# friction, 0 -> 100, 100 -> 40 and 0 -> 3 rad/s settle within 3 % in 0.21, 0.24 and 0.30 s, and a load of 1 V at 100
# rad/s costs 3.3 rad/s. Half the gains let it cost 4.8; twice the gains keep 3 rad/s swinging by 3 rad/s, because below
# 5 rad/s the encoder is later than such a loop is fast.
# reversal_speed: at 10 rad/s the paper's motor stops within a slot, so one or two edges show that it has turned.
NUMBERS = (
    Row("kp", 0.2, "proportional gain", "V/(rad/s)", 0.0, 1000.0),
    Row("ki", 2.5, "integral gain", "V/rad", 0.0, 10_000.0),
    Row("voltage_limit", 12.0, "largest voltage to ask for, if max_voltage is not less", "V", 0.0, 100.0),
    Row("sample_timeout", 0.1, "silence on motor/speed that stops the motor; at least two samples", "s", 0.002, 10.0),
    Row("reference_rate_limit", 0.0, "slope at which a new reference is approached; 0: at once", "rad/s^2", 0.0, 1e6),
    Row("reversal_speed", 10.0, "single channel, measured: no voltage against a faster motion", "rad/s", 0.0, 1e4),
    Row("stall_time", 0.5, "full voltage without an edge for this long stops the motor; 0: never", "s", 0.0, 60.0),
    Row(
        "slot_irregularity",
        0.01,
        "what the observer takes the disc's slots to scatter by, share of a slot",
        "-",
        0,
        0.2,
    ),
)
ROWS = (
    *NUMBERS,
    Row(
        "speed_source", MEASURED, f"the speed that the law uses: {MEASURED} (by the plant) or {OBSERVER} (by the model)"
    ),
    Row("model", "", "model file (YAML) for observer and feed-forward, as identify writes it; empty: none"),
    Row("feedforward", False, "add the voltage that the model needs for the reference"),
)
PROGRAM = Program(
    "motor_control",
    "motor_control",
    "Holds the speed on motor/reference: answers every sample of a plant with a voltage (PI, observer, feed-forward).\n"
    "Without a reference it leaves the motor alone; Ctrl-C leaves the motor at 0 V.",
    ROWS,
    "ros2 run motor_control motor_control --ros-args -p kp:=0.1 -p model:=model.yaml -p speed_source:=observer",
    publishes=("motor/voltage", "motor/control_state", "/diagnostics"),
    subscribes=("motor/speed", "motor/info", "motor/reference"),
    services=("motor/reset",),
)

NO_MODEL = "No model is loaded, so {}: set the parameter model to a file that identify wrote."
NO_OBSERVER, NO_FEEDFORWARD = "the speed is the measured one", "there is no feed-forward"
NO_INFO = "The observer waits for motor/info to say what the encoder is like; the speed is the measured one until then."
NO_EDGES = "The plant does not stamp its edges, which the observer needs: the speed is the measured one."
NOT_READY = "Observer and feed-forward are being prepared; the speed is the measured one until then."


def model_of(path: str) -> Parameters | None:
    """The model in a file; None where no file is named.

    Raises:
        MotorError: there is no such model.
    """
    return load(path) if path else None


def config_of(
    values: Mapping[str, Value], info: Info | None, motor: Parameters | None = None, ready: bool = True
) -> controller.Config:
    """The controller's configuration; without `info` the encoder is taken for a single channel, which is always safe.

    motor: the model in the file that `values` name, read if it is not given. ready: whether what compiles is loaded.

    Raises:
        MotorError: a value does not work.
    """
    motor = motor or model_of(str(values["model"]))
    kp, ki, limit, timeout, rate_limit, reversal_speed, stall_time, _ = (float(values[row.name]) for row in NUMBERS)
    if info is not None:
        limit, timeout = min(limit, info.max_voltage), max(timeout, 2.0 * info.sample_period)
    config = controller.Config(
        gains=pi.Config(kp, ki, limit),
        voltage_limit=limit,
        sample_timeout=timeout,
        reference_rate_limit=rate_limit,
        reversal_speed=reversal_speed,
        single_channel=info is None or info.single_channel,
        faults=faults.Config(stall_time),
        note=_lack(values, info, motor, ready),
    )
    return config if motor is None or not ready else _with_model(config, values, info, motor)


def _lack(values: Mapping[str, Value], info: Info | None, motor: Parameters | None, ready: bool) -> str:
    """What is asked for and cannot be had, as a sentence; "" if nothing."""
    source, feedforward = values["speed_source"], values["feedforward"]
    if source not in (MEASURED, OBSERVER):
        raise MotorError(f"speed_source = '{source}' does not work: give {MEASURED} or {OBSERVER}.")
    lacks = [NO_OBSERVER] * (source == OBSERVER) + [NO_FEEDFORWARD] * bool(feedforward)
    if not lacks:
        return ""
    if motor is None:
        return NO_MODEL.format(" and ".join(lacks))
    if not ready:
        return NOT_READY
    if source == OBSERVER and info is None:
        return NO_INFO
    return NO_EDGES if source == OBSERVER and info and info.measurement is not Measurement.EDGES else ""


def _with_model(
    config: controller.Config, values: Mapping[str, Value], info: Info | None, motor: Parameters
) -> controller.Config:
    """The configuration with what a model makes possible; imported here, because it compiles."""
    from motor_control.controller.feedforward import FeedForward
    from motor_control.controller.observer import Observer

    if info is not None:
        motor = replace(motor, max_voltage=info.max_voltage)
    forward, watcher = FeedForward(motor), None
    if values["speed_source"] == OBSERVER and info is not None and info.measurement is Measurement.EDGES:
        watcher = Observer(motor, info, float(values["slot_irregularity"]))
    return replace(
        config,
        observer=watcher,
        feedforward=forward if values["feedforward"] else None,
        faults=replace(config.faults, fastest=forward.fastest),
    )
