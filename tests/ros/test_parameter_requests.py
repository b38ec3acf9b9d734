"""A request of a type of parameter that there is none of ends no node: one message of anybody ended each."""

from collections.abc import Callable
from subprocess import Popen

import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from workbench import Bench

from motor_ros.parameter_requests import NO_KIND

Start = Callable[..., "Popen[str]"]
# Executors differ in how they call a service, and nodes in whether recordings may set their parameters.
NODES = [("motor_sim", "motor_sim"), ("motor_identification", "motor_identification")]


def setting(kind: int) -> Parameter:
    return Parameter(name="use_sim_time", value=ParameterValue(type=kind, bool_value=False))


@pytest.mark.parametrize(("package", "program"), NODES)
@pytest.mark.parametrize(
    ("kind", "set_up"), [(ParameterType.PARAMETER_BOOL, True), (ParameterType.PARAMETER_STRING_ARRAY + 1, False)]
)
def test_a_value_of_no_type_is_refused_and_nothing_ends(
    bench: Bench, start: Start, package: str, program: str, kind: int, set_up: bool
) -> None:
    process = start(package, program)
    told = [setting(ParameterType.PARAMETER_BOOL), setting(kind)]
    one = bench.call(SetParameters, f"{program}/set_parameters", SetParameters.Request(parameters=told)).results
    assert [result.successful for result in one] == [set_up, set_up]
    asked = SetParametersAtomically.Request(parameters=told)
    whole = bench.call(SetParametersAtomically, f"{program}/set_parameters_atomically", asked).result
    assert whole.successful is set_up and process.poll() is None
    assert set_up or {result.reason for result in [*one, whole]} == {NO_KIND.format("use_sim_time", kind)}
