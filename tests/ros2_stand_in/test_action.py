"""`ros2 action send_goal`."""

import re

import pytest

SEND = ("action", "send_goal", "/diagnose", "motor_msgs/action/Diagnose")


def test_goal_feedback_and_result(bench):
    ros2, _ = bench
    out = ros2(*SEND, "{bag_uris: [a], known_effects: [dead_zone]}", "--feedback").out
    head = (
        "Waiting for an action server to become available...\n"
        "Sending goal:\n     bag_uris:\n- a\nvalidation_uris: []\ntopic_namespace: ''\nknown_effects:\n- dead_zone\n\n"
    )
    assert out.startswith(head)
    accepted, feedback, result = re.split(r"\n(?=Feedback|Result)", out.removeprefix(head))
    assert re.fullmatch(r"Goal accepted with ID: [0-9a-f]{32}\n", accepted)
    assert feedback == "Feedback:\n    stage: first\nprogress: 0.25\nbest_effect: ''\ngap: 0.0\n"
    assert result.startswith(
        "Result:\n    success: true\nmessage: ''\nverdict: ''\neffects:\n- dead_zone\nmodel:\n  header:"
    )
    assert result.endswith("report_uri: ''\n\nGoal finished with status: SUCCEEDED\n")


def test_a_goal_that_did_not_succeed_is_not_status_0(bench):
    ros2, _ = bench
    assert ros2(*SEND, "{bag_uris: [a], known_effects: [none]}", status=1).out.endswith("with status: ABORTED\n")
    assert ros2(*SEND, status=1).out.endswith("\nGoal was rejected.\n")


@pytest.mark.on_time
def test_ctrl_c_cancels_the_goal(bench):
    ros2, node = bench
    goal = ros2.start(*SEND, "{bag_uris: [a], known_effects: [forever]}", "-f")
    goal.wait_for("Feedback:")
    output, took = goal.end()
    assert node.wait_for("cancelled") == "cancelled"
    assert output.out.endswith("\nCanceling goal...\nGoal canceled.\n")
    assert (output.status, output.err) == (130, "")
    assert took < 1.5


def test_bad_input_is_a_sentence(ros2):
    assert ros2(*SEND, "{bags: [a]}", status=1).err == (
        "motor_msgs/action/Diagnose_Goal has no field 'bags'; "
        "it has: bag_uris, validation_uris, topic_namespace, known_effects.\n"
    )
