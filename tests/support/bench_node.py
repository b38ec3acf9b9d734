"""A node with a bit of everything, for the stand-in to be tried on; prints what it receives."""

import contextlib
import sys
import time

import rclpy
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from std_msgs.msg import Float64, Float64MultiArray, String
from std_srvs.srv import SetBool

from motor_msgs.action import Diagnose
from motor_msgs.msg import MotorVoltage

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def say(text: str) -> None:
    print(text, flush=True)


class Bench(Node):
    def __init__(self) -> None:
        super().__init__("bench", namespace="/lab")
        span = FloatingPointRange(from_value=0.0, to_value=10.0)
        self.declare_parameter(
            "kp", 0.3, ParameterDescriptor(description="gain [V·s/rad]", floating_point_range=[span])
        )
        self.declare_parameter("name", "motor")
        self.declare_parameter("workers", 2)
        self.declare_parameter("limits.voltages", [1.5, 12.0])
        self.declare_parameter("limits.on", True, ParameterDescriptor(read_only=True))
        self.create_subscription(Float64, "/reference", lambda message: say(f"reference {message.data!r}"), 10)
        self.create_subscription(MotorVoltage, "/voltage", self.on_voltage, 10)
        self.create_service(SetBool, "/enable", self.enable)
        self.create_publisher(Float64, "/_hidden", 1)
        if "--late" not in sys.argv or self.is_awaited("/latched"):
            self.latched = self.create_publisher(String, "/latched", LATCHED)
            self.latched.publish(String(data="for those who come later"))
        self.fast = self.create_publisher(Float64, "/fast", qos_profile_sensor_data)
        self.array = self.create_publisher(Float64MultiArray, "/array", 10)
        self.create_timer(0.02, self.tick)
        self.server = ActionServer(
            self,
            Diagnose,
            "/diagnose",
            self.diagnose,
            goal_callback=lambda goal: GoalResponse.ACCEPT if goal.bag_uris else GoalResponse.REJECT,
            cancel_callback=lambda handle: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup(),
        )

    def is_awaited(self, topic: str) -> bool:
        end = time.monotonic() + 20.0
        while time.monotonic() < end and not self.count_subscribers(topic):
            time.sleep(0.01)
        return self.count_subscribers(topic) > 0

    def on_voltage(self, message: MotorVoltage) -> None:
        age = self.get_clock().now().nanoseconds * 1e-9 - message.header.stamp.sec - message.header.stamp.nanosec * 1e-9
        say(f"voltage {message.voltage!r} {'now' if abs(age) < 5.0 else message.header.stamp.sec}")

    def enable(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        response.success, response.message = True, "on" if request.data else "off"
        return response

    def tick(self) -> None:
        self.fast.publish(Float64(data=0.5))
        self.array.publish(Float64MultiArray(data=[0.5, 1e-6]))

    def diagnose(self, handle: object) -> Diagnose.Result:
        result = Diagnose.Result()
        handle.publish_feedback(Diagnose.Feedback(stage="first", progress=0.25))
        if handle.request.known_effects == ["forever"]:
            while not handle.is_cancel_requested:
                time.sleep(0.01)
            say("cancelled")
            handle.canceled()
        elif handle.request.known_effects == ["none"]:
            handle.abort()
        else:
            result.success, result.effects = True, list(handle.request.known_effects)
            handle.succeed()
        return result


def main() -> None:
    rclpy.init(args=[])
    node = Bench()
    executor = MultiThreadedExecutor(3)
    executor.add_node(node)
    say("ready")
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()
    executor.shutdown(0.5)
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
