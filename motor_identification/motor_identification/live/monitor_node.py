"""The monitor: listens to a motor, compares its motion with a model twice a window, and says how it is."""

import time
from concurrent.futures import Future, ThreadPoolExecutor

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.node import Node

from motor_identification.live.health_message import health_message
from motor_identification.live.monitor_parameters import PARAMETERS, PROGRAM
from motor_identification.live.recorder import Recorder
from motor_identification.monitoring.evaluation import evaluate
from motor_identification.monitoring.health import Health, Limits, State, Verdict, update_health
from motor_identification.monitoring.heard import Heard
from motor_identification.monitoring.load_watch import load_watch
from motor_msgs.msg import MotorHealth
from motor_ros import qos
from motor_ros.clocks.steady_timer import steady_timer
from motor_ros.messages import diagnostic_message
from motor_ros.parameters import declare
from motor_ros.run import run

LOOK_EVERY = 0.1  # [s] how long a verdict may wait to be sent
LEVELS = {
    State.FITS: DiagnosticStatus.OK,
    State.DRIFTING: DiagnosticStatus.WARN,
    State.BROKEN: DiagnosticStatus.ERROR,
    State.UNKNOWN: DiagnosticStatus.STALE,
}


class Monitor(Node):
    """Publishes motor/health and /diagnostics; hears the motor's topics as a recorder would, and sends it nothing."""

    def __init__(self) -> None:
        super().__init__("monitor")
        values = declare(self, PARAMETERS)
        limits = Limits(float(values["window"]), float(values["tolerance"]))
        self._watch = load_watch(str(values["model"]), str(values["mapping"]), self.get_namespace(), limits)
        self._heard = Heard(limits.window)
        self._recorder = Recorder(self, self._heard, self._watch.motor.topics)
        self._told = 0  # notes of the recorder that are in the log
        self._health = Health(since=time.time_ns())
        self._pool = ThreadPoolExecutor(1)
        self._pending: Future[Verdict] | None = None
        self._publisher = self.create_publisher(MotorHealth, "motor/health", qos.HEALTH)
        self._diagnostics = self.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
        rows = ((0.5 * limits.window, self._begin), (LOOK_EVERY, self._finish), (1.0, self._diagnose))
        self._timers_kept = [steady_timer(self, period, callback) for period, callback in rows]
        self.get_logger().info(f"watching {', '.join(self._watch.motor.topics)}; commanding nothing")

    def _begin(self) -> None:
        for note in self._recorder.notes[self._told :]:
            self.get_logger().error(note)
        self._told = len(self._recorder.notes)
        if self._pending is None:  # a computer that is too slow for this judges less often
            self._pending = self._pool.submit(evaluate, self._watch, self._heard.copy(), time.time_ns())

    def _finish(self) -> None:
        if self._pending is None or not self._pending.done():
            return
        verdict, self._pending = self._pending.result(), None
        before, self._health = self._health, update_health(self._health, verdict, time.time_ns())
        if self._health.verdict.state is not before.verdict.state:
            self._say(self._health.verdict)
        self._publisher.publish(health_message(self._health, self._name))

    def _say(self, verdict: Verdict) -> None:
        if verdict.state is State.FITS:
            self.get_logger().info(verdict.sentence)
        elif verdict.state is State.BROKEN:
            self.get_logger().error(verdict.sentence)
        else:
            self.get_logger().warning(verdict.sentence)

    def _diagnose(self) -> None:
        verdict, gap = self._health.verdict, self._health.verdict.gap
        values = (
            {} if gap is None else {"residual [rad/s]": f"{gap.rms:.4g}", "expected [rad/s]": f"{gap.expected:.4g}"}
        )
        name, stamp = self.get_fully_qualified_name(), self.get_clock().now().to_msg()
        level = LEVELS[verdict.state]
        self._diagnostics.publish(
            diagnostic_message(f"{name}: {self._name}", level, verdict.sentence, values, stamp, self._name)
        )

    @property
    def _name(self) -> str:
        return self._watch.model.parameters.name

    def close(self) -> None:
        """Stop listening, and end what is computed."""
        self._recorder.close()
        self._pool.shutdown(cancel_futures=True)


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_identification monitor`."""
    return run(Monitor, args, program=PROGRAM)
