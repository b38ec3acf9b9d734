"""The controller's parameters as a table, and the configuration they make with what the plant says of itself."""

from collections.abc import Mapping

from motor_control import controller, pi
from motor_model.sample import Info
from motor_ros.parameters import Row, Value

# ki / kp = kv / ka of the paper's motor: the zero of the law cancels its pole. Simulated at 200 Hz with 0.4 V of
# friction, 0 -> 100, 100 -> 40 and 0 -> 3 rad/s settle within 3 % in 0.21, 0.24 and 0.30 s, and a load of 1 V at 100
# rad/s costs 3.3 rad/s. Half the gains let it cost 4.8; twice the gains keep 3 rad/s swinging by 3 rad/s, because below
# 5 rad/s the encoder is later than such a loop is fast.
# reversal_speed: at 10 rad/s the paper's motor stops within a slot, so one or two edges show that it has turned.
ROWS = (
    Row("kp", 0.2, "proportional gain", "V/(rad/s)", 0.0, 1000.0),
    Row("ki", 2.5, "integral gain", "V/rad", 0.0, 10_000.0),
    Row("voltage_limit", 12.0, "largest voltage to ask for, if max_voltage is not less", "V", 0.0, 100.0),
    Row("sample_timeout", 0.1, "silence on motor/speed that stops the motor; at least two samples", "s", 0.002, 10.0),
    Row("reference_rate_limit", 0.0, "slope at which a new reference is approached; 0: at once", "rad/s^2", 0.0, 1e6),
    Row("reversal_speed", 10.0, "single channel: no voltage against a motion faster than this", "rad/s", 0.0, 1e4),
)


def config_of(values: Mapping[str, Value], info: Info | None) -> controller.Config:
    """The controller's configuration; without `info` the encoder is taken for a single channel, which is always safe.

    Raises:
        MotorError: a value does not work.
    """
    kp, ki, limit, timeout, rate_limit, reversal_speed = (float(values[row.name]) for row in ROWS)
    if info is not None:
        limit, timeout = min(limit, info.max_voltage), max(timeout, 2.0 * info.sample_period)
    return controller.Config(
        gains=pi.Config(kp, ki, limit),
        voltage_limit=limit,
        sample_timeout=timeout,
        reference_rate_limit=rate_limit,
        reversal_speed=reversal_speed,
        single_channel=info is None or info.single_channel,
    )
