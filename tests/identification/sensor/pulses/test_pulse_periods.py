"""How long values stay tells the slot over whose times they were computed, and that others were not."""

import numpy as np
import pytest
from recorded import as_period_speed, as_speed
from swinging import noisy, recorded

from motor_identification.recording import Floats
from motor_identification.sensor.pulses import pulse_periods
from motor_identification.sensor.pulses.pulse_periods import (
    _Stays,
    contradicts,
    find_slot_by_decays,
    find_slot_by_stays,
    mark_decays,
    score_stays,
)
from motor_identification.sensor.value_lattice import find_lattice


def logged(edges: int, rate: float, falls: bool = False) -> tuple[Floats, Floats]:
    recording = as_period_speed(recorded(edges=edges, sample_rate=rate), falls)
    return recording.time, recording.speed


@pytest.mark.parametrize("falls", [False, True])
@pytest.mark.parametrize(("edges", "rate"), [(6, 50.0), (12, 200.0), (48, 200.0), (96, 500.0)])
def test_the_slot_is_found(edges: int, rate: float, falls: bool) -> None:
    slot = 2.0 * np.pi / edges
    assert find_slot_by_stays(*logged(edges, rate, falls)) == pytest.approx(slot, rel=0.05)


def test_rows_that_lack_now_and_then_tell_it_too() -> None:
    time, speed = logged(24, 500.0)
    kept = np.sort(np.random.default_rng(1).permutation(len(time))[: len(time) * 9 // 10])
    assert find_slot_by_stays(time[kept], speed[kept]) == pytest.approx(2.0 * np.pi / 24, rel=0.05)


@pytest.mark.parametrize("falls", [False, True])
@pytest.mark.parametrize("edges", [6, 48, 192])
def test_counts_alone_are_those_of_the_whole_comparison(edges: int, falls: bool) -> None:
    """A minute at 1 kHz is compared with hundreds of slots: all but a few are refuted without it."""
    time, speed = logged(edges, 200.0, falls)
    speed = np.round(speed, 1)
    row, fine = float(np.median(np.diff(time))), np.abs(speed) >= pulse_periods.STEPS * find_lattice(speed)
    known = time, speed, pulse_periods._list_changed(speed), fine, np.cumsum(speed == 0.0), row
    slots = 2.0 * np.pi / edges * np.geomspace(0.2, 5.0, 30)
    for slot, stay in zip(slots, pulse_periods._measure_stays(time, speed, slots), strict=True):
        counts = pulse_periods._count_stays(*known, pulse_periods.divide_slot(slot, speed))
        assert counts == (stay.held, stay.against, stay.open)


def test_a_fast_motor_shows_none() -> None:
    assert find_slot_by_stays(*logged(192, 50.0)) == 0.0


@pytest.mark.parametrize("rate", [50.0, 500.0])
def test_what_stays_for_other_reasons_is_none(rate: float) -> None:
    """Counts within a window, values held for even frames, and values rounded to few digits."""
    counted = as_speed(recorded(edges=12, sample_rate=rate))
    assert find_slot_by_stays(counted.time, counted.speed) == 0.0
    exact = as_speed(recorded(sample_rate=rate))
    for rows in (2, 3):
        held = exact.speed[np.arange(len(exact)) // rows * rows]
        assert find_slot_by_stays(exact.time, held) == 0.0
    for step in (0.5, 5.0):
        assert find_slot_by_stays(exact.time, np.round(exact.speed / step) * step) == 0.0


def test_no_slot_is_longer_than_a_turn() -> None:
    for falls, find in ((False, find_slot_by_stays), (True, find_slot_by_decays)):
        time, speed = logged(12, 200.0, falls)
        assert find(time, 11.0 * speed) == pytest.approx(11.0 * 2.0 * np.pi / 12, rel=0.05)
        assert find(time, 15.0 * speed) == 0.0


@pytest.mark.parametrize(("others", "tells"), [(1, False), (3, False), (4, True)])
def test_values_that_stay_for_one_number_of_rows_are_no_slot(others: int, tells: bool) -> None:
    """Single counts in means of two rows show for two, and are the larger the shorter these are: 19 of 20 stays."""
    period = 0.1 + 0.002 * np.arange(24)
    stays = _Stays(held=24, against=0, open=0, apart=period, period=period, alike=24 - others)
    assert stays.tells is tells


def test_too_few_changes_tell_nothing() -> None:
    assert find_slot_by_stays(np.arange(100.0), np.zeros(100)) == 0.0
    assert find_slot_by_stays(np.arange(100.0), np.repeat([1.0, 2.0], 50)) == 0.0


@pytest.mark.parametrize(
    ("name", "strict"), [("FEWEST", 10_000), ("LEFT", 0.01), ("AGAINST", 10_000.0), ("STEPS", 1e9)]
)
def test_each_limit_decides(name: str, strict: float, monkeypatch: pytest.MonkeyPatch) -> None:
    time, speed = logged(12, 200.0)
    rounded = np.round(speed / 0.02) * 0.02
    assert find_slot_by_stays(time, rounded) > 0.0
    monkeypatch.setattr(pulse_periods, name, strict)
    assert find_slot_by_stays(time, rounded) == 0.0


@pytest.mark.parametrize(("edges", "rate"), [(6, 50.0), (12, 200.0), (48, 200.0), (96, 500.0), (192, 50.0)])
def test_no_true_slot_is_contradicted(edges: int, rate: float) -> None:
    assert not contradicts(score_stays(*logged(edges, rate), 2.0 * np.pi / edges))


def test_values_that_come_more_often_than_a_slot_passes_contradict_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """A log of 100 counts a turn over rows of whole milliseconds was taken for one of four edges a turn."""
    log = noisy(0.05)
    usual = log.sample_period * float(np.quantile(log.speed, 0.9))
    assert contradicts(score_stays(log.time, log.speed, usual))
    assert not contradicts(score_stays(log.time, log.speed, 1e-4 * usual))
    monkeypatch.setattr(pulse_periods, "FEWEST", 1e9)
    assert not contradicts(score_stays(log.time, log.speed, usual))


def test_the_time_since_an_edge_grows_with_the_rows() -> None:
    time = np.array([0.0, 1.0, 2.0, 3.0, 4.0])
    period = np.array([0.0, 2.0, 3.0, 4.04, 5.1])
    assert mark_decays(time, period, 1.0).tolist() == [False, True, True, True, False]


@pytest.mark.parametrize(("edges", "rate"), [(6, 50.0), (12, 200.0), (48, 200.0), (96, 500.0)])
def test_values_that_fall_between_edges_tell_their_slot_exactly(edges: int, rate: float) -> None:
    slot = 2.0 * np.pi / edges
    assert find_slot_by_decays(*logged(edges, rate, falls=True)) == pytest.approx(slot, rel=1e-4)
    assert find_slot_by_decays(*logged(edges, rate)) == 0.0


def test_what_falls_for_other_reasons_tells_none() -> None:
    """A motor that coasts, noise, a lattice of counts, and one of a timer's ticks."""
    time = 0.005 * np.arange(1000)
    slow = 100.0 * np.exp(-time / 0.7)
    noise = 1.0 + 0.01 * np.random.default_rng(2).standard_normal(len(time))
    ticks = 1.0 / (np.round(1.0 / slow / 2e-4) * 2e-4)
    for speed in (slow, slow * noise, np.round(slow), ticks):
        assert find_slot_by_decays(time, speed) == 0.0


@pytest.mark.parametrize(
    "strict", [{"FEWEST_DECAYS": 10_000}, {"BEYOND_CHANCE": 1e6}, {"OF_ALL_FALLS": 1.01, "MANY_DECAYS": 10_000}]
)
def test_each_limit_of_falling_values_decides(strict: dict[str, float], monkeypatch: pytest.MonkeyPatch) -> None:
    time, speed = logged(12, 200.0, falls=True)
    assert find_slot_by_decays(time, speed) > 0.0
    for name, limit in strict.items():
        monkeypatch.setattr(pulse_periods, name, limit)
    assert find_slot_by_decays(time, speed) == 0.0


@pytest.mark.parametrize(("many", "told"), [(pulse_periods.MANY_DECAYS, True), (10_000, False)])
def test_a_motor_that_is_seldom_slow_shows_its_slot(many: int, told: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """One in five of a long log's values falls by chance, and one in a hundred of those for the time since an edge."""
    time, speed = logged(12, 200.0, falls=True)
    random = np.random.default_rng(4)
    fast = 300.0 * (1.0 + 0.014 * random.standard_normal(9 * len(time)))
    monkeypatch.setattr(pulse_periods, "MANY_DECAYS", many)
    found = find_slot_by_decays(0.005 * np.arange(10 * len(time)), np.concatenate([speed, fast]))
    assert found == (pytest.approx(2.0 * np.pi / 12, rel=1e-4) if told else 0.0)


def test_a_few_slots_are_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of counts in rows of uneven lengths there were 40, each of which took 0.2 s of ten minutes at 1 kHz."""
    time, speed = logged(12, 200.0, falls=True)
    looked: list[float] = []

    def contradicted(_: Floats, __: Floats, slot: float) -> float:
        looked.append(slot)
        return -1e9

    monkeypatch.setattr(pulse_periods, "score_stays", contradicted)
    monkeypatch.setattr(pulse_periods, "BEYOND_CHANCE", 0.0)
    monkeypatch.setattr(pulse_periods, "OF_ALL_FALLS", 0.0)
    monkeypatch.setattr(pulse_periods, "FEWEST_DECAYS", 1)
    assert find_slot_by_decays(time, speed) == 0.0 and len(looked) == pulse_periods.CANDIDATES
    assert looked[0] == pytest.approx(2.0 * np.pi / 12, rel=1e-4)
