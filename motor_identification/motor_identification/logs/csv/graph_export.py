"""Tables that LabVIEW and others export from a graph: of each plot times, or numbers of samples, and values."""

import re
from dataclasses import replace

import numpy as np

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.vocabulary import Quantity, words_of
from motor_identification.logs.csv.table import Table

_OF_PLOT = re.compile(r"(?P<axis>[^-]*?)\s*(?<!\S)-\s+(?P<plot>.+)$")  # Time - Speed, Amplitude - Speed, - Speed
_VALUES = words_of("amplitude amplitud amplitudine ampiezza amplituda value valor wert valeur y")


def name_plots(table: Table) -> Table:
    """Name the columns of an exported graph by its plots alone, and keep times once that all of them share.

    Other tables stay as they are: every second column has to be of values, beside one of the same plot.
    """
    matches = [_OF_PLOT.match(name) for name in table.names]
    pairs = list(zip(matches[::2], matches[1::2], strict=False))
    axes = {(times["axis"], values["axis"]) for times, values in pairs if times and values}
    # Of one graph: every value's axis has the same name, such as that of the first plot, or none.
    alike = len(axes) == 1 and len(pairs) > 1 and all(read_heading(one).quantity is Quantity.TIME for one, _ in axes)
    if len(matches) % 2 or not pairs or not all(_is_pair(times, values, alike) for times, values in pairs):
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


def _is_pair(times: re.Match[str] | None, values: re.Match[str] | None, alike: bool) -> bool:
    """Whether two names are those of one plot's axes, the second of its values; alike: all plots have the same two."""
    if times is None or values is None or times["axis"] in ("", values["axis"]):
        return False
    return times["plot"] == values["plot"] and (alike or values["axis"].lower() in _VALUES)
