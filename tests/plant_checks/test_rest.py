"""Stops, starts, reversals and backlash of the plant against closed forms; and that a finer step changes nothing."""

import numpy as np
import pytest
from numpy.typing import NDArray
from plant import profiles
from plant.motor import Motion, move
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from tiers import mark_slow

KV, KA = 12 / 174.097, 0.0055
TAU = KA / KV
BASE = {"kv": KV, "ka": KA}
Floats = NDArray[np.float64]
TIMES: Floats = np.arange(0.0, 0.6001, 0.005, dtype=np.float64)


def stop_of(motion: Motion) -> int:
    return int(np.flatnonzero(motion.speed == 0.0)[0])


def test_coulomb_coast_down_ends_on_time_and_in_place() -> None:
    ks, speed = 0.5, 100.0
    motion = move(BASE | {"ks": ks}, TIMES, 0.0 * TIMES, start_speed=speed)
    stop = stop_of(motion)
    time = TAU * np.log(1.0 + KV * speed / ks)
    assert motion.time[stop] == pytest.approx(time, abs=1e-12)
    assert motion.angle[stop] == pytest.approx(TAU * speed - ks / KV * time, abs=1e-11)
    assert np.all(motion.speed[stop:] == 0.0) and np.all(motion.angle[stop:] == motion.angle[stop])
    assert 0.2 < time < 0.3


def test_without_back_emf_friction_takes_all_kinetic_energy() -> None:
    motion = move({"kv": 0.0, "ka": KA, "ks": 0.8, "drag": 0.0}, TIMES, 0.0 * TIMES, start_speed=-70.0)
    assert motion.angle[-1] == pytest.approx(-0.5 * KA * 70.0**2 / 0.8, abs=1e-9)


def take_ups(motion: Motion) -> NDArray[np.int64]:
    """The nodes at which a moving motor takes its load along again."""
    return np.flatnonzero((np.diff(motion.time) == 0.0) & (motion.speed[1:] != 0.0))


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_holds_up_to_breakaway_and_not_beyond(way: float) -> None:
    parameters = BASE | {"ks": 0.3, "breakaway_voltage": 0.8, "stribeck_speed": 2.0, "bias_voltage": 0.1}
    held = move(parameters, TIMES, np.full_like(TIMES, 0.1 + way * 0.7999))
    moved = move(parameters, TIMES, np.full_like(TIMES, 0.1 + way * 0.8001))
    assert np.all(held.angle == 0.0) and np.all(held.speed == 0.0)
    assert way * moved.speed[-1] == pytest.approx(0.0001 / KV, rel=0.01)  # creeps: the Stribeck term still holds it
    slides = move(parameters, TIMES, np.full_like(TIMES, 0.1 + way * 1.5))
    assert way * slides.speed[-1] == pytest.approx((1.5 - 0.3) / KV * -np.expm1(-0.6 / TAU), rel=0.01)


def test_what_holds_grows_as_the_copper_warms() -> None:
    warm = BASE | {"ks": 0.5, "bias_voltage": 0.1, "resistance_rise": 0.4}  # warm at once: holds up to 1.4*(0.5 + 0.1)
    for volts, moves in ((0.839, False), (0.841, True), (-0.559, False), (-0.561, True)):
        assert bool(np.any(move(warm, TIMES, np.full_like(TIMES, volts)).speed)) is moves
    slowly = warm | {"warm_up_time": 0.2}
    stays = move(slowly, TIMES, np.where(TIMES < 0.3, 0.0, 0.75))  # 0.6*(1.4 - 0.4*exp(-1.5)) = 0.786 V holds by now
    assert not np.any(stays.speed)
    assert np.any(move(slowly, TIMES, np.where(TIMES < 0.3, 0.0, 0.79)).speed)


def test_breaks_away_at_the_instant_a_ramp_passes_breakaway() -> None:
    parameters = BASE | {"ks": 0.3, "breakaway_voltage": 0.8, "stribeck_speed": 2.0, "slew_rate": 7.3}
    motion = move(parameters, TIMES, np.full_like(TIMES, 6.0))
    first = np.flatnonzero(motion.speed)[0] - 1
    assert motion.time[first] == pytest.approx(0.8 / 7.3, abs=1e-12)


