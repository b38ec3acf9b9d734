"""The steps of a first run in their order and what each of them says; the motor is driven last."""

from dataclasses import replace
from math import isnan, nan, tau

from motor_driver.check.drive import Breakaway, Pace, break_away, hold, stop_motor
from motor_driver.check.hand import Turned, judge_counts, turn_by_hand
from motor_driver.check.look import OFF, Answer, Prompt, Steps
from motor_driver.check.record import UNKNOWN, Record
from motor_driver.check.rest import ask, watch_rest
from motor_driver.check.settings import Settings
from motor_driver.frames import Hello

LITTLE = 3.0  # [V] of supply: no bridge works with less
LEAST_SUPPLY, MOST_SUPPLY = 0.8, 1.1  # of the expected one: a battery that is empty, a divider of two 5 % resistors
SUPPLY_TIME = 0.3  # [s] of which the mean is taken
MORE, APART = 0.2, 0.12  # of the motor's voltage: the quicker pace above the breakaway, and above the slower one
FOLLOWS = 1.1  # that the quicker of the two is over the slower one at least
WAYS = {Answer.YES: 1, Answer.NO: -1, Answer.DONE: 0}
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
    _judge_hand(settings, board, record, turned)
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
        record.say("supply", f"not measured by this board; {settings.supply:.3g} V are believed", UNKNOWN)
    elif supply < LITTLE:
        record.find("supply", "no_supply", **said)
    elif supply > MOST_SUPPLY * settings.supply:
        record.find("supply", "supply_too_high", **said)
    elif supply < LEAST_SUPPLY * settings.supply:
        record.find("supply", "supply_too_low", **said)
    else:
        record.say("supply", f"{supply:.1f} V measured, {settings.supply:.3g} V expected")


def _judge_hand(settings: Settings, board: Hello, record: Record, turned: Turned) -> None:
    """What the turn by hand has shown."""
    step = "encoder"
    if turned.to_and_fro and board.channels == 2:
        record.find(step, "b_missing")
    elif turned.said is Answer.DONE and not turned.alive:
        record.find(step, "a_missing")
    elif turned.said is Answer.NO:
        record.say(step, "the shaft cannot be turned by hand", UNKNOWN)
    elif turned.said is None:
        text = f"{turned.span} edges, but nobody has said when the turn was done" if turned.alive else "not tried"
        record.say(step, f"{text}; a turn by hand would tell edges per revolution and direction", UNKNOWN)
        if settings.edges(board) is None:
            record.find(step, "no_counts")
    else:
        record.measured = replace(record.measured, edges_by_hand=abs(turned.count) / settings.turns)
        wrong = judge_counts(turned, settings.turns, settings.edges(board))
        if wrong:
            record.add(step, wrong)
        else:
            record.say(step, f"{abs(turned.count)} edges by hand, {settings.edges(board)} expected in a turn")
        if board.channels == 2 and turned.way < 0:
            record.find(step, "channels_swapped")


def _drive(settings: Settings, board: Hello, record: Record, turned: Turned) -> Steps[None]:
    """Both directions: break away, and if both do, two paces each."""
    two = board.channels == 2
    forward = yield from _break_away(settings, record, 1)
    if record.codes and record.codes[-1] == "bridge_stuck_on":
        return
    backward = yield from _break_away(settings, record, -1)
    _judge_motion(settings, two, record, turned, (forward, backward))
    if forward.voltage is None or backward.voltage is None or set(record.codes) & {"b_missing", "bridge_stuck_on"}:
        return
    ahead = yield from _pace(settings, record, forward.voltage, 1)
    by_hand = turned.way if two else 0
    answer = (yield from ask(Prompt.FORWARD, settings.hand_time)) if settings.hand and not by_hand else None
    _judge_direction(two, record, by_hand, forward, answer)
    back = yield from _pace(settings, record, backward.voltage, -1)
    _judge_paces(settings, board, record, ahead, back)


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
        stall = found.current / found.voltage * settings.max_voltage
        record.measured = replace(record.measured, stall_current=stall)
    return found


