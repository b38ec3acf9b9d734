"""Drive a robot with two wheels as a ROS node: cmd_vel in, two references out, odometry back."""

from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist as TwistMessage
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

from motor_examples.diff_drive import drive
from motor_examples.diff_drive.kinematics import STILL, Wheels, body_twist
from motor_examples.diff_drive.messages import diagnostics_message, odometry_message, transform_message, twist_of
from motor_examples.diff_drive.motor import Motor
from motor_examples.diff_drive.odometry import Pose, advance_pose
from motor_examples.diff_drive.parameters import PROGRAM, ROWS, config_of
from motor_model.errors import MotorError
from motor_ros import qos
from motor_ros.clocks.hold_ups import STOOD_STILL, HoldUps, boot_time
from motor_ros.clocks.steady_timer import steady_timer
from motor_ros.graph.callers import Callers
from motor_ros.graph.commanders import Commanders
from motor_ros.interface_types import NotInstalled, load_message
from motor_ros.messages import stamp_age
from motor_ros.numbered_input import Arrival, NumberedInput
from motor_ros.parameters import declare
from motor_ros.run import quick_executor, run

LOOK_EVERY = 0.1  # [s] at who controls the wheels
DOUBT = "{}: correct that, and start the drive again."
SAME = "Both wheels would be the motor that is told on {}: give left and right the namespaces of two."
NO_TF = "tf2_msgs is not installed here: no transforms on /tf; the pose is on odom."


class DiffDrive(Node):
    """Two motors as one robot."""

    def __init__(self) -> None:
        super().__init__("diff_drive")
        self._values = declare(self, ROWS)
        self._config, self._state, self._pose = config_of(self._values), drive.State(), Pose()
        self._doubt = ""  # why no velocity is obeyed
        self._decision, self._turned = drive.Decision(None), Wheels(0.0, 0.0)
        sides = ("left", "right")
        motors = [Motor(self, str(self._values[s]), bool(self._values[f"{s}_reversed"])) for s in sides]
        self._left, self._right = motors
        if self._left.topic == self._right.topic:
            raise MotorError(SAME.format(self._left.topic))
        self._frames = (str(self._values["odom_frame"]), str(self._values["base_frame"]))
        self._odometry = self.create_publisher(Odometry, "odom", qos.ODOMETRY)
        self._diagnostics = self.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
        self._transforms = self._load_transforms() if self._values["publish_tf"] else None
        self._tf = self.create_publisher(self._transforms, "/tf", qos.TRANSFORMS) if self._transforms else None
        self._hold_ups = HoldUps(self)
        kind = TwistStamped if self._values["stamped"] else TwistMessage
        self._commanders = Commanders(self, "cmd_vel")
        self._input: NumberedInput[Any] = NumberedInput(
            self,
            kind,
            "cmd_vel",
            qos.COMMANDS,
            self._on_cmd_vel,
            hold_ups=self._hold_ups,
            commanders=self._commanders,
            counts=lambda message, _: twist_of(message) == STILL,
        )
        steady_timer(self, 1.0 / float(self._values["rate"]), self._on_timer)
        steady_timer(self, LOOK_EVERY, self._on_look)
        steady_timer(self, 1.0, self._on_second)
        Callers(self)
        self.add_on_set_parameters_callback(self._on_parameters)

    def doubt(self, why: str) -> None:
        """Obey no velocity: what was given does not reach the node, and may be a limit."""
        self._doubt = DOUBT.format(why[0].upper() + why[1:])
        self.get_logger().error(self._doubt)

    def close(self) -> None:
        """Stop both wheels and let go of them."""
        self._tell(drive.Decision(Wheels(0.0, 0.0), True))

    def _load_transforms(self) -> Any:
        try:
            return load_message("tf2_msgs/msg/TFMessage")
        except NotInstalled:
            self.get_logger().warning(NO_TF)
            return None

    def _on_cmd_vel(self, message: Any, arrival: Arrival) -> None:
        twist, age, now = twist_of(message), 0.0, boot_time()
        if isinstance(message, TwistStamped):
            age = stamp_age(message.header.stamp, self.get_clock().now().nanoseconds)
        if twist != STILL and self._hold_ups.bars(arrival.waited):
            self._state = drive.refuse_command(self._state, STOOD_STILL, now, twist, arrival.number)
        else:
            self._state = drive.take_command(self._config, self._state, twist, now, age, arrival.number)

    def _on_timer(self) -> None:
        self._input.poll()
        if players := self._commanders.players:
            self._state = drive.refuse_command(self._state, drive.PLAYED.format(players), boot_time())
        if self._doubt:
            self._state = drive.refuse_command(self._state, self._doubt, boot_time())
        wheels = (self._left.wheel, self._right.wheel)
        decision, self._state = drive.step(self._config, self._state, wheels, boot_time())
        self._tell(decision)
        if decision.reason != self._decision.reason:
            say = self.get_logger()
            say.info(decision.reason) if decision.healthy else say.warning(decision.reason)
        self._decision = decision
        turned = Wheels(self._left.wheel.angle, self._right.wheel.angle)
        left, right = turned.left - self._turned.left, turned.right - self._turned.right
        self._pose, self._turned = advance_pose(self._config.geometry, self._pose, left, right), turned
        self._publish_pose()

    def _tell(self, decision: drive.Decision) -> None:
        if decision.references is not None:
            self._left.refer(decision.references.left)
            self._right.refer(decision.references.right)
        if decision.release:
            self._left.release()
            self._right.release()

    def _publish_pose(self) -> None:
        stamp = self.get_clock().now().to_msg()
        twist = body_twist(self._config.geometry, Wheels(self._left.wheel.speed, self._right.wheel.speed))
        self._odometry.publish(odometry_message(self._pose, twist, stamp, self._frames))
        if self._transforms and self._tf:
            self._tf.publish(self._transforms(transforms=[transform_message(self._pose, stamp, self._frames)]))

    def _on_look(self) -> None:
        self._left.meet_controller()
        self._right.meet_controller()

    def _on_second(self) -> None:
        self._left.ask_controller()
        self._right.ask_controller()
        name, stamp = self.get_fully_qualified_name(), self.get_clock().now().to_msg()
        wheels = (self._left.wheel, self._right.wheel)
        self._diagnostics.publish(diagnostics_message(self._decision, self._pose, wheels, name, stamp))

    def _on_parameters(self, changed: list[Parameter]) -> SetParametersResult:
        values = {**self._values, **{parameter.name: parameter.value for parameter in changed}}
        try:
            config = config_of(values)
        except MotorError as error:
            return SetParametersResult(successful=False, reason=str(error))
        wheels = (self._left.wheel, self._right.wheel)
        if why := drive.refuse_geometry(self._config, self._state, wheels, config.geometry):
            return SetParametersResult(successful=False, reason=why)
        self._config, self._values = config, values
        return SetParametersResult(successful=True)


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_examples diff_drive`."""
    return run(DiffDrive, args, quick_executor, PROGRAM)
