"""A plant's shell in the test's own process, sampled when the test says so."""

import time

from std_srvs.srv import SetBool
from workbench import Bench

from motor_model.sample import Info, Sample
from motor_ros.gate import Gate
from motor_ros.messages import time_message
from motor_ros.plant import Plant


class Rig:
    """A plant that samples whenever its executor is spun, driven with 6 V."""

    def __init__(self, bench: Bench) -> None:
        self.bench, self.count = bench, 0
        self.plant = Plant(bench.node, Info(), Gate(True, 10.0), changed=lambda: None)
        self.plant.gate = self.plant.gate.take(0.0, time.monotonic_ns()).take(6.0, time.monotonic_ns())

    def stamp(self) -> int:
        return self.bench.node.get_clock().now().nanoseconds

    def sample(self) -> float:
        """One sample [V]."""
        self.count += 5_000_000
        voltage = self.plant.voltage()
        self.plant.publish(Sample(self.count, 0.0, voltage), time_message(self.stamp()))
        self.bench.executor.spin_once(timeout_sec=0.001)
        return voltage

    def begin_again(self) -> None:
        """After others have gone: who sent meanwhile begins at 0 V, or is let on."""
        self.plant.gate = self.plant.gate.take(6.0, time.monotonic_ns())
        assert self.sample() == 0.0
        assert self.plant._on_enable(SetBool.Request(data=True), SetBool.Response()).success
        self.plant.gate = self.plant.gate.take(6.0, time.monotonic_ns())
        assert self.sample() == 6.0
