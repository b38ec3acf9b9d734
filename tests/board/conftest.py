"""Boards that end with the test."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from board_fixtures import live  # noqa: F401  (a fixture)
from emulated_board import Bench, Client, need_emulator

from motor_board.live import LiveBoard


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
def connect(live: LiveBoard, tmp_path: Path) -> Iterator[Callable[[], Client]]:  # noqa: F811
    """Opens the live board's port."""
    clients: list[Client] = []

    def connect() -> Client:
        clients.append(Client(tmp_path / "port"))
        return clients[-1]

    yield connect
    for client in clients:
        client.close()
