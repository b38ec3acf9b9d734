"""Boards that end with the test."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from board.bench import Bench, Client, need_emulator

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulator import Emulator
from motor_board.live import LiveBoard
from motor_board.port import Port
from motor_board.shaft import EncoderConfig
from motor_model.parameters import paper_motor


@pytest.fixture
def make_bench() -> Iterator[Callable[..., Bench]]:
    """Makes boards in lockstep."""
    need_emulator()
    made: list[Bench] = []

    def make(**settings: object) -> Bench:
        made.append(Bench(**settings))  # type: ignore[arg-type]
        return made[-1]

    yield make
    for bench in made:
        bench.close()


@pytest.fixture
def bench(make_bench: Callable[..., Bench]) -> Bench:
    return make_bench()


@pytest.fixture
def live(tmp_path: Path) -> Iterator[LiveBoard]:
    """A board in real time behind tmp_path/port."""
    need_emulator()
    elf = firmware(FirmwareConfig(edges_per_revolution=96))
    board = LiveBoard(Emulator(elf, paper_motor(), EncoderConfig(seed=3)), Port(tmp_path / "port"))
    yield board
    board.close()
    assert board.error is None


@pytest.fixture
def connect(live: LiveBoard, tmp_path: Path) -> Iterator[Callable[[], Client]]:
    """Opens the live board's port."""
    clients: list[Client] = []

    def connect() -> Client:
        clients.append(Client(tmp_path / "port"))
        return clients[-1]

    yield connect
    for client in clients:
        client.close()
