"""What a guess says to the user, and what it has to ask."""

from dataclasses import dataclass


@dataclass
class Notes:
    """Lines for the user, and what he has to be asked: the column, and the question behind its name."""

    findings: list[str]
    questions: list[tuple[str, str]]
