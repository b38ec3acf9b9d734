"""Boards that end with the test."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from board_fixtures import live  # noqa: F401  (a fixture)
from emulated_board import Bench, Client, need_emulator

from motor_board.build import FirmwareConfig
from motor_board.emulation.live import LiveBoard


@pytest.fixture
def chip() -> str:
    """What boards are built for, unless a test is `on_each_chip`."""
    return "atmega328p"


@pytest.fixture
def make_bench(chip: str) -> Iterator[Callable[..., Bench]]:
    """Makes boards in lockstep."""
    need_emulator()
    made: list[Bench] = []

    def make(config: FirmwareConfig | None = None, **settings: object) -> Bench:
        made.append(Bench(config=replace(config or FirmwareConfig(), chip=chip), **settings))  # type: ignore[arg-type]
        return made[-1]

    yield make
    for bench in made:
        bench.close()


@pytest.fixture
def bench(make_bench: Callable[..., Bench]) -> Bench:
    return make_bench()


@pytest.fixture
def connect(live: LiveBoard, tmp_path: Path) -> Iterator[Callable[[], Client]]:  # noqa: F811
    """Opens the live board's port."""
    clients: list[Client] = []

    def connect() -> Client:
        clients.append(Client(tmp_path / "port"))
        return clients[-1]

    yield connect
    for client in clients:
        client.close()
