"""How the driving column becomes volts."""

import numpy as np
import pytest

from motor_identification.logs.columns.drive import duty_drive, is_supply, sags, supply_scale, voltage_drive
from motor_identification.logs.columns.heading import read_heading

WAVE = np.sin(np.arange(100) / 5.0)


@pytest.mark.parametrize(
    ("name", "top", "full"),
    [
        ("duty", 1.0, 1.0),
        ("duty", 0.4, 1.0),
        ("duty", 80.0, 100.0),
        ("cmd", 100.0, 100.0),
        ("pwm", 60.0, 255.0),  # whole numbers of a PWM that never reach 100
        ("pwm", 126.0, 255.0),
        ("pwm", 127.0, 127.0),  # of VEX
        ("pwm", 128.0, 255.0),
        ("pwm", 255.0, 255.0),
        ("pwm", 256.0, 1000.0),
        ("pwm", 399.0, 1000.0),
        ("pwm", 400.0, 400.0),  # of Pololu's drivers
        ("pwm", 401.0, 1000.0),
        ("pwm", 1023.0, 1023.0),
        ("pwm", 32767.0, 32767.0),
        ("duty_pct", 40.0, 100.0),
    ],
)
def test_full_duty_by_the_largest_value(name: str, top: float, full: float) -> None:
    values = np.rint(top * WAVE) if top > 1.0 else top * WAVE
    values[7] = top
    drive = duty_drive(read_heading(name), values)
    assert drive.full == full and drive.scale is None
    assert duty_drive(read_heading(name), values, 500.0).full == 500.0


@pytest.mark.parametrize(
    ("name", "levels", "full", "sure"),
    [
        ("pwm", (0, 15, -15), 255.0, False),
        ("pwm", (0, 60, 95), 255.0, False),
        ("pwm", (0, 60, 64), 255.0, True),  # a quarter of 256
        ("pwm", (0, 43, 60, -12), 255.0, True),  # of a controller
        ("pwm", (0, 60, 105), 255.0, True),
        ("power", (0, 60, 95), 100.0, True),  # called per cent by many
        ("pwm", (0, 1), 1.0, True),
    ],
)
def test_round_levels_below_100_may_be_per_cent(name: str, levels: tuple[int, ...], full: float, sure: bool) -> None:
    """A Mecanum robot's "pwm" of 10 was 10 %, and was taken for 10 of 255."""
    values = np.tile(np.array(levels, dtype=float), 20)
    drive = duty_drive(read_heading(name), values)
    assert (drive.full, drive.sure) == (full, sure)
    assert ("if they are per cent, say --full-duty 100" in drive.why) is (full == 255.0 and max(levels) < 100)
    assert duty_drive(read_heading(name), values, 100.0).sure


@pytest.mark.parametrize(("top", "sure"), [(4095.0, True), (4096.0, False), (16383.0, False), (16384.0, True)])
def test_a_timer_that_counts_to_a_number_of_its_own(top: float, sure: bool) -> None:
    values = np.rint(top * WAVE)
    values[7] = top
    assert duty_drive(read_heading("pwm"), values).sure == sure
    assert duty_drive(read_heading("pwm"), values, 20_000.0).sure


@pytest.mark.parametrize(
    ("levels", "sure"),
    [((0, 127), False), ((0, 127, -127), False), ((0, 64, 127), True), ((0, 2047), False), ((0, 400), True)],
)
def test_one_level_may_be_half_of_what_there_is(levels: tuple[int, ...], sure: bool) -> None:
    """`analogWrite(pin, 127)` is half of 255, and all that a VEX has: the numbers do not tell which."""
    values = np.tile(np.array(levels, dtype=float), 20)
    assert duty_drive(read_heading("pwm"), values).sure is sure
    assert duty_drive(read_heading("pwm"), values, 255.0).sure


@pytest.mark.parametrize(("top", "millivolts"), [(1999.0, False), (2000.0, True), (60_000.0, True), (60_001.0, False)])
def test_a_voltage_of_thousands_is_in_millivolts(top: float, millivolts: bool) -> None:
    values = np.rint(top * WAVE)
    values[3] = top
    assert (voltage_drive(read_heading("Voltage"), values).scale == 1e-3) == millivolts
    assert voltage_drive(read_heading("u"), values).scale is None


