"""Describe the sensors that were found in the values of recordings, as a note beside every result."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from math import degrees

from motor_identification.recording import Recording
from motor_identification.sensor.noisy_angle import find_noisy_angles
from motor_identification.sensor.speed_sensor import SpeedSensor, find_speed_sensor
from motor_identification.sensor.white_noise import LEAST_SAMPLES
from motor_model.sample import Measurement

HELD = "The sensor gives a new speed every {} ms; what repeats it in between is left out."
WRONG = (
    "{} of {} speeds were left out: far beside their neighbours, with no voltage to make them so, or 0 while the motor "
    "moved."
)
LATTICE = "Every speed{} is a multiple of {} rad/s ({} deg/s): {} counts a turn over {} ms are assumed."
BLURRED = (
    "Speeds of a few counts are near multiples of {} rad/s ({} deg/s): {} counts a turn over {} ms are assumed. Larger "
    "ones lie between, as counts do that were divided by lengths of rows which their stamps do not show."
)
BY_ROWS = ", by the length of its row beside the usual one,"
SOME_BY_ROWS = ", in some recordings by the length of its row beside the usual one,"
FEW = "There are too few speeds to tell their noise: {} rad/s is assumed."
ANGLE = "The angle has white noise of {} rad, more than a count: it is taken from sample to sample."
AVERAGED = "The angle has white noise of {} rad, far more than the motion of a row: it is averaged over {} rows."
WHITE = "The speeds lie on no lattice of counts: white noise of {} rad/s, as between neighbours, is assumed."


def note_sensors(recordings: Sequence[Recording]) -> tuple[Recording, ...]:
    """Add to the first recording's notes what their values say of sensors that nobody described."""
    unsaid = [recording for recording in recordings if recording.info.measurement is Measurement.SPEED]
    note = describe_speed_sensors(
        [(find_speed_sensor(recording), bool(recording.info.edges_per_revolution)) for recording in unsaid]
    ) or _describe_angles(recordings)
    if not note or note in recordings[0].notes:
        return tuple(recordings)
    first, *others = recordings
    return (replace(first, notes=(*first.notes, note)), *others)


def tells_of_speeds(note: str) -> bool:
    """Decide whether a note says how speeds were taken to be made."""
    return note.startswith(tuple(text.split("{")[0] for text in (HELD, LATTICE, BLURRED, FEW, WHITE)))


def describe_speed_sensors(sensors: Sequence[tuple[SpeedSensor, bool]]) -> str:
    """Say what was found of speed sensors, each with whether its counts were known; empty where nothing is new."""
    held = [sensor for sensor, _ in sensors if sensor.frame > 0.0]
    lattices = [sensor for sensor, known in sensors if sensor.step > 0.0 and not known]
    counted, blurred = ([one for one in lattices if one.blurred is some] for some in (False, True))
    white = [sensor for sensor, known in sensors if sensor.sigma > 0.0 and not known]
    told = [sensor for sensor in white if len(sensor.row) >= LEAST_SAMPLES]
    few = [sensor for sensor in white if len(sensor.row) < LEAST_SAMPLES]
    parts = []
    if held:
        parts.append(HELD.format(_span((one.frame * 1e3 for one in held), "{:.3g}")))
    wrong = sum(sensor.wrong for sensor, _ in sensors)
    if wrong:
        parts.append(WRONG.format(wrong, wrong + sum(len(sensor.row) for sensor, _ in sensors)))
    even, by_rows = ([one for one in counted if (one.lengths is None) == is_even] for is_even in (True, False))
    if even and by_rows and _number_lattice(even) == _number_lattice(by_rows):
        parts.append(LATTICE.format(SOME_BY_ROWS, *_number_lattice(counted)))
    else:
        parts.extend(
            LATTICE.format(text, *_number_lattice(some)) for some, text in ((even, ""), (by_rows, BY_ROWS)) if some
        )
    if blurred:
        parts.append(BLURRED.format(*_number_lattice(blurred)))
    for some, text in ((told, WHITE), (few, FEW)):
        if some:
            parts.append(text.format(_span((one.sigma for one in some), "{:.2g}")))
    return " ".join(parts)


def _number_lattice(sensors: Sequence[SpeedSensor]) -> tuple[str, ...]:
    """The numbers of the sentence on a lattice, each as it is shown: rad/s, deg/s, counts a turn, ms."""
    return (
        _span((one.step for one in sensors), "{:.4g}"),
        _span((degrees(one.step) for one in sensors), "{:.4g}"),
        _span((one.edges_per_revolution for one in sensors), "{:,}"),
        _span((one.window * 1e3 for one in sensors), "{:.4g}"),
    )


def _describe_angles(recordings: Sequence[Recording]) -> str:
    """Say how noisy sampled angles are; empty where they are counts of edges."""
    noisy = [(angles, one.info.edge_angle) for one in recordings if (angles := find_noisy_angles(one)) is not None]
    if not noisy:
        return ""
    noises = _span((angles.noise_of_row * slot for angles, slot in noisy), "{:.2g}")
    rows = [angles.rows for angles, _ in noisy]
    return AVERAGED.format(noises, _span(rows, "{}")) if max(rows) > 1 else ANGLE.format(noises)


def _span(values: Iterable[float], form: str) -> str:
    """One number, or the least and the largest of several."""
    show: Callable[[float], str] = form.format
    some = sorted(values)
    ends = dict.fromkeys((show(some[0]), show(some[-1])))
    return " to ".join(ends)
