"""Each worker begins with long tests, half of them go on with what waits, and a share ends with what computes."""

import random
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from shares import LIVE, share_out


@dataclass(frozen=True)
class Item:
    nodeid: str
    long: bool = False

    def get_closest_marker(self, _name: str) -> bool:
        return self.long


def made(long: int, live: int, others: int) -> list[Any]:
    items = [Item(f"tests/model/test_long.py::test_{k}", long=True) for k in range(long)]
    items += [Item(f"{LIVE[k % len(LIVE)]}test_live.py::test_{k:03}") for k in range(live)]
    items += [Item(f"tests/model/test_short.py::test_{k:03}") for k in range(others)]
    random.Random(1).shuffle(items)
    return items


def kind(item: Any) -> str:
    return "long" if item.long else "live" if item.nodeid.startswith(LIVE) else "computes"


def test_shares_begin_with_the_longest_and_half_of_them_go_on_with_what_waits() -> None:
    items = made(6, 40, 154)
    ordered = share_out(items, 4)
    assert sorted(map(id, ordered)) == sorted(map(id, items))
    shares = [[kind(item) for item in ordered[k : k + 50]] for k in range(0, 200, 50)]
    assert shares == [
        ["long"] * 2 + ["live"] * 20 + ["computes"] * 28,
        ["long"] * 2 + ["live"] * 20 + ["computes"] * 28,
        ["long"] + ["computes"] * 49,
        ["long"] + ["computes"] * 49,
    ]


@pytest.mark.parametrize("workers", [1, 2, 3, 4, 7])
@pytest.mark.parametrize("counts", [(0, 0, 0), (1, 0, 1), (5, 9, 0), (0, 3, 2), (2, 30, 5)])
def test_every_test_is_run_once_and_neighbours_stay_together(workers: int, counts: tuple[int, int, int]) -> None:
    items = made(*counts)
    ordered = share_out(items, workers)
    assert sorted(map(id, ordered)) == sorted(map(id, items))
    live = [item for item in ordered if kind(item) == "live"]
    assert live == [item for item in items if kind(item) == "live"]  # a bench is made once for all tests of its file


def test_the_rooms_that_wait_are_there() -> None:
    assert all((Path(__file__).parents[1] / room).is_dir() for room in LIVE)
