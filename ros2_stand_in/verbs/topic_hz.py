"""`ros2 topic hz`: how often messages come, and how evenly."""

import argparse
import time
from collections import deque
from typing import Any

import numpy as np

from ros2_stand_in.arguments import positive_count
from ros2_stand_in.graph import discovery, qos
from ros2_stand_in.graph.session import session
from ros2_stand_in.verbs.topic import message_type

_PRINT_EVERY = 1.0  # [s]


def rate_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 topic hz` takes."""
    parser.add_argument("topic_name", help="name of the topic")
    parser.add_argument("-w", "--window", type=positive_count, default=10000, metavar="N",
                        help="how many of the latest messages to average over (default: %(default)s)")  # fmt: skip
    discovery.discovery_arguments(parser)


def rate(args: argparse.Namespace) -> int:
    """Print the rate once a second until Ctrl-C."""
    name = discovery.full_name(args.topic_name)
    with session() as ros:
        discovery.settle(ros, args.spin_time, lambda: ros.node.count_publishers(name))
        kind = message_type(ros, name, None)
        intervals = Intervals(args.window)
        profile = qos.fitting([], "sensor_data")
        ros.node.create_subscription(kind, name, lambda message: intervals.tick(time.monotonic_ns()), profile, raw=True)
        while True:
            ros.pause(_PRINT_EVERY)
            if intervals.news:
                print(intervals.report())


class Intervals:
    """The times between the latest messages."""

    def __init__(self, window: int) -> None:
        self._latest: int | None = None
        self._intervals: deque[int] = deque(maxlen=window)  # [ns]
        self.news = False

    def tick(self, now: int) -> None:
        """A message came at this time [ns] of a steady clock."""
        if self._latest is not None:
            self._intervals.append(now - self._latest)
            self.news = True
        self._latest = now

    def report(self) -> str:
        """The real command's two lines about the intervals so far."""
        self.news = False
        seconds: Any = np.array(self._intervals) * 1e-9
        return (
            f"average rate: {1.0 / seconds.mean():.3f}\n\tmin: {seconds.min():.3f}s max: {seconds.max():.3f}s "
            f"std dev: {seconds.std():.5f}s window: {len(seconds)}"
        )
