"""Driver and check joined, on the real firmware: the pins follow, and are off whenever the run is."""

import re
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from emulated_board import need_emulator
from first_run_bench import EmulatedRun, motor

from motor_board.build import FirmwareConfig
from motor_board.emulation.wiring import Wiring
from motor_driver.check.look import Prompt
from motor_driver.check.settings import Settings
from motor_driver.check.words import board_row, line_of, plan_of, prompt_of, verdict_of

README = Path(__file__).resolve().parents[3] / "motor_driver" / "README.md"
NUMBER = re.compile(r"\d+(?:\.\d+)?")
TOLD = Settings(edges_per_revolution=96)
BOARD = FirmwareConfig(channels=2, supply_full_scale=60_000, board_id=7)


def test_a_whole_run_on_the_firmware() -> None:
    need_emulator()
    bench = EmulatedRun(TOLD, wiring=Wiring(motor_swapped=True), config=BOARD, seed=2)
    run = bench.run()
    assert run.check is not None and run.check.record.codes == ["motor_swapped"] and run.check.right
    assert run.check.record.measured.gain == pytest.approx(bench.parameters.gain, rel=0.04)
    assert run.off and bench.pins[-1][1] == 0.0
    assert max(abs(volts) for _, volts in bench.pins) <= 6.0
    asked = [volts for _, volts in bench.asked]
    late = [abs(volts) for k, (_, volts) in enumerate(bench.pins) if k > 20 and not any(asked[k - 20 : k])]
    assert max(late) == 0.0  # 20 ms after it asks for nothing, nothing is there
    shown = README.read_text(encoding="utf-8").splitlines()
    rows = [line_of(row) for row in (board_row(run.check.board, "/dev/ttyUSB0"), *run.check.record.rows)]
    prompts = [prompt_of(prompt, TOLD) for prompt in (Prompt.HANDS_OFF, Prompt.TURN)]
    for line in (plan_of(TOLD), *rows, *prompts, verdict_of(run.check)):  # what a person sees is what the README shows
        assert NUMBER.sub("#", line) in [NUMBER.sub("#", one) for one in shown], line


@pytest.mark.parametrize(
    ("settings", "code", "said"),
    [
        (Settings(board_id=9), "wrong_board", "This is the board number 7, and the parameter board_id is 9"),
        (Settings(single_channel=True), "wrong_firmware", "reads 2 encoder channel(s)"),
    ],
)
def test_another_board_than_the_one_that_was_meant_is_not_touched(settings: Settings, code: str, said: str) -> None:
    need_emulator()
    bench = EmulatedRun(settings, config=BOARD)
    run = bench.run()
    assert run.check is None and run.code == code and said in run.problem(10**12)
    assert not any(volts for _, volts in bench.pins)


@pytest.mark.parametrize(
    "when", ["before the board answers", "while it waits for a turn by hand", "while the motor runs"]
)
def test_a_terminal_that_ends_is_no_answer(when: str) -> None:
    """Ctrl-D, or input from a file: as an empty line it would say that the turn is done."""
    need_emulator()
    bench = EmulatedRun(TOLD, config=BOARD)
    if when == "before the board answers":
        bench.run_.hear("")
    elif when == "while the motor runs":
        while not any(volts for _, volts in bench.pins[-1:]):
            bench._step()
    else:
        bench.person.said, bench.person.prompt = True, Prompt.TURN  # nobody turns
        while bench.run_.prompt is not Prompt.TURN:
            bench._step()
    driven = len(bench.pins)
    bench.run_.hear("")
    run = bench.run()
    assert run.check is not None and not run.check.right and run.off
    assert run.check.record.rows[-1].text.startswith("The check has stopped the motor: the terminal was closed.")
    assert not any(volts for _, volts in bench.pins[driven + 10 :])  # a sample of 5 ms, and its frame
    assert (when == "while the motor runs") == any(volts for _, volts in bench.pins)


def test_a_line_that_falls_silent_stops_it() -> None:
    need_emulator()
    bench = EmulatedRun(Settings(edges_per_revolution=96, hand=False), config=BOARD)
    while not any(volts for _, volts in bench.pins[-1:]):
        bench._step()
    bench.run_.received = lambda data, now: None  # type: ignore[method-assign]
    run = bench.run()
    assert run.check is not None and "no telemetry from the port for 120 ms" in run.check.record.rows[-1].text
    assert bench.pins[-1][1] == 0.0


def test_a_line_that_is_silent_for_a_while_with_the_motor_off_is_waited_for_and_no_longer() -> None:
    need_emulator()
    bench = EmulatedRun(Settings(edges_per_revolution=96, hand=False), config=BOARD)
    while bench.run_.check is None:
        bench._step()
    hear = bench.run_.received
    bench.run_.received = lambda data, now: None  # type: ignore[method-assign]
    for _ in range(500):
        bench._step()
    assert not bench.run_.done
    bench.run_.received = hear  # type: ignore[method-assign]
    for _ in range(500):
        bench._step()
    assert not bench.run_.done and not any(volts for _, volts in bench.pins)
    bench.run_.received = lambda data, now: None  # type: ignore[method-assign]
    run = bench.run(10.0)
    assert run.check is not None and "no telemetry comes from the port any more" in run.check.record.rows[-1].text


def test_a_geared_encoder_of_two_channels_is_counted_at_its_output() -> None:
    need_emulator()
    said = Settings(edges_per_revolution=11, quadrature=4, gear=Fraction("34.014"))
    bench = EmulatedRun(said, motor(12.0, 12.0, 0.1), config=BOARD, edges=11, gear=34.014)
    run = bench.run()
    assert run.check is not None and run.check.record.codes == []
    assert run.check.record.measured.top_speed == pytest.approx(12.0, rel=0.03)
    assert run.check.record.measured.edges_by_hand == pytest.approx(374.2, abs=4.0)


def test_a_current_sensor_tells_the_stall_current_before_anything_stalls() -> None:
    need_emulator()
    true = replace(motor(friction=0.08), resistance=2.0)
    said = Settings(edges_per_revolution=96, current_gain=0.185)
    bench = EmulatedRun(said, true, config=replace(BOARD, current_sense=True), seed=1)
    run = bench.run()
    assert run.check is not None and run.check.record.codes == []
    assert run.check.record.measured.stall_current == pytest.approx(6.0, rel=0.1)  # 12 V over 2 ohm; a step is 26 mA
