"""How every node of the workbench starts and ends: on this machine only, without a traceback, never with power on."""

import os
import signal
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import FrameType

import rclpy
from rclpy.executors import Executor, ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from motor_model.errors import MotorError
from motor_model.given.mistakes import find_mistake
from motor_model.program.internal_error import report
from motor_model.program.starter import read_starter, watch_starter
from motor_ros.clocks.clock_watch import ClockWatch
from motor_ros.graph.open_sockets import refuse_open_sockets
from motor_ros.graph.process_number import refuse_crowd, tell_crowd
from motor_ros.loopback import stay_on_this_machine
from motor_ros.parameter_requests import check_parameter_requests
from motor_ros.parameters import given_parameters, unknown_parameters
from motor_ros.program import INVALID_ARGUMENTS, Program, answer, plain_sentence

LOOK_FOR_SIGNALS_EVERY = 0.1  # [s] how long an idle node takes at most to notice Ctrl-C
CAUSES: dict[int, str] = {
    signal.SIGINT: "Ctrl-C",
    signal.SIGTERM: "it was told to end",
    signal.SIGHUP: "the terminal was closed",
}


def start_ros(args: list[str] | None = None) -> None:
    """Initialise rclpy with our own handling of signals, so that a node can still publish after Ctrl-C.

    Raises:
        MotorError: the arguments or the environment do not allow it.
    """
    if said := stay_on_this_machine():
        print(said, file=sys.stderr)
    check_security(os.environ)
    try:
        rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    except (rclpy_implementation.RCLError, *INVALID_ARGUMENTS) as error:
        raise MotorError(f"ROS 2 cannot start: {plain_sentence(error)}: correct that, and start again.") from error


def check_security(environment: Mapping[str, str]) -> None:
    """Refuse to run without the security that the user has asked for.

    Raises:
        MotorError: there is no keystore.
    """
    if environment.get("ROS_SECURITY_ENABLE") != "true":
        return
    keystore = environment.get("ROS_SECURITY_KEYSTORE", "")
    if not keystore or not Path(keystore).is_dir():
        raise MotorError(
            f"ROS_SECURITY_ENABLE is true and there is no keystore (ROS_SECURITY_KEYSTORE is '{keystore}'): "
            "make one as docs/security.md says, or unset ROS_SECURITY_ENABLE."
        )


class Interrupt:
    """Becomes true at the first SIGINT, SIGTERM or SIGHUP (a terminal that is closed, unless `nohup` stands before us).

    Or when the launch that started us ends, however it does. As in rclpy and rosbag2, SIGINT is heard where a script's
    `&` has us start with it ignored: `kill -INT` is meant.
    """

    def __init__(self) -> None:
        self.received: int | None = None  # the first signal
        self._alone = False  # the launch that started us has ended
        for number in CAUSES:
            if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self._on_signal)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, CAUSES)  # whoever started us may have held them back
        if starter := read_starter(os.environ):
            watch_starter(starter, self._on_starter_ended)

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        self.received = self.received or number

    def _on_starter_ended(self) -> None:
        if self.received is None:
            self._alone = True
            os.kill(os.getpid(), signal.SIGTERM)

    def __bool__(self) -> bool:
        return self.received is not None

    def forgive(self) -> None:
        """Go on after a signal; the next one is the first again."""
        self.received = None

    @property
    def cause(self) -> str:
        """What the first signal meant, as a clause; empty before it."""
        if self and self._alone:
            return "the launch that started it has ended"
        return CAUSES.get(self.received or 0, "")


def quick_executor() -> Executor:
    """One that is told what has come instead of asking each entity every time: at 1 kHz, half the processor.

    For nodes with topics, services and timers that are spun once: it knows neither guard conditions nor coroutines, and
    a node that it has let go is not served again.
    """
    try:
        from rclpy.experimental import EventsExecutor
    except ImportError:  # before rclpy 7.1.4
        return SingleThreadedExecutor()
    executor: Executor = EventsExecutor()
    return executor


def spin(node: Node, until: Callable[[], bool], make_executor: Callable[[], Executor] = SingleThreadedExecutor) -> None:
    """Run the node's callbacks until the condition holds or ROS is shut down from outside."""
    executor = make_executor()
    executor.add_node(node)
    try:
        with ClockWatch(node, executor):
            while rclpy.ok() and not until():
                executor.spin_once(timeout_sec=LOOK_FOR_SIGNALS_EVERY)
    except ExternalShutdownException:
        pass
    finally:
        executor.shutdown(timeout_sec=0.5)


def _created(create: Callable[[], Node]) -> Node:
    """The node.

    Raises:
        MotorError: the middleware cannot make it, such as one without security where that is asked for.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # of what rclpy could not take back either
            return create()
    except rclpy_implementation.RCLError as error:
        raise MotorError(f"ROS 2 cannot start: {plain_sentence(error)}: correct that, and start again.") from error


def run(
    create: Callable[[], Node],
    args: list[str] | None = None,
    make_executor: Callable[[], Executor] = SingleThreadedExecutor,
    program: Program | None = None,
) -> int:
    """Create a node, run it until Ctrl-C, let it `close()`, and return the exit status.

    With a `program`, `--help` and `--version` are answered without starting. A node that has a `close` method is asked
    to leave the motor at 0 V while it can still publish; one that has a `doubt` method is told, as a clause, what was
    given to it and does not reach it.
    """
    if program is not None:
        answer(program, sys.argv[1:] if args is None else args)
    node: Node | None = None
    status = 0
    try:
        interrupt = Interrupt()
        start_ros(args)
        node = _created(create)
        refuse_open_sockets(node)
        if hasattr(node, "doubt"):
            refuse_crowd(node)
        elif crowd := tell_crowd(node):
            node.get_logger().warning(crowd)
        check_parameter_requests(node)
        for warning in unknown_parameters(node, program.rows if program else ()):
            node.get_logger().warning(warning)
        _doubt(node, program, sys.argv[1:] if args is None else args)
        spin(node, lambda: bool(interrupt), make_executor)
    except MotorError as error:
        print(error, file=sys.stderr)
        status = 1
    except Exception as error:
        print(report(error), file=sys.stderr)
        status = 1
    finally:
        if node is not None:
            status = max(status, _end(node))
        rclpy.try_shutdown()
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # a second Ctrl-C does not turn a clean end into a failure
    return status


def _doubt(node: Node, program: Program | None, words: Sequence[str]) -> None:
    """Have a node that drives a motor leave it at 0 V where something that was given does not reach the node."""
    doubt = getattr(node, "doubt", None)
    if doubt is None or program is None:
        return
    known = [row.name for row in program.rows]
    if mistake := find_mistake(node.get_fully_qualified_name(), given_parameters(node), known, words):
        doubt(mistake)


def _end(node: Node) -> int:
    """Let a node `close()`, and take it down even where that fails, so that it lets go of its port; the exit status."""
    try:
        close = getattr(node, "close", None)
        if close is not None and rclpy.ok():
            close()
    except Exception as error:
        print(report(error), file=sys.stderr)
        return 1
    finally:
        node.destroy_node()
    return 0
