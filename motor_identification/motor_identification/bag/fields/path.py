"""Where a number stands: topic, attributes, elements of arrays by number or by name."""

import re
from dataclasses import dataclass

from motor_identification.bag.topic import absolute_name
from motor_model.errors import RecordingError

LONGEST = 500  # characters: names of topics and joints end long before
_STEP = re.compile(r"\.?([A-Za-z]\w*)|\[([^\[\]]+)\]", re.ASCII)


@dataclass(frozen=True)
class Element:
    """An element of an array; by its number, or by its name in a list of names beside the array."""

    key: int | str


@dataclass(frozen=True)
class FieldPath:
    """A field of the messages on a topic."""

    topic: str
    steps: tuple[str | Element, ...]  # attributes and elements

    def __str__(self) -> str:
        return f"{self.topic}:{self.field}"

    @property
    def field(self) -> str:
        """The path within a message."""
        parts = [f"[{step.key}]" if isinstance(step, Element) else f".{step}" for step in self.steps]
        return "".join(parts).removeprefix(".")


def parse_path(text: str) -> FieldPath:
    """Read `TOPIC:FIELD`, such as `/odom:twist.twist.linear.x` or `/joint_states:velocity[left_wheel]`.

    Raises:
        RecordingError: it is written otherwise.
    """
    topic, colon, field = text.partition(":")
    steps: list[str | Element] = []
    place = 0
    while len(text) <= LONGEST and (match := _STEP.match(field, place)):
        attribute, element = match[1], match[2]
        number = element is not None and element.isdecimal() and len(element) < 9
        steps.append(attribute or Element(int(element) if number else element))
        place = match.end()
    if not (topic and colon and steps and place == len(field)) or isinstance(steps[0], Element):
        raise RecordingError(
            f"{text[:LONGEST]} names no field of a message: write TOPIC:FIELD, such as "
            "/joint_states:velocity[left_wheel]."
        )
    return FieldPath(absolute_name("", topic), tuple(steps))
