"""Requests to the identification node that nobody foresaw: too many at once, too long, out of its directory."""

import os
from collections.abc import Callable
from pathlib import Path
from subprocess import Popen

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from std_srvs.srv import Trigger
from workbench import Bench

from motor_msgs.srv import Identify
from motor_ros import qos

Start = Callable[..., "Popen[str]"]
SLOW = ["static_friction", "torque_ripple", "backlash"]  # minutes
LONG = Identify.Request(bag_uris=["staircase"], effects=SLOW, particles=2000, epochs=100_000)


def serve(start: Start, bags: Path, *arguments: str) -> None:
    start("motor_identification", "motor_identification", "--ros-args", "-p", f"bag_directory:={bags}", *arguments)


def test_twenty_at_once_are_all_answered_and_the_rest_is_ended_by_cancel(
    bench: Bench, start: Start, bags: Path
) -> None:
    serve(start, bags, "-p", "queue_length:=3")
    client = bench.node.create_client(Identify, "motor/identify", qos_profile=qos.REQUESTS)  # or its own 10 overflow
    bench.wait(client.service_is_ready, "the service")
    asked = [client.call_async(LONG) for _ in range(20)]
    bench.wait(lambda: sum(future.done() for future in asked) >= 16, "those for whom there is no room")
    told = [future.result().message for future in asked if future.done()]
    assert len(told) == 16 and all(message.startswith("busy: 3 requests wait already") for message in told)
    ended = bench.call(Trigger, "motor/cancel", Trigger.Request())
    assert (ended.success, ended.message) == (True, "4 requests of motor/identify were ended.")
    bench.wait(lambda: all(future.done() for future in asked), "the others")
    stopped = [future.result() for future in asked if not future.result().message.startswith("busy")]
    assert [(answer.success, answer.message) for answer in stopped] == [(False, "the computation was stopped.")] * 4


def test_no_request_names_a_place_outside_and_no_parameter_moves_the_places(
    bench: Bench, start: Start, bags: Path, tmp_path: Path
) -> None:
    """A stranger's `param set model_file`, then motor/identify, replaced any file of the user."""
    victim = tmp_path / "victim.yaml"
    victim.write_text("mine")
    serve(start, bags)
    for name in ("model_file", "report_directory", "bag_directory"):
        value = ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=str(victim))
        request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
        (result,) = bench.call(SetParameters, "motor_identification/set_parameters", request).results
        assert not result.successful and "read-only" in result.reason
    for uri in (str(tmp_path), "../../etc", "/dev/zero"):
        response = bench.call(Identify, "motor/identify", Identify.Request(bag_uris=[uri]))
        assert not response.success and "is outside of bag_directory" in response.message
    assert victim.read_text() == "mine" and list(tmp_path.iterdir()) == [victim]


def test_a_pipe_as_a_bag_is_refused_and_the_node_goes_on(bench: Bench, start: Start, tmp_path: Path) -> None:
    """It waited for somebody to write, and answered nobody until it was started again."""
    os.mkfifo(tmp_path / "bag.mcap")
    (tmp_path / "bag").mkdir()
    os.mkfifo(tmp_path / "bag" / "metadata.yaml")
    os.mkfifo(tmp_path / "bag" / "bag_0.mcap")
    serve(start, tmp_path)
    for uri, said in (("bag.mcap", "is no regular file"), ("bag", "bag"), ("none", "none")):
        response = bench.call(Identify, "motor/identify", Identify.Request(bag_uris=[uri]))
        assert not response.success and said in response.message and "\n" not in response.message


def test_a_fit_that_takes_too_long_is_ended_and_one_whose_file_cannot_be_written_is_not_lost(
    bench: Bench, start: Start, bags: Path, tmp_path: Path
) -> None:
    serve(start, bags, "-p", "time_limit:=2.0", "-p", f"model_file:={tmp_path / 'no' / 'model.yaml'}")
    late = bench.call(Identify, "motor/identify", LONG)
    assert not late.success and late.message.startswith("the computation took longer than 2 s (time_limit)")
    assert bench.set("motor_identification", "time_limit", 60.0)[0]
    response = bench.call(Identify, "motor/identify", Identify.Request(bag_uris=["staircase"]))
    assert response.success and len(response.model.parameter_values) == 2
    assert "cannot write the model file" in response.message and "\n" not in response.message


def test_a_request_for_more_than_any_memory_has_is_one_sentence(bench: Bench, start: Start, bags: Path) -> None:
    serve(start, bags)
    for name, most in (("particles", 100_000), ("epochs", 1_000_000)):
        request = Identify.Request(bag_uris=["staircase"], **{name: 2**32 - 1})
        response = bench.call(Identify, "motor/identify", request)
        assert not response.success and response.message.startswith(f"{name} is 4294967295: it must be {most} at most")