@pytest.mark.parametrize(("top", "scale"), [(60.0, 1.0), (61.0, None)])
def test_whole_numbers_beyond_a_small_motors_volts_are_a_duty(top: float, scale: float | None) -> None:
    values = np.rint(top * WAVE)
    values[3] = top
    assert voltage_drive(read_heading("u"), values).scale == scale
    assert voltage_drive(read_heading("u"), values + 0.5).scale == 1.0
    assert voltage_drive(read_heading("u [mV]"), values).scale == 1e-3


@pytest.mark.parametrize(
    ("name", "values", "full"),
    [
        ("Chirp", 65_530.25 * WAVE / np.max(np.abs(WAVE)), 65535.0),
        ("u", 1001.5 * WAVE / np.max(np.abs(WAVE)), 1023.0),
        ("u", 999.5 * WAVE / np.max(np.abs(WAVE)), None),  # of a machine on a mains voltage
        ("u", np.clip(300.0 * WAVE, -255.0, 255.0), 255.0),  # a controller's output, cut off at a register's end
        ("u", np.clip(300.0 * WAVE, -254.0, 254.0), None),
        ("u", 255.0 * WAVE / np.max(np.abs(WAVE)), None),  # comes there once
        ("voltage", np.clip(300.0 * WAVE, -255.0, 255.0), None),
    ],
)
def test_more_than_any_motors_volts_is_a_duty(name: str, values: np.ndarray, full: float | None) -> None:
    drive = voltage_drive(read_heading(name), values)
    assert (drive.full, drive.scale) == (full, None if full else 1.0)


def test_what_is_called_a_voltage_and_is_more_than_any_motors_is_asked_about() -> None:
    drive = voltage_drive(read_heading("voltage"), 1001.5 * WAVE / np.max(np.abs(WAVE)))
    assert (drive.scale, drive.full, drive.sure) == (None, None, False) and "more than a motor's volts" in drive.why


def test_a_supply_stays_where_the_duty_turns() -> None:
    duty = 255.0 * WAVE
    assert is_supply(12.0 - np.abs(WAVE), duty)
    assert not is_supply(12.0 * WAVE, duty) and not is_supply(np.full(100, 12.0), np.full(100, 255.0))
    assert not is_supply(np.zeros(100), duty)


def test_the_unit_of_a_supply() -> None:
    assert supply_scale(read_heading("batteryVoltage"), np.full(5, 7931.0))[0] == 1e-3
    assert supply_scale(read_heading("battery"), np.full(5, 99.0)) == (1.0, "V")
    assert supply_scale(read_heading("battery [mV]"), np.full(5, 12.0)) == (1e-3, "mV")


@pytest.mark.parametrize(("top", "full"), [(0.98, 1.0), (1.0, 1.0), (1.2, 100.0)])
def test_per_cent_that_never_come_to_more_than_one_are_shares(top: float, full: float) -> None:
    assert duty_drive(read_heading("pwm_pct"), top * WAVE / np.max(np.abs(WAVE))).full == full
    assert duty_drive(read_heading("pwm_pct"), np.rint(WAVE)).full == 100.0  # whole ones


@pytest.mark.parametrize(
    ("name", "values", "volts"),
    [
        ("cmd_vp", np.repeat([0.0, 6.0], 50), True),
        ("cmd", 7.3 * WAVE, True),
        ("control", np.clip(30.0 * WAVE, -24.0, 24.0), True),  # cut off at a supply
        ("control", 24.0 * WAVE, False),  # comes there once
        ("control", np.clip(30.0 * WAVE, -25.0, 25.0), False),
        ("cmd", 0.9 * WAVE, False),
        ("cmd", 13.0 * WAVE, False),
        ("pwm", np.repeat([0.0, 6.0], 50), False),
        ("cmd [%]", 7.3 * WAVE, False),
        ("Control Effort", 4.884 * WAVE, True),
        ("effort", 4.884 * WAVE, False),
    ],
)
def test_a_command_of_a_few_is_in_volts(name: str, values: np.ndarray, volts: bool) -> None:
    drive = duty_drive(read_heading(name), values)
    assert ("in V (assumed, as" in drive.why) == volts
    assert (drive.scale == 1.0) == volts and (drive.full is None) == volts
    assert duty_drive(read_heading(name), values, 100.0).scale is None


