"""Follow what the edges and voltages so far say of the motor: its speed by counting, and the last steady motion.

The speed that a law uses hangs on the latest period, on an observer, on a sign. To tell whether edges can be the
motor's at all, they are counted instead. And without a model, the last steady motion says what this motor does: under
more voltage it turns at least as fast, unless a load has come.
"""

from dataclasses import dataclass, replace
from math import exp, inf

from motor_model.sample import Sample

FAST, SLOW = 0.05, 0.15  # [s] time constants of the two averages
STEADY = 0.1  # share of the speed by which both averages may differ in a steady motion
# Shares of the voltage limit: of its averages, and by how much a sample may differ as a loop's voltage trembles with
# each edge. With more it answers something new: a line that is lost is not to teach what the motor does.
EVEN_VOLTAGE, TREMBLE = 0.05, 0.15
FEW_SLOTS = 10.0  # in the faster average: there a single edge shows in it
STEADY_TIME = 0.15  # [s] for which they have to
HELD = 0.02  # of each, by which the averages may differ where the voltage is one that holds the speed
STANDSTILL = 0.1  # [s] without an edge


@dataclass(frozen=True, slots=True)
class Motion:
    """What is known of the motion; speeds are magnitudes [rad/s], voltages [V] too."""

    edge_count: int = 0
    speed: float = 0.0  # by the edges of the last 50 ms
    slow_speed: float = 0.0  # of the last 0.15 s
    voltage: float = 0.0  # of the last 50 ms
    slow_voltage: float = 0.0  # of the last 0.15 s
    silent: float = 0.0  # [s] since the latest edge
    edges: int = 0  # since the sample before
    steady: float = 0.0  # [s] for which the motion has been steady
    steady_speed: float = 0.0  # of the last steady motion; 0: there was none
    steady_voltage: float = 0.0
    steady_way: int = 0  # its direction
    most: float = 0.0  # largest average of the last 0.15 s so far
    held_speed: float = 0.0  # of the last steady motion under an even voltage; 0: there was none
    held_voltage: float = 0.0  # that held it

    def fastest(self, voltage_limit: float) -> float:
        """Give the least top speed [rad/s] that the motion so far proves; infinite: there was no steady one.

        A steady motion of little speed under a load proves little: the motor has been faster than that.
        """
        if self.steady_voltage <= 0.0:
            return inf
        return max(self.steady_speed / self.steady_voltage * voltage_limit, self.most)


def follow_motion(
    motion: Motion, sample: Sample, slot: float, dt: float, voltage_limit: float, regular: bool = True
) -> Motion:
    """Follow one sample, dt [s] after the last one; slot [rad], 0: the reported speed is taken, no edge is counted.

    Of edges that are not `regular` nothing is learnt.
    """
    edges = abs(sample.edge_count - motion.edge_count)
    if dt <= 0.0:
        return replace(motion, edge_count=sample.edge_count)
    seen = edges * slot / dt if slot > 0.0 else abs(sample.speed)
    voltage = abs(sample.voltage)
    fast, slow = 1.0 - exp(-dt / FAST), 1.0 - exp(-dt / SLOW)
    speed = motion.speed + fast * (seen - motion.speed)
    slow_speed = motion.slow_speed + slow * (seen - motion.slow_speed)
    slow_voltage = motion.slow_voltage + slow * (voltage - motion.slow_voltage)
    edge = slot / FAST if slow_speed * FAST < FEW_SLOTS * slot else 0.0  # by which one edge moves the average
    calm = abs(speed - slow_speed) <= STEADY * slow_speed + edge
    fast_voltage = motion.voltage + fast * (voltage - motion.voltage)
    calm &= abs(voltage - slow_voltage) <= TREMBLE * voltage_limit
    calm &= abs(fast_voltage - slow_voltage) <= EVEN_VOLTAGE * voltage_limit and slow_voltage > 0.0 and slow_speed > 0.0
    silent = 0.0 if edges or (slot == 0.0 and seen > 0.0) else motion.silent + dt
    calm &= sample.speed * sample.voltage > 0.0 and regular and silent < STANDSTILL
    steady = motion.steady + dt if calm else 0.0
    known = (motion.steady_speed, motion.steady_voltage) if steady < STEADY_TIME else (slow_speed, slow_voltage)
    way = motion.steady_way if steady < STEADY_TIME else 1 if sample.voltage > 0.0 else -1
    most = max(motion.most, min(slow_speed, abs(sample.speed))) if regular else motion.most  # a count may jump
    voltages = fast_voltage, slow_voltage
    even = abs(fast_voltage - slow_voltage) <= HELD * slow_voltage and abs(speed - slow_speed) <= HELD * slow_speed
    held = (slow_speed, slow_voltage) if even and steady >= STEADY_TIME else (motion.held_speed, motion.held_voltage)
    return Motion(sample.edge_count, speed, slow_speed, *voltages, silent, edges, steady, *known, way, most, *held)
