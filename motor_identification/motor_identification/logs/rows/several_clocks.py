"""Vectors of several lengths as the rows of one table: those that are asked for, or that have times of their own."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.second_reading import ends_of_a_loop
from motor_identification.logs.columns.clock import runs_forward
from motor_identification.logs.columns.drive import drives
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.vocabulary import MOVES, Quantity

Floats = NDArray[np.float64]

SIGNALS = 3  # time, voltage and motion: vectors of one length, of which more tell nothing
SAME_SPAN = 0.1  # of the longer one's duration, by which clocks of one experiment may begin or end apart
SAME_INSTANT = 1e-3  # of the shortest step between rows


def choose_columns(groups: Mapping[int, Mapping[str, Floats]], wanted: Collection[str]) -> dict[str, Floats]:
    """Choose the columns of a log among vectors of several lengths.

    Those that the user named come first; then those whose names tell a drive and a motion; then the longest of which
    there are three. Where no length has both a drive and a motion, two that have clocks of their own are joined.

    Args:
        groups: for each length, the vectors that have it, by name; one at least.
        wanted: names that the user said.
    """
    sizes = {n: (tell_a_motor([*group]), min(len(group), SIGNALS), n) for n, group in groups.items()}
    length = max(groups, key=lambda n: (sum(name in wanted for name in groups[n]), *sizes[n]))
    chosen = dict(groups[length])
    if sizes[length][0]:
        return chosen
    others = (groups[n] for n in sorted(groups, reverse=True) if n != length)
    return next(filter(None, (_join(chosen, other) for other in others)), chosen)


def tell_a_motor(names: Sequence[str]) -> bool:
    """Whether there is a drive among the names, and a motion."""
    headings = [read_heading(name) for name in names]
    return any(map(drives, headings)) and any(heading.quantity in MOVES for heading in headings)


def _join(these: Mapping[str, Floats], those: Mapping[str, Floats]) -> dict[str, Floats]:
    """Columns of two clocks, by the times of either; empty where they have none, or tell no motor together.

    A row has the values of those whose time it is, and nan for the others, as where several senders speak.
    """
    clocks = [_find_clock(these), _find_clock(those)]
    if not all(clocks) or not _are_halves(these, those):
        return {}
    times: list[Floats] = [columns[clock] for columns, clock in zip((these, those), clocks, strict=True)]
    spans = [float(np.ptp(time)) for time in times]
    apart = max(abs(times[0][0] - times[1][0]), abs(times[0][-1] - times[1][-1]))
    if apart > SAME_SPAN * max(spans):
        return {}
    every, rows = _merge(times)
    joined = {"time": every}
    for columns, clock, place in zip((these, those), clocks, rows, strict=True):
        for name, values in columns.items():
            if name != clock:
                joined[name] = np.full(len(every), np.nan)
                joined[name][place] = values
    return joined


def _are_halves(these: Mapping[str, Floats], those: Mapping[str, Floats]) -> bool:
    """Whether two sets of columns are a motor's together: one has the drive alone, and the other the motion."""
    named = [read_heading(name) for name in (*these, *those)]
    read = {one.name: one for one in ends_of_a_loop(named)}
    outputs = {one.name for one in named if drives(one) and not drives(read[one.name])}
    driven, moved = (
        [any(tells(read[name]) for name in columns) for columns in (these, those)]
        for tells in (drives, lambda one: one.quantity in MOVES or one.name in outputs)
    )
    return driven == [not one for one in moved] and any(driven) and any(moved)


def _find_clock(columns: Mapping[str, Any]) -> str:
    """The column of times; empty where there is none that goes on."""
    times = (name for name in columns if read_heading(name).quantity is Quantity.TIME)
    return next((name for name in times if runs_forward(columns[name])), "")


def _merge(times: Sequence[Floats]) -> tuple[Floats, list[NDArray[np.int64]]]:
    """All times of two clocks, of which those at one instant are one, and the rows where each clock's are."""
    shortest = min(float(np.min(np.diff(np.unique(time)), initial=np.inf)) for time in times)
    grid = SAME_INSTANT * shortest
    ticks = [np.round((time - times[0][0]) / grid) for time in times]
    every = np.unique(np.concatenate(ticks))
    return every * grid + times[0][0], [np.searchsorted(every, one) for one in ticks]
