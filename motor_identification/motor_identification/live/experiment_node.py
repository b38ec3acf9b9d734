"""The node of a live experiment: answers every sample with the plan's command, and sees when something is wrong."""

import time
from dataclasses import replace
from math import inf

from builtin_interfaces.msg import Time as Stamp
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time

from motor_identification.experiment import Plan, make_plan
from motor_identification.live.plant_watch import Asked, Listener, PlantWatch
from motor_model.errors import MotorError
from motor_model.excitation import Profile
from motor_model.sample import Info, Sample
from motor_msgs.msg import MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.graph.publishers import NAMELESS, count_publishers, publishers_of
from motor_ros.messages import info_of, sample_of, voltage_message

QUEUED = 0.5  # [s] after which no sample from before can come out of the queue any more
LEAST = 0.02  # of max_voltage: a command that any bridge can follow
ARRIVAL = 0.5  # [s] for the last command to arrive
OURS = "experiment"  # frame_id of the voltages this command sends


class Driver(Node):
    """Answers every sample with the plan's command for that instant of the plant's clock.

    `problem` is a sentence as soon as the experiment has to end; from then on no voltage is sent.
    """

    def __init__(self, profile: Profile, voltage: float | None, limit: float | None, namespace: str) -> None:
        super().__init__("experiment", namespace=namespace, start_parameter_services=False)  # it has none of its own
        self.profile, self._wanted, self.limit = profile, voltage, limit
        self.info: Info | None = None
        self.plan: Plan | None = None
        self.samples: list[Sample] = []  # of a probe
        self.done, self.problem = False, ""
        self._following: Plan | None = None
        self._ready = self.get_clock().now()  # samples from before have waited in the queue
        self._since = time.monotonic()  # likewise
        self._enough: float | None = None  # [rad/s] that ends a probe
        self.elapsed = 0.0  # [s]
        self.heard: float | None = None  # [s] monotonic time of the latest sample
        self._start: int | None = None  # [ns] plant's clock
        self._asked = 0.0  # [V] the latest command
        self._stamp = Stamp()  # of the latest sample, which its answer has, too: the plant's computer has its own time
        self._plant = PlantWatch(limit or inf)
        self._listener = Listener()
        self.plant_says = ""  # what the plant's diagnostics said since its output is off
        self._voltage = self.create_publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
        self.create_subscription(MotorInfo, "motor/info", self._on_info, qos.INFO)
        self._samples = self.create_subscription(MotorSpeed, "motor/speed", self._on_sample, qos.SPEED)
        self.create_subscription(MotorVoltage, "motor/voltage", self._on_voltage, qos.VOLTAGE)
        self.create_subscription(DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.DIAGNOSTICS)

    def follow(self, plan: Plan, enough: float | None = None) -> None:
        """Do what a plan says from now on; with `enough` it is a probe, kept in `samples`, that ends at that speed."""
        for _ in range(qos.SPEED.depth):  # what has waited is of before, whatever its stamps say: nobody may record it
            if not self._samples.handle.take_message(MotorSpeed, False):
                break
        self._following, self._enough, self.samples = plan, enough, []
        self._ready, self._start, self.done, self.elapsed = self.get_clock().now(), None, False, 0.0
        self.heard = self._since = time.monotonic()  # nobody has listened while something else was done
        self._plant = replace(self._plant, seen=None)

    def send(self, voltage: float) -> None:
        """Ask the plant for a voltage [V]."""
        self._asked = voltage
        self._voltage.publish(voltage_message(voltage, self._stamp, OURS))

    def stop(self) -> None:
        """Send 0 V, see that it arrives, and send nothing else any more."""
        self.done = True
        self.send(0.0)
        self._voltage.wait_for_all_acked(Duration(seconds=ARRIVAL))

    def failed(self) -> bool:
        """Whether the plant has stopped sending samples, is not alone, or there is another problem."""
        self._listener, silence = self._listener.look(self.heard, self.elapsed, time.monotonic())
        plants = count_publishers(self, "motor/speed")
        if plants > 1:
            self.problem = f"{plants} nodes publish motor/speed: stop all but the plant that is to be driven."
        elif silence and not self.problem:
            self.problem = silence
        return bool(self.problem)

    def _on_info(self, message: MotorInfo) -> None:
        try:
            info = info_of(message)
            if self.info is None:
                self.plan = make_plan(self.profile, self._wanted, info.max_voltage, info.sample_period)
            elif info != self.info:
                self.problem = "motor/info has changed: the plan is for another plant; start anew."
            self.info = info
        except MotorError as error:
            self.problem = str(error)

    def _on_sample(self, message: MotorSpeed) -> None:
        self.heard, self._stamp = time.monotonic(), message.header.stamp
        if self._following is None or self.problem or self._is_old(message):
            return
        if self._enough is not None:
            self.samples.append(sample_of(message))
            self.done |= abs(message.speed) >= self._enough
        if self.done:
            return
        if self._start is None:
            self._start = message.sample_time
        self._watch(message)
        self.elapsed = (message.sample_time - self._start) * 1e-9
        if not self.problem:
            command = self._following.command(self.elapsed)
            self.done = command is None
            self.send(command or 0.0)

    def _is_old(self, message: MotorSpeed) -> bool:
        """Whether a sample is from before, as far as stamps tell: the plant may have another ROS time."""
        waited = self._start is None and time.monotonic() - self._since < QUEUED
        return waited and Time.from_msg(message.header.stamp) < self._ready

    def _on_voltage(self, message: MotorVoltage) -> None:
        if self._following and message.header.frame_id != OURS and not self.problem:
            names = {name for name in publishers_of(self, self._voltage.topic_name) if name != NAMELESS}
            others = ", ".join(sorted(names - {self.get_fully_qualified_name()})) or "its name is not known yet"
            self.problem = f"Another node publishes motor/voltage: {others}. End it, and start anew."

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            if self._plant.deaf_since is not None and self.info and status.hardware_id == self.info.name:
                self.plant_says = status.message

    def _watch(self, message: MotorSpeed) -> None:
        if message.voltage != 0.0:
            self.plant_says = ""
        heard = self.info is not None and abs(self._asked) > LEAST * self.info.max_voltage
        asked, now = Asked(self._asked, heard, self.elapsed), time.monotonic()
        self._plant, problem = self._plant.see(message.sample_time, message.speed, message.voltage, asked, now)
        self.problem = problem or self.problem
