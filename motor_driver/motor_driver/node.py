"""The real motor as a ROS node: the board on a serial port, with the topics and services of the simulated one."""

import time

from rclpy.node import Node

from motor_driver import status
from motor_driver.driver import Driver, Reading
from motor_driver.link import Link
from motor_driver.link_events import Closed, Event, Opened, Received
from motor_driver.parameters import PROGRAM, ROWS, config_of
from motor_ros.clocks.steady_timer import steady_timer
from motor_ros.gate import Gate
from motor_ros.messages import time_message
from motor_ros.parameters import declare
from motor_ros.plant import Plant
from motor_ros.run import quick_executor, run

WATCH_EVERY = 0.01  # [s]
NO_THREAD = "The thread of the serial port has ended, which is a mistake in the driver: start it again, and report it."
SETTLING = 100_000_000  # [ns] a clock that goes back further than this was set


class MotorDriver(Node):
    """Passes bytes between link and driver, and samples and commands between driver and plant."""

    def __init__(self) -> None:
        super().__init__("motor_driver")
        values = declare(self, ROWS)
        self._driver = Driver(config_of(values))
        self._was = status.tally(self._driver, time.monotonic_ns())
        self._said = self._assumed = ""
        self._runs_begun = 0
        self._stamp = 0  # [ns] ROS time of the latest sample
        period = 1.0 / float(values["sample_rate"])
        gate = Gate(bool(values["enabled_at_start"]), float(values["command_timeout"]), period)
        self._plant = Plant(self, self._driver.info, gate, self._driver.refusal, self._work)
        self._woken = False  # and has not begun to work
        self._mistake: Exception | None = None
        config = self._driver.config
        self._link = Link(str(values["port"]), config.baud, self._wake, search=config.board_id is not None)
        steady_timer(self, WATCH_EVERY, self._on_watch)
        steady_timer(self, 1.0, self._on_second)

    def doubt(self, why: str) -> None:
        """Leave the output off: what was given does not reach the node, and the motor may be another than it takes."""
        self._plant.stop(why)

    def close(self) -> None:
        """Switch the output off while the port is still open."""
        self._plant.gate = self._plant.gate.enable(False)
        self._act()  # whatever is wrong with what has come

    def destroy_node(self) -> None:
        """Close the port, then the node."""
        self._link.close()
        super().destroy_node()

    def _wake(self) -> None:
        """Have the node's thread work, from the link's; what wakes it while it has not begun to is the same."""
        if not self._woken and self.executor is not None:
            self._woken = True
            self.executor.create_task(self._on_wake)

    def _on_wake(self) -> None:
        """Work; a mistake that shows itself then ends the node as one in a timer does: a task's ends the process."""
        self._woken = False
        try:
            self._work()
        except Exception as error:
            self._mistake = error

    def _on_watch(self) -> None:
        if self._mistake is not None:
            raise self._mistake
        self._work()

    def _work(self) -> None:
        """Take what has come, then send what is due."""
        to_ros = self._plant.now() - time.monotonic_ns()
        for event in self._link.take():
            for reading in self._hear(event):
                self._publish(reading, to_ros)
        if not self._link.alive and self._driver.trouble != NO_THREAD:
            self._driver.closed(NO_THREAD)
        self._act()

    def _hear(self, event: Event) -> list[Reading]:
        match event:
            case Received(data, at):
                return self._driver.received(data, at)
            case Opened(port, at, roll_call):
                self._driver.opened(port, at, roll_call)
            case Closed(why, passed):
                self._driver.closed(why)
                if not passed:
                    self._say()
        return []

    def _publish(self, reading: Reading, to_ros: int) -> None:
        if reading.restarted:
            self._plant.recount()
        if self._plant.info != self._driver.info:
            self._plant.info = self._driver.info
            self._plant.publish_info()
        stamp = reading.host + to_ros
        if self._stamp - SETTLING < stamp <= self._stamp:  # a better fit never takes the samples back in time
            stamp = self._stamp + 1
        self._stamp = stamp
        self._plant.publish(reading.sample, time_message(self._stamp))

    def _act(self) -> None:
        now = time.monotonic_ns()
        if self._driver.runs_begun > self._runs_begun:
            self._runs_begun = self._driver.runs_begun
            self._plant.gate = self._plant.gate.come_up(now)
            self.get_logger().info(status.connection(self._driver))
        order = self._driver.step(now, self._plant.gate.enabled, self._plant.voltage())
        self._link.write(order.data)
        if order.stop:
            self._plant.stop(order.stop, order.motor)
        if self._driver.unsuitable(now):
            self._link.pass_over(self._driver.matches)

    def _say(self) -> None:
        """Log what is wrong, once."""
        problem = status.problem(self._driver, self._was, time.monotonic_ns())
        if problem and problem != self._said:
            self.get_logger().error(problem)
        self._said = problem

    def _on_second(self) -> None:
        now = time.monotonic_ns()
        self._say()
        if (assumed := status.assumption(self._driver)) and assumed != self._assumed:
            self._assumed = assumed
            self.get_logger().warning(assumed)
        told = " ".join(filter(None, (self._said, status.risk(self._driver))))
        self._plant.diagnose(told, status.values(self._driver, self._was, now))
        self._was = status.tally(self._driver, now)


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_driver motor_driver`."""
    return run(MotorDriver, args, quick_executor, PROGRAM)
