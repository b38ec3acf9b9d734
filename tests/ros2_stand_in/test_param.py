"""`ros2 param`."""

import yaml

NODE = "/lab/bench"
NAMES = ["kp", "limits.on", "limits.voltages", "name", "start_type_description_service", "use_sim_time", "workers"]


def test_list(bench):
    ros2, _ = bench
    lines = "".join(f"  {name}\n" for name in NAMES)
    one, everyone, typed = ros2.together(f"param list {NODE}", "param list", f"param list {NODE} --param-type")
    assert one == lines
    assert everyone == f"{NODE}:\n{lines}"
    assert "  limits.voltages (type: double array)\n" in typed


def test_get(bench):
    ros2, _ = bench
    array, hidden_type = ros2.together(f"param get {NODE} limits.voltages", "param get lab/bench limits.on --hide-type")
    assert array == "Double values are: [1.5, 12.0]\n"
    assert hidden_type == "True\n"
    assert ros2("param", "get", NODE, "nope", status=1).err == f"Parameter not set: '{NODE}' has no value for 'nope'.\n"


def test_a_node_that_is_not_there_is_a_sentence(ros2):
    assert ros2("param", "get", "/nope", "kp", "--timeout", "0.1", status=1).err == (
        "Node not found: '/nope' does not run; 'ros2 node list' shows what does.\n"
    )


def test_set_is_seen_by_get_and_refusals_are_told(bench):
    ros2, _ = bench
    assert ros2("param", "set", NODE, "kp", "0.5").out == "Set parameter successful\n"
    assert ros2("param", "get", NODE, "kp").out == "Double value is: 0.5\n"
    assert ros2("param", "set", NODE, "kp", "-1.0", status=1).err.startswith("Setting parameter failed: ")
    assert ros2("param", "set", NODE, "kp", "1", status=1).err.startswith(
        "Setting parameter failed: Wrong parameter type"
    )
    for text in ("{a: 1}", "'half"):
        assert ros2("param", "set", NODE, "kp", text, status=1).err == (
            f"'{text}' is no value: write a number, true, false, a text, or a list.\n"
        )
    assert ros2("param", "get", NODE, "kp").out == "Double value is: 0.5\n"


def test_describe(bench):
    ros2, _ = bench
    assert ros2("param", "describe", NODE, "kp", "limits.on").out == (
        "Parameter name: kp\n  Type: double\n  Description: gain [V·s/rad]\n  Constraints:\n"
        "    Min value: 0.0\n    Max value: 10.0\n"
        "Parameter name: limits.on\n  Type: boolean\n  Constraints:\n    Read only: true\n"
    )


def test_dump_is_a_parameter_file(bench):
    ros2, _ = bench
    parameters = yaml.safe_load(ros2("param", "dump", NODE).out)[NODE]["ros__parameters"]
    assert parameters["limits"] == {"on": True, "voltages": [1.5, 12.0]}
    assert (parameters["name"], parameters["workers"]) == ("motor", 2)
