"""Firmware, chip and motor in lockstep: the same run however it is cut, and the encoder's faults."""

from collections.abc import Iterator

import pytest
from emulated_board import MS, Bench, need_emulator

from motor_driver.frames.from_board import Hello, Telemetry


@pytest.fixture
def board() -> Iterator[Bench]:
    need_emulator()
    bench = Bench()
    bench.start()
    yield bench
    bench.close()


def counted(board: Bench, milliseconds: int) -> int:
    """Edges that the firmware counts at half the voltage."""
    first = board.last(Telemetry).edge_count
    board.drive(128, milliseconds)
    return board.last(Telemetry).edge_count - first


def test_a_run_is_the_same_however_it_is_cut() -> None:
    need_emulator()
    said = []
    for step in (0.25, 1.0, 7.0):
        bench = Bench()
        bench.start()
        begin = bench.chip.cycle
        while bench.chip.cycle < begin + 140 * MS:
            bench.emulator.run(round(min(bench.chip.cycle + step * MS, begin + 140 * MS)))
        bench.run(1)
        said.append([(frame.time, frame.edge_count, frame.flags) for frame in bench.all(Telemetry)])
        bench.close()
    assert len(said[0]) > 20 and said[0] == said[1] == said[2]


def test_it_stops_within_an_instruction_of_where_it_was_told_to(board: Bench) -> None:
    goal = board.chip.cycle + 12_345
    board.emulator.run(goal)
    assert goal <= board.chip.cycle <= goal + 5


def test_without_its_cable_the_encoder_counts_nothing_and_the_motor_turns_on(board: Bench) -> None:
    board.drive(128, 100)
    board.events.clear()
    board.drive(128, 20)
    assert counted(board, 200) > 100
    board.emulator.encoder_connected = False
    board.drive(128, 20)
    assert counted(board, 200) == 0 and board.emulator.shaft.speed > 50.0


def test_a_line_that_picks_up_noise_counts_what_no_flank_has_made(board: Bench) -> None:
    board.emulator.encoder_connected = False
    board.emulator.stray_edges = 500.0
    board.run(20)
    assert 60 < counted(board, 200) < 150  # 100 ± 10


def test_the_reset_button_lets_go_of_the_motor(board: Bench) -> None:
    board.drive(128, 50)
    boot = board.last(Telemetry).boot
    assert board.emulator.shaft.voltage == pytest.approx(6.0)
    board.emulator.reset()
    assert board.emulator.shaft.voltage == 0.0
    board.run_until(lambda: bool(board.all(Hello)), 100)
    assert board.last(Hello).boot != boot
