"""Lines between rows of numbers that are none: comments, names of columns, what a board says as it starts again."""

from collections.abc import Iterable, Iterator, Sequence

from motor_identification.logs.csv.cells import COMMENT, is_number
from motor_identification.logs.csv.sparse import NO_VALUE

Row = tuple[int, list[str]]  # its line, and its cells


def drop_words(rows: Iterable[Row], comma: bool, dropped: list[int]) -> Iterator[Row]:
    """Drop rows without a number; their lines are added to `dropped`."""
    for line, row in rows:
        if COMMENT.match(row[0]) or not any(is_number(cell, comma) for cell in row):
            dropped.append(line)
        else:
            yield line, row


def drop_sentences(rows: Iterable[Row], width: int, comma: bool, dropped: list[int]) -> Iterator[Row]:
    """Drop rows that are at least half words, and have other cells than columns, in a table that begins without words.

    Their lines are added to `dropped`. A garbled row has as many cells as the others, and keeps its place.
    """
    of_numbers: bool | None = None
    for line, row in rows:
        words, numbers = _count(row, comma)
        of_numbers = words == 0 if of_numbers is None else of_numbers
        if of_numbers and len(row) != width and words >= numbers > 0 and not COMMENT.match(row[0]):
            dropped.append(line)
        else:
            yield line, row


def _count(row: Sequence[str], comma: bool) -> tuple[int, int]:
    """How many words and how many numbers there are in a row."""
    numbers = sum(is_number(cell, comma) for cell in row)
    return len(row) - numbers - sum(cell in NO_VALUE for cell in row), numbers
