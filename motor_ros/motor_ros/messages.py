"""Our messages and the plain values they carry, both ways."""

from collections.abc import Mapping
from dataclasses import fields

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from motor_model.errors import MotorError
from motor_model.printable import escape
from motor_model.sample import Info, Measurement, Sample, check_info
from motor_msgs.msg import MotorInfo, MotorSpeed, MotorVoltage

INFO_FIELDS = [field.name for field in fields(Info) if field.name in MotorInfo.get_fields_and_field_types()]


def speed_message(sample: Sample, stamp: Time, name: str) -> MotorSpeed:
    """Return a sample as it goes out on `motor/speed`."""
    message = MotorSpeed(
        sample_time=sample.sample_time,
        speed=sample.speed,
        voltage=sample.voltage,
        edge_count=sample.edge_count,
        edge_time=sample.edge_time,
        edge_period=sample.edge_period,
        supply_voltage=sample.supply_voltage,
        current=sample.current,
    )
    message.header.stamp = stamp
    message.header.frame_id = name
    return message


def sample_of(message: MotorSpeed) -> Sample:
    """Return the sample in a message."""
    return Sample(
        sample_time=message.sample_time,
        speed=message.speed,
        voltage=message.voltage,
        edge_count=message.edge_count,
        edge_time=message.edge_time,
        edge_period=message.edge_period,
        supply_voltage=message.supply_voltage,
        current=message.current,
    )


def info_message(info: Info, stamp: Time) -> MotorInfo:
    """Return what `motor/info` says."""
    values = {name: getattr(info, name) for name in INFO_FIELDS}
    message = MotorInfo(**values | {"measurement": info.measurement.value})
    message.header.stamp = stamp
    message.header.frame_id = info.name
    return message


def info_of(message: MotorInfo) -> Info:
    """Return the plain value of a `motor/info` message.

    Raises:
        MotorError: its `measurement` is none of edges, counts and speed, or a number is out of range.
    """
    if message.measurement not in {kind.value for kind in Measurement}:
        raise MotorError(f"motor/info says measurement '{message.measurement}': it must be edges, counts or speed.")
    values = {name: getattr(message, name) for name in INFO_FIELDS}
    info = Info(**values | {"name": escape(message.name), "measurement": Measurement(message.measurement)})
    check_info(info)
    return info


def voltage_message(voltage: float, stamp: Time, name: str) -> MotorVoltage:
    """Return a command as it goes out on `motor/voltage`."""
    message = MotorVoltage(voltage=voltage)
    message.header.stamp = stamp
    message.header.frame_id = name
    return message


def diagnostic_message(
    name: str, level: bytes, sentence: str, values: Mapping[str, str], stamp: Time, hardware: str = ""
) -> DiagnosticArray:
    """One status for `/diagnostics`; level: one of DiagnosticStatus, hardware: the motor that it is of."""
    pairs = [KeyValue(key=key, value=value) for key, value in values.items()]
    status = DiagnosticStatus(name=name, level=level, message=sentence, hardware_id=hardware, values=pairs)
    message = DiagnosticArray(status=[status])
    message.header.stamp = stamp
    return message


def time_message(nanoseconds: int) -> Time:
    """Integer nanoseconds, 0 if negative, as a ROS time; no float in between, which would lose 240 ns."""
    nanoseconds = max(nanoseconds, 0)
    return Time(sec=nanoseconds // 1_000_000_000, nanosec=nanoseconds % 1_000_000_000)


def stamp_age(stamp: Time, now: int) -> float:
    """Compute how old [s] a stamp is at `now` [ns] of ROS time; 0 of an empty one, or while no time runs."""
    then = stamp.sec * 1_000_000_000 + stamp.nanosec
    return (now - then) * 1e-9 if then and now else 0.0
