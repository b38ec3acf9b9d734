"""The disc and its edges: statistics of its slots, edges against closed forms, and hard parameters by the thousand."""

from math import floor, sin, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from motor_model.dynamics.bridge import effective_voltage
from motor_model.dynamics.state import State, at_rest, turning
from motor_model.effects import EFFECT_BY_NAME, EFFECTS, SPEC_BY_NAME, normalised, specs_of
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sensing.encoder import Disc, flank, make_disc, turn

Floats = NDArray[np.float64]

SLOT = tau / 96
IDEAL = make_disc(96)


def edges(
    parameters: Parameters,
    state: State,
    voltage: float,
    seconds: float,
    disc: Disc = IDEAL,
    offset: float = 0.0,
    room: int = 4096,
    start: float = 0.0,
) -> tuple[State, Floats, NDArray[np.int64]]:
    """The state, and times [s] and directions of the edges, after turning at a command [V]."""
    p = parameters.vector()
    times, directions = np.full(room, np.nan), np.zeros(room, dtype=np.int64)
    u = effective_voltage(p, voltage)
    state, count = turn(p, u, state, start, seconds, disc.forward, disc.backward, offset, times, directions, False)
    return state, times[:count], directions[:count]


def at_speed(speed: float, **effects: float) -> tuple[Parameters, State, float]:
    """A motor that goes on at a speed [rad/s], and the voltage for that."""
    names = tuple(effect.name for effect in EFFECTS if any(spec.name in effects for spec in effect.parameters))
    parameters = Parameters({"kv": PAPER_KV, "ka": PAPER_KA} | effects, names)
    return parameters, turning(parameters.vector(), speed, PAPER_KV * speed), PAPER_KV * speed


def test_an_ideal_disc_is_even() -> None:
    assert np.diff(IDEAL.forward) == pytest.approx(SLOT, rel=1e-12)
    assert np.allclose(np.diff(IDEAL.forward), SLOT, rtol=0, atol=1e-14)
    assert np.allclose(IDEAL.backward - IDEAL.forward, 0.5 * SLOT, rtol=0, atol=1e-14)


def test_irregular_slots_have_the_scatter_that_was_asked_for() -> None:
    offsets = []
    for seed in range(50):
        disc = make_disc(96, 0.01, seed)
        pair = np.array([disc.forward - IDEAL.forward, disc.backward - IDEAL.backward]) / SLOT
        assert np.all(np.abs(pair.mean(axis=1)) < 1e-12)  # the disc as a whole is not turned
        offsets.append(pair)
    scatter = np.array(offsets)
    assert 0.0097 < scatter.std() < 0.0103
    assert 0.03 < np.abs(scatter).max() < 0.055  # Gaussian: 4 σ and a little in 9,600 flanks
    assert abs(np.corrcoef(scatter[:, 0].ravel(), scatter[:, 1].ravel())[0, 1]) < 0.05  # two flanks, two errors


def test_a_seed_is_a_disc() -> None:
    assert np.array_equal(make_disc(96, 0.01, 7).forward, make_disc(96, 0.01, 7).forward)
    assert not np.array_equal(make_disc(96, 0.01, 7).forward, make_disc(96, 0.01, 8).forward)


