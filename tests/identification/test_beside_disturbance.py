"""Effects are named beside a random torque, which is measured; what is not in the table is told from it."""

from collections.abc import Callable

import pytest
from plant import profiles, record

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.recording import check

TORQUE, TIME = 0.15, 0.05  # [V] 1.25 % of the supply, [s]


def short(volts: float, seed: int) -> profiles.Profile:
    """What tells a torque that follows the motion from a random one, in 11 s."""
    parts = [profiles.staircase(volts, 3, 0.4), profiles.reversals(volts, 4)]
    return profiles.joined(*parts, profiles.random(volts, 5.0, seed))


def diagnosed(hidden: dict[str, float], seed: int, drive: Callable[..., profiles.Profile]) -> Diagnosis:
    values = {"kv": 0.07, "ka": 0.0055, "random_torque": TORQUE, "random_torque_time": TIME, "random_torque_seed": seed}
    recording, _truth = record(values | hidden, *drive(12.0, seed), seed=seed, irregularity=0.005, disc_seed=seed)
    return diagnose([check(recording)])


@pytest.mark.long
@pytest.mark.parametrize(
    ("hidden", "named"),
    [
        pytest.param({}, (), marks=pytest.mark.slow),
        ({"ks": 0.3, "delay": 0.006}, ("coulomb_friction", "transport_delay")),
        pytest.param({"backlash_angle": 0.3, "load_fraction": 0.5}, ("backlash",), marks=pytest.mark.slow),
    ],
    ids=["nothing", "friction and delay", "backlash"],
)
def test_effects_are_named_and_the_torque_is_measured(hidden: dict[str, float], named: tuple[str, ...]) -> None:
    found = diagnosed(hidden, 11, profiles.compact)
    assert tuple(sorted(one.effect for one in found.findings)) == named
    assert found.verdict is (Verdict.EXPLAINED if named else Verdict.NOTHING_MISSING)
    for name, value in hidden.items():
        assert found.model.parameters.values[name] == pytest.approx(value, rel=0.15)
    assert found.disturbance is not None
    assert 0.8 * TORQUE < found.disturbance.rms_voltage < 1.2 * TORQUE
    assert 0.6 * TIME < found.disturbance.correlation_time < 1.6 * TIME
    assert 0.85 < found.gap_after / found.noise_floor < 1.2
    assert found.sensor_floor < 0.5 * found.noise_floor


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize(
    ("hidden", "variables"),
    [
        ({"speed_wave": 0.5, "speed_wave_scale": 12.0}, {"speed"}),
        ({"load_friction": 0.15}, {"drive", "speed_voltage"}),
    ],
    ids=["a wave over the speed", "friction of loaded gears"],
)
def test_what_is_not_in_the_table_is_told_from_the_torque(hidden: dict[str, float], variables: set[str]) -> None:
    found = diagnosed(hidden, 12, short)
    assert found.verdict is Verdict.UNEXPLAINED
    assert not found.findings and found.disturbance is None
    assert found.structure[0].variable in variables and found.structure[0].certain
    assert found.noise_floor == found.sensor_floor < 0.2 * found.gap_after


@pytest.mark.slow
@pytest.mark.long
def test_a_ripple_is_named_beside_a_torque_in_which_its_phase_hardly_shows() -> None:
    """In mean speeds the torque leaves thirty times as much; beside it the ripple's size is sure to some per cent."""
    ripple = {"ripple_voltage": 0.4, "ripple_cycles": 8.43, "ripple_phase": 0.7}
    motor = {"kv": 0.082, "ka": 0.0058, "random_torque": 2.0 * TORQUE, "random_torque_time": TIME} | ripple
    slow = profiles.joined(profiles.step(12.0), profiles.staircase(12.0, 4, 0.4), profiles.reversals(12.0))
    drives = {4: profiles.joined(slow, profiles.random(12.0, 5.0, 4)), 5: profiles.random(12.0, 6.0, 5)}
    training, validation = (
        check(record(motor | {"random_torque_seed": seed}, *drive, seed=seed, irregularity=0.005)[0])
        for seed, drive in drives.items()
    )
    found = diagnose([training], [validation])
    assert [one.effect for one in found.findings] == ["torque_ripple"]
    assert found.verdict is Verdict.EXPLAINED
    size, error = found.findings[0].parameters["ripple_voltage"]
    cycles, _ = found.findings[0].parameters["ripple_cycles"]
    assert size == pytest.approx(ripple["ripple_voltage"], rel=0.15)
    assert 0.002 < error < 0.05
    assert cycles == pytest.approx(ripple["ripple_cycles"], abs=0.01)
