"""`ros2 service call`."""

import signal

import pytest


@pytest.mark.parametrize(("text", "value", "answer"), [("{data: true}", True, "on"), ("{}", False, "off")])
def test_call_prints_request_and_response(bench, text, value, answer):
    ros2, _ = bench
    out = ros2("service", "call", "/enable", "std_srvs/srv/SetBool", text).out
    assert out.removeprefix("waiting for service to become available...\n") == (
        f"requester: making request: std_srvs.srv.SetBool_Request(data={value})\n\n"
        f"response:\nstd_srvs.srv.SetBool_Response(success=True, message='{answer}')\n\n"
    )


def test_call_waits_for_a_service_that_comes_up(ros2):
    call = ros2.start("service", "call", "/enable", "std_srvs/srv/SetBool")
    call.wait_for("waiting for service to become available...")
    ros2.start_node()
    call.wait_for("std_srvs.srv.SetBool_Response(success=True, message='off')")


@pytest.mark.on_time
def test_waiting_ends_with_ctrl_c(ros2):
    call = ros2.start("service", "call", "/enable", "std_srvs/srv/SetBool")
    call.wait_for("waiting for service to become available...")
    output, took = call.end()
    assert (output.status, output.err) == (130, "")
    assert took < 1.0


def test_bad_input_is_a_sentence(ros2):
    call = ("service", "call", "/enable")
    assert ros2(*call, "std_srvs/srv/SetBool", "{dat: true}", status=1).err == (
        "std_srvs/srv/SetBool_Request has no field 'dat'; it has: data.\n"
    )
    assert ros2(*call, "std_srvs/srv/SetBool", "{data: maybe}", status=1).err == (
        "field 'data' of std_srvs/srv/SetBool_Request takes true or false, not 'maybe'.\n"
    )
    assert ros2(*call, "nope_srvs/srv/SetBool", status=1).err.startswith("Package 'nope_srvs' not found")


@pytest.fixture
def signal_handlers():
    """Puts back what a verb that runs inside the tests sets."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


def test_a_service_that_nobody_offers_is_a_sentence(ros2, signal_handlers, monkeypatch, capsys):
    from ros2_stand_in import main
    from ros2_stand_in.verbs import service

    monkeypatch.setattr(service, "_LONGEST_WAIT", 0.3)
    monkeypatch.setenv("ROS_DOMAIN_ID", ros2.env["ROS_DOMAIN_ID"])
    assert main.main(["service", "call", "nope", "std_srvs/srv/SetBool"]) == 1
    assert capsys.readouterr().err == "No service '/nope' of type std_srvs/srv/SetBool came up: is its node running?\n"
