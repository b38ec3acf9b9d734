"""A source reads each of its bags: one motor, one part."""

from pathlib import Path

import pytest
from motor_bags import PERIOD, SAMPLES, assert_is, write_bag

from motor_identification.bag import Source, Window
from motor_model.errors import RecordingError


def test_a_bag_is_read_with_the_namespace_of_its_motor_and_within_the_window(tmp_path: Path) -> None:
    bag = str(write_bag(tmp_path / "bag", SAMPLES[:100], namespace="/left"))
    assert_is(Source((bag,), "left").read(bag), SAMPLES[:100])
    start, stop = 20.5 * PERIOD * 1e-9, 40.5 * PERIOD * 1e-9
    assert_is(Source((bag,), "left", Window(start, stop)).read(bag), SAMPLES[21:41])
    assert_is(Source((bag,), "left", Window(start)).read(bag), SAMPLES[21:100])
    with pytest.raises(RecordingError, match="/right/motor/speed"):
        Source((bag,), "right").read(bag)


def test_a_bag_has_one_name_with_and_without_the_slash_that_a_shell_puts_behind_it() -> None:
    """A sentence was "From 1.2 s on in  the motor stands", with no name in it."""
    assert Source(("bags/step/", "bags/ramp", "/", "a//")).uris == ("bags/step", "bags/ramp", "/", "a")
