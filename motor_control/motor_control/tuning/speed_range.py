"""Choose the speeds at which a loop is looked at: from the slowest reference of interest to the fastest.

All follows the motor and its encoder: the same physics in other volts, radians and seconds has the same range.
"""

from math import ceil, floor, log10

from motor_control.tuning.speed_feedback import Encoder
from motor_model.errors import MotorError
from motor_model.parameters import Parameters

TOP = 0.9  # of the speed at full voltage: a reference above has no voltage left to control with
# Of the speed at full voltage, where nothing else is asked for. Ordinary motors break loose at 3 to 8 % of their
# voltage (see `benchmarks/results/check.md`): what a slower reference asks for is less than friction holds, the motor
# sticks and slips there, and gains that are made for it are slow at every other speed.
LOWEST_SHARE = 0.06
# [edges/s] and no slower than this: without an edge for 0.1 s a plant reports a standstill. Twice that rate leaves room
# for a slot that is irregular, and for a speed that swings.
LOWEST_RATE = 20.0


def top_speed(parameters: Parameters) -> float:
    """Find the fastest reference [rad/s] that leaves voltage to control with."""
    return TOP * parameters.max_voltage / parameters.value("kv")


def default_lowest_speed(parameters: Parameters, encoder: Encoder) -> float:
    """Choose the slowest reference of interest [rad/s] where nobody has named one."""
    top = top_speed(parameters)
    return min(max(LOWEST_SHARE / TOP * top, LOWEST_RATE * encoder.slot), top)


def choose_speeds(parameters: Parameters, lowest: float) -> tuple[float, ...]:
    """Choose speeds [rad/s] from the lowest of interest to the top, two a decade (1 and 3 times powers of ten) between.

    Raises:
        MotorError: there is no such speed.
    """
    top = top_speed(parameters)
    if not 0.0 < lowest <= top:
        raise MotorError(
            f"The lowest speed is {lowest:g} rad/s: give one above 0 and below {top:.3g} rad/s, "
            f"{TOP:.0%} of what {parameters.max_voltage:g} V reach."
        )
    decades = range(floor(log10(lowest)), ceil(log10(top)) + 1)
    between = (figure * 10.0**decade for decade in decades for figure in (1.0, 3.0))
    return tuple(sorted({lowest, top, *(speed for speed in between if lowest < speed < top)}))
