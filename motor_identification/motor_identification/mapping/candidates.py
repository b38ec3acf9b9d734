"""Which field drives a motor and which is its motion: by names, and by what predicts what."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.motion.movement import guess_kind
from motor_identification.logs.columns.vocabulary import MOVES, Quantity
from motor_identification.logs.form import Kind
from motor_identification.logs.signals import Floats
from motor_identification.mapping.inventory import Field
from motor_identification.mapping.mapping import Mapping, Origin

LEAST_ROWS = 30  # fewer tell no prediction
FOLLOWS = 0.1  # share of what is unpredictable from the motion itself that the drive predicts: below, it does not
NAMED = 0.3  # what a telling name is worth beside that share
MOST_FIELDS = 40  # of a bag, each tried with each
_DRIVES = frozenset({Quantity.VOLTAGE, Quantity.DUTY})
_KINDS = {Quantity.SPEED: Kind.SPEED, Quantity.POSITION: Kind.POSITION, Quantity.COUNT: Kind.COUNT}


@dataclass(frozen=True)
class Candidate:
    """A field that drives and one that moves with it."""

    drive: Field
    motion: Field
    kind: Kind
    share: float  # of the motion's changes that nothing but the drive predicts

    def mapping(self) -> Mapping:
        """The mapping that this is, as far as it is known."""
        return Mapping(Origin(self.drive.path), Origin(self.motion.path), self.kind)


def find_candidates(fields: Sequence[Field]) -> list[Candidate]:
    """Find pairs of fields of which one drives the other, the likeliest first."""
    found = []
    for drive in fields[:MOST_FIELDS]:
        if quantity_of(drive) in (*MOVES, Quantity.REFERENCE, Quantity.SUPPLY, Quantity.TIME, Quantity.CURRENT):
            continue
        for motion in fields[:MOST_FIELDS]:
            if motion.path == drive.path or quantity_of(motion) not in (*MOVES, None):
                continue
            pair = _try(drive, motion)
            if pair is not None and pair.share > FOLLOWS:
                found.append(pair)
    return sorted(found, key=_rank, reverse=True)


def quantity_of(field: Field) -> Quantity | None:
    """Return what a field's name says, or its topic's where it says nothing."""
    inner = read_heading(" ".join(part for part in field.path.steps if isinstance(part, str)))
    if inner.quantity is not None:
        return inner.quantity
    outer = read_heading(field.path.topic.replace("/", " "))
    return outer.quantity if outer.quantity is not Quantity.OTHER else None


def _rank(pair: Candidate) -> float:
    named = (quantity_of(pair.drive) in _DRIVES) + (quantity_of(pair.motion) in MOVES)
    drive_words, motion_words = (
        set(read_heading(str(field.path).replace("/", " ")).words) for field in (pair.drive, pair.motion)
    )
    side = len(drive_words & motion_words - {"joint", "data", "state", "states"}) > 0  # left beside left
    speed = pair.kind is Kind.SPEED  # of two fields of one joint, the one whose window a user knows
    return pair.share + NAMED * named + NAMED * side + 0.01 * speed


def _try(drive: Field, motion: Field) -> Candidate | None:
    """The pair with the share that the drive predicts; None where they do not overlap."""
    place = np.searchsorted(drive.time, motion.time, side="right") - 1
    inside = place >= 0
    if np.count_nonzero(inside) < LEAST_ROWS:
        return None
    driven, moved = drive.values[place[inside]], motion.values[inside]
    if np.ptp(driven) == 0.0 or np.ptp(moved) == 0.0:
        return None
    quantity = quantity_of(motion)
    kind = _KINDS[quantity] if quantity in _KINDS else guess_kind(moved, driven)
    speed = moved if kind is Kind.SPEED else np.diff(moved)
    return Candidate(drive, motion, kind, _share(speed, driven[: len(speed)]))


def _share(speed: Floats, driven: Floats) -> float:
    """Of what a speed's past leaves of its changes, the share that the drive predicts (partial R²)."""
    change = np.diff(speed)
    past = np.column_stack([speed[:-1], np.ones(len(change))])
    with_drive = np.column_stack([past, driven[:-1]])
    scale = np.max(np.abs(with_drive), axis=0)
    scale[scale == 0.0] = 1.0
    with_drive, past = with_drive / scale, past / scale[:2]
    alone, both = (
        float(np.sum((change - x @ np.linalg.lstsq(x, change, rcond=None)[0]) ** 2)) for x in (past, with_drive)
    )
    return 1.0 - both / alone if alone > 0.0 else 0.0
