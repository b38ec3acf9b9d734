"""Two pins of a bridge, by what the motion does with each of them."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.half_bridges import join_half_bridge
from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.imported import import_log

Floats = NDArray[np.float64]

ROWS, PERIOD = 1200, 0.01
SEEDS = range(4_330_000, 4_330_008)


def excite(seed: int, levels: int = 255) -> Floats:
    """Duties of a motor that is driven both ways, shape (K,): levels for a while each, a quarter of them none."""
    rng = np.random.default_rng(seed)
    duties = np.repeat(rng.uniform(-1.0, 1.0, ROWS), rng.integers(5, 40, ROWS))[:ROWS]
    return np.round(levels * np.where(np.abs(duties) < 0.25, 0.0, duties))


def run_motor(drive: Floats, seed: int, noise: float = 0.5) -> Floats:
    """Speeds of a motor of 80 ms and 100 rad/s at full duty, with noise, shape (K,)."""
    share, speed = drive / max(float(np.max(np.abs(drive))), 1e-9), [0.0]
    for one in share[:-1]:
        speed.append(speed[-1] + PERIOD / 0.08 * (100.0 * one - speed[-1]))
    return np.round(np.array(speed) + np.random.default_rng(seed + 1).normal(0.0, noise, ROWS), 3)


def make_table(**columns: Floats) -> Table:
    cells = {"t": PERIOD * np.arange(ROWS), **columns}
    return Table(Path("log.csv"), np.arange(2, ROWS + 2), cells)


def forth(drive: Floats) -> Floats:
    return np.maximum(drive, 0.0)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("one", "other"), [("IN1", "IN2"), ("in1", "in2"), ("A1", "A2"), ("M1A", "M1B"), ("pin_a", "pin_b"), ("x", "what")]
)
def test_two_pins_that_are_never_on_together_are_one_drive(one: str, other: str, seed: int) -> None:
    drive = excite(seed)
    found = join_half_bridge(
        make_table(**{one: forth(drive), other: forth(-drive), "rpm": run_motor(drive, seed)}), Said()
    )
    assert found.names == ["t", "rpm", f"{one} - {other} (duty)"]
    assert np.array_equal(found.numbers(found.names[-1]), drive)
    assert f"{one} less {other}" in found.notes[-1]


def test_the_pin_that_drives_forward_comes_first() -> None:
    drive = excite(4_330_100)
    found = join_half_bridge(
        make_table(IN1=forth(-drive), IN2=forth(drive), count=np.cumsum(run_motor(drive, 4_330_100))), Said()
    )
    assert np.array_equal(found.numbers("IN2 - IN1 (duty)"), drive)


def test_pins_of_a_bridge_that_are_high_where_it_rests_are_joined_too() -> None:
    """Slow decay: one pin stays full, the other one goes down; both are full in a brake."""
    drive = excite(4_330_101)
    table = make_table(AIN1=255.0 - forth(-drive), AIN2=255.0 - forth(drive), speed=run_motor(drive, 4_330_101))
    assert np.array_equal(join_half_bridge(table, Said()).numbers("AIN1 - AIN2 (duty)"), drive)


def test_a_speed_without_a_sign_is_enough_beside_pins_of_a_bridge_by_name_alone() -> None:
    """Else they may be two motors, of which whichever runs is looked at."""
    drive = excite(4_330_102)
    speed = np.abs(run_motor(drive, 4_330_102))
    assert (
        "IN1 - IN2 (duty)" in join_half_bridge(make_table(IN1=forth(drive), IN2=forth(-drive), rpm=speed), Said()).names
    )
    for one, other in (("pwm1", "pwm2"), ("A1", "A2")):
        table = make_table(**{one: forth(drive), other: forth(-drive), "rpm": speed})
        assert join_half_bridge(table, Said()) is table


@pytest.mark.parametrize("seed", SEEDS)
def test_two_motors_are_no_bridge(seed: int) -> None:
    drive, half = excite(seed), np.arange(ROWS) < ROWS // 2
    other = np.abs(excite(seed + 50))
    signed, speed = run_motor(drive, seed), run_motor(np.abs(drive) * half, seed)
    either = np.where(half, speed, run_motor(other * ~half, seed))
    for table in (
        make_table(pwm1=np.abs(drive) * half, pwm2=other * ~half, rpm=speed),  # that of the first, which stands then
        make_table(pwm1=np.abs(drive) * half, pwm2=other * ~half, rpm=np.abs(either)),  # whichever runs
        make_table(pwm_left=forth(drive), pwm_right=forth(-drive), rpm=signed),  # a machine that turns on the spot
        make_table(pwm1=forth(drive), pwm2=forth(-drive), rpm_left=signed, rpm_right=-signed),
        make_table(pwm1=np.abs(drive), pwm2=other, rpm=signed),  # on together
    ):
        assert join_half_bridge(table, Said()) is table


@pytest.mark.parametrize("seed", SEEDS)
def test_marks_beside_a_drive_with_a_sign_are_no_bridge(seed: int) -> None:
    drive = excite(seed)
    speed = run_motor(drive, seed)
    table = make_table(pwm=drive, up=1.0 * (drive > 0.0), down=1.0 * (drive < 0.0), rpm=speed)
    assert join_half_bridge(table, Said()) is table


@pytest.mark.parametrize("name", ["pwm", "ENA"])
def test_pins_of_two_levels_turn_a_duty_without_a_sign(name: str) -> None:
    drive = excite(4_330_103)
    speed = run_motor(drive, 4_330_103)
    pins = {"in1": 1.0 * (drive > 0.0), "in2": 1.0 * (drive < 0.0)}
    found = join_half_bridge(make_table(**{name: np.abs(drive)}, **pins, rpm=speed), Said())
    assert found.names == ["t", name, "rpm"] and np.array_equal(found.numbers(name), drive)
    for table in (
        make_table(pwm=np.abs(drive), **pins, rpm=np.abs(speed)),  # nothing shows which way
        make_table(pwm=np.abs(drive), **pins, rpm=run_motor(np.abs(drive), 4_330_103)),  # it never turns
    ):
        assert join_half_bridge(table, Said()) is table


@pytest.mark.parametrize("seconds", [0.02, 0.08, 0.3])
@pytest.mark.parametrize("seed", range(4_360_000, 4_360_003))
def test_switches_at_the_ends_of_a_slide_are_no_pins(seed: int, seconds: float) -> None:
    """They turn what moves, but it moves without them."""
    rng = np.random.default_rng(seed)
    place, speed, way = 0.0, 0.0, 1
    duties, ways, ends, speeds = np.repeat(rng.integers(120, 255, ROWS // 60), 60), [], [], []
    for duty in duties:
        way = -1 if place > 20.0 else 1 if place < 0.0 else way
        ways.append(0.5 * (way + 1))
        ends.append((1.0 * (place < 0.0), 1.0 * (place > 20.0)))
        speed += PERIOD / (PERIOD + seconds) * (duty / 2.55 * way - speed)
        place += PERIOD * speed
        speeds.append(speed)
    low, high = np.array(ends).T
    for beside in ({"dir": np.array(ways)}, {}):
        table = make_table(pwm=1.0 * duties, end1=low, end2=high, **beside, speed=np.array(speeds))
        assert join_half_bridge(table, Said()) is table


@pytest.mark.parametrize("seed", range(4_360_100, 4_360_104))
def test_pins_that_pulse_a_slow_motor_are_joined(seed: int) -> None:
    """It goes on for long where both are off."""
    rng = np.random.default_rng(seed)
    pulses = np.repeat(rng.choice([-255.0, 0.0, 0.0, 255.0], ROWS), rng.integers(3, 12, ROWS))[:ROWS]
    speed = [0.0]
    for one in pulses[:-1]:
        speed.append(speed[-1] + PERIOD / 1.0 * (100.0 * one / 255.0 - speed[-1]))
    table = make_table(IN1=forth(pulses), IN2=forth(-pulses), speed=np.round(speed, 2))
    assert np.array_equal(join_half_bridge(table, Said()).numbers("IN1 - IN2 (duty)"), pulses)


def test_what_the_user_said_stays(tmp_path: Path) -> None:
    drive = excite(4_330_104)
    table = make_table(IN1=forth(drive), IN2=forth(-drive), rpm=run_motor(drive, 4_330_104))
    for said in (Said(voltage="IN1"), Said(direction="-")):
        assert join_half_bridge(table, said) is table
    path = tmp_path / "log.csv"
    rows = zip(*(table.numbers(name) for name in table.names), strict=True)
    path.write_text("\n".join([",".join(table.names), *(",".join(f"{one:g}" for one in row) for row in rows)]))
    (motor,) = import_log(path, Said(supply_voltage=12.0)).motors
    volts = [sample.voltage for sample in motor.log.runs[0].samples]
    assert min(volts) < -11.0 and max(volts) > 11.0


def test_columns_with_gaps_are_left_for_what_fills_them() -> None:
    drive = excite(4_330_105)
    gaps = np.where(np.arange(ROWS) % 3 == 0, "5", "")
    for name in ("Voltage", "speed_2"):
        cells = {"t": PERIOD * np.arange(ROWS), "IN1": forth(drive), "IN2": forth(-drive), name: gaps}
        table = Table(Path("log.csv"), np.arange(2, ROWS + 2), {**cells, "rpm": run_motor(drive, 4_330_105)})
        assert (join_half_bridge(table, Said()) is table) == (name == "Voltage")


def test_among_many_columns_pins_have_like_names() -> None:
    drive = excite(4_330_106)
    flags = {f"flag{chr(97 + k) * (k + 1)}": 1.0 * (np.arange(ROWS) % (k + 3) == 0) for k in range(9)}
    for one, other, joined in (("M1A", "M1B", True), ("what", "x", False)):
        pins = {one: forth(drive), other: forth(-drive)}
        found = join_half_bridge(make_table(**flags, **pins, rpm=run_motor(drive, 4_330_106)), Said())
        assert (f"{one} - {other} (duty)" in found.names) == joined


@pytest.mark.parametrize(
    ("one", "other", "joined"), [("IN1", "IN2", True), ("ain_1", "ain_2", True), ("A1", "A2", False)]
)
def test_pins_by_name_are_enough_where_the_motion_tells_nothing(one: str, other: str, joined: bool) -> None:
    drive = excite(4_330_107)
    for together in (False, True):
        first = forth(drive) + together * (np.arange(ROWS) < 5)
        second = forth(-drive) + 2.0 * together * (np.arange(ROWS) < 5)
        table = make_table(**{one: first, other: second, "rpm": np.zeros(ROWS)})
        assert (len(join_half_bridge(table, Said()).names) == 3) == (joined and not together)