def test_reverses_through_zero_with_friction_turning() -> None:
    ks, u, speed = 0.5, -6.0, 100.0
    motion = move(BASE | {"ks": ks}, TIMES, np.full_like(TIMES, u), start_speed=speed)
    before, after = (u - ks) / KV, (u + ks) / KV
    turn = TAU * np.log(1.0 - speed / before)
    expected = np.where(
        turn > TIMES,
        before + (speed - before) * np.exp(-TIMES / TAU),
        -after * np.expm1(-np.maximum(TIMES - turn, 0.0) / TAU),
    )
    assert motion.time[stop_of(motion)] == pytest.approx(turn, abs=1e-12)
    assert np.abs(motion.speed[motion.at] - expected).max() < 1e-10


def test_sticks_at_a_reversal_until_the_lagged_drive_breaks_it_loose() -> None:
    lag, breakaway, u, speed = 0.02, 1.2, -2.0, 2.0
    parameters = BASE | {"ks": 1.2, "electrical_time_constant": lag}
    motion = move(parameters, TIMES, np.full_like(TIMES, u), start_speed=speed)

    def rates(t: float, y: Floats) -> tuple[float, float]:
        return (y[1] - 1.2) / KA, (u - KV * y[0] - y[1]) / lag

    def standing(t: float, y: Floats) -> float:
        return float(y[0])

    standing.terminal = True  # type: ignore[attr-defined]
    braking = solve_ivp(rates, (0.0, 0.1), (speed, -KV * speed), "DOP853", events=standing, rtol=1e-12, atol=1e-13)
    stop, drive = braking.t[-1], braking.y[1, -1]
    start = stop + lag * np.log((drive - u) / (-breakaway - u))
    nodes = stop_of(motion)
    assert motion.time[nodes] == pytest.approx(stop, abs=1e-11)
    moving = np.flatnonzero((motion.speed != 0.0) & (motion.time > stop))[0] - 1
    assert motion.time[moving] == pytest.approx(start, abs=1e-11)
    assert start - stop > 0.005
    assert motion.speed[-1] == pytest.approx((u + 1.2) / KV, rel=2e-3)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_backlash_lets_the_motor_run_alone_until_the_play_is_taken_up(way: float) -> None:
    gap, share = 0.3, 0.4
    parameters = {"kv": 0.0, "ka": KA, "backlash_angle": gap, "load_fraction": share}
    volts = np.where(TIMES < 0.1, 1.0, -1.0)
    motion = move(parameters, TIMES, way * volts)
    a = 1.0 / KA
    alone = np.sqrt(2.0 * gap * (1.0 - share) / a)  # from the turn at 0.2 s to the other flank
    met = 0.2 + alone
    speed = np.select(
        [TIMES <= 0.1, TIMES <= 0.2, met >= TIMES],
        [a * TIMES, a * (0.2 - TIMES), -a / (1.0 - share) * (TIMES - 0.2)],
        -a / (1.0 - share) * alone - a * (TIMES - met),
    )
    assert np.abs(motion.speed[motion.at] - way * speed).max() < 1e-9
    twins = take_ups(motion)
    assert len(twins) == 1 and motion.time[twins[0]] == pytest.approx(met, abs=1e-12)
    assert way * motion.angle[twins[0]] == pytest.approx(a * 0.01 - gap, abs=1e-11)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_motor_that_turns_inside_the_play_comes_back_to_the_flank_it_left(way: float) -> None:
    gap, share = 0.3, 0.4
    parameters = {"kv": 0.0, "ka": KA, "backlash_angle": gap, "load_fraction": share}
    volts = np.where(TIMES < 0.1, 1.0, np.where(TIMES < 0.22, -1.0, 1.0))  # 0.02 s alone: 0.06 rad of the 0.3
    motion = move(parameters, TIMES, way * volts)
    a = 1.0 / KA / (1.0 - share)
    travel = 0.5 * a * 0.02**2
    back = 0.24 + np.sqrt(2.0 * 2.0 * travel / a)
    twins = take_ups(motion)
    assert len(twins) == 1 and motion.time[twins[0]] == pytest.approx(back, abs=1e-11)
    left = 0.01 / KA  # the angle at which it turned, 0.2 s
    assert way * motion.angle[twins[0]] == pytest.approx(left, abs=1e-11)


