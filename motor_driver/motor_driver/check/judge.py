"""What the steps of a first run have shown, in words and findings."""

from dataclasses import replace

from motor_driver.check.drive import Breakaway, Pace
from motor_driver.check.hand import Turned, judge_counts
from motor_driver.check.look import Answer
from motor_driver.check.record import UNKNOWN, Record
from motor_driver.check.settings import Settings
from motor_driver.frames.from_board import Hello

FOLLOWS = 1.1  # that the quicker of two paces is over the slower one at least
WAYS = {Answer.YES: 1, Answer.NO: -1, Answer.DONE: 0}
MOST_COUNTS = 20_000.0  # [1/s] likewise, two- and fourfold
MOST_EDGES = {1: 20_000.0, 2: 10_000.0}  # [1/s] that the board counts for certain, by its encoder's channels


def judge_hand(settings: Settings, board: Hello, record: Record, turned: Turned) -> None:
    """Judge what the turn by hand has shown."""
    step = "encoder"
    if turned.to_and_fro and board.channels == 2:
        record.find(step, "b_missing")
    elif turned.said is Answer.DONE and not turned.alive:
        record.find(step, "a_missing")
    elif turned.said is Answer.NO:
        record.say(step, "the shaft cannot be turned by hand", UNKNOWN)
    elif turned.said is None and settings.hand:
        record.find(step, "nobody_answered")
    elif turned.said is None:
        record.say(step, "not tried; a turn by hand would tell edges per revolution and direction", UNKNOWN)
        if settings.edges(board) is None:
            record.find(step, "no_counts")
    else:
        record.measured = replace(record.measured, edges_by_hand=abs(turned.count) / settings.turns)
        wrong = judge_counts(turned, settings.turns, settings.edges(board), float(settings.gear))
        if wrong:
            record.add(step, wrong)
        else:
            expected = f"{settings.edges_of_output(board):.0f} expected in a turn"
            record.say(step, f"{abs(turned.count)} edges by hand, {expected}")
        if board.channels == 2 and turned.way < 0:
            record.find(step, "channels_swapped")


def judge_motion(
    settings: Settings, two: bool, record: Record, turned: Turned, found: tuple[Breakaway, Breakaway]
) -> None:
    """Judge whether it moves in both directions."""
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


def judge_direction(two: bool, record: Record, by_hand: int, found: Breakaway, answer: Answer | None) -> None:
    """Judge what is exchanged: the motor's wires, channels A and B, or both."""
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


def judge_paces(settings: Settings, board: Hello, record: Record, ahead: list[Pace], back: list[Pace]) -> None:
    """Judge what a volt does, and the speed to expect at the motor's voltage."""
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
    slot, rate = settings.slot(board), sum(per_volt) / 2
    record.measured = replace(record.measured, edges_per_volt=rate)
    text = f"{_shown(rate)} edges a second more for a volt more"
    if slot and "wrong_counts" not in record.codes:
        record.measured = replace(record.measured, gain=rate * slot, top_speed=sum(top) / 2 * slot)
        text += f": about {_shown(record.measured.top_speed)} rad/s at {settings.max_voltage:.3g} V"
    most = MOST_EDGES[board.channels] if settings.quadrature == 1 else MOST_COUNTS / settings.quadrature
    if sum(top) / 2 > most:
        record.find(step, "too_many_edges", voltage=settings.max_voltage, rate=sum(top) / 2, most=most)
    steady = all(pace.steady for pace in (*ahead, *back))
    record.say(step, text if steady else f"{text} (it was still getting faster, or edges were few)")


def _shown(value: float) -> str:
    """Three digits, without an exponent."""
    return f"{float(f'{value:.3g}'):g}"
