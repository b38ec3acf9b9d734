"""What the simulated board reports, sample by sample, against the independent plant and against closed forms."""

from math import tau

import numpy as np
import plant
import pytest
from numpy.typing import NDArray

from motor_model.effects import EFFECTS
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sample import Measurement, Sample
from motor_model.sensing.board import POWER_UP, BoardConfig, SimulatedBoard

Floats = NDArray[np.float64]

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
SLOT = tau / 96
LEVELS: Floats = np.repeat([8.0, -8.0, 3.0, 0.0, -3.0, 10.0, -10.0, 0.0, 1.0, 0.6, 2.0], 60)


def motor(**values: float) -> Parameters:
    effects = tuple(effect.name for effect in EFFECTS if any(spec.name in values for spec in effect.parameters))
    return Parameters(BASE | values, effects)


def run(parameters: Parameters, commands: Floats, config: BoardConfig | None = None) -> list[Sample]:
    board = SimulatedBoard(parameters, config or BoardConfig(start_angle=0.0))
    return [board.sample(float(volts)) for volts in commands]


CASES = {
    "base": {},
    "friction": {"ks": 0.5},
    "friction and lag": {"ks": 0.5, "electrical_time_constant": 0.004},
    "delay": {"delay": 0.0123},
    "eccentricity": {"eccentricity": 0.05, "eccentricity_phase": 1.1},
    "limit, dead zone, asymmetry": {"limit_voltage": 7.0, "dead_zone_voltage": 0.4, "reverse_gain": 0.9},
    "backlash": {"backlash_angle": 0.3, "load_fraction": 0.5},
}


@pytest.mark.parametrize("single", [True, False], ids=["one channel", "two channels"])
@pytest.mark.parametrize("case", CASES)
def test_counts_and_stamps_are_those_of_the_independent_plant(case: str, single: bool) -> None:
    """Same disc, same starting angle: the same edges, in the same samples, at the same ticks."""
    config = BoardConfig(start_angle=2.345, slot_irregularity=0.01, seed=4, single_channel=single)
    samples = run(motor(**CASES[case]), LEVELS, config)
    truth, _ = plant.record(
        BASE | CASES[case],
        np.arange(len(LEVELS)) * 0.005,
        LEVELS,
        start_angle=2.345,
        irregularity=0.01,
        disc_seed=4,
        single_channel=single,
    )
    assert np.array_equal(truth.sample_time, [sample.sample_time for sample in samples])
    assert np.array_equal(truth.voltage, [sample.voltage for sample in samples])
    assert np.array_equal(truth.edge_count, [sample.edge_count for sample in samples])
    stamps = np.array([sample.edge_time for sample in samples])
    late = np.abs(truth.edge_time - stamps)
    assert np.count_nonzero(late) <= 3 and late.max() <= 4000  # [ns] an edge on the border of two ticks
    periods = np.array([sample.edge_period for sample in samples])
    assert np.max(np.abs(periods - truth.edge_period)) < 4.001e-6
    assert np.ptp(truth.edge_count) > (600 if single else 300)


def test_stamps_are_ticks_at_or_before_the_edge_and_never_after_the_sample() -> None:
    coarse = run(motor(ks=0.3), LEVELS, BoardConfig(start_angle=1.0, edge_resolution=1e-4))
    exact = run(motor(ks=0.3), LEVELS, BoardConfig(start_angle=1.0, edge_resolution=0.0))
    early = np.array([b.edge_time - a.edge_time for a, b in zip(coarse, exact, strict=True) if b.edge_count])
    assert early.min() >= -1 and 90_000 < early.max() <= 100_000  # [ns], 1 of rounding
    assert 45_000 < early.mean() < 55_000
    assert all((sample.edge_time - POWER_UP) % 100_000 == 0 for sample in coarse if sample.edge_count)
    for sample in (*coarse, *exact):
        assert sample.edge_time <= sample.sample_time + 1


def test_first_samples_say_that_there_was_no_edge_yet() -> None:
    first, *others = run(motor(), np.full(60, 10.0))
    assert first == Sample(POWER_UP, 0.0, 10.0, supply_voltage=first.supply_voltage, current=first.current)
    assert np.isnan(first.supply_voltage) and np.isnan(first.current)
    one = next(sample for sample in others if sample.edge_count == 1)
    assert one.edge_period == 0.0 and one.speed == 0.0 and one.edge_time > POWER_UP
    two = next(sample for sample in others if sample.edge_count >= 2)
    assert two.edge_period > 0.0 and two.speed == pytest.approx(SLOT / two.edge_period, rel=1e-9)


@pytest.mark.parametrize("rate", [100.0, 200.0, 300.0, 1000.0])
def test_samples_are_on_the_grid_of_their_rate(rate: float) -> None:
    samples = run(motor(), np.zeros(round(rate) + 1), BoardConfig(sample_rate=rate))
    grid = POWER_UP + np.round(np.arange(round(rate) + 1) * 1e9 / rate)
    assert np.array_equal([sample.sample_time for sample in samples], grid)
    assert samples[-1].sample_time == POWER_UP + 1_000_000_000


def test_commands_are_clipped_to_what_the_supply_has() -> None:
    samples = run(Parameters(BASE, max_voltage=6.0), np.array([7.0, -100.0, 5.9, np.inf, -6.0]))
    assert [sample.voltage for sample in samples] == [6.0, -6.0, 5.9, 6.0, -6.0]
    full = SimulatedBoard(Parameters(BASE, max_voltage=6.0), BoardConfig())
    for _ in range(400):
        full.sample(12.0)
    assert full.speed == pytest.approx(6.0 / PAPER_KV, rel=1e-6)


