"""Edges: what the two lines do where the shaft passes the disc's flanks, forward and back."""

import numpy as np
import pytest

from motor_board.emulation.edges import NO_EDGES, Edges, Line, edges_at_captures, edges_at_flanks, level_before

A_UP, A_DOWN, B_ALONE, B_HIGH = Line.A_STAYS, Line.A_FALLS, Line.B_ALONE, Line.B_HIGH


def cycles(count: int) -> np.ndarray:
    return np.arange(10, 10 * count + 10, 10, dtype=np.uint64)


def test_edges_are_joined_in_the_order_of_their_cycles_and_cut_from_the_front() -> None:
    first, second = Edges.alike(cycles(3), A_UP), Edges(np.array([5, 20], dtype=np.uint64), np.array([4, 4], np.uint8))
    both = first.joined(second)
    assert list(both.cycle) == [5, 10, 20, 20, 30] and list(both.what) == [4, 2, 2, 4, 2]
    assert list(both.after(3).cycle) == [20, 30] and list(both.after(3).what) == [4, 2]
    assert len(NO_EDGES.joined(first).cycle) == 3


def levels(first: int, edges: Edges) -> list[tuple[bool, bool]]:
    """A and B at power-up and after every flank, worked out line by line."""
    a, b = False, False
    seen = []
    for what in [int(level_before(first).what[0]), *map(int, edges.what)]:
        a = a if what & B_ALONE else bool(what & A_UP)
        b = bool(what & B_HIGH)
        seen.append((a, b))
    return seen


@pytest.mark.parametrize("first", range(4))
def test_one_line_changes_at_a_time_and_forward_a_leads(first: int) -> None:
    turned = levels(first, edges_at_flanks(cycles(9), np.ones(9, dtype=np.int64), first))
    assert all((a != c) + (b != d) == 1 for (a, b), (c, d) in zip(turned, turned[1:], strict=False))
    assert turned[4] == turned[0] and turned[8] == turned[0]  # one period of four flanks
    rises = [now[1] for before, now in zip(turned, turned[1:], strict=False) if now[0] > before[0]]
    assert rises and not any(rises)  # B is low where A rises


@pytest.mark.parametrize("first", range(4))
def test_turned_back_the_lines_take_the_same_levels_in_the_other_order(first: int) -> None:
    there_and_back = levels(first, edges_at_flanks(cycles(12), np.repeat([1, -1], 6), first))
    assert there_and_back == there_and_back[::-1]
    rises = [n[1] for b, n in zip(there_and_back[6:], there_and_back[7:], strict=False) if n[0] > b[0]]
    assert rises and all(rises)  # turning back, B is high where A rises


def test_where_a_rises_b_is_low_forward_and_high_backward_and_where_a_falls_the_other_way_round() -> None:
    seen = edges_at_captures(cycles(4), np.array([1, 2, -1, -2]), two=True)
    assert list(seen.what) == [A_UP, A_DOWN | B_HIGH, A_UP | B_HIGH, A_DOWN]
    assert list(edges_at_captures(cycles(2), np.array([1, -1]), two=False).what) == [0, B_HIGH]
