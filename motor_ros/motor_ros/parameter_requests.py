"""Refuse requests to set parameters to values of a type that there is none of: rclpy would end the node at them."""

from collections.abc import Callable
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.service import Service

SETTERS = ("/set_parameters", "/set_parameters_atomically")
KINDS = frozenset(kind.value for kind in Parameter.Type)
NO_KIND = "{} has a value of type {}, which ROS 2 has none of: nothing was set."


def parameter_setters(node: Node) -> list[Service]:
    """List the services by which a node's parameters are set."""
    return [one for one in node.services if one.service_name.endswith(SETTERS)]


def refuse_setting(request: Any, response: Any, why: str) -> Any:
    """Fill in the response that says of each parameter of a request that it was not set, and why."""
    refusal = SetParametersResult(successful=False, reason=why)
    if hasattr(response, "results"):
        response.results = [refusal for _ in request.parameters]
    else:
        response.result = refusal
    return response


def check_parameter_requests(node: Node) -> None:
    """Let no request through to a node that names a type which there is none of."""
    for service in parameter_setters(node):
        service.callback = _checked(service.callback)


def _checked(answer: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    def check(request: Any, response: Any) -> Any:
        for one in request.parameters:
            if one.value.type not in KINDS:
                return refuse_setting(request, response, NO_KIND.format(one.name, one.value.type))
        return answer(request, response)

    return check