@pytest.mark.parametrize(("top", "volts"), [(24.0, True), (25.0, False), (60.0, False)])
def test_whole_numbers_without_a_name_are_volts_of_a_small_motor_only(top: float, volts: bool) -> None:
    drive = voltage_drive(read_heading("column 1"), np.full(100, top))
    assert (drive.scale == 1.0) == volts and drive.sure == volts  # 60 may be of 100 or of 255
    assert voltage_drive(read_heading("column 1"), np.array([0.0, 100.0])).full == 100.0
    assert duty_drive(read_heading("column 1"), np.full(100, 60.0), 100.0).sure


@pytest.mark.parametrize(("top", "sure"), [(60.0, True), (61.0, False)])
def test_fractions_beyond_volts_without_a_name_drive_nothing(top: float, sure: bool) -> None:
    drive = voltage_drive(read_heading("column 1"), top * WAVE / np.max(np.abs(WAVE)))
    assert drive.sure == sure and (drive.scale == 1.0) == sure
    assert voltage_drive(read_heading("u"), 99.5 * WAVE).scale == 1.0


@pytest.mark.parametrize(("largest", "pulse"), [(1577.0, True), (999.0, False), (2501.0, False)])
def test_an_esc_gets_pulses_and_no_duty(largest: float, pulse: bool) -> None:
    """1577 µs are no share of 4095."""
    drive = duty_drive(read_heading("ESC signal"), np.array([0.0, largest]))
    assert ("ESC's pulse" in drive.why) == pulse == (not drive.sure)
    assert duty_drive(read_heading("pwm"), np.array([0.0, largest])).sure


@pytest.mark.parametrize(("least", "pulse"), [(400.0, True), (45.0, False)])
def test_what_is_shorter_than_any_pulse_is_an_escs_digital_command(least: float, pulse: bool) -> None:
    drive = duty_drive(read_heading("ESC signal"), np.array([0.0, least, 1796.0]))
    assert ("ESC's pulse in µs" in drive.why) == pulse and not drive.sure
    assert pulse or drive.why.startswith("goes from 45 to 1796, no pulse in µs but as digital commands do (of DSHOT:")


@pytest.mark.parametrize(("rows", "pulse"), [(3, True), (4, True), (6, False)])
def test_a_few_marks_of_a_lost_signal_make_no_digital_commands_of_pulses(rows: int, pulse: bool) -> None:
    values = np.concatenate([np.zeros(50), np.full(rows, 1.0), np.linspace(1000.0, 1900.0, 100 - rows)])
    drive = duty_drive(read_heading("ESC signal"), values)
    assert ("ESC's pulse in µs" in drive.why) == pulse and not drive.sure


@pytest.mark.parametrize(("largest", "pulse"), [(1994.0, True), (999.0, False), (2501.0, False)])
def test_a_servo_gets_pulses_and_no_duty_of_twelve_bits(largest: float, pulse: bool) -> None:
    drive = duty_drive(read_heading("Servo 3 (µs)"), np.array([900.0, largest]))
    assert ("is a servo's pulse in µs and no duty" in drive.why) == pulse == (not drive.sure)


@pytest.mark.parametrize(
    ("name", "values", "mains"),
    [
        ("voltage", (450.0, 450.0), True),
        ("voltage", (300.0, 450.0), True),
        ("voltage", (0.0, 450.0, 450.0), True),  # before it was on
        ("voltage", (200.0, 450.0), False),  # it swings: a duty
        ("voltage", (-450.0, 450.0), False),
        ("voltage", (255.0, 255.0), False),
        ("voltage", (1000.0, 1000.0), False),
        ("u", (450.0, 450.0), False),
    ],
)
def test_a_voltage_of_a_large_machine_is_no_duty(name: str, values: tuple[float, ...], mains: bool) -> None:
    """A data sheet's curve at 450 V was "a duty of ±1000"."""
    drive = voltage_drive(read_heading(name), np.array(values))
    assert ("which in V is more than a small motor gets (of a duty, say --full-duty)" in drive.why) is mains
    assert (drive.full is None) is mains