@pytest.mark.parametrize("delay", [0.0, 0.0021, 0.005, 0.0123, 0.05])
def test_a_voltage_acts_a_delay_after_the_sample_that_latches_it(delay: float) -> None:
    """The first turn away from rest is ½ u/ka t² long, whatever sample the delay falls into."""
    board = SimulatedBoard(motor(delay=delay), BoardConfig())
    for k in range(40):
        board.sample(10.0 if k >= 4 else 0.0)
        since = max((k - 4) * 0.005 - delay, 0.0)
        time_constant = PAPER_KA / PAPER_KV
        exact = 10.0 / PAPER_KV * (since - time_constant * -np.expm1(-since / time_constant))
        assert board.angle == pytest.approx(exact, abs=1e-11)


def test_short_pulses_all_come_through_a_long_delay() -> None:
    commands = np.zeros(200)
    commands[[3, 5, 9, 10, 17]] = [8.0, -8.0, 4.0, -2.0, 6.0]
    late, early = SimulatedBoard(motor(delay=0.1), BoardConfig()), SimulatedBoard(motor(), BoardConfig())
    angles = np.array([(late.sample(volts), late.angle)[1] for volts in commands.tolist()])
    expected = np.array([(early.sample(volts), early.angle)[1] for volts in commands.tolist()])
    assert np.max(np.abs(angles[20:] - expected[:-20])) < 1e-12 and np.all(angles[:23] == 0.0)
    assert np.ptp(expected) > 0.1


def test_two_channels_count_down_and_know_the_sign() -> None:
    board = SimulatedBoard(motor(), BoardConfig(single_channel=False, start_angle=0.0))
    shaft, samples = [], []
    for volts in LEVELS.tolist():
        samples.append(board.sample(volts))
        shaft.append(board.angle)
    counts = np.array([sample.edge_count for sample in samples])
    beside = counts - np.array(shaft) / SLOT
    assert 0.9 < np.max(np.abs(beside)) < 2.5  # a reversal between two flanks shifts the count by one of them
    assert np.any(np.diff(counts) < 0) and np.any(np.diff(counts) > 0)


def test_missed_edges_are_as_many_as_asked_for() -> None:
    whole = run(motor(), np.full(1200, 10.0))[-1].edge_count
    shares = [
        1.0
        - run(motor(miss_rate=rate), np.full(1200, 10.0), BoardConfig(start_angle=0.0, seed=seed))[-1].edge_count
        / whole
        for rate in (0.02, 0.2)
        for seed in range(4)
    ]
    assert whole > 12_000
    assert 0.017 < np.mean(shares[:4]) < 0.023 and 0.19 < np.mean(shares[4:]) < 0.21
    assert len(set(shares)) == 8


def test_the_period_after_a_missed_edge_spans_the_gap() -> None:
    samples = run(motor(miss_rate=0.1), np.full(800, 1.0), BoardConfig(seed=1))[400:]
    slots = np.array([sample.edge_period for sample in samples]) * (1.0 / PAPER_KV) / SLOT
    assert np.max(np.abs(slots - np.round(slots))) < 0.01
    assert set(np.round(slots)) >= {1.0, 2.0} and 0.05 < np.mean(np.round(slots) > 1.0) < 0.15


def test_a_seed_is_a_run_and_another_seed_another_start() -> None:
    first, again, other = (
        [(s.edge_count, s.edge_time, s.speed) for s in run(motor(miss_rate=0.05), LEVELS, BoardConfig(seed=seed))]
        for seed in (3, 3, 4)
    )
    assert first == again and first != other


def test_start_angles_are_anywhere_in_a_turn() -> None:
    """Seen from outside: when the first edge of a slow turn comes, over seeds, is uniform over a slot."""
    waits = []
    for seed in range(60):
        samples = run(motor(), np.full(40, 2.0), BoardConfig(seed=seed))
        waits.append(next(sample.edge_time for sample in samples if sample.edge_count))
    travel = np.array([2.0 / PAPER_KA * 0.5 * ((wait - POWER_UP) * 1e-9) ** 2 for wait in waits]) / SLOT
    assert 0.4 < travel.mean() < 0.6 and travel.min() < 0.1 and 0.9 < travel.max() < 1.1


def test_what_a_reader_has_to_know() -> None:
    config = BoardConfig("left", 500.0, 48, False, 1e-6)
    info = config.info(Parameters(BASE, max_voltage=24.0))
    assert (info.name, info.source, info.measurement) == ("left", "simulation", Measurement.EDGES)
    assert (info.edges_per_revolution, info.single_channel, info.edge_resolution) == (48, False, 1e-6)
    assert (info.sample_period, info.max_voltage, info.decay) == (0.002, 24.0, "brake")
    assert config.info(motor(coast_share=0.5)).decay == "coast"


@pytest.mark.parametrize("single", [True, False], ids=["one channel", "two channels"])
def test_a_shaft_that_dithers_over_one_flank(single: bool) -> None:
    """Two channels take back what one channel, which knows no direction, counts up."""
    config = BoardConfig(sample_rate=1000.0, start_angle=-0.02, single_channel=single)
    shaken = np.tile(np.repeat([6.0, -6.0], 20), 100)  # 20 ms each way: to and fro over the flank at 0.02 rad
    samples = run(motor(), np.concatenate([[6.0] * 10, shaken]), config)
    counts = np.array([sample.edge_count for sample in samples])
    board = SimulatedBoard(motor(), config)
    turned = []
    for volts in np.concatenate([[6.0] * 10, shaken]):
        board.sample(float(volts))
        turned.append(board.angle * 96 / tau)
    off = counts - np.array(turned)
    if single:
        assert off[-1] > 100.0
    else:
        assert np.ptp(off) <= 1.5
