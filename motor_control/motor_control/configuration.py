"""Make the controller's configuration of its parameters, the model in its file and what the plant says of itself."""

from collections.abc import Mapping
from dataclasses import replace
from math import inf, isfinite

from motor_control.controller import pi
from motor_control.controller.faults.evidence import SPARE, SPARE_SINGLE
from motor_control.controller.faults.evidence import Config as FaultConfig
from motor_control.controller.faults.stall import REPORTABLE
from motor_control.controller.faults.unexpected_edges import FEW_SLOTS
from motor_control.controller.reference import position_law
from motor_control.controller.run import Config
from motor_control.controller.timing.sample_rate import SLOWEST, are_few, lower_gains, warn_of_swing
from motor_model.errors import MotorError
from motor_model.model_file import load
from motor_model.parameters import Parameters
from motor_model.sample import Info, Measurement

Value = bool | int | float | str

MEASURED, OBSERVER = "measured", "observer"  # what speed_source may be

NO_MODEL = "No model is loaded, so {}: set the parameter model to a file that identify wrote."
NO_OBSERVER, NO_FEEDFORWARD = "the speed is the measured one", "there is no feed-forward"
NO_INFO = "The observer waits for motor/info to say what the encoder is like; the speed is the measured one until then."
NO_EDGES = "The plant does not stamp its edges, which the observer needs: the speed is the measured one."
NO_DIRECTION = "An angle cannot be approached: a single channel does not measure the direction; use two channels."
NO_POSITION = "An angle cannot be approached without the observer: set model, and speed_source to observer."
FEW_SAMPLES = (
    "Only {:.3g} samples a second come: some faults of the encoder's line are not noticed below {:g}: raise the "
    "plant's sample_rate."
)
NOT_READY = "Observer and feed-forward are being prepared; the speed is the measured one until then."
BAD_INFO = "motor/info says {} = {:g}, which cannot be: correct it in the plant. The motor gets 0 V until then."

TOO_FEW_EDGES = (
    "By its model this motor shows {:.2g} edges a second at top speed, and below {:g} a standstill is reported: "
    "a lost encoder line or a wrong direction could not be detected. Use an encoder with more edges. "
    "The motor gets 0 V until then."
)


def model_of(path: str) -> Parameters | None:
    """Load the model in a file; None where no file is named.

    Raises:
        MotorError: there is no such model.
    """
    return load(path) if path else None


def config_of(
    values: Mapping[str, Value], info: Info | None, motor: Parameters | None = None, ready: bool = True
) -> Config:
    """Make the controller's configuration; without `info` the encoder counts as a single channel, which is always safe.

    motor: the model in the file that `values` name, read if it is not given. ready: whether what compiles is loaded.

    Raises:
        MotorError: a value does not work.
    """
    motor = motor or model_of(str(values["model"]))
    unusable = info_problem(info) if info else ""
    info = None if unusable else info
    limit, two_samples = float(values["voltage_limit"]), 0.0
    if info is not None:
        limit, two_samples = min(limit, info.max_voltage), 2.0 * info.sample_period
    single = info is None or info.single_channel
    config = Config(
        gains=pi.Config(float(values["kp"]), float(values["ki"]), limit),
        voltage_limit=limit,
        sample_timeout=max(float(values["sample_timeout"]), two_samples),
        reference_rate_limit=max(float(values["reference_rate_limit"]), 0.0),
        reversal_speed=float(values["reversal_speed"]),
        single_channel=single,
        faults=_make_fault_config(float(values["stall_time"]), info),
        note=_lack(values, info, motor, ready) or _find_few_samples(info),
        plug_limit=float(values["plug_limit"]),
        latency_limit=max(float(values["latency_limit"]), two_samples),
        reference_timeout=float(values["reference_timeout"]),
        joint_timeout=float(values["joint_command_timeout"]),
        joint=str(values["joint"]) or (info.name if info is not None else ""),
        effort_as_voltage=bool(values["effort_as_voltage"]),
        no_position=NO_DIRECTION if single else NO_POSITION,
        sample_period=info.sample_period if info else 0.0,
        unusable=unusable,
    )
    return config if motor is None or not ready else _add_model(config, values, info, motor)


