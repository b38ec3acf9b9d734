"""A run of the plant as the recording a board would make of it, and the truth that no board knows."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from motor_identification.recording import Recording
from motor_model.errors import ModelError
from motor_model.sample import Info

from .ammeter import Ammeter
from .board import Report, report
from .encoder import Disc, Edges, edges_of, missed, with_returns
from .motor import Motion, move
from .parameters import Values, record_of

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# [s] The longest step of a recorded run. Over `rich` with any effect of the table the edges are within 1 ns of those at
# 10 µs, beside a ripple of 20 cycles a turn within 0.2 µs (a tick is 4 µs), for a third of the time.
RECORDED_STEP = 4e-5


@dataclass(frozen=True)
class Truth:
    """What really happened; times in seconds since the first sample, K samples, E counted edges."""

    parameters: dict[str, float]
    time: Floats  # (K,) [s] of the samples
    angle: Floats  # (K,) [rad] of the shaft since the first sample
    speed: Floats  # (K,) [rad/s] of the shaft
    latest_edge: Integers  # (K,) the edge each sample reports, an index into the edge arrays; -1 before the first
    edge_time: Floats  # (E,) [s] exact
    edge_angle: Floats  # (E,) [rad] of the shaft
    edge_speed: Floats  # (E,) [rad/s]
    edge_direction: Integers  # (E,) +1, -1
    edge_flank: Integers  # (E,) slots since the disc's zero; the hole is this modulo the slots
    missed_time: Floats  # [s] of the edges that were not counted
    reversal_time: Floats  # [s] at which motion begins in the direction opposite to the motion before
    start_angle: float  # [rad] of the disc at the first sample
    disc: Disc
    motion: Motion


def record(
    parameters: Values,
    time_of_command: ArrayLike,
    commands: ArrayLike,
    *,
    duration: float | None = None,
    sample_rate: float = 200.0,
    seed: int = 0,
    edges: int = 96,
    tick: float = 4e-6,
    irregularity: float = 0.0,
    disc_seed: int = 0,
    start_angle: float | None = None,
    start_speed: float = 0.0,
    single_channel: bool = True,
    start_time: int = 1_000_000_000,
    step: float = RECORDED_STEP,
    name: str = "plant",
    ammeter: Ammeter = Ammeter(),  # noqa: B008
) -> tuple[Recording, Truth]:
    """Run the plant and record it.

    A sample latches the command that is due at its instant (0 V before the first, clipped to max_voltage), reports it
    and applies it until the next sample. Counting begins with the recording.

    Args:
        parameters: names of interfaces.md (and of `BEYOND_THE_TABLE`); an absent effect is off.
        time_of_command: [s] since the first sample, ascending.
        commands: [V] one for each of those times.
        duration: [s] default: until the last command is due.
        sample_rate: [Hz] samples are exact multiples of its period, rounded to nanoseconds, after start_time.
        seed: for the start angle and for missed edges.
        edges: of one polarity a turn.
        tick: [s] of the timer; stamps are floored to it. 0: nanoseconds.
        irregularity: of the disc's flanks, a share of a slot; `disc_seed` keeps it the same disc over recordings.
        start_angle: [rad] of the disc; default: anywhere in a turn, by the seed.
        start_speed: [rad/s]
        single_channel: False: the count goes down backward.
        start_time: [ns] on the board's clock at the first sample.
        step: [s] the longest step of the simulation.
        name: uri of the recording.
        ammeter: reads the current, where the motor has a resistance.

    Raises:
        ModelError: parameters or commands that describe no run.
    """
    p = record_of(parameters)
    times, volts = np.asarray(time_of_command, dtype=np.float64), np.asarray(commands, dtype=np.float64)
    if times.shape != volts.shape or not len(times) or not np.all(np.isfinite(volts)) or np.any(np.diff(times) < 0.0):
        raise ModelError("The plant needs a finite voltage for each of its ascending command times.")
    period = round(1e9 / sample_rate)
    last = times[-1] if duration is None else duration
    samples = np.arange(int(np.floor(last * 1e9 / period + 1e-6)) + 1, dtype=np.int64) * period
    latched = _latched(times, volts, samples, p["max_voltage"])
    sample_times: Floats = np.asarray(samples * 1e-9, dtype=np.float64)
    motion = move(parameters, sample_times, latched, start_speed=start_speed, step=step)

    random = np.random.default_rng(seed)
    if start_angle is None:
        start_angle = float(random.uniform(0.0, 2.0 * np.pi))
    disc = Disc.cut(edges, irregularity, disc_seed)
    counted, back, lost = _counted(motion, disc, p, start_angle, single_channel, random)
    stamps = _stamps(counted.time, start_time, tick)
    seen = np.searchsorted(counted.time, sample_times, side="right")  # by true time: a stamp may be a tick early
    board = report(samples + start_time, latched, seen, stamps, counted.direction, edges, single_channel, back)
    info = Info(
        name=name,
        edges_per_revolution=edges,
        single_channel=single_channel,
        edge_resolution=tick,
        sample_period=period * 1e-9,
        max_voltage=float(p["max_voltage"]),
    )
    current = ammeter.read(p, sample_times, latched, motion, np.random.default_rng([seed, 1]))
    recording = _recording(name, info, samples + start_time, latched, board, current)
    return recording, _truth(parameters, sample_times, motion, counted, lost, board, start_angle, disc)


def _counted(
    motion: Motion, disc: Disc, p: Any, start_angle: float, single_channel: bool, random: np.random.Generator
) -> tuple[Edges, NDArray[np.bool_] | None, Floats]:
    """The edges that the board counts, which of them take one back (None with one channel), and when it misses one."""
    shown = {"start_angle": start_angle, "eccentricity": p["eccentricity"], "phase": p["eccentricity_phase"]}
    every = edges_of(motion, disc, **shown)
    lost = missed(every, p["miss_rate"], random)
    if single_channel:
        return every.only(~lost), None, every.time[lost]
    return *with_returns(motion, disc, every.only(~lost), **shown), every.time[lost]


def _latched(times: Floats, volts: Floats, samples: Integers, limit: float) -> Floats:
    """[V] the command that is due at each sample [ns]."""
    due = np.searchsorted(np.round(times * 1e9), samples, side="right") - 1
    return np.clip(np.where(due >= 0, volts[np.maximum(due, 0)], 0.0), -limit, limit)


def _stamps(time: Floats, start: int, tick: float) -> Integers:
    """[ns] on the board's clock, floored to the timer's tick, shape (E,)."""
    if tick == 0.0:
        return start + np.floor(time * 1e9).astype(np.int64)
    ticks = np.floor((start * 1e-9 + time) / tick + 1e-9)  # 1e-9: an edge exactly on a tick belongs to it
    return np.round(ticks * tick * 1e9).astype(np.int64)


def _recording(
    uri: str, info: Info, sample_time: Integers, latched: Floats, board: Report, current: Floats
) -> Recording:
    return Recording(
        uri=uri,
        info=info,
        sample_time=sample_time,
        voltage=latched,
        speed=board.speed,
        edge_count=board.edge_count,
        edge_time=board.edge_time,
        edge_period=board.edge_period,
        supply_voltage=np.full(len(sample_time), np.nan),
        current=current,
    )


def _truth(
    parameters: Values,
    sample_times: Floats,
    motion: Motion,
    counted: Edges,
    missed_time: Floats,
    board: Report,
    start_angle: float,
    disc: Disc,
) -> Truth:
    return Truth(
        parameters=dict(parameters),
        time=sample_times,
        angle=motion.angle[motion.at],
        speed=motion.speed[motion.at],
        latest_edge=board.latest_edge,
        edge_time=counted.time,
        edge_angle=counted.angle,
        edge_speed=counted.speed,
        edge_direction=counted.direction,
        edge_flank=counted.flank,
        missed_time=missed_time,
        reversal_time=_reversals(motion),
        start_angle=start_angle,
        disc=disc,
        motion=motion,
    )


def _reversals(motion: Motion) -> Floats:
    """[s] where motion begins against the direction of the motion before it."""
    ways = np.sign(np.diff(motion.angle))
    moving = np.flatnonzero(ways)
    turned = np.flatnonzero(np.diff(ways[moving])) + 1
    return motion.time[moving[turned]]
