"""Lists and descriptions of what runs."""

import pytest

OUR_SERVICES = """\
/enable [std_srvs/srv/SetBool]
/lab/bench/describe_parameters [rcl_interfaces/srv/DescribeParameters]
/lab/bench/get_parameter_types [rcl_interfaces/srv/GetParameterTypes]
/lab/bench/get_parameters [rcl_interfaces/srv/GetParameters]
/lab/bench/get_type_description [type_description_interfaces/srv/GetTypeDescription]
/lab/bench/list_parameters [rcl_interfaces/srv/ListParameters]
/lab/bench/set_parameters [rcl_interfaces/srv/SetParameters]
/lab/bench/set_parameters_atomically [rcl_interfaces/srv/SetParametersAtomically]
"""

TOPICS = """\
/array [std_msgs/msg/Float64MultiArray]
/fast [std_msgs/msg/Float64]
/latched [std_msgs/msg/String]
/parameter_events [rcl_interfaces/msg/ParameterEvent]
/reference [std_msgs/msg/Float64]
/rosout [rcl_interfaces/msg/Log]
/voltage [motor_msgs/msg/MotorVoltage]
"""


def test_an_empty_graph_is_known_at_once(ros2):
    assert ros2("node", "list").out == ""
    assert ros2("topic", "list").out == "/parameter_events\n/rosout\n"


def test_a_list_is_complete_although_discovery_can_take_seconds(ordinary_ros2):
    ordinary_ros2.start_node()
    assert [ordinary_ros2("node", "list").out for _ in range(2)] == ["/lab/bench\n"] * 2


def test_nodes(bench):
    ros2, _ = bench
    assert ros2("node", "list").out == "/lab/bench\n"
    out = ros2("node", "list", "-a").out.splitlines()
    assert out[0].startswith("/_ros2cli_") and out[1:] == ["/lab/bench"]


def test_topics(bench):
    ros2, _ = bench
    plain, with_hidden, verbose = ros2.together(
        "topic list -t", "topic list --include-hidden-topics", "topic list -v --no-daemon"
    )
    assert plain == TOPICS
    assert "/_hidden\n" in with_hidden
    published, subscribed = verbose.split("Subscribed topics:\n")
    assert " * /fast [std_msgs/msg/Float64] 1 publisher\n" in published
    assert subscribed == (
        " * /reference [std_msgs/msg/Float64] 1 subscriber\n * /voltage [motor_msgs/msg/MotorVoltage] 1 subscriber\n\n"
    )


def test_one_topic(bench):
    ros2, _ = bench
    kind, counts, verbose = ros2.together("topic type /fast", "topic info /reference", "topic info -v latched")
    assert kind == "std_msgs/msg/Float64\n"
    assert counts == "Type: std_msgs/msg/Float64\nPublisher count: 0\nSubscription count: 1\n"
    assert verbose.startswith(
        "Type: std_msgs/msg/String\n\nPublisher count: 1\n\nNode name: bench\nNode namespace: /lab\n"
    )
    assert "  Durability: TRANSIENT_LOCAL\n" in verbose
    assert verbose.endswith("Subscription count: 0\n\n")


def test_services(bench):
    ros2, _ = bench
    assert ros2.together("service list -t", "service type enable") == [OUR_SERVICES, "std_srvs/srv/SetBool\n"]


def test_what_is_not_there_is_a_sentence(ros2):
    assert ros2("topic", "info", "/nope", status=1).err == (
        "Unknown topic '/nope': nobody publishes or subscribes to it.\n"
    )
    assert ros2("service", "type", "/nope", status=1).err == "Unknown service '/nope': no running node offers it.\n"
    assert (
        ros2("node", "info", "nope", status=1).err == "Unable to find node '/nope'; 'ros2 node list' shows what runs.\n"
    )


@pytest.mark.parametrize(
    "words",
    [
        ("topic", "info", "/a b"),
        ("topic", "echo", "/1a"),
        ("topic", "hz", "a/"),
        ("topic", "pub", "/a//b", "std_msgs/msg/Float64"),
        ("topic", "pub", "/a", "std_msgs/msg/Float64", "-n", "a b"),
        ("service", "call", "a-b", "std_srvs/srv/SetBool"),
        ("action", "send_goal", "", "motor_msgs/action/Diagnose"),
        ("node", "info", "a b"),
        ("param", "list", "a b"),
    ],
)
def test_impossible_names_are_a_sentence(ros2, words):
    assert ros2(*words, status=1).err.endswith(
        "' cannot be a name in ROS: between slashes stand letters, digits and _, a digit not first.\n"
    )


def test_an_impossible_domain_is_a_sentence(ros2):
    err = ros2("node", "list", status=1, ROS_DOMAIN_ID="lab").err
    assert err.startswith("ROS 2 cannot start: ROS_DOMAIN_ID is not an integral number")
    assert err.count("\n") == 1


def test_actions(bench):
    ros2, _ = bench
    assert ros2("action", "list", "-t").out == "/diagnose [motor_msgs/action/Diagnose]\n"


def test_one_node(bench):
    ros2, _ = bench
    services = "".join(f"    {line[:-1].replace(' [', ': ')}\n" for line in OUR_SERVICES.splitlines())
    assert ros2("node", "info", "/lab/bench").out == (
        "/lab/bench\n  Subscribers:\n    /reference: std_msgs/msg/Float64\n    /voltage: motor_msgs/msg/MotorVoltage\n"
        "  Publishers:\n    /array: std_msgs/msg/Float64MultiArray\n    /fast: std_msgs/msg/Float64\n"
        "    /latched: std_msgs/msg/String\n    /parameter_events: rcl_interfaces/msg/ParameterEvent\n"
        f"    /rosout: rcl_interfaces/msg/Log\n  Service Servers:\n{services}  Service Clients:\n\n"
        "  Action Servers:\n    /diagnose: motor_msgs/action/Diagnose\n  Action Clients:\n\n"
    )
