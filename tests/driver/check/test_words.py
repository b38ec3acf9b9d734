"""What a person reads: what will happen with its voltages, what he is asked, one line a step, the verdict."""

from dataclasses import replace

import pytest
from first_run_bench import SimulatedRun, hello

from motor_board.emulation.wiring import Wiring
from motor_driver.check.look import Prompt
from motor_driver.check.settings import Settings
from motor_driver.check.words import board_row, line_of, plan_of, prompt_of, verdict_of

TOLD = Settings(edges_per_revolution=96)


def test_the_voltage_is_said_before_it_is_given() -> None:
    assert "at 6 V at most" in plan_of(TOLD)


@pytest.mark.parametrize("prompt", Prompt)
def test_every_prompt_says_what_to_do(prompt: Prompt) -> None:
    said = prompt_of(prompt, Settings(turns=10, hand_time=20.0))
    assert said.endswith(".") and ("Enter" in said or prompt is Prompt.HANDS_OFF)
    if prompt is Prompt.TURN:
        assert "10 turns" in said and "(20 s)" in said


def test_the_board_and_a_step_are_a_line_each() -> None:
    line = line_of(board_row(hello(2, board_id=7), "/dev/ttyUSB0"))
    assert line == "board      ok     firmware 1.2.0 on an ATmega328P at /dev/ttyUSB0, board_id 7, two channels"
    assert "no board_id, one channel" in board_row(hello(), "x").text


def test_the_verdict_is_right_cured_or_not() -> None:
    assert verdict_of(SimulatedRun(TOLD, supply=12.0).run()) == "All is right."
    assert verdict_of(SimulatedRun(TOLD).run()) == "All is right, as far as it was checked (not: supply)."
    alone = verdict_of(SimulatedRun(replace(TOLD, hand=False), supply=12.0).run())
    assert alone == "All is right, as far as it was checked (not: encoder, direction)."
    assert "make up for" in verdict_of(SimulatedRun(TOLD, wiring=Wiring(motor_swapped=True)).run())
    assert "no parameter file" in verdict_of(SimulatedRun(TOLD, wiring=Wiring(a_connected=False)).run())
