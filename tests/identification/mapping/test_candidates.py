"""Which field drives which."""

from pathlib import Path

import foreign_bags
import numpy as np
import pytest

from motor_identification.bag.fields import parse_path
from motor_identification.logs.form import Kind
from motor_identification.mapping.candidates import FOLLOWS, find_candidates
from motor_identification.mapping.inventory import Field, take_inventory

MOTION = foreign_bags.move(8.0)
TIME = np.rint(MOTION.time * 1e9).astype(np.int64)


def field(path: str, values: object, time: object = None) -> Field:
    return Field(parse_path(path), TIME if time is None else np.asarray(time), np.asarray(values, float))


def test_a_command_drives_a_joint(tmp_path: Path) -> None:
    foreign_bags.write_joint_states(tmp_path / "bag", MOTION)
    best, second = find_candidates([one for topic in take_inventory(tmp_path / "bag") for one in topic.fields])
    assert str(best.mapping().voltage) == "/wheels/commands:data[1]" and best.kind is Kind.SPEED
    assert str(best.mapping().motion) == "/joint_states:velocity[right_wheel]" and second.kind is Kind.POSITION
    assert 0.9 < best.share <= 1.0


def test_names_that_tell_nothing_are_tried_by_their_numbers() -> None:
    (pair,) = find_candidates([field("/x:a", MOTION.voltage), field("/x:b", MOTION.speed)])
    assert (str(pair.drive.path), str(pair.motion.path), pair.kind) == ("/x:a", "/x:b", Kind.SPEED)


def test_what_is_measured_or_wanted_drives_nothing() -> None:
    assert find_candidates([field("/x:speed", MOTION.speed), field("/x:position", MOTION.angle)]) == []
    assert find_candidates([field("/x:target", MOTION.voltage), field("/x:speed", MOTION.speed)]) == []


def test_what_does_not_follow_is_no_candidate() -> None:
    noise = np.random.default_rng(4).normal(0.0, 1.0, len(TIME))
    assert find_candidates([field("/x:command", MOTION.voltage), field("/x:speed", noise)]) == []
    late = TIME + TIME[-1] + 1
    assert find_candidates([field("/x:command", MOTION.voltage, late), field("/x:speed", MOTION.speed)]) == []


@pytest.mark.parametrize(("noise", "found"), [(0.1, True), (30.0, False)])
def test_a_tenth_of_the_changes_is_enough(noise: float, found: bool) -> None:
    speed = MOTION.speed + noise * np.random.default_rng(4).normal(0.0, 1.0, len(TIME))
    pairs = find_candidates([field("/x:command", MOTION.voltage), field("/x:speed", speed)])
    assert bool(pairs) == found and all(pair.share > FOLLOWS for pair in pairs)
