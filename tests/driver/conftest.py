"""Rigs that end with the test."""

from collections.abc import Callable, Iterator

import pytest
from driver_rig import Rig
from emulated_board import need_emulator


@pytest.fixture
def make_rig() -> Iterator[Callable[..., Rig]]:
    """Makes rigs."""
    need_emulator()
    made: list[Rig] = []

    def make(**settings: object) -> Rig:
        made.append(Rig(**settings))  # type: ignore[arg-type]
        return made[-1]

    yield make
    for rig in made:
        rig.close()


@pytest.fixture
def running(make_rig: Callable[..., Rig]) -> Rig:
    """A motor that the user drives with 6 V, at full speed."""
    rig = make_rig()
    rig.run(20)
    rig.plug()
    rig.voltage = 6.0
    rig.until(lambda: bool(rig.readings) and rig.readings[-1].sample.speed > 86.9, 900)
    return rig
