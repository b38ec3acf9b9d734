"""What is wired wrong reaches the real firmware as it would from a real motor."""

from collections.abc import Iterator

import pytest
from emulated_board import Bench, need_emulator

from motor_board.build import FirmwareConfig
from motor_board.emulation.wiring import Wiring
from motor_driver.frames.from_board import Telemetry


@pytest.fixture
def board() -> Iterator[Bench]:
    """Two channels, and a supply that is measured: 12 V of 60."""
    need_emulator()
    bench = Bench(config=FirmwareConfig(channels=2, supply_full_scale=60_000))
    bench.emulator.supply(1.0)
    bench.start()
    yield bench
    bench.close()


def counted(board: Bench, duty: int = 64, milliseconds: int = 200) -> int:
    """Edges, with their sign, at a quarter of the voltage."""
    board.drive(duty, 100)
    first = board.last(Telemetry).edge_count
    board.drive(duty, milliseconds)
    return (board.last(Telemetry).edge_count - first + 2**31) % 2**32 - 2**31


def test_as_it_stands_it_counts_forward_and_measures_the_supply(board: Bench) -> None:
    assert counted(board) > 50
    assert 11_900 < board.last(Telemetry).supply <= 12_000


@pytest.mark.parametrize(
    "wiring",
    [
        Wiring(motor_swapped=True),
        Wiring(channels_swapped=True),
    ],
)
def test_what_is_swapped_counts_backward(board: Bench, wiring: Wiring) -> None:
    board.emulator.wiring = wiring
    assert counted(board) < -50
    assert (board.emulator.shaft.speed > 0.0) == wiring.channels_swapped


def test_swapped_twice_it_counts_forward(board: Bench) -> None:
    board.emulator.wiring = Wiring(motor_swapped=True, channels_swapped=True)
    assert counted(board) > 50 and board.emulator.shaft.speed < 0.0


def test_without_a_nothing_is_counted_and_without_b_only_to_and_fro(board: Bench) -> None:
    for wiring in (Wiring(a_connected=False), Wiring(b_connected=False)):
        board.emulator.wiring = wiring
        assert abs(counted(board)) <= 1 and board.emulator.shaft.speed > 40.0


def test_a_supply_that_is_off_drives_nothing_and_measures_nothing(board: Bench) -> None:
    board.emulator.wiring = Wiring(powered=False)
    assert counted(board) == 0 and board.last(Telemetry).supply == 0


def test_a_stuck_bridge_turns_at_duty_zero_and_a_stuck_shaft_never(board: Bench) -> None:
    board.emulator.wiring = Wiring(bridge_stuck=0.5)
    assert counted(board, duty=0) > 100
    board.emulator.wiring = Wiring(shaft_stuck=True, hand=50.0)
    assert counted(board, duty=255) == 0
    board.emulator.wiring = Wiring(hand=3.0)
    assert counted(board, duty=0) > 50  # let go again, by hand


def test_hum_of_the_mains_is_edges_at_its_frequency() -> None:
    need_emulator()
    bench = Bench()
    bench.emulator.wiring = Wiring(hum=50.0)
    bench.start()
    assert 24 <= counted(bench, duty=0, milliseconds=500) <= 26
    bench.close()
