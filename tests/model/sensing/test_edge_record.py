"""Edges, recorded one after the other: counts, stamps and periods by hand, and however they are cut into samples."""

import numpy as np
import pytest

from motor_model.sensing.edge_record import LATEST, NO_EDGES, POWER_UP, EdgeRecord, record_edges

TICK = 4e-6


def record(times: list[float], directions: list[int], cut: int = 0, **how: object) -> EdgeRecord:
    """Record edges, in two samples where `cut` is inside."""
    stamps, after = np.zeros(LATEST, dtype=np.int64), NO_EDGES
    tick, single, quadrature = float(how.get("tick", TICK)), bool(how.get("single", True)), int(how.get("q", 1))  # type: ignore[call-overload]
    for part in (slice(0, cut), slice(cut, None)):
        some = np.array(times[part]), np.array(directions[part], dtype=np.int64)
        after = record_edges(after, stamps, *some, tick, single, quadrature)
    return after


def test_an_edge_is_stamped_at_the_tick_before_and_the_first_has_no_period() -> None:
    after = record([0.0010039], [1])
    assert (after.edges, after.time, after.period) == (1, POWER_UP + 1_000_000, 0.0)
    after = record([0.0010039, 0.0020041], [1, 1])
    assert (after.edges, after.time) == (2, POWER_UP + 2_004_000)
    assert after.period == pytest.approx(0.001004, abs=1e-12)
    assert record([0.0010039], [1], tick=0.0).time == POWER_UP + 1_003_900


def test_two_channels_count_down_and_one_does_not() -> None:
    times, directions = [0.001, 0.002, 0.003], [1, -1, -1]
    assert record(times, directions).edges == 3
    after = record(times, directions, single=False)
    assert (after.edges, after.direction) == (-1, -1)


def test_a_shaft_that_comes_out_where_it_went_in_takes_the_edge_back() -> None:
    """The flank again is no travel: no period, for this edge and the next."""
    back = record([0.001, 0.002], [1, -2], single=False)
    assert (back.edges, back.period, back.undone, back.entered) == (0, 0.0, True, 0)
    again = record([0.001, 0.002, 0.004], [1, -2, 1], single=False)
    assert (again.edges, again.period, again.undone) == (1, 0.0, False)
    through = record([0.001, 0.002, 0.004], [1, 2, 1], single=False)
    assert (through.edges, through.undone) == (2, False)
    assert through.period == pytest.approx(0.003, abs=1e-12)


def test_fourfold_a_period_is_the_mean_over_one_of_channel_a_since_the_turn() -> None:
    times, means = [0.001, 0.002, 0.004, 0.005, 0.009, 0.011], [0.0, 0.001, 0.0015, 0.0015, 0.002, 0.00225]
    for k, mean in enumerate(means):
        after = record(times[: k + 1], [1] * (k + 1), tick=0.0, single=False, q=4)
        assert after.period == pytest.approx(mean, abs=1e-12)
    assert record(times, [1, 1, 1, 1, 1, -1], single=False, q=4).period == 0.0


@pytest.mark.parametrize("quadrature", [1, 2, 4])
def test_it_does_not_matter_how_edges_are_cut_into_samples(quadrature: int) -> None:
    random = np.random.default_rng(3)
    times = list(np.cumsum(random.exponential(0.001, 60)))
    directions = [int(one) for one in random.choice([-1, 1] if quadrature > 1 else [-2, -1, 1, 1, 2], 60)]
    whole = record(times, directions, single=False, q=quadrature)
    for cut in range(1, 60):
        assert record(times, directions, cut, single=False, q=quadrature) == whole
