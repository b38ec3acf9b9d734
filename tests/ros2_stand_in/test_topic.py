"""`ros2 topic echo`, `hz` and `pub`, against a running node and against each other."""

import re

import pytest

from ros2_stand_in.verbs.topic_hz import Intervals


def test_echo_once(bench):
    ros2, _ = bench
    latched, array = ros2.together("topic echo --once /latched", "topic echo --once /array")
    assert latched == "data: for those who come later\n---\n"
    assert array == "layout:\n  dim: []\n  data_offset: 0\ndata:\n- 0.5\n- 1.0e-06\n---\n"


def test_echo_of_a_field_and_as_csv(bench):
    ros2, _ = bench
    assert ros2.together(
        "topic echo --once /fast --field data",
        "topic echo --once /array --field layout",
        "topic echo --once /array --csv",
    ) == ["0.5\n---\n", "dim: []\ndata_offset: 0\n---\n", "0,0.5,1e-06\n"]
    assert ros2("topic", "echo", "--once", "/array", "--field", "layout.size", status=1).err == (
        "Invalid field 'layout.size': there is no 'size'; there is: dim, data_offset.\n"
    )


def test_qos_asked_for_is_used(bench):
    ros2, _ = bench
    echo = ("topic", "echo", "/latched")
    assert ros2(*echo, "--qos-durability", "volatile", "--timeout", "0.5").out == ""
    latched = ("--qos-durability", "transient_local", "--qos-reliability", "reliable")
    assert ros2(*echo, *latched, "--once").out == "data: for those who come later\n---\n"


@pytest.mark.on_time
def test_echo_waits_for_its_topic_and_takes_what_is_latched(ros2):
    echo = ros2.start("topic", "echo", "/latched")
    warning = "WARNING: topic [/latched] does not appear to be published yet"
    echo.wait_for(warning, errors=True)
    ros2.start_node()
    echo.wait_for("data: for those who come later")
    output, took = echo.end()
    assert output.err == f"{warning}\n"
    assert output.out == "data: for those who come later\n---\n"
    assert output.status == 130
    assert took < 1.0


def test_echo_fits_a_publisher_that_comes_after_its_subscription(ros2):
    echo = ros2.start("topic", "echo", "--once", "/latched", "std_msgs/msg/String")
    ros2.start_node("--late")
    echo.wait_for("data: for those who come later")


@pytest.mark.on_time
@pytest.mark.parametrize("words", [("echo", "/fast"), ("pub", "/fast", "std_msgs/msg/Float64")])
def test_ctrl_c_ends_at_once_without_a_traceback(bench, words):
    ros2, _ = bench
    process = ros2.start("topic", *words)
    process.wait_for({"echo": "data: 0.5", "pub": "publishing #1"}[words[0]])
    output, took = process.end()
    assert (output.status, output.err) == (130, "")
    assert took < 1.0


def test_a_reader_that_goes_ends_it_quietly(bench):
    ros2, _ = bench
    process = ros2.start_shell("topic echo /fast | head -n 1; echo ${PIPESTATUS[0]}")
    assert process.wait_for("data") == "data: 0.5"
    output, _ = process.end(None)
    assert (output.out, output.err) == ("data: 0.5\n141\n", "")


@pytest.mark.on_time
def test_hz_measures_the_rate(bench):
    ros2, _ = bench
    process = ros2.start("topic", "hz", "/fast", "--window", "20")
    line = process.wait_for("average rate: ")
    assert 40.0 < float(line.split()[-1]) < 60.0
    numbers = re.fullmatch(
        r"\tmin: (\d\.\d{3})s max: (\d\.\d{3})s std dev: (\d\.\d{5})s window: (\d+)", process.wait_for("\t")
    )
    low, high, spread, window = map(float, numbers.groups())
    assert 0.0 <= low <= 0.02 <= high < 0.2
    assert 0.0 < spread < 0.1
    assert window == 20
    output, took = process.end()
    assert (output.status, output.err) == (130, "")
    assert took < 1.0


def test_hz_of_known_times():
    intervals = Intervals(window=3)
    for time in (0, 900_000_000, 910_000_000, 930_000_000, 960_000_000):
        assert intervals.news == (time > 0) or time == 900_000_000
        intervals.tick(time)
    assert intervals.report() == "average rate: 50.000\n\tmin: 0.010s max: 0.030s std dev: 0.00816s window: 3"
    assert not intervals.news


def test_pub_once_arrives(bench):
    ros2, node = bench
    out = ros2("topic", "pub", "--once", "/reference", "std_msgs/msg/Float64", "{data: 100}").out
    assert node.wait_for("reference") == "reference 100.0"
    lines = [line for line in out.splitlines() if not line.startswith("Waiting for")]
    assert lines == ["publisher: beginning loop", "publishing #1: std_msgs.msg.Float64(data=100.0)", ""]


@pytest.mark.slow
def test_pub_once_arrives_at_everyone_who_listens_already(ordinary_ros2):
    listeners = [ordinary_ros2.start("topic", "echo", "/told", "std_msgs/msg/Float64") for _ in range(3)]
    while "/told [std_msgs/msg/Float64] 3 subscribers" not in ordinary_ros2("topic", "list", "-v").out:
        pass  # they are starting
    ordinary_ros2("topic", "pub", "--once", "/told", "std_msgs/msg/Float64", "{data: 7.5}")
    for listener in listeners:
        assert listener.wait_for("data: ") == "data: 7.5"


def test_pub_times_at_a_rate_with_automatic_stamps(bench):
    ros2, node = bench
    words = ("/voltage", "motor_msgs/msg/MotorVoltage", "{header: auto, voltage: -1.5}")
    out = ros2("topic", "pub", "-t", "3", "-r", "50", "-p", "2", *words).out
    assert [node.wait_for("voltage") for _ in range(3)] == ["voltage -1.5 now"] * 3
    assert re.findall(r"publishing #(\d+)", out) == ["2"]


def test_pub_waits_for_someone_to_listen(ros2):
    pub = ros2.start("topic", "pub", "-1", "/reference", "std_msgs/msg/Float64", "data: 2")
    pub.wait_for("Waiting for at least 1 matching subscription(s)...")
    assert ros2.start_node().wait_for("reference") == "reference 2.0"
    pub.wait_for("publishing #1")


def test_pub_gives_up_where_told_to(ros2):
    words = ("/reference", "std_msgs/msg/Float64", "--once", "--max-wait-time-secs", "0.2")
    assert ros2("topic", "pub", *words, status=1).err == (
        "Nobody to publish to after 0.2 s: 0 of 1 matching subscriptions.\n"
    )


def test_bad_input_is_a_sentence(ros2):
    pub = ("topic", "pub", "/reference")
    assert ros2(*pub, "std_msgs/msg/Float64", "{dat: 1}", status=1).err == (
        "std_msgs/msg/Float64 has no field 'dat'; it has: data.\n"
    )
    assert ros2(*pub, "std_msgs/msg/Float46", status=1).err.startswith("There is no interface 'std_msgs/msg/Float46'")
    assert ros2(*pub, "std_srvs/srv/SetBool", status=1).err == (
        "'std_srvs/srv/SetBool' is not a msg type name; one looks like std_msgs/msg/Float64.\n"
    )
    assert "'0' is not a number above 0" in ros2(*pub, "std_msgs/Float64", "-r", "0", status=2).err
