"""`ros2 action`: which actions there are, and sending a goal to one."""

import argparse
from typing import Any

from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient, get_action_names_and_types

from motor_model.errors import MotorError
from ros2_stand_in.graph import discovery
from ros2_stand_in.graph.session import Session, session
from ros2_stand_in.interfaces import interface_type, rendering, values

_LONGEST_WAIT = 10.0  # [s] for an action that nobody offers (yet)
_LONGEST_CANCEL = 5.0  # [s]
_LOOK_EVERY = 0.02  # [s]
_STATUS = {
    getattr(GoalStatus, f"STATUS_{name}"): name
    for name in ("ACCEPTED", "EXECUTING", "CANCELING", "SUCCEEDED", "CANCELED", "ABORTED")
}


def actions_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 action list` takes."""
    parser.add_argument("-t", "--show-types", action="store_true", help="print the types too")
    parser.add_argument("-c", "--count-actions", action="store_true", help="print only how many there are")
    discovery.discovery_arguments(parser)


def actions(args: argparse.Namespace) -> int:
    """Print all actions."""
    with session() as ros:
        discovery.settle(ros, args.spin_time)
        discovery.print_list(get_action_names_and_types(ros.node), args.show_types, args.count_actions)
    return 0


def send_goal_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 action send_goal` takes."""
    parser.add_argument("action_name", help="name of the action")
    parser.add_argument("action_type", help="type, such as motor_msgs/action/Diagnose")
    parser.add_argument("goal", nargs="?", default="{}", help="fields of the goal in YAML")
    parser.add_argument("-f", "--feedback", action="store_true", help="print the feedback too")


def send_goal(args: argparse.Namespace) -> int:
    """Send a goal, however long it takes, and print its result; exit status 0 is a goal that succeeded."""
    kind = interface_type.load(args.action_type, "action")
    goal = kind.Goal()
    values.fill(goal, values.parse(args.goal))
    name = discovery.full_name(args.action_name)
    with session() as ros:
        client = ActionClient(ros.node, kind, name)
        print("Waiting for an action server to become available...")
        if not ros.spin(client.server_is_ready, _LONGEST_WAIT, _LOOK_EVERY):
            raise MotorError(f"No action '{name}' of type {args.action_type} came up: is its node running?")
        print(f"Sending goal:\n     {rendering.to_yaml(goal)}")
        feedback = _Feedback()
        sent = client.send_goal_async(goal, feedback if args.feedback else None)
        try:
            return _follow(ros, client, sent, name, feedback)
        except KeyboardInterrupt:
            _cancel(ros, sent, name)
            raise
        finally:
            client.destroy()  # the node would not, and others would take us for alive for another 20 s


class _Feedback:
    """Prints feedback, but none before it is said that the goal is accepted."""

    def __init__(self) -> None:
        self._held: list[str] | None = []

    def __call__(self, message: Any) -> None:
        text = f"Feedback:\n    {rendering.to_yaml(message.feedback)}"
        if self._held is None:
            print(text)
        else:
            self._held.append(text)

    def release(self) -> None:
        """Print what came so far, and from now on everything at once."""
        for text in self._held or ():
            print(text)
        self._held = None


def _follow(ros: Session, client: ActionClient, sent: Any, name: str, feedback: _Feedback) -> int:
    _wait(ros, client, sent, name)
    handle = sent.result()
    if not handle.accepted:
        print("Goal was rejected.")
        return 1
    print(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
    feedback.release()
    finished = handle.get_result_async()
    _wait(ros, client, finished, name)
    answer = finished.result()
    print(f"Result:\n    {rendering.to_yaml(answer.result)}")
    print(f"Goal finished with status: {_STATUS.get(answer.status, 'UNKNOWN')}")
    return 0 if answer.status == GoalStatus.STATUS_SUCCEEDED else 1


def _wait(ros: Session, client: ActionClient, future: Any, name: str) -> None:
    ros.spin(lambda: future.done() or not client.server_is_ready())
    if not future.done():
        raise MotorError(f"The node that offers '{name}' ended before it answered.")


def _cancel(ros: Session, sent: Any, name: str) -> None:
    """Cancel a goal, even one that is sent and not yet known to be accepted."""
    print("Canceling goal...")
    ros.forgive_interrupt()
    if ros.spin(sent.done, _LONGEST_CANCEL) and not sent.result().accepted:
        return
    cancelled = sent.result().cancel_goal_async() if sent.done() else None
    if cancelled is None or not ros.spin(cancelled.done, _LONGEST_CANCEL) or not cancelled.result().goals_canceling:
        raise MotorError(f"'{name}' did not cancel the goal: it may still be working on it.")
    print("Goal canceled.")
