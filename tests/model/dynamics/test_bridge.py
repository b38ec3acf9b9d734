"""The bridge: what the motor gets of a command."""

import pytest

from motor_model.dynamics.bridge import effective_voltage
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}


def effective(command: float, effects: tuple[str, ...] = (), **values: float) -> float:
    return float(effective_voltage(Parameters(BASE | values, effects).vector(), command))


@pytest.mark.parametrize(("command", "voltage"), [(5.0, 5.0), (-5.0, -5.0), (0.0, 0.0), (13.0, 12.0), (-13.0, -12.0)])
def test_a_plain_bridge_gives_what_is_asked_for_up_to_the_supply(command: float, voltage: float) -> None:
    assert effective(command) == voltage


def test_a_limit_below_the_supply_counts_and_one_above_it_does_not() -> None:
    assert effective(9.0, ("voltage_limit",), limit_voltage=7.0) == 7.0
    assert effective(-9.0, ("voltage_limit",), limit_voltage=7.0) == -7.0
    assert effective(6.9, ("voltage_limit",), limit_voltage=7.0) == 6.9
    assert effective(20.0, ("voltage_limit",), limit_voltage=15.0) == 12.0


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_dead_zone_takes_its_voltage_from_every_command(sign: float) -> None:
    assert effective(sign * 0.5, ("dead_zone",), dead_zone_voltage=0.5) == 0.0
    assert effective(sign * 0.6, ("dead_zone",), dead_zone_voltage=0.5) == pytest.approx(sign * 0.1)
    assert effective(sign * 20.0, ("dead_zone",), dead_zone_voltage=0.5) == sign * 11.5  # the limit comes first


def test_asymmetry_is_of_the_reverse_and_comes_last() -> None:
    both = ("dead_zone", "direction_asymmetry")
    assert effective(4.5, both, dead_zone_voltage=0.5, reverse_gain=0.9) == 4.0
    assert effective(-4.5, both, dead_zone_voltage=0.5, reverse_gain=0.9) == pytest.approx(-3.6)
