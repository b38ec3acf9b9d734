"""Gains found by their consequences: the largest that swing no more than allowed, those of a wished time constant."""

from math import log

from motor_control.tuning.linear_loop import Gains, Plant
from motor_control.tuning.speed_feedback import MEASURED, OBSERVER, Sight, cancelling
from motor_control.tuning.step_response import RISEN, small_step
from motor_model.errors import MotorError

SLOWEST = 1000.0  # times less than the largest kp; beyond that a wish is a slip of the pen
TOO_FAST = {
    MEASURED: (
        "A time constant of {:.3g} ms is too short for this loop. The total delay is {:.3g} ms ({}): ask for {:.3g} ms "
        "or more, sample faster, give a higher lowest speed, or use the observer."
    ),
    OBSERVER: (
        "A time constant of {:.3g} ms is too short for this loop. The total delay is {:.3g} ms ({}), and the observer "
        "needs its own margins: ask for {:.3g} ms or more, or sample faster."
    ),
}
TOO_SLOW = "A time constant of {:.3g} s is too long for this law: ask for {:.3g} s or less."


def time_constant_of(sight: Sight, plant: Plant, gains: Gains) -> float:
    """[s] of a small step, which is simulated no further."""
    return small_step(plant, sight.law(gains), sight.forward(plant, 1.0), RISEN).time_constant


def quiet_kp(sight: Sight, bare: Plant, speeds: tuple[float, ...], most: float, largest: float) -> float:
    """Find the largest kp up to `largest` whose swings (share, peak to peak) exceed `most` at none of the speeds."""
    from scipy.optimize import brentq

    def excess(log_kp: float) -> float:
        gains = cancelling(bare, float(2.0**log_kp))
        return log(max(1e-12, *(sight.ripple(bare, gains, speed).speed for speed in speeds)) / most)

    high = log(largest, 2.0)
    low = high - log(SLOWEST, 2.0)
    if excess(high) <= 0.0:
        return largest
    if excess(low) > 0.0:
        raise MotorError(
            f"No gains keep the speed ripple below {100 * most:.3g} % with this encoder: allow more, or give a higher "
            "lowest speed."
        )
    return float(2.0 ** brentq(excess, low, high, xtol=1e-3))


def wished_gains(sight: Sight, plant: Plant, wanted: float, largest: float) -> Gains:
    """Find the gains for a closed-loop time constant [s]."""
    from scipy.optimize import brentq

    fastest = cancelling(plant, largest)
    shortest = time_constant_of(sight, plant, fastest)
    if not wanted >= shortest * (1.0 - 1e-9):
        late, parts = _parts(plant)
        raise MotorError(TOO_FAST[sight.name].format(1e3 * wanted, late, parts, 1e3 * shortest))
    slowest = time_constant_of(sight, plant, cancelling(plant, largest / SLOWEST))
    if not wanted <= slowest:
        raise MotorError(TOO_SLOW.format(wanted, slowest))

    def excess(kp: float) -> float:
        return time_constant_of(sight, plant, cancelling(plant, kp)) / wanted - 1.0

    if excess(largest) >= 0.0:
        return fastest
    return cancelling(plant, float(brentq(excess, largest / SLOWEST, largest, rtol=1e-4)))


def _parts(plant: Plant) -> tuple[float, str]:
    """What makes the loop late, in ms, and of what that is the sum."""
    parts = {
        "sampling": 1.5 * plant.sample_period,
        "bridge": plant.delay,
        "inductance": plant.electrical_lag,
        "encoder": plant.sensor_lag,
    }
    return 1e3 * plant.late, ", ".join(f"{name} {1e3 * value:.3g}" for name, value in parts.items() if value > 0.0)
