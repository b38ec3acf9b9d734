"""What is kept within bounds without a stop: a higher supply, a second sender, a dithering shaft, a reversal."""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
from faults_board_loop import BoardLoop
from faults_injected import block
from faults_line import Swapped
from faults_loop import Line, Loop
from faults_motor import MOTORS
from faults_supply import lose_motor_supply

from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_ros.gate import APART

MOTOR = MOTORS[2]


def limits() -> Iterable[str]:
    """One line a case."""
    yield "| case | 200 Hz | 1 kHz |"
    yield "|---|---|---|"
    for name, measure in CASES.items():
        yield f"| {name} | {measure(200.0)} | {measure(1000.0)} |"


def higher_supply(rate: float) -> str:
    """Largest voltage at the pins of a 12 V motor on a measured 24 V supply, asked for all there is."""
    loop = BoardLoop(rate, supply=24.0)
    loop.run(0.6)
    loop.raw = 0.0
    loop.run(0.05)
    loop.raw = 100.0
    loop.run(1.0)
    loop.emulator.close()
    return f"{max(abs(moment.voltage) for moment in loop.moments):.2f} V"


def second_sender(rate: float) -> str:
    """Largest change of the voltage that a second sender of another voltage makes, whose numbers are far away."""
    loop, first = Loop(MOTOR, rate), 10 * APART
    loop.raw = 6.0
    loop.run(0.5)
    begin = loop.time
    for k in range(round(rate)):
        loop.run(1.0 / rate)
        loop.gate = loop.gate.take(-6.0, 2 + round(loop.time * 1e9), "", first + k)
    during = [moment for moment in loop.moments if moment.time > begin]
    said = loop.gate.problem(1 + round(loop.time * 1e9))
    return f"{max(abs(moment.voltage - 6.0) for moment in during):.2f} V; {said}"


def reversal(model: bool):  # type: ignore[no-untyped-def]
    """A measurement of the largest voltage against the back-EMF in a reversal at 86 % of the top speed."""

    def measure(rate: float) -> str:
        loop = Loop(MOTOR, rate, model, single_channel=False)
        loop.run(0.2)
        loop.reference = 0.86 * MOTOR.top
        loop.run(2.0)
        loop.reference = -0.86 * MOTOR.top
        begin = loop.time
        loop.run(2.0)
        during = [moment for moment in loop.moments if moment.time >= begin]
        drive = max(abs(moment.voltage - MOTOR.kv * moment.speed) for moment in during)
        reached = -during[-1].speed / MOTOR.top
        return f"{drive / MOTOR.voltage:.2f} × stall current; ends at {reached:.0%} of the top speed"

    return measure


