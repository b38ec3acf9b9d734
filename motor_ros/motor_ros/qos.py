"""The QoS of every topic, in one place: publishers and subscribers that share a row always connect."""

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy


def _reliable(depth: int, durability: DurabilityPolicy = DurabilityPolicy.VOLATILE) -> QoSProfile:
    return QoSProfile(depth=depth, reliability=ReliabilityPolicy.RELIABLE, durability=durability)


def newest(profile: QoSProfile) -> QoSProfile:
    """Make a subscription that keeps the newest message alone: who is held up answers that, not what has queued up."""
    return QoSProfile(depth=1, reliability=profile.reliability, durability=profile.durability)


SPEED = _reliable(100)
INFO = _reliable(1, DurabilityPolicy.TRANSIENT_LOCAL)
VOLTAGE = _reliable(1)
COMMANDS = _reliable(10)  # where voltages and references arrive: one sender does not push out what another has sent
REFERENCE = _reliable(1)
CONTROL_STATE = _reliable(100)
MODEL = _reliable(1, DurabilityPolicy.TRANSIENT_LOCAL)
HEALTH = _reliable(1, DurabilityPolicy.TRANSIENT_LOCAL)
JOINT_STATES = _reliable(10)
DIAGNOSTICS = _reliable(10)
ODOMETRY = _reliable(10)
TRANSFORMS = _reliable(100)  # as tf2 has it
REQUESTS = _reliable(1000)  # of a service that many may call at once: who is not heard is not answered
