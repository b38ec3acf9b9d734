"""Drives the live plant through a plan and records it; leaves the motor at 0 V however it ends."""

import sys
import time

import rclpy
from rclpy.node import Node
from rclpy.time import Time
from tqdm import tqdm

from motor_identification.bag import BagWriter
from motor_identification.cli._recorder import Recorder
from motor_identification.experiment import Plan, make_plan
from motor_model.errors import MotorError
from motor_model.excitation import Profile
from motor_msgs.msg import MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import info_of, voltage_message
from motor_ros.run import Interrupt, spin, start_ros

PATIENCE = 10.0  # [s] for a plant to appear
SILENCE = 1.0  # [s] without samples after which the plant is gone
OURS = "experiment"  # frame_id of the voltages this command sends
RECORDED = ("motor/speed", "motor/info", "motor/voltage", "motor/model")


class Driver(Node):
    """Answers every sample with the plan's command for that instant of the plant's clock."""

    def __init__(self, profile: Profile, voltage: float | None, namespace: str) -> None:
        super().__init__("experiment", namespace=namespace)
        self._profile, self._wanted = profile, voltage
        self.info: MotorInfo | None = None
        self.plan: Plan | None = None
        self.ready: Time | None = None  # when the recorder began to hear
        self.done, self.problem = False, ""
        self._start: int | None = None  # [ns] plant's clock
        self.elapsed = 0.0  # [s]
        self.heard: float | None = None  # [s] monotonic time of the latest sample
        self._voltage = self.create_publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
        self.create_subscription(MotorInfo, "motor/info", self._on_info, qos.INFO)
        self.create_subscription(MotorSpeed, "motor/speed", self._on_sample, qos.SPEED)
        self.create_subscription(MotorVoltage, "motor/voltage", self._on_voltage, qos.VOLTAGE)

    def _on_info(self, message: MotorInfo) -> None:
        self.info = message
        if self.plan is None:
            info = info_of(message)
            try:
                self.plan = make_plan(self._profile, self._wanted, info.max_voltage, info.sample_period)
            except MotorError as error:
                self.problem = str(error)

    def _on_sample(self, message: MotorSpeed) -> None:
        self.heard = time.monotonic()
        if self.plan is None or self.ready is None or self.done:
            return
        if Time.from_msg(message.header.stamp) < self.ready:  # waited in the queue: the recorder does not have it
            return
        if self._start is None:
            self._start = message.sample_time
        self.elapsed = (message.sample_time - self._start) * 1e-9
        command = self.plan.command(self.elapsed)
        self.done = command is None
        self.send(command or 0.0)

    def _on_voltage(self, message: MotorVoltage) -> None:
        if self.ready and message.header.frame_id != OURS:
            self.problem = "something else sends motor/voltage too (a controller with a reference?): stop it first."

    def send(self, voltage: float) -> None:
        """Ask the plant for a voltage [V]."""
        self._voltage.publish(voltage_message(voltage, self.get_clock().now().to_msg(), OURS))

    def silent(self) -> bool:
        """Whether the plant has stopped sending samples."""
        if self.heard is not None and time.monotonic() - self.heard > SILENCE:
            self.problem = f"the samples stopped after {self.elapsed:.2f} s: is the plant still running?"
        return bool(self.problem)


def drive(profile: Profile, voltage: float | None, output: str, namespace: str) -> int:
    """Run the plan on the live plant; returns the exit status.

    Raises:
        MotorError: no plant, a plant that falls silent, another driver, or a bag that cannot be written.
    """
    interrupt = Interrupt()
    start_ros()
    node = Driver(profile, voltage, namespace)
    try:
        _wait_for_plant(node, interrupt)
        with BagWriter(output) as writer:
            recorder = Recorder(node, writer, [node.resolve_topic_name(topic) for topic in RECORDED])
            try:
                _follow(node, interrupt, recorder)
            finally:
                node.send(0.0)
                recorder.close()
        if node.problem:
            raise MotorError(f"{node.problem} What was recorded until then is in {output}.")
        count = recorder.counts[node.resolve_topic_name("motor/speed")]
        how = "interrupted, " if interrupt else ""
        print(f"{output}: {how}{count} samples, {node.elapsed:.2f} s of '{profile.name}'")
        return 130 if interrupt else 0
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _wait_for_plant(node: Driver, interrupt: Interrupt) -> None:
    deadline = time.monotonic() + PATIENCE
    spin(
        node,
        lambda: bool((node.plan and node.heard) or node.problem or interrupt) or time.monotonic() > deadline,
    )
    if node.problem:
        raise MotorError(node.problem)
    if (node.plan is None or node.heard is None) and not interrupt:
        topic = node.resolve_topic_name("motor/info" if node.plan is None else "motor/speed")
        raise MotorError(f"nothing on {topic}: start motor_sim or motor_driver, or simulate offline with --model.")


def _follow(node: Driver, interrupt: Interrupt, recorder: Recorder) -> None:
    """Start once the recorder hears the samples, and show progress until the plan is done."""
    speed = node.resolve_topic_name("motor/speed")
    spin(node, lambda: recorder.counts[speed] > 0 or node.silent() or bool(interrupt))
    node.ready = node.get_clock().now()
    total = node.plan.duration if node.plan else 0.0
    columns = "{desc} {bar} {n:.1f}/{total:.1f} s"
    with tqdm(total=total, desc=node._profile.name, disable=None, file=sys.stderr, bar_format=columns) as bar:

        def over() -> bool:
            bar.update(min(node.elapsed, total) - bar.n)
            return node.done or bool(interrupt) or node.silent()

        spin(node, over)


if __name__ == "__main__":
    sys.exit("run 'experiment' instead")