def dither(rate: float) -> str:
    """Counted and true travel of a shaft that is shaken over one flank for 20 s, two channels."""
    config = BoardConfig(sample_rate=rate, start_angle=-0.02, single_channel=False)
    board = SimulatedBoard(replace(MOTOR.parameters(), effects=(), values={"kv": MOTOR.kv, "ka": 0.0055}), config)
    half = round(0.02 * rate)
    for volts in np.tile(np.repeat([6.0, -6.0], half), round(20.0 * rate) // (2 * half)):
        sample = board.sample(float(volts))
    return f"{sample.edge_count * 2 * np.pi / 96:.2f} rad counted, {board.angle:.2f} rad true"


def no_gain(rate: float) -> str:
    """What a motor does 3 s after a reference of 0, whose `ki` was set to 0 while it ran."""
    loop = Loop(MOTOR, rate, single_channel=False)
    loop.run(0.2)
    loop.reference = 0.5 * MOTOR.top
    loop.run(1.0)
    loop.config = replace(loop.config, gains=replace(loop.config.gains, ki=0.0))
    loop.run(0.3)
    return _rest(loop)


def large_gain(rate: float) -> str:
    """What a motor does 3 s after a reference of 0 under four times the gain."""
    loop = Loop(MOTOR, rate, single_channel=False)
    gains = loop.config.gains
    loop.config = replace(loop.config, gains=replace(gains, kp=4.0 * gains.kp))
    loop.run(0.2)
    loop.reference = 0.5 * MOTOR.top
    loop.run(1.0)
    return f"{_rest(loop)}. {loop.state.latched}".strip()


def few_edges(rate: float) -> str:
    """What a motor of 6 rad/s with 24 edges a turn does 3 s after a reference of 0."""
    loop = Loop(MOTORS[0], rate, single_channel=False, edges=24)
    loop.run(0.2)
    loop.reference = 0.04 * MOTORS[0].top
    loop.run(1.5)
    return _rest(loop)


def impatience(make_line: Callable[[], Line], blocked: bool = False):  # type: ignore[no-untyped-def]
    """A measurement of what a supervisor gets that answers every stop at once: the voltage in the mean of a minute."""

    def measure(rate: float) -> str:
        loop = Loop(MOTOR, rate, single_channel=False)
        loop.run(0.2)
        loop.goes_on = 0.5 * MOTOR.top
        loop.run(1.0)
        loop.line = make_line()
        if blocked:
            block(loop)
        begin = loop.time
        loop.run(60.0)
        volts = np.array([abs(moment.voltage) for moment in loop.moments if moment.time >= begin]) / MOTOR.voltage
        second = volts[round(0.5 * volts.size) :]
        return f"{volts.mean():.1%}, in its second half {second.mean():.1%}"

    return measure


def _rest(loop: Loop) -> str:
    """Let a loop come to rest for 3 s; its true speed then."""
    loop.reference = 0.0
    loop.run(3.0)
    fast = max(abs(moment.speed) for moment in loop.moments[-round(0.5 * loop.rate) :])
    return f"{fast / loop.motor.top:.1%} of the top speed"


def loose_divider(rate: float) -> str:
    """Largest voltage at the pins of a 12 V motor on 24 V, of which a loose divider measures 3.5."""
    loop = BoardLoop(rate, supply=24.0, told=24.0)
    loop.emulator.chip.supply(5.0 * 3.5 / 60.0)
    loop.run(0.6)
    loop.raw = 0.0
    loop.run(0.05)
    loop.raw = 6.0
    loop.run(0.5)
    loop.emulator.close()
    return f"{max(abs(moment.voltage) for moment in loop.moments):.2f} V"


def supply_back(seconds: float, raw: float):  # type: ignore[no-untyped-def]
    """A measurement of what a motor does whose supply, which is not measured, was off for a while."""

    def measure(rate: float) -> str:
        loop = BoardLoop(rate)
        loop.run(0.6)
        loop.raw, loop.reference = (0.0, None) if raw else (None, 0.5 * MOTOR.top)
        loop.run(0.05)
        loop.raw = raw * MOTOR.voltage if raw else None
        loop.run(1.5)
        lose_motor_supply(loop, seconds)
        begin = loop.time
        loop.run(2.0)
        loop.emulator.close()
        during = [moment for moment in loop.moments if moment.time >= begin]
        most = max(abs(moment.speed) for moment in during)
        return f"{most / MOTOR.top:.0%} of the top speed, at the end {during[-1].speed / MOTOR.top:.0%}"

    return measure


CASES = {
    "12 V motor on a 24 V supply, 100 V asked for: largest voltage": higher_supply,
    "the same on 24 V that supply_voltage says, 6 V asked for, a loose divider that reads 3.5 V": loose_divider,
    "two channels, `ki` set to 0 in a running loop, then a reference of 0: 3 s later": no_gain,
    "two channels, four times the gain `kp`, measured, then a reference of 0: 3 s later": large_gain,
    "two channels, 24 edges a turn, 6 rad/s, 4 % of it, then a reference of 0: 3 s later": few_edges,
    "second sender of −6 V beside one of 6 V: change of the voltage": second_sender,
    "two channels exchanged, every stop answered by 0 and a reference: voltage in the mean of a minute": impatience(
        Swapped
    ),
    "the same, shaft blocked": impatience(lambda: lambda sample: sample, blocked=True),
    "reversal from +86 % to −86 % of the top speed, measured speed": reversal(False),
    "the same with a model": reversal(True),
    "motor's supply off for 0.1 s at half of the top speed: largest speed when it is back": supply_back(0.1, 0.0),
    "the same for 0.5 s, plain voltage of 60 %": supply_back(0.5, 0.6),
    "the same for 3 s, plain voltage of 30 %, supply not measured": supply_back(3.0, 0.3),
    "shaft shaken over one flank for 20 s, two channels": dither,
}
