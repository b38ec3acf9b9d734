"""The steps of a first run in their order and what each of them says; the motor is driven last."""

from dataclasses import replace
from math import isnan, nan

from motor_driver.check.drive import Breakaway, Pace, break_away, hold, stop_motor
from motor_driver.check.hand import Turned, turn_by_hand
from motor_driver.check.judge import judge_direction, judge_hand, judge_motion, judge_paces
from motor_driver.check.look import OFF, Prompt, Steps
from motor_driver.check.record import UNKNOWN, Record
from motor_driver.check.rest import ask, watch_rest
from motor_driver.check.settings import Settings
from motor_driver.frames.from_board import Hello
from motor_model.sensing.supply import find_least_supply

LEAST_SUPPLY, MOST_SUPPLY = 0.8, 1.1  # of the expected one: a battery that is empty, a divider of two 5 % resistors
MORE_SUPPLY = ", as --max-voltage: if it is more, so is what the motor gets; say --supply-voltage"
SUPPLY_TIME = 0.3  # [s] of which the mean is taken
MORE, APART = 0.2, 0.12  # of the motor's voltage: the quicker pace above the breakaway, and above the slower one
HARMLESS = {"wrong_counts", "unknown_counts", "no_counts"}  # the motor may be driven all the same


def run_script(settings: Settings, board: Hello, record: Record) -> Steps[None]:
    """All steps; they end early where going on would be of no use, or not safe."""
    two = board.channels == 2
    yield from _measure_supply(settings, record)
    rest = yield from watch_rest(two, settings.hand, settings.hand_time)
    if rest.code:
        record.find("at rest", rest.code, rate=rest.rate)
        return
    record.say("at rest", "no edge comes while the motor is off")
    turned = Turned()
    if settings.hand:
        turned = yield from turn_by_hand(settings.hand_time)
    judge_hand(settings, board, record, turned)
    if set(record.codes) - HARMLESS - {"channels_swapped"}:
        return
    yield from _drive(settings, board, record, turned)


def _measure_supply(settings: Settings, record: Record) -> Steps[None]:
    look = yield OFF
    begun, values = look.time, [look.supply]
    while look.time - begun < SUPPLY_TIME:
        look = yield OFF
        values.append(look.supply)
    measured = [value for value in values if not isnan(value)]
    supply = sum(measured) / len(measured) if measured else nan
    record.measured = replace(record.measured, supply=supply)
    said = {"supply": supply, "expected": settings.supply}
    if isnan(supply):
        believed = f"not measured by this board; {settings.supply:.3g} V are believed"
        record.say("supply", believed + ("" if settings.supply_voltage else MORE_SUPPLY), UNKNOWN)
    elif supply < find_least_supply(settings.supply):
        record.find("supply", "no_supply", **said)
    elif supply > MOST_SUPPLY * settings.supply:
        record.find("supply", "supply_too_high", **said)
    elif supply < LEAST_SUPPLY * settings.supply:
        record.find("supply", "supply_too_low", **said)
    else:
        record.say("supply", f"{supply:.1f} V measured, {settings.supply:.3g} V expected")


def _drive(settings: Settings, board: Hello, record: Record, turned: Turned) -> Steps[None]:
    """Both directions: break away, and if both do, two paces each."""
    two = board.channels == 2
    forward = yield from _break_away(settings, record, 1)
    if record.codes and record.codes[-1] == "bridge_stuck_on":
        return
    backward = yield from _break_away(settings, record, -1)
    judge_motion(settings, two, record, turned, (forward, backward))
    if forward.voltage is None or backward.voltage is None or set(record.codes) & {"b_missing", "bridge_stuck_on"}:
        return
    ahead = yield from _pace(settings, record, forward.voltage, 1)
    by_hand = turned.way if two else 0
    answer = (yield from ask(Prompt.FORWARD, settings.hand_time)) if settings.hand and not by_hand else None
    judge_direction(two, record, by_hand, forward, answer)
    back = yield from _pace(settings, record, backward.voltage, -1)
    judge_paces(settings, board, record, ahead, back)


def _break_away(settings: Settings, record: Record, way: int) -> Steps[Breakaway]:
    found = yield from break_away(settings, way)
    rate = yield from stop_motor()
    if rate:
        record.find("stop", "bridge_stuck_on", rate=rate)
    volts = nan if found.voltage is None else found.voltage
    if way > 0:
        record.measured = replace(record.measured, breakaway_forward=volts)
    else:
        record.measured = replace(record.measured, breakaway_backward=volts)
    if found.voltage and found.current > 0.0:
        stall, before = found.current / found.voltage * settings.max_voltage, record.measured.stall_current
        stall = stall if isnan(before) else 0.5 * (stall + before)
        record.measured = replace(record.measured, stall_current=stall)
        if way < 0:
            record.say("current", f"about {stall:.2g} A if the motor were blocked at {settings.max_voltage:.3g} V")
    return found


def _pace(settings: Settings, record: Record, breakaway: float, way: int) -> Steps[list[Pace]]:
    paces = []
    quicker = min(breakaway + MORE * settings.max_voltage, settings.highest)
    for voltage in (quicker - APART * settings.max_voltage, quicker):
        paces.append((yield from hold(way * voltage)))
    rate = yield from stop_motor()
    if rate:
        record.find("stop", "bridge_stuck_on", rate=rate)
    return paces