def test_a_stop_without_reversal_frees_no_play() -> None:
    parameters = BASE | {"ks": 0.5, "backlash_angle": 0.3, "load_fraction": 0.4}
    volts = np.where((TIMES > 0.1) & (TIMES < 0.4), 0.0, 3.0)
    with_play, without = move(parameters, TIMES, volts), move(BASE | {"ks": 0.5}, TIMES, volts)
    assert np.count_nonzero(without.speed == 0.0) > 10
    assert np.array_equal(with_play.speed, without.speed)


def test_a_ripple_holds_the_motor_in_its_valley() -> None:
    ripple, cycles, u = 1.0, 5.0, 0.4
    parameters = BASE | {"ripple_voltage": ripple, "ripple_cycles": cycles}
    motion = move(parameters, np.arange(0.0, 8.0, 0.005, dtype=np.float64), np.full(1600, u))
    rest = brentq(lambda angle: u - ripple * np.sin(cycles * angle), 0.0, 0.3)
    assert motion.angle[-1] == pytest.approx(rest, abs=1e-6)
    assert motion.angle.max() > 1.2 * rest  # it swung past and came back


EVERYTHING = BASE | {
    "ks": 0.4,
    "breakaway_voltage": 0.7,
    "stribeck_speed": 4.0,
    "drag": 2e-5,
    "bias_voltage": 0.1,
    "step_voltage": 0.2,
    "step_time": 1.234567,
    "dead_zone_voltage": 0.3,
    "limit_voltage": 10.0,
    "reverse_gain": 0.95,
    "coast_share": 0.3,
    "sag": 0.1,
    "electrical_time_constant": 0.0015,
    "delay": 0.00321,
    "ripple_voltage": 0.15,
    "ripple_cycles": 7.0,
    "backlash_angle": 0.05,
    "load_fraction": 0.3,
    "resistance_rise": 0.2,
    "warm_up_time": 2.0,
}
MORE = {
    "angle_friction": 0.2,
    "load_friction": 0.1,
    "compliance_fraction": 0.3,
    "compliance_stiffness": 1.0,
    "compliance_damping": 1e-3,
    "supply_ripple": 0.05,
    "supply_ripple_frequency": 2.0,
}


@pytest.mark.parametrize("parameters", [EVERYTHING, EVERYTHING | MORE], ids=["table", "table and more"])
@pytest.mark.parametrize(
    "profile", [profiles.reversals(), mark_slow(profiles.coast()), mark_slow(profiles.random(seed=3))]
)
def test_a_finer_step_changes_nothing(parameters: dict[str, float], profile: profiles.Profile) -> None:
    coarse, fine = (move(parameters, *profile, step=step) for step in (2e-5, 5e-6))
    loose = 1e3 if "load_friction" in parameters else 1.0  # |drive| has a corner that no step ends at
    assert np.abs(coarse.angle[coarse.at] - fine.angle[fine.at]).max() < 1e-8 * loose
    assert np.abs(coarse.speed[coarse.at] - fine.speed[fine.at]).max() < 1e-6 * loose
    assert np.ptp(fine.angle) > 10.0


def test_slewing_and_presliding_converge_too() -> None:
    parameters = BASE | {"ks": 0.5, "presliding_angle": 0.02, "slew_rate": 500.0}
    runs = [move(parameters, *profiles.reversals(), step=step) for step in (2e-5, 1e-5, 5e-6)]
    errors = [np.abs(run.angle[run.at] - runs[2].angle[runs[2].at]).max() for run in runs[:2]]
    assert errors[0] < 1e-5 and errors[1] < 0.5 * errors[0] + 1e-9
