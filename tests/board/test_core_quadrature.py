"""The table of transitions, on this computer: any walk of the two lines is counted, and what no motion makes is not."""

from ctypes import byref

import firmware_core as core
from hypothesis import given
from hypothesis import strategies as st

ORDER = [0, 1, 3, 2]  # levels (A is bit 0, B bit 1) as a shaft that turns forward shows them
A, B = 1, 2
walks = st.lists(st.tuples(st.integers(-1, 2), st.integers(1, 5_000)), min_size=1, max_size=60)


@given(st.integers(0, 3), walks)
def test_counts_every_step_of_any_walk(start: int, walk: list[tuple[int, int]]) -> None:
    """Steps of −1, 0, 1; 2 changes both lines: an error, after which no period reaches back."""
    timer, library = core.EdgeTimer(), core.load()
    library.quadrature_start(byref(timer), 4, ORDER[start])
    at, count, errors, time = start, 0, 0, 0
    travel: list[tuple[int, int]] = []  # time and direction of every edge since the latest error
    for step, gap in walk:
        time += gap
        before, at = ORDER[at % 4], at + step
        lines = ORDER[at % 4]
        if (before ^ lines) == A:
            library.quadrature_see_a(byref(timer), time % 65536, False, lines)
        else:
            library.quadrature_see_b(byref(timer), time % 65536, False, lines, 0)
        timer.overflows = time // 65536
        if step == 2:
            errors, travel = errors + 1, []
        elif step:
            count += step
            travel.append((time, step))
    edge = library.quadrature_at(byref(timer), time + 5_000)
    assert edge.count == count % 2**32 and timer.errors == errors and edge.valid == bool(travel)
    if travel:
        assert edge.time == travel[-1][0] and edge.reverse == (travel[-1][1] < 0)
        runs = [len(travel) > n and len({way for _, way in travel[-n - 1 :]}) == 1 for n in (4, 2, 1)]
        span = next((n for n, good in zip((4, 2, 1), runs, strict=True) if good), 0)
        expected = (travel[-1][0] - travel[-1 - span][0] + span // 2) // span if span else 0
        assert edge.period == expected


def test_where_edges_are_close_the_exact_one_is_reported_with_its_own_count() -> None:
    library = core.load()
    for gap, exact in ((500, True), (3_000, False)):
        timer = core.EdgeTimer()
        library.quadrature_start(byref(timer), 4, 0)
        library.quadrature_see_a(byref(timer), 1_000, False, A)
        library.quadrature_see_b(byref(timer), 1_000 + gap, False, A | B, 5)
        soon, later = (library.quadrature_at(byref(timer), 1_000 + gap + wait) for wait in (100, 2_500))
        assert (soon.count, soon.time) == ((1, 1_000) if exact else (2, 995 + gap))
        assert (later.count, later.time) == (2, 995 + gap)


def test_twice_counts_the_flanks_of_a_only() -> None:
    timer, library = core.EdgeTimer(), core.load()
    library.quadrature_start(byref(timer), 2, 0)
    for time, lines in enumerate((A, B, A | B, 0, A, 0), 1):  # B is what it is when A's interrupt reads it
        library.quadrature_see_a(byref(timer), 1_000 * time, False, lines)
    # rise with B low +1, fall with B high +1, rise with B high −1, fall with B low −1, and to and fro over one flank
    assert library.quadrature_at(byref(timer), 9_000).count == 0 and timer.errors == 0
