"""What a guess says to the user, and what it has to ask."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from shlex import quote

import numpy as np

from motor_identification.logs.columns.drive import drives
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.vocabulary import MOVES, WORDS, Quantity, words_of
from motor_identification.logs.csv.table import Table
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT
from motor_identification.logs.rows.row_times import ROW_TIMES
from motor_model.errors import RecordingError

ERRORS = words_of("error errors err erro erros fehler erreur errore regelabweichung")  # of a loop: no motion
SHOWN = 12  # names in a question
GREEK = words_of("alpha beta gamma delta epsilon zeta eta theta lambda phi psi omega tau sigma")
_NUMBERS = re.compile(r"\d+")
FEWEST_ROWS = 10  # that numbers of rows are told by
LETTERS, FEWEST_OTHERS = 3, 3  # of a word, and columns: `x` and `w1` may be anything, and so may two columns


@dataclass
class Notes:
    """Lines for the user, and what he has to be asked: the column, and the question behind its name."""

    findings: list[str]
    questions: list[tuple[str, str]]


def ask_column(table: Table, what: str, option: str, names: Sequence[str]) -> RecordingError:
    """Ask for a column, by the option that says it, among some."""
    return RecordingError(f"{table.path}: which column is the {what}? Say {option} and one of {_list_names(names)}.")


def _list_names(names: Sequence[str]) -> str:
    shown = [name for name in names if name != ROW_TIMES]
    more = f" and {len(shown) - SHOWN} more" if len(shown) > SHOWN else ""
    return f"{', '.join(shown[:SHOWN])}{more}"


def ask_motion(
    table: Table, headings: Sequence[Heading], quantity: Quantity | None, found: Sequence[str]
) -> RecordingError:
    """Ask which of several motions is meant, or whether each is that of a motor of its own on the one drive."""
    driving = [one.name for one in headings if one.quantity in (Quantity.DUTY, Quantity.VOLTAGE)]
    each = ""
    if len(driving) == 1:
        said = [quote(f"{k}:{driving[0]},{name}") for k, name in enumerate(found[:2], start=1)]
        motors = " ".join(f"--motor {one}" for one in said)
        each = f" For a motor of each: {motors}{' …' if len(found) > 2 else ''}"
    if quantity is None:
        return RecordingError(f"{ask_column(table, 'motion', '--speed, --position or --count', found)}{each}")
    what, option = quantity.value, f"--{quantity.value}"
    if quantity is Quantity.COUNT and any(np.any(table.numbers(name) % 1.0) for name in found):  # none, by any name
        what, option = "motion", "--speed or --position"
    return RecordingError(f"{ask_column(table, what, option, found)}{each}")


def ask_drive(table: Table, candidates: Sequence[str]) -> RecordingError:
    """Ask for the voltage among columns whose names tell nothing, of which a log of one step has none."""
    if complaint := _refuse_other_data(table):
        return complaint
    asked = ask_column(table, "voltage or duty", "--voltage", candidates)
    if told := _find_reference(table):
        return RecordingError(
            f"{asked} {told} is what a controller was told: where what it gave to the motor is none of them, log that, "
            "too."
        )
    moves = any(read_heading(name).quantity in MOVES for name in table.names)
    motion = "" if moves else " Say which is the motion, too: --speed, --position or --count COL."
    return RecordingError(f"{asked} Where it is none of them, as in a log of one step: --constant-voltage V.{motion}")


def _refuse_other_data(table: Table) -> RecordingError | None:
    """Say that a table is no motor's log, where words stand over its columns and none of them is of a motor's."""
    headings = [read_heading(name) for name in table.names if name not in (ROW_TIMES, CONSTANT)]
    told = [one for one in headings if one.quantity is not Quantity.TIME]
    worded = [one for one in told if _says_something(one)]
    numbered = len({_NUMBERS.sub("", one.name) for one in told}) < len(told)  # CH1_Data, CH2_Data
    if (
        numbered
        or len(worded) < max(FEWEST_OTHERS, len(told))
        or any(one.quantity not in (None, Quantity.OTHER) for one in told)
    ):
        return None
    names = _list_names([one.name for one in told])
    return RecordingError(
        f"{table.path}: no motor's log by the names of its columns ({names}): none is that of a voltage or duty, a "
        "speed, a position or a count. If it is one, say which they are: --voltage COL, or --constant-voltage V for a "
        "log of one step, and --speed, --position or --count COL."
    )


def _says_something(heading: Heading) -> bool:
    """Whether a name has words: `close`, and neither `x` nor `beta` nor `data.step1.th`."""
    worded = any(len(word) >= LETTERS and word not in GREEK for word in heading.words)
    return worded and "." not in heading.name


def _find_reference(table: Table) -> str:
    """The first column that says what a controller should do; empty without one."""
    headings = (read_heading(name) for name in table.names)
    return next((one.name for one in headings if one.quantity is Quantity.REFERENCE), "")


def miss_drive(table: Table) -> RecordingError:
    """Ask for the voltage where no column can be it; a controller's log without it tells nothing of the motor."""
    if complaint := _refuse_other_data(table):
        return complaint
    if told := _find_reference(table):
        heading = read_heading(told)
        of_motion = bool(heading.unit) or any(WORDS[kind] & set(heading.words) for kind in MOVES)  # setpoint_rpm
        itself = f"where {told} itself went to it, say --voltage {quote(told)}"
        return RecordingError(
            f"{table.path}: no column is the voltage or duty. {told} is what a controller was told, and what it gave "
            "to the motor is not there: log that, too; or "
            f"{'say which column it is (--voltage COL)' if of_motion else itself}."
        )
    headings = [read_heading(name) for name in table.names if name not in (ROW_TIMES, CONSTANT)]
    able = [one.name for one in headings if one.quantity in (None, Quantity.OTHER) or drives(one)]
    if not able:
        names = ", ".join(f"{one.name} is a {one.quantity.value}" for one in headings[:SHOWN] if one.quantity)
        return RecordingError(
            f"{table.path}: no column is the voltage or duty: {names}. Log what drives the motor beside them, say "
            "which column does (--voltage COL), or --constant-voltage V for a log of one step."
        )
    return RecordingError(
        f"{table.path}: no column is the voltage or duty: say which one of {_list_names(able)} is (--voltage "
        "COL), or --constant-voltage V for a log of one step."
    )


