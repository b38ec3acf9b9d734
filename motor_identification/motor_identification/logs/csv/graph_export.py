"""Tables that LabVIEW exports from a graph: of each plot the times, or numbers of samples, and the values."""

import re
from dataclasses import replace

import numpy as np

from motor_identification.logs.columns.vocabulary import words_of
from motor_identification.logs.csv.table import Table

_OF_PLOT = re.compile(r"(?P<axis>[^-]+?)\s+-\s+(?P<plot>.+)$")  # Time - Speed, Amplitude - Speed
_VALUES = words_of("amplitude amplitud amplitudine ampiezza amplituda value valor wert valeur y")


def name_plots(table: Table) -> Table:
    """Name the columns of an exported graph by its plots alone, and keep times once that all of them share.

    Other tables stay as they are: every second column has to be of values, beside one of the same plot.
    """
    matches = [_OF_PLOT.match(name) for name in table.names]
    pairs = list(zip(matches[::2], matches[1::2], strict=False))
    if len(matches) % 2 or not pairs or not all(_is_pair(times, values) for times, values in pairs):
        return table
    plots = [values["plot"] for _, values in pairs if values]
    axis = matches[0]["axis"] if matches[0] else ""
    if len(set(plots)) < len(plots) or axis in plots:
        return table
    first = table.column(table.names[0])
    cells = {axis: first}
    for place, plot in enumerate(plots):
        times, values = table.names[2 * place : 2 * place + 2]
        if not np.array_equal(np.asarray(table.column(times)), np.asarray(first)):
            cells[times] = table.column(times)
        cells[plot] = table.column(values)
    return replace(table, cells=cells)


def _is_pair(times: re.Match[str] | None, values: re.Match[str] | None) -> bool:
    """Whether two names are those of one plot's axes, the second of its values."""
    if times is None or values is None:
        return False
    return times["plot"] == values["plot"] and values["axis"].lower() in _VALUES and times["axis"] != values["axis"]
