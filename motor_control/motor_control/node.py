"""Control a motor's speed as a ROS node: answer the newest motor/speed, and leave the motor at 0 V in the end."""

import time

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

from motor_control.announcements import describe_start
from motor_control.answers import Answers
from motor_control.controller import controller
from motor_control.demands import TOPICS, Demands
from motor_control.neighbours import Neighbours
from motor_control.parameters import PROGRAM, ROWS
from motor_control.settings import Settings
from motor_control.speakers import Speakers
from motor_control.toggles import Toggles
from motor_model.errors import MotorError
from motor_msgs.msg import MotorInfo, MotorSpeed
from motor_ros import qos
from motor_ros.clocks.steady_timer import steady_timer
from motor_ros.graph.callers import Callers
from motor_ros.graph.unheard import Unheard
from motor_ros.messages import info_of, sample_of
from motor_ros.parameters import declare
from motor_ros.run import quick_executor, run

WATCH_EVERY = 0.02  # [s]
LOOK_EVERY = 0.2  # [s] at who is there, which takes 0.2 ms: less than the 0.5 s after which a wrong plant shows itself


class MotorControl(Node):
    """Speed in, voltage out."""

    def __init__(self) -> None:
        super().__init__("motor_control")
        values = declare(self, ROWS)
        self._settings, self._toggles = Settings(values), Toggles({row.name for row in ROWS if row.checked})
        _, self._toggles = self._toggles.see(values, time.monotonic())
        self._state = controller.State(since=time.monotonic())
        self._speakers = Speakers(self)
        self._answers, self._neighbours, self._unheard = Answers(self), Neighbours(self), Unheard(self, *TOPICS)
        self.create_subscription(MotorSpeed, "motor/speed", self._on_speed, qos.newest(qos.SPEED))
        self.create_subscription(MotorInfo, "motor/info", self._on_info, qos.INFO)
        self._demands = Demands(self, self._settings.config)
        resets = self.create_service(Trigger, "motor/reset", lambda _, response: self._on_reset(response))
        Callers(self).guard(resets, lambda _: bool(self._state.latched), _refuse)
        self.create_service(Trigger, "motor/release", lambda _, response: self._on_release(response))
        steady_timer(self, WATCH_EVERY, self._on_watch)
        steady_timer(self, LOOK_EVERY, lambda: self._settings.bar(self._neighbours.crossed()))
        steady_timer(self, 1.0, self._on_second)
        self.add_on_set_parameters_callback(self._on_parameters)
        self.get_logger().info(describe_start(self._settings.config))

    def doubt(self, why: str) -> None:
        """Leave the motor at 0 V until motor/reset: what was given does not reach the node."""
        self._state = controller.stop(self._state, f"{why[0].upper()}{why[1:]}.", time.monotonic())

    def close(self) -> None:
        """Leave the motor at 0 V, and see that it arrives."""
        self._answers.close()

    def _on_speed(self, message: MotorSpeed) -> None:
        self._poll()
        sample, now = sample_of(message), time.monotonic()
        if self._state.arrival is None or self._state.silent is not None:  # samples begin, or begin again
            self._state = self._speakers.meet(self._state)
        output, self._state = controller.update(self._settings.config, self._state, sample, None, now)
        self._answers.answer(output, message.header, self._settings.config, self._state.demand)

    def _on_watch(self) -> None:
        self._poll()
        self._settings.refresh()
        self._state = self._demands.look(self._speakers.name(self._state))
        output, self._state = controller.watch(self._settings.config, self._state, time.monotonic())
        if output is not None:
            self._answers.announce_silence(output, self._settings.config, self._state.demand)

    def _on_second(self) -> None:
        config, state = self._settings.config, self._state
        missing = self._neighbours.missing() or self._demands.left(config, state)
        self._answers.diagnose(config, state.demand, missing, self._unheard.look())

    def _poll(self) -> None:
        """Take what is asked for, before what acts on it."""
        self._state = self._demands.poll(self._settings.config, self._state)

    def _on_reset(self, response: Trigger.Response) -> Trigger.Response:
        response.message, self._state = controller.reset(self._state, time.monotonic())
        response.success = not self._state.latched
        return response

    def _on_release(self, response: Trigger.Response) -> Trigger.Response:
        response.success, (response.message, self._state) = True, controller.release(self._state, time.monotonic())
        return response

    def _on_info(self, message: MotorInfo) -> None:
        try:
            if self._settings.meet(info_of(message)):
                self._state = controller.meet_other_plant(self._state)
        except MotorError as error:
            self._settings.refuse(f"{error} The motor gets 0 V until then.")

    def _on_parameters(self, changed: list[Parameter]) -> SetParametersResult:
        values = {parameter.name: parameter.value for parameter in changed}
        try:
            self._settings.change(values)
        except MotorError as error:
            return SetParametersResult(successful=False, reason=str(error))
        now = time.monotonic()
        why, self._toggles = self._toggles.see(values, now)
        if why and self._state.demand is not None:
            self._state = controller.stop(self._state, why, now)
        return SetParametersResult(successful=True)


def _refuse(_: Trigger.Request, response: Trigger.Response, why: str) -> Trigger.Response:
    response.success, response.message = False, why
    return response


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_control motor_control`."""
    return run(MotorControl, args, quick_executor, PROGRAM)
