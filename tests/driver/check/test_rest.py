"""Edges while the motor is off: a motor that turns, the mains, or noise."""

import numpy as np
import pytest

from motor_driver.check.look import Answer
from motor_driver.check.rest import Edge, Rhythm, cause_of, rhythm_of


def edges(rate: float, scatter: float = 0.0, seed: int = 0) -> list[Edge]:
    """One second of edges as samples at 200 Hz show them: the latest only."""
    random = np.random.default_rng(seed)
    times = np.cumsum((1.0 + scatter * random.standard_normal(round(rate))) / rate)
    seen = [int(np.searchsorted(times, k * 0.005)) for k in range(1, 201)]
    return [Edge(float(times[n - 1]), n) for n in sorted(set(seen)) if n > 0]


@pytest.mark.parametrize("rate", [50.0, 60.4, 962.0, 9000.0])
def test_an_even_rhythm_has_its_rate_though_samples_show_the_latest_edge_only(rate: float) -> None:
    rhythm = rhythm_of(edges(rate))
    assert rhythm.rate == pytest.approx(rate, rel=0.01) and rhythm.even and rhythm.one_way
    assert rhythm.mains == (rate in (50.0, 60.4))


def test_two_lines_that_hum_go_up_and_down_again() -> None:
    to_and_fro = [Edge(0.02 * k + part, up) for k in range(50) for part, up in ((0.0, 1), (0.008, 0))]
    rhythm = rhythm_of(to_and_fro)
    assert rhythm.rate == pytest.approx(50.0, rel=1e-6) and rhythm.mains and not rhythm.one_way


def test_slots_may_be_irregular_and_chance_is_not_even() -> None:
    assert rhythm_of(edges(90.0, 0.02)).even
    random = np.random.default_rng(2)
    assert not rhythm_of([Edge(float(t), k) for k, t in enumerate(np.cumsum(random.exponential(0.02, 50)))]).even
    assert not rhythm_of([Edge(0.1, 1)]).even


def test_the_mains_are_known_to_one_and_a_half_per_cent() -> None:
    assert Rhythm(50.7, True, True).mains and not Rhythm(50.8, True, True).mains
    assert not Rhythm(50.0, False, True).mains


@pytest.mark.parametrize(
    ("rhythm", "two", "said", "code"),
    [
        (Rhythm(50.0, True, True), False, Answer.YES, "bridge_stuck_on"),
        (Rhythm(50.0, True, True), False, Answer.NO, "hum"),
        (Rhythm(50.0, True, True), False, None, "edges_at_rest"),  # one channel, nobody looks: it may be either
        (Rhythm(50.0, True, True), True, None, "bridge_stuck_on"),  # two channels of a line that hums do not run
        (Rhythm(50.0, True, False), True, None, "hum"),
        (Rhythm(70.0, True, True), False, None, "bridge_stuck_on"),
        (Rhythm(70.0, True, True), False, Answer.NO, "noise"),
        (Rhythm(50.0, False, True), False, None, "noise"),
    ],
)
def test_the_cause_follows_from_rhythm_and_eye(rhythm: Rhythm, two: bool, said: Answer | None, code: str) -> None:
    assert cause_of(rhythm, two, said) == code