def test_edges_are_counted_without_end_over_the_turns() -> None:
    disc = make_disc(7, 0.05, 3)
    for index in (-15, -8, -7, -1, 0, 6, 7, 20):
        assert flank(disc.forward, index) == pytest.approx(disc.forward[index % 7] + tau * (index // 7), abs=1e-12)
    assert np.all(np.diff([flank(disc.forward, index) for index in range(-20, 20)]) > 0.0)


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize("offset", [0.0, 0.0123, 5.9])
def test_edges_of_a_steady_speed_come_where_the_flanks_are(way: int, offset: float) -> None:
    parameters, state, voltage = at_speed(way * 50.0)
    after, times, directions = edges(parameters, state, voltage, 0.5, offset=offset, start=3.0)
    first = 0.0 if way > 0 else 0.5  # turning backward the other flank is seen
    passed = [k for k in range(-400, 800) if 0.0 < way * ((k + first) * SLOT - offset) <= 50.0 * 0.5]
    expected = 3.0 + np.sort([way * ((k + first) * SLOT - offset) / 50.0 for k in passed])
    assert len(times) in (381, 382) and len(times) == len(expected)
    assert np.max(np.abs(times - expected)) < 1e-12
    assert np.all(directions == way)
    assert after.angle == pytest.approx(way * 25.0, abs=1e-11)


def test_irregular_flanks_shift_their_edges_and_no_others() -> None:
    disc = make_disc(96, 0.01, 5)
    parameters, state, voltage = at_speed(50.0)
    _, ideal, _ = edges(parameters, state, voltage, 0.3, offset=0.01)
    _, real, _ = edges(parameters, state, voltage, 0.3, disc, offset=0.01)
    shift = np.array([disc.forward[(k + 1) % 96] - SLOT * ((k + 1) % 96) for k in range(len(ideal))]) / 50.0
    assert np.max(np.abs(real - ideal - shift)) < 1e-12
    assert 0.5 * 0.01 * SLOT / 50.0 < (real - ideal).std() < 2.0 * 0.01 * SLOT / 50.0


@pytest.mark.parametrize("way", [1, -1])
def test_an_eccentric_disc_shows_its_angle(way: int) -> None:
    e, phase = 0.15, 0.7
    parameters, state, voltage = at_speed(way * 50.0, eccentricity=e, eccentricity_phase=phase)
    _, times, _ = edges(parameters, state, voltage, 0.4, offset=0.02)
    shown = way * 50.0 * times + e * np.sin(way * 50.0 * times + phase) + 0.02
    flanks = shown / SLOT - (0.0 if way > 0 else 0.5)
    assert np.max(np.abs(flanks - np.round(flanks))) < 1e-8
    assert np.all(np.diff(np.round(flanks)) == way)
    periods = np.diff(times)
    assert 0.84 < periods.min() * 50.0 / SLOT < 0.88 and 1.15 < periods.max() * 50.0 / SLOT < 1.19  # 1/(1 ± e)
    travel = way * 20.0 + e * (sin(way * 20.0 + phase) - sin(phase))
    assert abs(len(times) - way * travel / SLOT) < 1.0


def test_a_shaft_that_rocks_over_a_flank_makes_an_edge_each_time_forward_and_none_back() -> None:
    parameters = Parameters({"kv": PAPER_KV, "ka": PAPER_KA})
    state, forward = at_rest(0.0), 0
    for volts in (2.0, -2.0, -2.0, 2.0) * 3:  # to and fro within a quarter of a slot around 0.2 of one
        state, times, directions = edges(parameters, state, volts, 0.008, offset=-0.1 * SLOT)
        forward += len(times)
        assert np.all(directions == 1) and len(times) <= 1
    assert forward == 3


def test_more_edges_than_there_is_room_for_are_dropped_not_written_elsewhere() -> None:
    parameters, state, voltage = at_speed(50.0)
    _, times, _ = edges(parameters, state, voltage, 0.5, room=10)
    assert len(times) == 10 and times[-1] == pytest.approx(10 * SLOT / 50.0, abs=1e-12)
    _, times, _ = edges(parameters, state, voltage, 0.5, room=0)
    assert len(times) == 0


# Boxes far beyond any motor, but with time constants over 1 ms and speeds a disc could show.
BOX = {
    "kv": (2e-3, 1.0),
    "ka": (2e-6, 10.0),
    "ks": (1e-9, 20.0),
    "breakaway_voltage": (1e-9, 20.0),
    "stribeck_speed": (1e-3, 1e3),
    "drag": (1e-9, 1.0),
    "dead_zone_voltage": (1e-9, 5.0),
    "limit_voltage": (0.1, 20.0),
    "reverse_gain": (0.01, 2.0),
    "coast_share": (0.01, 1.0),
    "sag": (1e-6, 10.0),
    "electrical_time_constant": (1e-6, 0.3),
    "step_time": (1e-3, 1.0),
    "ripple_voltage": (1e-6, 5.0),
    "ripple_cycles": (0.1, 100.0),
    "eccentricity": (1e-6, 0.9),
    "backlash_angle": (1e-9, 5.0),
    "load_fraction": (1e-3, 0.99),
    "resistance_rise": (1e-3, 10.0),
    "warm_up_time": (1e-3, 1e3),
}
SIGNED = {"bias_voltage": 10.0, "step_voltage": 10.0, "ripple_phase": 9.0, "eccentricity_phase": 9.0}


@st.composite
def motors(draw: st.DrawFn) -> Parameters:
    names = sorted(set(EFFECT_BY_NAME) - {"transport_delay", "missed_edges"})
    effects = normalised(tuple(draw(st.lists(st.sampled_from(names), max_size=6))))
    values = {}
    for spec in specs_of(effects):
        if spec.name in SIGNED:
            values[spec.name] = draw(st.floats(-SIGNED[spec.name], SIGNED[spec.name]))
            continue
        low, high = BOX[spec.name]
        size = low * (high / low) ** draw(st.floats(0.0, 1.0))
        never_zero = spec.name in ("kv", "ka", "stribeck_speed", "warm_up_time", "limit_voltage")
        values[spec.name] = size if never_zero or draw(st.integers(0, 6)) else 0.0
    values["ka"] = min(max(values["ka"], 1e-3 * values["kv"]), 10.0 * values["kv"])
    if "breakaway_voltage" in values:
        values["breakaway_voltage"] = max(values["breakaway_voltage"], values["ks"])
    assert all(SPEC_BY_NAME[name].minimum <= value <= SPEC_BY_NAME[name].maximum for name, value in values.items())
    return Parameters(values, effects)


@settings(max_examples=150, deadline=3000, derandomize=True, database=None)
@given(
    parameters=motors(),
    commands=st.lists(
        st.tuples(st.sampled_from([0.0, 12.0, -12.0, 0.1, 3.0, -5.0]), st.floats(1e-6, 0.02)), max_size=12
    ),
)
@pytest.mark.timeout(60)
def test_every_motor_moves_on_and_its_edges_fit_its_angle(
    parameters: Parameters, commands: list[tuple[float, float]]
) -> None:
    """No parameters make the step stand still in time, blow up, or pass flanks out of order."""
    state, time = at_rest(0.0), 0.0
    slot = SLOT
    for volts, seconds in commands:
        before = state
        state, times, directions = edges(parameters, state, volts, seconds, offset=0.3 * slot, start=time)
        time += seconds
        assert all(np.isfinite(state))
        assert np.all(np.diff(times) >= -1e-12)
        assert len(times) == 0 or (times[0] >= time - seconds - 1e-12 and times[-1] <= time + 1e-12)
        if parameters.value("eccentricity") == 0.0 and np.all(directions == 1) and len(times) < 4096:
            passed = floor(state.angle / slot + 0.3) - floor(before.angle / slot + 0.3)
            assert max(passed, 0) <= len(times) <= max(passed, 0) + 8  # more where it rocked over a flank
