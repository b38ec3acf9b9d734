"""A frozen record is copied with some fields changed, in a small part of the standard library's time."""

import dataclasses
from dataclasses import dataclass, field
from timeit import repeat

import pytest

from motor_control.controller.state import State
from motor_model.frozen_record import replace
from motor_model.sensing.motion_check import MotionCheck


@dataclass(frozen=True)
class Plain:
    speed: float = 0.0
    seen: tuple[int, ...] = field(default=(), compare=False)


@dataclass(frozen=True, slots=True)
class Slotted:
    speed: float = 0.0


@dataclass(frozen=True)
class Checked:
    speed: float = 0.0

    def __post_init__(self) -> None:
        if self.speed < 0.0:
            raise ValueError


def test_only_what_is_named_changes_and_only_in_the_copy() -> None:
    before = Plain(1.0, (2,))
    after = replace(before, speed=3.0)
    assert (before, before.seen) == (Plain(1.0), (2,))
    assert (after, after.seen, type(after)) == (Plain(3.0), (2,), Plain)
    assert hash(after) == hash(Plain(3.0)) and repr(after) == "Plain(speed=3.0, seen=(2,))"
    with pytest.raises(dataclasses.FrozenInstanceError):
        after.speed = 4.0  # type: ignore[misc]


@pytest.mark.parametrize("record", [State(since=1.0), MotionCheck(12.0, True)])
def test_the_loops_own_records_are_copied_as_by_the_standard_library(record: State | MotionCheck) -> None:
    assert replace(record) == dataclasses.replace(record) and replace(record) is not record
    name, value = dataclasses.fields(record)[0].name, 7.5
    assert replace(record, **{name: value}) == dataclasses.replace(record, **{name: value}) != record


def test_an_unknown_field_is_refused() -> None:
    with pytest.raises(TypeError, match=r"Plain has no field speeed\."):
        replace(Plain(), speeed=1.0, speed=2.0)  # type: ignore[call-arg]


@pytest.mark.parametrize("record", [Slotted(), Checked(), 1.0])
def test_what_is_more_than_its_fields_is_refused(record: object) -> None:
    with pytest.raises(TypeError, match="is no plain dataclass: use dataclasses.replace"):
        replace(record, speed=1.0)  # type: ignore[type-var]


@pytest.mark.on_time
def test_it_takes_a_small_part_of_the_time() -> None:
    def least(copy: object) -> float:
        return min(repeat(lambda: copy(STATE, arrival=1.0), number=2000, repeat=7))  # type: ignore[operator]

    assert 0.01 < least(replace) / least(dataclasses.replace) < 0.4


STATE = State()
