"""Turn what the controller says into messages."""

from collections.abc import Sequence

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from motor_control.controller.output import DISABLED, NO_SAMPLES, RUNNING, STOPPED, Output
from motor_control.controller.reference.demand import Demand
from motor_control.controller.reference.joint_command import Unreadable, read_joint_command
from motor_control.controller.run import Config
from motor_msgs.msg import ControlState
from motor_ros.messages import diagnostic_message

LEVELS = {
    RUNNING: DiagnosticStatus.OK,
    DISABLED: DiagnosticStatus.OK,
    NO_SAMPLES: DiagnosticStatus.ERROR,
    STOPPED: DiagnosticStatus.ERROR,
}
RIVALS = "More than one node publishes motor/voltage, and the plant may obey any of them: end the others."
REFERRERS = "Several nodes publish references ({}), and the latest is obeyed, whosever it is: end all but one."


def control_state_message(output: Output, header: Header) -> ControlState:
    """Make the message of an output for `motor/control_state`."""
    terms = output.terms
    return ControlState(
        header=header,
        state=output.state,
        reason=output.reason,
        reference=output.reference,
        speed=output.speed,
        speed_sigma=output.speed_sigma,
        innovation=output.innovation,
        error=terms.error,
        proportional=terms.proportional,
        integral=terms.integral,
        feedforward=terms.feedforward,
        voltage=terms.voltage,
        saturated=terms.saturated,
        latency=output.latency,
    )


def joint_demand_of(message: JointState, config: Config) -> Demand | str | None:
    """Find what a message asks of this motor, or a sentence why that cannot be told; None: nothing."""
    try:
        return read_joint_command(
            message.name, message.velocity, message.effort, config.joint, config.effort_as_voltage
        )
    except Unreadable as error:
        return str(error)


def diagnostics_message(
    output: Output,
    config: Config,
    answered: int,
    worst: float,
    publishers: int,
    referrers: Sequence[str],
    missing: str,
    unheard: str,
    name: str,
    stamp: Time,
) -> DiagnosticArray:
    """Make one status: state, samples `answered` in the last second, their `worst` latency [s], publishers, referrers.

    Referrers: the nodes that publish a reference that is in force; missing: who should be there, a sentence;
    unheard: who asks for a motion and cannot be heard.
    """
    problem = RIVALS if publishers > 1 else REFERRERS.format(", ".join(referrers)) if len(referrers) > 1 else missing
    problem = " ".join(filter(None, (problem, unheard)))
    values = {
        "state": output.state,
        "samples per second": str(answered),
        "largest latency [ms]": f"{1e3 * worst:.2f}",
        "publishers of motor/voltage": str(publishers),
        "voltage limit [V]": f"{config.voltage_limit:g}",
        "single channel": str(config.single_channel).lower(),
        "speed source": "measured" if config.observer is None else "observer",
        "feedforward": str(config.feedforward is not None).lower(),
    }
    level = max(LEVELS[output.state], DiagnosticStatus.WARN if problem or output.warning else DiagnosticStatus.OK)
    return diagnostic_message(name, level, problem or output.reason or output.state, values, stamp)