def _make_fault_config(stall_time: float, info: Info | None) -> FaultConfig:
    """Make what the faults are judged by from what the encoder is; `_add_model` adds what a model knows."""
    single = info is None or info.single_channel
    return FaultConfig(
        stall_time,
        slot=slot_of(info),
        even=info is None or info.quadrature <= 1,
        tick=info.edge_resolution if info is not None else 0.0,
        few_slots=info.edges_per_revolution if info is not None and info.edges_per_revolution <= FEW_SLOTS else 0,
        spare=SPARE_SINGLE if single else SPARE,
        two_channels=not single,
    )


def slot_of(info: Info | None) -> float:
    """Find the angle [rad] between edges that are counted; 0: none are, or nothing is known."""
    counted = info is not None and info.measurement is not Measurement.SPEED
    return info.edge_angle if info is not None and counted else 0.0


def info_problem(info: Info) -> str:
    """Find what a plant says of itself and cannot be, as a sentence; "" if nothing."""
    positive = {"sample_period": info.sample_period, "max_voltage": info.max_voltage}
    if info.measurement is not Measurement.SPEED:
        positive["edges_per_revolution"] = float(info.edges_per_revolution)
    for name, value in positive.items():
        if not (isfinite(value) and value > 0.0):
            return BAD_INFO.format(name, value)
    if not (isfinite(info.edge_resolution) and info.edge_resolution >= 0.0):
        return BAD_INFO.format("edge_resolution", info.edge_resolution)
    return ""


def _lack(values: Mapping[str, Value], info: Info | None, motor: Parameters | None, ready: bool) -> str:
    """Find what is asked for and cannot be had, as a sentence; "" if nothing."""
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


def _find_few_samples(info: Info | None) -> str:
    """Find that the plant samples too seldom for the checks for faults, as a sentence; "" if it does not."""
    few = info is not None and are_few(info.sample_period)
    return FEW_SAMPLES.format(1.0 / info.sample_period, SLOWEST) if info is not None and few else ""


def _add_model(config: Config, values: Mapping[str, Value], info: Info | None, motor: Parameters) -> Config:
    """Add what a model makes possible; imported here, because it compiles."""
    from motor_control.controller.feedforward import FeedForward
    from motor_control.controller.observer import Observer

    if info is not None:
        motor = replace(motor, max_voltage=info.max_voltage)
    forward, watcher, place = FeedForward(motor), None, None
    if values["speed_source"] == OBSERVER and info is not None and info.measurement is Measurement.EDGES:
        watcher = Observer(motor, info, float(values["slot_irregularity"]))
    rate_limit, limit, gentle = config.reference_rate_limit, config.voltage_limit, 0.0
    kv = max(limit - forward.breakaway, 0.1 * limit) / max(forward.top_speed(limit), 1e-9)
    lag = motor.value("delay") + motor.value("electrical_time_constant")
    faults = replace(
        config.faults,
        fastest=forward.fastest,
        kv=kv,
        time_constant=motor.value("ka") / motor.value("kv") + lag,
        friction=forward.breakaway,
    )
    kp = lower_gains(config.gains, faults, 0.0, limit, config.sample_period).kp
    if float(values["reference_rate_limit"]) < 0.0:
        rate_limit, gentle = 2.0 * limit / motor.value("ka"), 0.5 * motor.value("ka") / max(kp, 1e-9)
    if watcher is not None and not config.single_channel:
        place = position_law.design(slot_of(info), kp, motor.value("ka"), limit, forward.top_speed(limit))
    shown = forward.fastest / config.faults.slot if config.faults.slot else inf
    return replace(
        config,
        note=config.note or warn_of_swing(config.gains, faults, config.sample_period),
        reference_rate_limit=rate_limit,
        gentle=gentle,
        observer=watcher,
        position=place,
        feedforward=forward if values["feedforward"] else None,
        unusable=config.unusable or (TOO_FEW_EDGES.format(shown, REPORTABLE) if shown < REPORTABLE else ""),
        faults=faults,
    )