def _judge_motion(
    settings: Settings, two: bool, record: Record, turned: Turned, found: tuple[Breakaway, Breakaway]
) -> None:
    """Whether it moves in both directions."""
    moved = [one.voltage is not None for one in found]
    if two and any(one.to_and_fro for one in found):
        record.find("motion", "b_missing")
    elif not any(moved):
        code = "stuck_shaft" if turned.said is Answer.NO else "no_power" if turned.alive else "no_motion"
        record.find("motion", code, highest=settings.highest)
    elif not all(moved):
        record.find("motion", "one_way", way="positive" if moved[0] else "negative")
    elif two and found[0].count * found[1].count > 0:
        record.find("motion", "same_way")
    else:
        record.say("motion", f"moves from {found[0].voltage:.2g} V on forward, {found[1].voltage:.2g} V backward")


def _judge_direction(two: bool, record: Record, by_hand: int, found: Breakaway, answer: Answer | None) -> None:
    """What is exchanged: the motor's wires, channels A and B, or both."""
    step, counted = "direction", 0 if not two else 1 if found.count > 0 else -1
    motor_forward = counted * by_hand or (WAYS[answer] if answer else 0)
    if motor_forward < 0:
        record.find(step, "motor_swapped")
    if not by_hand and counted * motor_forward < 0:
        record.find(step, "channels_swapped")
    if not motor_forward and counted < 0:
        record.find(step, "against")
    elif not motor_forward:
        text = "a positive voltage counts forward; " if two else "one channel does not tell; "
        record.say(step, f"{text}whether that is your forward, only your eye can tell", UNKNOWN)
    elif motor_forward > 0 and "channels_swapped" not in record.codes:
        record.say(step, "a positive voltage turns it forward" + (", and counts forward" if two else ""))


def _pace(settings: Settings, record: Record, breakaway: float, way: int) -> Steps[list[Pace]]:
    paces = []
    quicker = min(breakaway + MORE * settings.max_voltage, settings.highest)
    for voltage in (quicker - APART * settings.max_voltage, quicker):
        paces.append((yield from hold(way * voltage)))
    rate = yield from stop_motor()
    if rate:
        record.find("stop", "bridge_stuck_on", rate=rate)
    return paces


def _judge_paces(settings: Settings, board: Hello, record: Record, ahead: list[Pace], back: list[Pace]) -> None:
    """What a volt does, and the speed to expect at the motor's voltage."""
    step, per_volt, top = "speed", [], []
    for slow, fast in (ahead, back):
        if not slow.edges or not fast.edges or fast.voltage == slow.voltage:
            record.say(step, "too few edges, or too little voltage left, to tell", UNKNOWN)
            return
        if abs(fast.rate) < FOLLOWS * abs(slow.rate):
            said = {"low": abs(slow.voltage), "low_rate": abs(slow.rate)}
            record.find(step, "not_proportional", **said, high=abs(fast.voltage), high_rate=abs(fast.rate))
            return
        per_volt.append(abs(fast.rate - slow.rate) / abs(fast.voltage - slow.voltage))
        top.append(abs(fast.rate) + per_volt[-1] * (settings.max_voltage - abs(fast.voltage)))
    edges, rate = settings.edges(board), sum(per_volt) / 2
    record.measured = replace(record.measured, edges_per_volt=rate)
    text = f"{rate:.3g} edges a second more for a volt more"
    if edges and "wrong_counts" not in record.codes:
        slot = tau / edges
        record.measured = replace(record.measured, gain=rate * slot, top_speed=sum(top) / 2 * slot)
        text += f": about {record.measured.top_speed:.3g} rad/s at {settings.max_voltage:.3g} V"
    steady = all(pace.steady for pace in (*ahead, *back))
    record.say(step, text if steady else f"{text} (it was still getting faster, or edges were few)")
