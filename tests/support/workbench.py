"""What tests of nodes share: a node of the test's own, and our programs as processes, in a domain of their own."""

import os
import signal
import subprocess
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import rclpy
from ament_index_python.packages import get_package_prefix
from domains import free_domain
from forked import Forked
from patience import PATIENCE
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import ListParameters, SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile

from motor_ros import qos
from motor_ros.loopback import stay_on_this_machine

DOMAIN = str(free_domain())
MANNERS = 5.0  # [s] for a process to end after its signal, once a test is over
ENVIRONMENT = {**os.environ, "ROS_DOMAIN_ID": DOMAIN, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


class Bench:
    """A node that publishes, hears and calls, and waits for what it is told of."""

    def __init__(self, namespace: str = "") -> None:
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        stay_on_this_machine()
        self._context = rclpy.Context()
        rclpy.init(context=self._context, domain_id=int(DOMAIN))
        self.node = rclpy.create_node("bench", context=self._context, namespace=namespace or None)
        self.executor = SingleThreadedExecutor(context=self._context)
        self.executor.add_node(self.node)
        self._kept: dict[str, Any] = {}  # clients, by their services

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)

    def wait(self, condition: Callable[[], bool], what: str, patience: float = PATIENCE) -> None:
        """Hear messages until the condition holds."""
        end = time.monotonic() + patience
        while not condition():
            assert time.monotonic() < end, f"still waiting for {what}"
            self.executor.spin_once(timeout_sec=0.02)

    def publisher(self, kind: type, topic: str, profile: QoSProfile = qos.SPEED) -> Any:
        return self.node.create_publisher(kind, topic, profile)

    def hear(self, kind: type, topic: str, profile: QoSProfile = qos.SPEED) -> list[Any]:
        """A list that grows with every message."""
        messages: list[Any] = []
        self.node.create_subscription(kind, topic, messages.append, profile)
        return messages

    def heard(self, *publishers: Any) -> None:
        """Wait until each of the publishers has a subscriber."""
        self.wait(lambda: all(publisher.get_subscription_count() for publisher in publishers), "subscribers")

    def known_to(self, node: str) -> None:
        """Wait until a node knows all readers that this one has by now: else it answers them, and nobody hears it.

        Who serves is told of readers one after the other, in the order in which they were made. So when it answers one
        that is made now, it knows those before; its answers until then are lost, and asked for again.
        """
        client = self.node.create_client(ListParameters, f"{node}/list_parameters")
        self.wait(client.service_is_ready, f"{node}/list_parameters")
        asked: list[Any] = []

        def answered() -> bool:
            asked.append(client.call_async(ListParameters.Request()))
            return any(one.done() for one in asked)

        self.wait(answered, f"an answer of {node}")
        client.destroy()

    def call(self, kind: type, name: str, request: object, keep: bool = False) -> Any:
        """The response of a service; who gets none asks again, for a server that was held up may not know us yet.

        keep: the client is there for later calls, too, which a server that wants to know who calls answers at once.
        """
        client = self._kept.pop(name, None) or self.node.create_client(kind, name)
        self.wait(client.service_is_ready, name)
        asked = [client.call_async(request)]
        again = time.monotonic() + PATIENCE / 3

        def answered() -> bool:
            if len(asked) == 1 and time.monotonic() > again:
                warnings.warn(f"{name} was asked again", stacklevel=2)
                asked.append(client.call_async(request))
            return any(future.done() for future in asked)

        self.wait(answered, f"an answer of {name}")
        if keep:
            self._kept[name] = client
        else:
            self.node.destroy_client(client)
        return next(future.result() for future in asked if future.done())

    def set(self, node: str, name: str, value: float) -> tuple[bool, str]:
        """Whether a number parameter could be set, and what was said about it."""
        number = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)
        request = SetParameters.Request(parameters=[Parameter(name=name, value=number)])
        result = self.call(SetParameters, f"{node}/set_parameters", request, keep=True).results[0]
        return result.successful, result.reason


def program(package: str, command: str) -> str:
    """The file of one of our programs."""
    return str(Path(get_package_prefix(package)) / "lib" / package / command)


def start(package: str, command: str, *arguments: object) -> "subprocess.Popen[str]":
    """One of our programs as a process; `end` ends it."""
    words = [program(package, command), *map(str, arguments)]
    return Forked(words, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def quit_all(processes: "Sequence[subprocess.Popen[str]]") -> None:
    """End them by a signal, so that none leaves its shared memory behind; kill what does not answer."""
    for process in processes:
        process.send_signal(signal.SIGTERM)
    deadline = time.monotonic() + MANNERS
    for process in processes:
        try:
            process.wait(max(0.0, deadline - time.monotonic()))
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def end(process: "subprocess.Popen[str]", number: signal.Signals = signal.SIGINT) -> tuple[str, str]:
    """Stop it: what it wrote; it has to end by itself, without a traceback."""
    process.send_signal(number)
    try:
        out, err = process.communicate(timeout=PATIENCE)
    finally:
        process.kill()
    assert "Traceback" not in err, err
    return out, err
