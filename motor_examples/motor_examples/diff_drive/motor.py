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
from motor_ros.graph.publishers import NAMELESS, Id, list_publishers
from motor_ros.messages import info_of, sample_of

ASK_AGAIN = 1.0  # [s] without an answer, after which a question may be lost


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
        self._question: Future | None = None  # to it, without an answer yet
        self._asked_at = 0.0  # [s]
        self._let_go: Future | None = None  # the latest request to

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
            self._let_go = _ask(self._release, Trigger.Request(), self._let_go)

    def meet_controller(self) -> None:
        """See who controls the wheel, and ask at once whoever is new."""
        found = list_publishers(self._node, self._controls)
        there = frozenset(one.id for one in found)
        if there and there != self._controllers:
            self.wheel = replace(self.wheel, reference_timeout=None, unsaid_since=boot_time())
            self._forget()
        self._controllers = there
        names = sorted(one.node or NAMELESS for one in found)
        self.wheel = replace(self.wheel, rivals=", ".join(names) if len(names) > 1 else "")
        if self.wheel.unsaid_since is not None:
            self.ask_controller()

    def ask_controller(self) -> None:
        """Ask the wheel's controller how long it holds a reference; one question at a time, which may be lost."""
        found, now = list_publishers(self._node, self._controls), boot_time()
        if len(found) != 1 or not found[0].node:
            return
        name = f"{found[0].node}/get_parameters"
        if self._asked is None or self._asked.srv_name != name:
            self._forget()
            if self._asked is not None:
                self._node.destroy_client(self._asked)
            self._asked = self._node.create_client(GetParameters, name)
        if self.wheel.unsaid_since is None:
            self.wheel = replace(self.wheel, unsaid_since=now)
        if self._asked.service_is_ready() and (self._question is None or now - self._asked_at >= ASK_AGAIN):
            request = GetParameters.Request(names=["reference_timeout"])
            self._question, self._asked_at = _ask(self._asked, request, self._question), now
            self._question.add_done_callback(self._on_answer)

    def _forget(self) -> None:
        """Take no answer any more to what was asked."""
        if self._asked is not None and self._question is not None:
            self._asked.remove_pending_request(self._question)
        self._question = None

    def _on_answer(self, future: Future) -> None:
        response = future.result()
        if self._question is not future:  # of a controller that was there before
            return
        known = response is not None and response.values and response.values[0].type == ParameterType.PARAMETER_DOUBLE
        if known:  # else it is asked again as one that does not answer is
            self._question = None
            self.wheel = replace(self.wheel, reference_timeout=response.values[0].double_value, unsaid_since=None)

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


def _ask(client: Client, request: object, before: Future | None) -> Future:
    """Send a request, and wait no longer for the answer to the one before: else all are kept that nobody answers."""
    if before is not None:
        client.remove_pending_request(before)
    return client.call_async(request)
