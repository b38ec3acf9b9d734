"""Draw motors of any size, drive each by one excitation, and write logs of it as other people make them."""

import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

import numpy as np
from numpy.typing import NDArray
from period_method import compute_period_speeds
from plant.motor import move
from scipy.signal import butter, lfilter

Floats = NDArray[np.float64]
SUPPLIES = (3.0, 5.0, 6.0, 7.4, 12.0, 24.0, 48.0)
RATES = (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
SENSORS = ("positions", "speeds", "tachogenerator")  # counted, counted from row to row, of the row's own instant
TIMED = "times between edges"
DISC, SILENCE, SILENT_ROWS = 0.01, 0.1, 10.0  # of a slot; [s] and rows without an edge after which a speed is 0
NOISE, CONVERTER = (1e-3, 2e-2), (1.3 / 1024, 1e-9)  # of a tachogenerator: of the top speed, and steps of that
EXCITATIONS = ("step", "steps one way", "staircase", "prbs one way", "prbs", "ramps", "sweep", "speed loop")
# Chance of each effect, and its size: of the supply, of the time constant, or a number.
EFFECTS = {
    "coulomb_friction": (0.8, {"ks": (0.02, 0.12)}),
    "transport_delay": (0.25, {"delay": (0.1, 0.5)}),
    "quadratic_drag": (0.1, {"drag": (0.05, 0.3)}),
    "dead_zone": (0.1, {"dead_zone_voltage": (0.03, 0.12)}),
    "direction_asymmetry": (0.1, {"reverse_gain": (0.85, 0.95)}),
    "load_bias": (0.1, {"bias_voltage": (0.03, 0.1)}),
}


@dataclass(frozen=True)
class Logger:
    """How rows come about: clock, stamps, what is written when."""

    loop: float = 0.0  # of a row: standard deviation of the loop's periods
    late: float = 0.0  # of a row: how late a row is stamped, in the mean
    whole: bool = False  # stamps in whole milliseconds
    before: bool = False  # the voltage that held until the row, not the one from there on
    nominal: bool = False  # counts are divided by the period that the loop should have
    memory: float = 0.0  # share of the speed shown before that a new one keeps
    falls: bool = False  # speeds from times between edges fall with the time since the latest
    filter: str = ""  # what else filters the speeds, with its number: see `filter_of`

    @property
    def is_smoothed(self) -> bool:
        """Whether speeds come late by a filter."""
        return self.memory > 0.0 or bool(self.filter)

    def describe(self) -> str:
        """Say what is special about it; empty where rows are what they say."""
        parts = (
            (self.loop > 0.0, f"periods ±{self.loop:.0%}"),
            (self.late > 0.0, f"stamps {self.late:.0%} late"),
            (self.whole, "whole ms"),
            (self.before, "voltage until then"),
            (self.nominal, "nominal period"),
            (self.falls, "falling"),
            (self.memory > 0.0, f"smoothed {self.memory:g}"),
            (bool(self.filter), self.filter),
        )
        return ", ".join(text for there, text in parts if there)


@dataclass(frozen=True)
class Case:
    """A motor, what is in it, and how it was logged."""

    seed: int
    values: dict[str, float]  # of the plant
    hidden: tuple[str, ...]
    excitation: str
    rate: float  # [Hz]
    counts: int  # of a turn
    sensor: str
    supply: float  # [V]
    torque: float  # [V] RMS
    logger: Logger = Logger()
    least: float = 0.0  # [s] that the log lasts at least

    @property
    def lag(self) -> float:
        """[s] the time constant."""
        return self.values["ka"] / self.values["kv"]

    def describe(self) -> str:
        """Say what it is in half a line."""
        top = self.supply / self.values["kv"]
        counts = "" if self.sensor == SENSORS[2] else f" of {self.counts} counts"
        sensor = f"{self.sensor}{counts} at {self.rate:g} Hz"
        motor = f"{self.supply:g} V, {top:.3g} rad/s, {1e3 * self.lag:.0f} ms"
        text = f"{self.excitation}, {motor}, {sensor}, torque {100 * self.torque / self.supply:.1f} %"
        return ", ".join(filter(None, (text, self.logger.describe())))


def draw(seed: int) -> Case:
    """Draw a case."""
    random = np.random.default_rng([16, seed])
    supply, top = float(random.choice(SUPPLIES)), 10.0 ** random.uniform(0.7, 3.3)
    lag = 10.0 ** random.uniform(np.log10(0.02), np.log10(0.6))
    kv = supply / top
    scale = {"ks": supply, "dead_zone_voltage": supply, "bias_voltage": supply, "delay": lag, "drag": kv / top}
    values, hidden = {"kv": kv, "ka": kv * lag, "max_voltage": supply}, []
    for name, (chance, sizes) in EFFECTS.items():
        if random.random() < chance:
            hidden.append(name)
            values |= {key: random.uniform(*bounds) * scale.get(key, 1.0) for key, bounds in sizes.items()}
    torque = float(random.choice([0.0, 0.002, 0.005, 0.015])) * supply
    if torque:
        time = lag * 10.0 ** random.uniform(-1.0, 0.5)
        values |= {"random_torque": torque, "random_torque_time": time, "random_torque_seed": float(seed)}
    rate = min(float(random.choice(RATES)), 1000.0)
    rate = next(one for one in RATES if one >= min(max(rate, 4.0 / lag), RATES[-1]))
    per_row = 10.0 ** random.uniform(0.5, 2.5)  # counts from row to row at full speed
    counts = int(np.clip(np.rint(per_row * rate * 2.0 * np.pi / top), 12, 100_000))
    return Case(
        seed=seed,
        values=values,
        hidden=tuple(hidden),
        excitation=str(random.choice(EXCITATIONS)),
        rate=rate,
        counts=counts,
        sensor=str(random.choice(SENSORS)),
        supply=supply,
        torque=torque,
    )


def command(case: Case, time: Floats) -> Floats:
    """The voltages of the rows, as shares of the supply; a speed loop's are found while it runs."""
    random, span = np.random.default_rng([17, case.seed]), time[-1]
    part = (time / span * 8).astype(int)
    match case.excitation:
        case "step":
            return np.where(time > 0.1 * span, random.uniform(0.5, 1.0), 0.0)
        case "steps one way":
            return np.append(0.0, random.uniform(0.2, 1.0, 8))[part]
        case "staircase":
            return np.array([0.0, 0.3, 0.6, 0.9, 0.0, -0.3, -0.6, -0.9, 0.0])[part]
        case "prbs one way" | "prbs":
            low, high = random.uniform(0.25, 0.45), random.uniform(0.55, 0.9)
            bits = random.integers(2, size=int(span / (1.5 * case.lag)) + 2)
            levels = np.where(bits, high, low if case.excitation == "prbs one way" else -high)
            return np.asarray(levels[(time / (1.5 * case.lag)).astype(int)])
        case "ramps":
            return np.asarray(np.interp(time / span, [0.0, 0.05, 0.3, 0.55, 0.8, 1.0], [0.0, 0.0, 0.9, -0.9, 0.9, 0.0]))
        case _:
            sweep = 2.0 * np.pi * span / (4.0 * case.lag) / 8.0 * (np.exp(2.0 * time / span) - 1.0) / 3.0
            return np.asarray(random.uniform(0.5, 0.9) * np.sin(sweep))


def span_of(case: Case) -> float:
    """Say how long the log is [s]."""
    return max(float(np.clip(60.0 * case.lag, 4.0, 30.0)), case.least)


def run(case: Case) -> tuple[Floats, Floats, Floats, Floats]:
    """Time [s], voltage [V], angle [rad] and speed [rad/s] of every row."""
    time = _draw_instants(case)
    if case.excitation != "speed loop":
        volts = case.supply * np.clip(command(case, time), -1.0, 1.0)
        return time, volts, *_move(case, time, volts)
    volts = np.zeros(len(time))
    part = np.minimum(time / span_of(case) * 8, 8).astype(int)
    wanted = np.array([0.5, 0.2, 0.7, 0.4, -0.3, -0.6, 0.3, 0.5, 0.0])[part]
    for _ in range(3):  # a loop without a model: the command of a run answers the speed of the run before
        _, speed = _move(case, time, volts)
        error = wanted * case.supply / case.values["kv"] - speed
        volts = np.clip(volts + 0.5 * case.values["kv"] * error, -case.supply, case.supply)
    return time, volts, *_move(case, time, volts)


def _move(case: Case, time: Floats, volts: Floats) -> tuple[Floats, Floats]:
    motion = move(case.values, time, volts, step=min(1e-4, case.lag / 400.0))
    return np.asarray(motion.angle[motion.at]), np.asarray(motion.speed[motion.at])


def time_edges(case: Case, time: Floats, volts: Floats) -> Floats:
    """[rad/s] what a board that times edges shows at the rows."""
    motion = move(case.values, time, volts, step=min(2e-5, case.lag / 2000.0))
    disc = DISC * np.random.default_rng([24, case.seed]).standard_normal(case.counts)
    slot, silence = 2.0 * np.pi / case.counts, max(SILENCE, SILENT_ROWS / case.rate)
    return compute_period_speeds(motion.time, motion.angle, time, slot, disc, case.logger.falls, silence)


def _draw_instants(case: Case) -> Floats:
    """The instants of the rows [s]; a loop that takes its time is never faster than twice its rate."""
    count = int(span_of(case) * case.rate)
    if case.logger.loop == 0.0:
        return np.arange(count) / case.rate
    periods = 1.0 + case.logger.loop * np.random.default_rng([20, case.seed]).standard_normal(count - 1)
    return np.append(0.0, np.cumsum(np.maximum(periods, 0.5))) / case.rate


def _stamp(case: Case, time: Floats) -> Floats:
    """The stamps of rows [s] at these instants."""
    logger, random = case.logger, np.random.default_rng([21, case.seed])
    stamps = time + logger.late / case.rate * random.exponential(size=len(time)) if logger.late else time
    stamps = np.maximum.accumulate(stamps)
    return np.floor(stamps * 1e3) * 1e-3 if logger.whole else stamps


def filter_of(name: str) -> tuple[Floats, Floats]:
    """Numerator and denominator, powers of 1/z ascending, of a filter with its number."""
    kind, number = name.split()
    value = float(number)
    match kind:
        case "bilinear":  # of a pole
            return np.array([1.0, 1.0]) * (1.0 - value) / 2.0, np.array([1.0, -value])
        case "twice":
            return np.array([(1.0 - value) ** 2]), np.array([1.0, -2.0 * value, value**2])
        case "butterworth":  # of a corner, as a share of half the rate
            return butter(2, value)
        case _:  # the mean of so many
            return np.full(int(value), 1.0 / value), np.ones(1)


def write(case: Case, path: Path) -> None:
    """Write the log."""
    time, volts, angle, speed = run(case)
    random, logger = np.random.default_rng(case.seed), case.logger
    values = case.values
    angle = angle + values.get("eccentricity", 0.0) * np.sin(angle + values.get("eccentricity_phase", 0.0))
    count = np.floor(angle * case.counts / (2.0 * np.pi) + random.random())
    shown = count * 360.0 / case.counts
    if case.sensor == SENSORS[1]:
        periods = np.diff(time) if logger.loop and not logger.nominal else 1.0 / case.rate
        shown = np.append(0.0, np.diff(shown) / periods) / 6.0
    elif case.sensor == TIMED:
        shown = time_edges(case, time, volts) * 30.0 / np.pi
    elif case.sensor == SENSORS[2]:
        top, noise = case.supply / case.values["kv"], NOISE[0] * (NOISE[1] / NOISE[0]) ** random.random()
        step = top * random.choice(CONVERTER)
        shown = step * np.round((speed + top * noise * random.standard_normal(len(speed))) / step) * 30.0 / np.pi
    if logger.memory:
        shown = np.asarray(lfilter([1.0 - logger.memory], [1.0, -logger.memory], shown))
    if logger.filter:
        shown = np.asarray(lfilter(*filter_of(logger.filter), shown))
    written = np.append(0.0, volts[:-1]) if logger.before else volts
    name = "position [deg]" if case.sensor == SENSORS[0] else "speed [rpm]"
    rows = zip(_stamp(case, time), written, shown, strict=True)
    text = "\n".join(f"{t:.6f},{u:.4f},{y:.5f}" for t, u, y in rows)
    path.write_text(f"time [s],voltage [V],{name}\n{text}\n", encoding="utf-8")
