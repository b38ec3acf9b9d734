"""Rows whose duty is a code: what drove the motor in them is not known."""

import numpy as np

from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import CsvForm
from motor_identification.logs.signals import Signals


def drop_coded_rows(signals: Signals, table: Table, form: CsvForm) -> tuple[Signals, list[str]]:
    """Leave out rows whose duty is one of the form's codes; what comes behind them is a run of its own."""
    coded = np.isin(table.numbers(form.voltage), form.codes)
    if not coded.any():
        return signals, []
    begins = signals.lines[1:][coded[:-1] & ~coded[1:]]
    kept = signals.only(~coded)
    parts = kept.split(np.isin(kept.lines, begins))
    names = " and ".join(f"{code:g}" for code in form.codes)
    bags = "" if len(parts.runs) == 1 else f": {len(parts.runs)} runs, a bag each"
    return parts, [
        f"Left out: {np.count_nonzero(coded)} rows where {form.voltage} is {names}, a code and no duty{bags} (assumed; "
        "otherwise: --full-duty)."
    ]
