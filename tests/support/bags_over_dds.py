"""What tests of `record` and `play` share: samples that tell which one is missing, and queues that lose none."""

import subprocess
from collections.abc import Callable

from rclpy.qos import QoSProfile

from motor_model.sample import Info, Sample

PERIOD = 5_000_000  # [ns]
DEEP = QoSProfile(depth=1000)  # loses nothing, however busy the machine is


INFO = Info(name="wheel", max_voltage=9.0)


Start = Callable[..., "subprocess.Popen[str]"]


def sample(k: int) -> Sample:
    return Sample(k * PERIOD, 100.0 + k, 6.0, edge_count=k)
