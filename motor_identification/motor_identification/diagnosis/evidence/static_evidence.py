"""Evidence of static effects: all of them shape one curve over voltage and speed, which few places cannot tell apart.

Frictions, a dead zone, a coasting bridge, a sagging supply: where a recording stays at three places, three of them
beside kv pass through all of these, whatever is there, and what they leave in between is a torque. Held-out motion at
other places would tell; where there is none, and such a torque was learned, their parameters are counted.
"""

from collections.abc import Iterable

import numpy as np

from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.effect_test import is_static
from motor_identification.measurement.command_swing import LEVEL_SHARE, LEVELS
from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Floats, Recording
from motor_identification.validation.held_out import HeldOut
from motor_model.effects import EFFECT_BY_NAME

STAYING = 0.5  # of the time in motion at places where a motor stays: with less it goes from place to place


def find_untold(model: Model) -> tuple[str, ...]:
    """Find the static effects of a model whose recordings stay at too few places to tell so many apart.

    Without a torque beside them the motion between the places tells; one step is told by its shape.
    """
    held, static = model.held, tuple(filter(_shapes_curve, model.effects))
    if not held.seen or not held.confirms or model.errors.rms_voltage == 0.0:
        return ()
    return static if count_static(static) >= count_places(held) else ()


def is_told_alone(plain: Model, beside: Model) -> bool:
    """Decide whether a part of what was found beside a torque is told without one, and leaves what the sensor does.

    Measured: a fan under a loop had friction, drag and a late command; a dead zone more, of 1.6 standard errors beside
    a torque of 0.2 % of the supply, was one effect too many for four places: nothing was named at 43 × the floor.
    """
    return set(plain.effects) < set(beside.effects) and not plain.above_floor and not find_untold(plain)


def count_places(judged: HeldOut) -> int:
    """Count the places, fifths of the largest voltage and speed, at which motors stay; rest at 0 V is none.

    A motor that hardly stays passes many: as many as would have equal shares (Laakso and Taagepera, Comp. Political
    Studies 12, 1979, of parties).
    """
    rows = zip(judged.recordings, judged.intervals, judged.scored, strict=True)
    parts = [(*_place(recording, data), data.duration * scored) for recording, data, scored in rows]
    voltage, speed, weight = (np.concatenate(part) for part in zip(*parts, strict=True))
    places = np.column_stack([_round_to_fifths(voltage), _round_to_fifths(speed)])
    found, which = np.unique(places, axis=0, return_inverse=True)
    share = np.bincount(which.reshape(-1), weight) / max(float(weight.sum()), 1e-300)
    share = share[found.any(axis=1)]
    stays = share >= LEVEL_SHARE
    if share[stays].sum() >= STAYING * share.sum():
        return int(np.count_nonzero(stays))
    return int(share.sum() ** 2 / np.sum(share**2))


def _place(recording: Recording, data: Intervals) -> tuple[Floats, Floats]:
    """Voltage [V] in the middle of each interval, and mean speed [rad/s], shape (I,) each."""
    return recording.voltage[data.find_rows(recording)], data.speed


def _round_to_fifths(values: Floats) -> Floats:
    largest = float(np.max(np.abs(values), initial=0.0))
    return np.asarray(np.rint(LEVELS * values / largest)) if largest > 0.0 else np.zeros(len(values))


def count_static(effects: Iterable[str]) -> int:
    """Count the parameters that static effects among some have; an instant is none of them."""
    specs = [spec for effect in effects if _shapes_curve(effect) for spec in EFFECT_BY_NAME[effect].parameters]
    return sum(not spec.of_recording for spec in specs)


def _shapes_curve(name: str) -> bool:
    """Whether an effect shapes the curve of torques over voltage and speed, or does so from an instant on."""
    effect = EFFECT_BY_NAME[name]
    return effect.constant is not None or (is_static(name) and effect.fitted)
