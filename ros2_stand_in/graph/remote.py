"""The parameter services of another node, asked and waited for."""

from typing import Any

from rcl_interfaces.msg import Parameter
from rclpy.parameter_client import AsyncParameterClient

from motor_model.errors import MotorError
from ros2_stand_in.graph import discovery
from ros2_stand_in.graph.session import Session

_LONGEST_WAIT = 5.0  # [s] for the parameter services of a node that is there
_LOOK_EVERY = 0.02  # [s]


class Remote:
    """Another node's parameters.

    Raises:
        MotorError: the node does not run, offers no parameters, or does not answer.
    """

    def __init__(self, ros: Session, name: str, timeout: float = 1.0) -> None:
        self._ros, self._name = ros, discovery.full_name(name)
        self._client = AsyncParameterClient(ros.node, self._name)
        self._wait(timeout)

    def names(self) -> list[str]:
        """All parameters, sorted."""
        return sorted(self._answer(self._client.list_parameters()).result.names)

    def values(self, names: list[str]) -> Any:
        """Their rcl_interfaces/msg/ParameterValue."""
        return self._answer(self._client.get_parameters(names)).values

    def set(self, parameters: list[Parameter]) -> Any:
        """Their rcl_interfaces/msg/SetParametersResult."""
        return self._answer(self._client.set_parameters(parameters)).results

    def describe(self, names: list[str]) -> Any:
        """Their rcl_interfaces/msg/ParameterDescriptor."""
        return self._answer(self._client.describe_parameters(names)).descriptors

    def _wait(self, timeout: float) -> None:
        def there() -> bool:
            return self._name in discovery.node_names(self._ros.node, hidden_too=True)

        discovery.settle(self._ros, enough=self._client.services_are_ready)
        if not self._ros.spin(lambda: there() or self._client.services_are_ready(), timeout, _LOOK_EVERY):
            raise MotorError(f"Node not found: '{self._name}' does not run; 'ros2 node list' shows what does.")
        if not self._ros.spin(self._client.services_are_ready, _LONGEST_WAIT, _LOOK_EVERY):
            raise MotorError(f"Node '{self._name}' runs, but offers no parameter services.")

    def _answer(self, future: Any) -> Any:
        if not self._ros.spin(future.done, _LONGEST_WAIT):
            raise MotorError(f"Node '{self._name}' did not answer within {_LONGEST_WAIT:g} s: is it busy?")
        return future.result()
