"""Play a bag: its messages in the order of time, each when it is due, round after round."""

import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from motor_identification.bag import Contents, in_time_order, messages
from motor_identification.live.playback_schedule import Schedule
from motor_identification.live.publishers import Publishers
from motor_model.errors import RecordingError
from motor_ros.terminal import in_place

ANNOUNCED_GAP = 10.0  # [s] who sees nothing happen that long asks why
HELD_UP = 1.0  # [s] after which nobody expects a motor to be driven on
LONGEST_GAP = 30 * 86400.0  # [s] no bag of a motor pauses for a month; garbled log times lie centuries off


@dataclass
class Playback:
    """A bag, what publishes it, and when."""

    uri: str
    bag: Contents
    publishers: Publishers
    schedule: Schedule
    start_offset: float  # [s] that are left out
    _damage: set[str] = field(default_factory=set)  # that has been said

    def run(self, interrupted: Callable[[], bool], loop: bool) -> None:
        """Publish what is due until the end, or until interrupted; with `loop` begin again at the end.

        Raises:
            RecordingError: a garbled log time, which would have us wait for ever; or a motor's commands were held up.
        """
        start = (self.bag.span.first if self.bag.span else 0) + round(self.start_offset * 1e9)
        for topic, data in self._latched_before(start):
            self.publishers.publish(topic, data)
        shown = time.monotonic()
        going = True
        while going:
            begun = False
            for topic, log_time, data in self._from(start):
                if not begun:
                    self.schedule.begin(log_time)
                    begun = True
                self._check_gap(self.schedule.gap(log_time))
                if not self.schedule.wait(log_time, interrupted):
                    return
                self._check_hold_up()
                self.publishers.publish(topic, data)
                if time.monotonic() - shown >= 1.0:
                    shown, elapsed = time.monotonic(), self.schedule.elapsed(log_time)
                    in_place(f"{elapsed:.0f} of {self.bag.duration:.0f} s, {self.schedule.played} messages")
            going = loop and begun

    def _check_hold_up(self) -> None:
        """Refuse to drive a motor on that has stood meanwhile."""
        if self.publishers.command and self.schedule.held_up > HELD_UP:
            raise RecordingError(
                f"Playing stood still for {self.schedule.held_up:.1f} s (Ctrl-Z, or this computer was held up), and a "
                "motor would go on by itself: begin again."
            )

    def _check_gap(self, gap: float) -> None:
        """Announce a long pause [s], and refuse one that no recording has."""
        if gap > LONGEST_GAP:
            days = gap / 86400.0
            raise RecordingError(
                f"{self.uri}: the next message is {days:.0f} days later, so its log time is damaged: end here."
            )
        if gap > ANNOUNCED_GAP:
            in_place("")
            print(f"{self.uri}: the next message comes {gap:.0f} s later.", file=sys.stderr)

    def _from(self, start: int) -> Iterator[tuple[str, int, bytes]]:
        """Topic, log time and data of the wanted messages from a log time on, in the order of time."""
        for topic, _, log_time, data in in_time_order(messages(self.uri, self.publishers, self._tell), self.uri):
            if log_time >= start:
                yield topic, log_time, data

    def _tell(self, damage: str) -> None:
        """Say once what is damaged."""
        if damage not in self._damage:
            in_place("")
            print(damage, file=sys.stderr)
        self._damage.add(damage)

    def _latched_before(self, start: int) -> Iterator[tuple[str, bytes]]:
        """The latest message before a log time on each topic whose publisher kept it for those who came later."""
        if self.start_offset == 0.0:
            return
        latched = {
            topic.name
            for topic in self.bag.topics
            if topic.name in self.publishers and any(profile.durability == "transient_local" for profile in topic.qos)
        }
        before = {topic: data for topic, _, log_time, data in messages(self.uri, latched) if log_time < start}
        yield from before.items()
