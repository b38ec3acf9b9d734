"""What ends an experiment, sample by sample, on a clock of the test's own."""

from dataclasses import replace
from math import nan

import pytest

from motor_identification.live.plant_watch import DEAF, HELD_UP, SILENCE, Asked, Listener, PlantWatch

ASKED = Asked(6.0, True, 1.5)
PERIOD = 5_000_000  # [ns]


def see(watch: PlantWatch, samples: list[tuple[float, float]], asked: Asked = ASKED) -> tuple[PlantWatch, list[str]]:
    """Speeds [rad/s] and voltages [V], one a sample."""
    problems = []
    for speed, voltage in samples:
        time = watch.latest + PERIOD
        watch, problem = watch.see(time, speed, voltage, asked, time * 1e-9)
        problems.append(problem)
    return watch, problems


def test_two_samples_in_a_row_are_too_fast_and_one_is_not() -> None:
    _, problems = see(PlantWatch(40.0), [(40.1, 6.0), (40.0, 6.0), (-40.1, 6.0), (-41.0, 6.0)])
    assert problems[:3] == ["", "", ""]
    assert problems[3].startswith("The motor ran at 41 rad/s after 1.50 s, at 6 V, above --speed 40")
    assert see(PlantWatch(40.0), [(nan, 6.0)] * 2)[1][1].startswith("The motor ran at nan rad/s")
    assert see(PlantWatch(), [(1e6, 6.0)] * 3)[1] == ["", "", ""]


@pytest.mark.parametrize(("asked", "off"), [(ASKED, True), (Asked(0.1, False, 1.5), False)])
def test_a_plant_that_applies_nothing_is_off(asked: Asked, off: bool) -> None:
    count = round(DEAF / PERIOD * 1e9)
    watch, problems = see(PlantWatch(), [(0.0, 0.0)] * count, asked)
    assert not any(problems) and (watch.deaf_since is not None) == off
    _, problems = see(watch, [(0.0, 0.0)] * 3, asked)
    assert problems[-1].startswith("The plant's output is off") == off
    obeying, problems = see(watch, [(0.0, 6.0), (0.0, 0.0)], asked)
    assert not any(problems) and (obeying.deaf_since or 0.0) * 1e9 == (obeying.latest if off else 0)


def test_a_clock_that_steps_back_is_another_plant() -> None:
    watch, _ = see(PlantWatch(), [(0.0, 6.0)] * 2)
    assert watch.see(watch.latest + 1, 0.0, 6.0, ASKED, 0.0)[1] == ""
    assert watch.see(watch.latest, 0.0, 6.0, ASKED, 0.0)[1].startswith("The plant's clock stepped back after 1.50 s")


@pytest.mark.parametrize(("ours", "plants"), [(1.0, 1.0), (1.0, 0.005), (0.005, 1.0)])
def test_a_motor_that_stood_does_not_go_on_by_itself(ours: float, plants: float) -> None:
    """Ctrl-Z and fg of the command; a computer that was suspended, whose clock then stands still."""
    watch, _ = see(PlantWatch(), [(0.0, 6.0)] * 2)
    assert watch.seen is not None
    for longer in (0.99, 1.01):
        time, now = watch.latest + round(plants * longer * HELD_UP * 1e9), watch.seen + ours * longer * HELD_UP
        problem = watch.see(time, 0.0, 0.0, ASKED, now)[1]
        assert problem.startswith("No sample was answered for 1.0 s after 1.50 s") is (longer > 1.0)
        assert replace(watch, seen=None).see(time, 0.0, 0.0, ASKED, now)[1] == ""


def listen(looks: list[float], heard: float = 10.0) -> str:
    """What is said at the last of these looks [s], if the latest sample came at `heard`."""
    listener, problem = Listener(), ""
    for now in looks:
        assert problem == ""
        listener, problem = listener.look(min(heard, now), 0.5, now)
    return problem


def test_who_stood_still_himself_does_not_blame_the_plant() -> None:
    """Stopped (SIGSTOP) for 2 s, it said that the plant's samples had stopped, and asked whether it was running."""
    said = listen([10.0, 10.02, 12.02])
    assert said.startswith("No sample was answered for 2.0 s after 0.50 s") and "the command or this computer" in said
    assert listen([10.0, 10.02, 10.6, 11.1]).startswith("No sample was answered for 1.1 s")  # half of it and more
    assert listen([9.99, 12.0]).startswith("No sample was answered for 2.0 s")  # from just after the latest sample on


def test_a_plant_that_falls_silent_while_it_is_listened_to_is_blamed() -> None:
    looks = [10.0 + 0.02 * k for k in range(51)]
    assert listen(looks) == "" and looks[-1] == 10.0 + SILENCE
    assert listen([*looks, 11.02]) == "The samples stopped after 0.50 s: is the plant still running?"
    assert listen([10.0, 10.4, 10.8, 11.1]).startswith("The samples stopped")  # held up for less than half of it


def test_a_pause_before_the_latest_sample_is_over() -> None:
    listener, _ = Listener().look(10.0, 0.5, 10.0)
    listener, problem = listener.look(12.0, 0.5, 12.0)
    assert problem == "" and listener.away == 0.0
    assert Listener().look(None, 0.0, 99.0)[1] == ""
    for k in range(51):
        listener, problem = listener.look(12.0, 0.5, 12.0 + 0.02 * k)
    assert listener.look(12.0, 0.5, 13.02)[1].startswith("The samples stopped")
