"""What a first run has found so far, and its result."""

from dataclasses import dataclass, field, replace
from math import nan

from motor_driver.check.findings import Finding, finding
from motor_driver.check.pins import name_pins
from motor_driver.frames.codes import Board

OK, WRONG, CURED, UNKNOWN = "ok", "wrong", "cured", "not known"


@dataclass(frozen=True)
class Row:
    """One line of what a person reads."""

    step: str
    mark: str  # OK | WRONG | CURED | UNKNOWN
    text: str


@dataclass(frozen=True)
class Measured:
    """What was measured; NaN where it was not."""

    supply: float = nan  # [V]
    edges_by_hand: float = nan  # in a turn
    breakaway_forward: float = nan  # [V]
    breakaway_backward: float = nan  # [V], a positive number
    edges_per_volt: float = nan  # [1/s/V] more edges a second for a volt more
    gain: float = nan  # [rad/s/V] the same of the encoder's shaft
    top_speed: float = nan  # [rad/s] expected at the motor's voltage
    stall_current: float = nan  # [A] expected at the motor's voltage


@dataclass
class Record:
    """Written as the run goes on."""

    board: int = Board.ATMEGA328P  # whose pins are named
    rows: list[Row] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    measured: Measured = Measured()

    def say(self, step: str, text: str, mark: str = OK) -> None:
        """A step has ended, well or without an answer."""
        self.rows.append(Row(step, mark, text))

    def find(self, step: str, code: str, **values: object) -> None:
        """Something is wrong."""
        self.add(step, finding(code, **values))

    def add(self, step: str, found: Finding) -> None:
        """Something is wrong; each thing once."""
        if found.code not in self.codes:
            sentence, cure = name_pins(found.sentence, self.board), name_pins(found.cure, self.board)
            found = replace(found, sentence=sentence, cure=cure)
            self.findings.append(found)
            self.rows.append(Row(step, CURED if found.cured else WRONG, f"{found.sentence} {found.cure}"))

    @property
    def codes(self) -> list[str]:
        """Of the findings."""
        return [found.code for found in self.findings]

    @property
    def wrong(self) -> bool:
        """Whether there is something that software does not make up for."""
        return any(not found.cured for found in self.findings)
