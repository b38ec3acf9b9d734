"""Talk to one wheel's motor: its samples and its controller's state in, references out."""

from dataclasses import replace

from rcl_interfaces.msg import ParameterType
from rcl_interfaces.srv import GetParameters
from rclpy.client import Client
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from motor_examples.diff_drive.wheel import Wheel, follow_controller, follow_sample
from motor_model.errors import MotorError
from motor_msgs.msg import ControlState, MotorInfo, MotorSpeed
from motor_ros import qos
from motor_ros.clocks.hold_ups import boot_time
from motor_ros.graph.publishers import Id, list_publishers, publisher_ids
from motor_ros.messages import info_of, sample_of


class Motor:
    """One wheel's motor: what is heard of it and said to it; forwards is positive, whichever way it is mounted."""

    def __init__(self, node: Node, name: str, is_reversed: bool) -> None:
        self._node = node
        self.wheel = Wheel(name, -1.0 if is_reversed else 1.0)
        self._reference = node.create_publisher(Float64, f"{name}/motor/reference", qos.REFERENCE)
        self._release = node.create_client(Trigger, f"{name}/motor/release")
        node.create_subscription(MotorSpeed, f"{name}/motor/speed", self._on_speed, qos.newest(qos.SPEED))
        node.create_subscription(MotorInfo, f"{name}/motor/info", self._on_info, qos.INFO)
        state = qos.newest(qos.CONTROL_STATE)
        heard = node.create_subscription(ControlState, f"{name}/motor/control_state", self._on_control_state, state)
        self._controls = heard.topic_name
        self._controllers: frozenset[Id] = frozenset()  # who publishes there
        self._asked: Client | None = None  # for the parameters of the one who does

    @property
    def topic(self) -> str:
        """The topic on which it is told, as the graph knows it."""
        return str(self._reference.topic_name)

    def refer(self, speed: float) -> None:
        """Ask for a speed [rad/s], forwards."""
        self._reference.publish(Float64(data=self.wheel.sign * speed))

    def release(self) -> None:
        """Let go of the motor."""
        if self._release.service_is_ready():
            self._release.call_async(Trigger.Request())

    def meet_controller(self) -> None:
        """See who controls the wheel, and ask at once whoever is new."""
        there = publisher_ids(self._node, self._controls)
        if there != self._controllers:
            self._controllers = there
            self.wheel = replace(self.wheel, reference_timeout=None, unsaid_since=boot_time() if there else None)
        if self.wheel.unsaid_since is not None:
            self.ask_controller()

    def ask_controller(self) -> None:
        """Ask the wheel's controller how long it holds a reference."""
        found = list_publishers(self._node, self._controls)
        if len(found) != 1 or not found[0].node:
            return
        name = f"{found[0].node}/get_parameters"
        if self._asked is None or self._asked.srv_name != name:
            if self._asked is not None:
                self._node.destroy_client(self._asked)
            self._asked = self._node.create_client(GetParameters, name)
        if self._asked.service_is_ready():
            request = GetParameters.Request(names=["reference_timeout"])
            self._asked.call_async(request).add_done_callback(self._on_answer)

    def _on_answer(self, future: Future) -> None:
        response = future.result()
        known = response is not None and response.values and response.values[0].type == ParameterType.PARAMETER_DOUBLE
        timeout = response.values[0].double_value if known else None
        self.wheel = replace(self.wheel, reference_timeout=timeout, unsaid_since=None)

    def _on_speed(self, message: MotorSpeed) -> None:
        self.wheel = follow_sample(self.wheel, sample_of(message), boot_time())

    def _on_info(self, message: MotorInfo) -> None:
        try:
            self.wheel = replace(self.wheel, info=info_of(message))
        except MotorError as error:
            self._node.get_logger().error(f"{self.wheel.name}: {error}")

    def _on_control_state(self, message: ControlState) -> None:
        said = (message.state, message.reason, message.voltage)
        self.wheel = follow_controller(self.wheel, *said, boot_time())
