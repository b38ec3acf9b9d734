"""What speaks against running comes as a state and a sentence: first a stop, then settings, sample, reference."""

from dataclasses import replace
from math import inf, nan

import pytest
from bench_board import DEFAULTS, motor, settings

from motor_control.configuration import config_of
from motor_control.controller.controller import State, refer, stop
from motor_control.controller.obstacles import FASTEST, explain_stop, find_mistake, find_obstacle, is_finite
from motor_control.controller.output import DISABLED, RUNNING, STOPPED
from motor_control.controller.reference.demand import Demand, Kind
from motor_control.controller.reference.position_law import FARTHEST
from motor_model.sample import Info, Sample

CONFIG = config_of(DEFAULTS, Info())
FINE = Sample(0, 3.0, 0.5, 1, 0, 1e-3)
ASKED = refer(State(), 60.0, 0.0)


def test_nothing_speaks_against_a_reference_and_a_sample() -> None:
    assert find_obstacle(CONFIG, ASKED, FINE) == (RUNNING, "")


def test_the_first_that_is_true_is_said() -> None:
    bad, unusable = replace(FINE, speed=nan), replace(CONFIG, unusable="The plant says nonsense.")
    stopped = stop(ASKED, "It is wired wrong.", 0.0)
    reset = "It is wired wrong. Call motor/reset, then publish a fresh reference, to go on."
    assert find_obstacle(unusable, stopped, bad) == (STOPPED, reset)
    again = "It is stop number 2, each within a minute of the one before: motor/reset is refused for 1 s after it."
    assert explain_stop(stop(stopped, "It is wired wrong.", 5.0)) == f"{reset} {again}"
    assert find_obstacle(unusable, ASKED, bad) == (STOPPED, "The plant says nonsense.")
    assert find_obstacle(CONFIG, State(), bad)[0] == STOPPED
    name, reason = find_obstacle(CONFIG, State(), FINE)
    assert name == DISABLED and reason.startswith("No reference yet")
    powerless = replace(CONFIG, voltage_limit=0.0)
    assert find_obstacle(powerless, State(), FINE)[0] == DISABLED
    assert find_obstacle(powerless, ASKED, FINE) == (
        STOPPED,
        "voltage_limit is 0 V: set it to what the motor may get.",
    )
    dropped = replace(State(), dropped="The plant was restarted.")
    assert find_obstacle(CONFIG, dropped, FINE)[1].startswith("The plant was restarted. The motor waits for a fresh")


@pytest.mark.parametrize("field", ["speed", "voltage", "edge_period"])
@pytest.mark.parametrize("value", [nan, inf, -inf])
def test_a_sample_that_is_no_number_is_named(field: str, value: float) -> None:
    sample = replace(FINE, **{field: value})
    assert not is_finite(sample) and is_finite(FINE)
    assert find_obstacle(CONFIG, ASKED, sample) == (
        STOPPED,
        f"A sample on motor/speed says {field} = {value}: find out what is wrong with the plant.",
    )


def test_a_demand_that_cannot_be_obeyed_is_a_mistake() -> None:
    assert find_mistake(CONFIG, Demand(60.0), FINE) == ""
    assert find_mistake(CONFIG, Demand(nan), FINE).startswith("The reference is nan")
    assert find_mistake(CONFIG, Demand(-FASTEST), FINE) == ""
    assert find_mistake(CONFIG, Demand(1.001 * FASTEST), FINE).startswith(
        "The reference is 1e+06 rad/s, faster than any"
    )
    angle = Demand(1.0, Kind.POSITION)
    nowhere = replace(CONFIG, position=None, no_position="One channel has no angle.")
    assert find_mistake(nowhere, angle, FINE) == "One channel has no angle."
    two = settings(motor(), Info(single_channel=False))
    assert two.position is not None
    far = FARTHEST * two.position.slot
    assert find_mistake(two, Demand(0.999 * far, Kind.POSITION), FINE) == ""
    assert "farther than any motor turns" in find_mistake(two, Demand(-1.001 * far, Kind.POSITION), FINE)
