"""A halt is 0 V in every term."""

from math import nan

from motor_control.controller.output import STOPPED, halt


def test_a_halt_is_zero_in_every_term() -> None:
    output = halt(STOPPED, "Because.", 50.0, 20.0)
    terms = output.terms
    assert (terms.voltage, terms.proportional, terms.integral, terms.feedforward, terms.error) == (0, 0, 0, 0, 30.0)
    assert (output.state, output.reason, output.drives) == ("stopped", "Because.", False)
    assert halt(STOPPED, "", nan, 1.0).terms.error != 0.0
