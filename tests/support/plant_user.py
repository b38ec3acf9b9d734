"""A user of the plant, whichever it is."""

import warnings
from collections.abc import Callable
from itertools import pairwise
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from std_msgs.msg import Float64
from std_srvs.srv import SetBool
from workbench import Bench

from motor_msgs.msg import MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import time_message, voltage_message

BEGIN = 20  # samples that are answered by 0 V
MOST_STOPS = 3  # of one plant in one test: a busy machine holds the emulated board up, and late telemetry is a stop


def count_stop(stops: int, what: str) -> None:
    """Tell in pytest's summary that the output was off for the n-th time; more than a few are no accident."""
    assert stops <= MOST_STOPS, f"{what}: the output was switched off {stops} times"
    warnings.warn(f"{what}: the output was switched off, and on again by the test ({stops})", stacklevel=3)


class User:
    """Sends a voltage after every sample, as a controller would, and 0 V at first."""

    def __init__(self, bench: Bench) -> None:
        self.bench, self.voltage, self.sending = bench, 0.0, True
        self.samples: list[MotorSpeed] = []
        self.stops = 0
        self._said: dict[str, str] = {}  # by node, why it does not drive
        bench.node.create_subscription(DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.DIAGNOSTICS)
        self._publisher = bench.publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
        bench.node.create_subscription(MotorSpeed, "motor/speed", self._on_sample, qos.SPEED)

    def _on_sample(self, message: MotorSpeed) -> None:
        self.samples.append(message)
        if self.sending:
            begun = len(self.samples) > BEGIN
            self._publisher.publish(voltage_message(self.voltage if begun else 0.0, time_message(0), "user"))

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        self._said.update({status.name: status.message for status in message.status})

    def until(self, condition: Callable[[MotorSpeed], bool], what: str) -> MotorSpeed:
        """The first new sample for which the condition holds."""
        begin = len(self.samples)
        self.bench.wait(lambda: any(condition(sample) for sample in self.samples[begin:]), what)
        return next(sample for sample in self.samples[begin:] if condition(sample))

    def until_on(
        self, condition: Callable[[MotorSpeed], bool], what: str, on_again: Callable[[], object] | None = None
    ) -> MotorSpeed:
        """As `until`, by a user who switches on again: a busy machine holds the emulated board up, which is a stop.

        With a controller, that ends its reference as well: `on_again` has to publish a fresh one.
        """
        begin = looked = len(self.samples)

        def enough() -> bool:
            return any(map(condition, self.samples[looked:])) or len(self.samples) > looked + 300

        while not any(map(condition, self.samples[begin:])):
            self.bench.wait(enough, what)
            looked = len(self.samples)
            if self.samples[-1].voltage == 0.0:
                self.stops += 1
                count_stop(self.stops, f"{what} ({'; '.join(self._said.values())})")
                (on_again or self.switch_on)()
        return next(sample for sample in self.samples[begin:] if condition(sample))

    def switch_on(self) -> None:
        """Call motor/enable, until it succeeds: a board that was held up sends no telemetry for a moment."""
        on = SetBool.Request(data=True)
        self.bench.wait(lambda: self.bench.call(SetBool, "motor/enable", on).success, "motor/enable to succeed")

    def until_moving(self, reference: Any, what: str, enable: bool = True) -> None:
        """Publish 60 rad/s on `reference`, again after each stop, until the motor turns with 50."""

        def refer() -> None:
            if enable and self.stops:
                self.switch_on()
            reference.publish(Float64(data=0.0))  # who refers again within a second or two begins with 0
            self.more(5)
            reference.publish(Float64(data=60.0))

        refer()
        self.until_on(lambda sample: sample.speed > 50.0, what, refer)

    def steady(self, voltage: float, count: int) -> list[MotorSpeed]:
        """So many samples in a row at this voltage [V]; those before one that was lost on the way do not count."""

        def steady(sample: MotorSpeed) -> bool:
            row = self.samples[-count:]
            evenly = len({b.sample_time - a.sample_time for a, b in pairwise(row)}) == 1
            return sample is self.samples[-1] and evenly and {one.voltage for one in row} == {voltage}

        begin = len(self.samples)
        self.until_on(lambda sample: len(self.samples) >= begin + count and steady(sample), "a steady voltage")
        return self.samples[-count:]

    def more(self, count: int) -> list[MotorSpeed]:
        """So many new samples."""
        begin = len(self.samples)
        self.bench.wait(lambda: len(self.samples) >= begin + count, "more samples")
        return self.samples[begin : begin + count]
