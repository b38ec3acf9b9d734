"""What `tune` prints: the tuning's own numbers, and sentences where they are needed."""

import pytest
from tuning_bench import RUBBING, tuning

from motor_control.tuning.table import as_table, cautions


def test_the_table_has_the_tunings_numbers() -> None:
    one = tuning()
    first, ripple, bounds = as_table(one).split("\n\n")
    rows = {line[: line.index("  ")]: line.split("  ")[-1] for line in first.splitlines()}
    assert f"kp{'':24}" in first[:40] and list(rows)[:2] == ["kp", "ki"]
    assert f"{1e3 * one.time_constant:.3g}" in first and f"{one.margins.phase:.0f}" in first
    assert "overshoot, 0 to 87 rad/s" in first and "% with the voltage limit" in first
    head, columns, *lines = ripple.splitlines()
    assert head == "Steady-state ripple from encoder errors (1 % slots, 4 µs timer), peak to peak:"
    assert columns.split("  ")[1] == "shaft [%]"
    for line, (speed, one_ripple) in zip(lines, one.ripples, strict=True):
        cells = [float(cell) for cell in line.split()]
        assert cells == pytest.approx(
            [speed, 100 * one_ripple.speed, 100 * one_ripple.reported, one_ripple.voltage], abs=0.06
        )
    title, *limits = bounds.splitlines()
    assert title == "Lower limits of the closed-loop time constant (cumulative):"
    values = [float(line.split()[-2]) for line in limits]
    assert values == sorted(values) and values[-1] == pytest.approx(1e3 * one.bounds[-1].time_constant, rel=0.01)


def test_friction_is_mentioned_where_the_gains_ignore_it() -> None:
    assert cautions(tuning(), RUBBING) == [
        "The model has 0.9 V of friction, which these gains do not compensate. With '--speed-source observer' the "
        "feed-forward does."
    ]
    (sentence,) = cautions(tuning(source="observer"), RUBBING)
    assert sentence.startswith("These margins assume that the model is exact.")


def test_more_ripple_than_allowed_is_said_with_the_way_out() -> None:
    one = tuning(time_constant=0.025)
    first = cautions(one, RUBBING)[0]
    assert (
        first
        == "At this time constant the disc causes 2.37 % speed ripple. A time constant of 33.1 ms keeps it at 2 %."
    )