@pytest.mark.parametrize(("largest", "full"), [(2046.0, 4095.0), (2047.0, 2047.0), (2048.0, 4095.0)])
def test_a_timer_of_eleven_bits_is_known_where_it_is_full(largest: float, full: float) -> None:
    assert duty_drive(read_heading("PWM"), np.array([0.0, 100.0, largest])).full == full


@pytest.mark.parametrize(("name", "top", "doubted"), [("u", 1.0, True), ("u", 1.01, False), ("voltage", 1.0, False)])
def test_an_input_that_is_never_above_1_may_be_a_share(name: str, top: float, doubted: bool) -> None:
    """A duty of ±1 that was called u was read as volts, and kv was off by the whole supply."""
    drive = voltage_drive(read_heading(name), top * WAVE / np.abs(WAVE).max())
    assert drive.scale == 1.0 and ("--full-duty 1)" in drive.why) is doubted


@pytest.mark.parametrize(
    ("volts", "least_duty", "supply"),
    [
        ((12.0, 9.0), 1000.0, True),  # a pulse, which never comes near 0
        ((12.0, 9.0), 0.0, True),
        ((12.0, 5.9), 0.0, False),  # less than half is left: no supply
        ((9.0, 12.0), 0.0, False),  # it rises with the speed, as what drives does
        ((12.0, 12.0), 0.0, False),  # nothing tells
    ],
)
def test_a_supply_falls_where_the_motor_runs_faster(
    volts: tuple[float, float], least_duty: float, supply: bool
) -> None:
    share = np.repeat([0.0, 0.5, 1.0, 0.2, 0.8], 20)
    values = volts[0] + (volts[1] - volts[0]) * share
    assert sags(values, least_duty + 1000.0 * share, 300.0 * share) == supply
    assert not sags(values, np.full(100, 1500.0), 300.0 * share)  # by no duty
    assert not sags(values, least_duty + 1000.0 * share, 300.0 * share + 50.0)  # it never stands


@pytest.mark.parametrize(
    ("name", "top", "full"),
    [
        ("pwm_10bit", 640.0, 1023.0),
        ("pwm_10bit", 400.0, 1023.0),  # not of Pololu's drivers, which have no bits
        ("PWM (12 bits)", 900.0, 4095.0),
        ("duty_8bit", 200.0, 255.0),
        ("pwm_8bit", 300.0, 1000.0),  # more than it has
        ("pwm10", 256.0, 1023.0),
        ("pwm10", 1023.0, 1023.0),
        ("pwm10", 255.0, 255.0),  # a pin
        ("pwm 12", 900.0, 1000.0),
        ("pwm10_left", 900.0, 1000.0),
        ("pwm_10bit", 0.8, 1.0),
    ],
)
def test_the_bits_of_a_timer_by_a_name(name: str, top: float, full: float) -> None:
    values = np.rint(top * WAVE) if top > 1.0 else top * WAVE
    values[7] = top
    drive = duty_drive(read_heading(name), values)
    assert (drive.full, drive.sure) == (full, True)
    assert duty_drive(read_heading(name), values, 500.0).full == 500.0


@pytest.mark.parametrize(
    ("stray", "rest", "sure"),
    [
        (1902.0, 193.0, False),  # 255 but for it
        (390.0, 193.0, False),
        (380.0, 193.0, True),  # no more than twice all others: a step
        (500.0, 193.0, False),
        (1902.0, 600.0, False),
        (900.0, 300.0, True),  # 1000 either way
    ],
)
def test_one_row_decides_no_full_duty(stray: float, rest: float, sure: bool) -> None:
    """One glitch in 3112 rows made a duty of 255 one of 4095, and each voltage 16 times too small."""
    values = np.rint(rest - 40.0 * WAVE**2)
    values[50:53] = rest
    values[51] = stray
    drive = duty_drive(read_heading("pwm"), values)
    assert drive.sure is sure
    assert sure or drive.doubt == f", up to {rest:g} in all rows but one, which is {stray:g}"
    assert duty_drive(read_heading("pwm"), values, 255.0).sure
    lasting = np.append(values, np.full(3, stray))
    assert duty_drive(read_heading("pwm"), lasting).sure