def lack_motion(table: Table, time: str | None) -> RecordingError:
    """Ask for the motion among columns that may be it by their names, or say that none can be."""
    others = (name for name in table.names if name not in (time, ROW_TIMES, CONSTANT))
    headings = [read_heading(name) for name in others if not _numbers_rows(table, name)]
    known = {Quantity.TIME, Quantity.DUTY, Quantity.SUPPLY, Quantity.CURRENT, Quantity.REFERENCE}
    if [one.quantity for one in headings if one.quantity in (Quantity.VOLTAGE, Quantity.DUTY)] == [Quantity.VOLTAGE]:
        known.add(Quantity.VOLTAGE)  # of several drives, one in volts may be a tachogenerator's
    if open_ones := [one.name for one in headings if one.quantity not in known and not ERRORS & set(one.words)]:
        return ask_column(table, "motion", "--speed, --position or --count", open_ones)
    names = [f"{one.name} is a {one.quantity.value}" for one in headings if one.quantity]
    taken = [f"{time} the time"] if time and time != ROW_TIMES else []
    return RecordingError(
        f"{table.path}: no column is the motion ({', '.join([*names[:SHOWN], *taken])}): log the motor's speed, "
        "position or count beside them, or say which column it is (--speed, --position or --count COL)."
    )


def _numbers_rows(table: Table, name: str) -> bool:
    """Whether a column counts the rows of a table, one after the other."""
    return len(table) > FEWEST_ROWS and bool(np.all(np.diff(table.numbers(name)) == 1.0))


def miss_motion(table: Table, still: str, other: str = "") -> RecordingError:
    """Say that a column stays the same throughout, where only one other can be drive or motion, or none."""
    more = f", or {other} is its motion and the voltage is missing (--constant-voltage V)" if other else ""
    same = f"{table.numbers(still)[0]:g} in every row"
    return RecordingError(f"{table.path}: {still} is {same}: the motor never moves in it{more}.")
