"""A motor's health as a message."""

import time
from math import nan

from motor_identification.monitoring.health import Health, ratio_of
from motor_msgs.msg import MotorHealth
from motor_ros.messages import time_message


def health_message(health: Health, name: str) -> MotorHealth:
    """Make the message of a motor's health that goes out on `motor/health`."""
    verdict, gap = health.verdict, health.verdict.gap
    message = MotorHealth(
        state=verdict.state.value,
        sentence=verdict.sentence,
        innovation_ratio=ratio_of(gap),
        since=time_message(health.since),
        changed_names=[change.name for change in verdict.changes],
        changed_values=[change.value for change in verdict.changes],
        changed_errors=[change.error for change in verdict.changes],
        residual_rms=gap.rms if gap else nan,
        noise_floor=gap.expected if gap else nan,
        window=gap.duration if gap else 0.0,
    )
    message.header.stamp = time_message(time.time_ns())
    message.header.frame_id = name
    return message
