"""Programs as actions of ROS 2's launch system; the only file that knows it."""

import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path

from launch import LaunchContext, LaunchDescription
from launch.action import Action
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction, RegisterEventHandler, Shutdown
from launch.event_handlers import OnProcessExit, OnProcessIO
from launch.events.process import ProcessExited, ProcessIO
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.substitutions import ExecutableInPackage

from motor_bringup.argument import Argument, refuse_unknown
from motor_bringup.program import Program, Session
from motor_model.errors import MotorError
from motor_model.program.starter import STARTER


def described(arguments: Iterable[Argument], session: Callable[[Mapping[str, str]], Session]) -> LaunchDescription:
    """Return a launch file: its arguments, and the session that they make."""

    def look(context: LaunchContext) -> None:
        """Before the defaults are told, too."""
        path = Path(getattr(context.locals, "current_launch_file_path", ""))
        refuse_unknown(arguments, context.launch_configurations, _is_launched(path, sys.argv))

    def start(context: LaunchContext) -> list[Action]:
        told = {argument.name: LaunchConfiguration(argument.name).perform(context) for argument in arguments}
        return _actions(session(told))

    declared = [
        DeclareLaunchArgument(
            argument.name,
            default_value=argument.default,
            description=argument.description,
            **({"choices": list(argument.choices)} if argument.choices else {}),
        )
        for argument in arguments
    ]
    return LaunchDescription([OpaqueFunction(function=look), *declared, OpaqueFunction(function=start)])


def _is_launched(path: Path, words: Sequence[str]) -> bool:
    """Whether the words of a command line launch that file itself, by package and name or by path, and no other's."""
    named = any(file == path.name and package == path.parent.parent.name for package, file in pairwise(words))
    return named or any(Path(word).resolve() == path.resolve() for word in words if Path(word).name == path.name)


def _actions(session: Session) -> list[Action]:
    running = [_process(program) for program in session.programs]
    ends = [_when_ended(program, [], process) for program, process in zip(session.programs, running, strict=True)]
    steps = _in_turn(session.steps)
    if session.ready and steps:
        return [*ends, _once_written(session.ready, running[0], steps), *running]
    return [*ends, *running, *steps]


def _in_turn(steps: tuple[Program, ...]) -> list[Action]:
    """The first step, and behind it the handlers that start the others."""
    following: list[Action] = [Shutdown(reason="all is done")]
    for program in reversed(steps):
        process = _process(program)
        following = [_when_ended(program, following, process), process]
    return following if steps else []


def _process(program: Program) -> ExecuteProcess:
    ends_with = {STARTER: str(os.getpid())}  # SIGKILL, SIGTERM and SIGHUP of a launch leave what it started behind
    if not program.node:
        executable = ExecutableInPackage(program.executable, program.package)
        words = [executable, *program.arguments]
        return ExecuteProcess(cmd=words, name=program.executable, output="screen", additional_env=ends_with)
    return Node(
        package=program.package,
        executable=program.executable,
        namespace=program.namespace,
        arguments=list(program.arguments),
        parameters=[dict(program.parameters)] if program.parameters else [],
        remappings=list(program.remappings),
        output="screen",
        additional_env=ends_with,
    )


def _when_ended(program: Program, following: list[Action], process: ExecuteProcess) -> RegisterEventHandler:
    def ended(event: ProcessExited, context: LaunchContext) -> list[Action]:
        if context.is_shutdown or not program.needed:
            return []
        if event.returncode:
            raise MotorError(f"{program.executable} ended with exit status {event.returncode}: see what it says above.")
        return following or [Shutdown(reason=f"{program.executable} has ended")]

    return RegisterEventHandler(OnProcessExit(target_action=process, on_exit=ended))


def _once_written(text: str, process: ExecuteProcess, following: list[Action]) -> RegisterEventHandler:
    waiting = [following]

    def written(event: ProcessIO) -> list[Action]:
        return waiting.pop() if waiting and text in event.text.decode(errors="replace") else []

    return RegisterEventHandler(OnProcessIO(target_action=process, on_stdout=written, on_stderr=written))
