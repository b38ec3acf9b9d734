"""Columns of a log among vectors of several lengths."""

import numpy as np
import pytest

from motor_identification.logs.rows.several_clocks import SAME_SPAN, choose_columns, tell_a_motor

TIME = np.arange(500) * 0.01


def test_the_vectors_that_the_user_named_are_the_log() -> None:
    """Several experiments of one struct, of which the longest is taken where nobody says which."""
    long = {"a.t": np.arange(900) * 0.01, "a.u": np.ones(900), "a.speed": np.ones(900)}
    short = {"b.t": TIME, "b.u": np.ones(500), "b.speed": np.ones(500)}
    groups = {900: long, 500: short}
    assert choose_columns(groups, ()).keys() == long.keys()
    assert choose_columns(groups, ("b.u",)).keys() == short.keys()
    assert choose_columns(groups, ("c.u",)).keys() == long.keys()


def test_a_drive_and_a_motion_with_clocks_of_their_own_are_joined() -> None:
    """A signal that was played, and a row more of what Simulink logged meanwhile."""
    played = {"t": TIME[:-1], "u": np.sin(TIME[:-1])}
    logged = {"time": TIME + 1e-9, "Motor velocity [rad/s]": np.cos(TIME)}
    joined = choose_columns({499: played, 500: logged}, ())
    assert joined.keys() == {"time", "u", "Motor velocity [rad/s]"}
    assert joined["time"] == pytest.approx(TIME, abs=1e-6) and joined["u"][:-1] == pytest.approx(np.sin(TIME[:-1]))
    assert np.isnan(joined["u"]).tolist() == [False] * 499 + [True]
    assert joined["Motor velocity [rad/s]"] == pytest.approx(np.cos(TIME))


def test_an_input_and_an_output_are_a_drive_and_a_motion() -> None:
    joined = choose_columns({100: {"t": TIME[:100] * 5, "input": TIME[:100]}, 500: {"time": TIME, "output": TIME}}, ())
    assert joined.keys() == {"time", "input", "output"} and np.count_nonzero(~np.isnan(joined["input"])) == 100


@pytest.mark.parametrize(("late", "together"), [(0.9 * SAME_SPAN, True), (1.1 * SAME_SPAN, False)])
def test_clocks_of_other_experiments_are_not_joined(late: float, together: bool) -> None:
    played = {"t": TIME[:-1] + late * TIME[-1], "u": np.sin(TIME[:-1])}
    logged = {"time": TIME, "speed": np.cos(TIME), "angle": TIME}
    assert ("u" in choose_columns({499: played, 500: logged}, ())) == together


def test_what_has_no_clock_or_is_whole_is_not_joined() -> None:
    logged = {"time": TIME, "speed": np.cos(TIME)}
    assert "u" not in choose_columns({499: {"u": np.sin(TIME[:-1])}, 500: logged}, ())
    assert "other u" not in choose_columns(
        {499: {"t": TIME[:-1], "other u": TIME[:-1]}, 500: {**logged, "u": TIME}}, ()
    )
    assert "current" not in choose_columns({499: {"t": TIME[:-1], "current": TIME[:-1]}, 500: logged}, ())


def test_names_tell_a_motor_by_a_drive_and_a_motion() -> None:
    assert tell_a_motor(["u", "speed"])
    assert not tell_a_motor(["time", "speed"]) and not tell_a_motor(["u", "time"])
