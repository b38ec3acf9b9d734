"""Our own motors as other people's logs: every format of numbers, stamps, columns and sensors at random."""

from dataclasses import dataclass
from math import tau
from pathlib import Path
from typing import Any

import numpy as np

from motor_identification.logs.form import Kind
from motor_model.excitation import profile
from motor_model.parameters import Parameters
from motor_model.simulate import simulate

Floats = np.ndarray[Any, np.dtype[np.float64]]
FULL = 12.0  # [V]
RATES = (10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)  # [Hz]
UNITS = {"rad": 1.0, "deg": 360.0 / tau, "rev": 1.0 / tau, "rad/s": 1.0, "deg/s": 360.0 / tau, "rpm": 60.0 / tau}
# Names of time, voltage and motion, with gaps for units; {} is where a name has none.
NAMES = {
    Kind.SPEED: [
        ("t [{}]", "u", "speed [{}]"),
        ("Zeit [{}]", "Spannung [V]", "Drehzahl [{}]"),
        ("time_{}", "voltage", "wheel velocity ({})"),
    ],
    Kind.POSITION: [
        ("t [{}]", "u", "position [{}]"),
        ("Tiempo ({})", "Voltaje (V)", "Posicion ({})"),
        ("time_{}", "motorVoltage", "angle_{}"),
    ],
    Kind.COUNT: [
        ("t [{}]", "u", "ticks"),
        ("time_{}", "voltage", "encoder count"),
        ("Zeit ({})", "Spannung (V)", "encoder"),
    ],
}
TIME_SIZES = {"s": 1.0, "ms": 1e3, "us": 1e6}


@dataclass(frozen=True)
class Case:
    """How a motor was logged."""

    seed: int
    truth: Parameters
    kind: Kind
    unit: str
    rate: float  # [Hz] of rows
    held: int  # rows for which a value is held
    jitter: float  # of a period
    time_unit: str
    whole: bool  # whether stamps are whole numbers
    edges: int  # counts of a turn
    delimiter: str
    comma: bool
    duty: bool  # -255 to 255 of a battery in mV, in a column beside
    wraps: bool

    @property
    def slow(self) -> float:
        """Sample periods of the sensor in a time constant, the other way round: how coarse the log is."""
        return self.held / self.rate / (self.truth.values["ka"] / self.truth.values["kv"])


def draw_case(seed: int) -> Case:
    """A case at random."""
    random = np.random.default_rng([18, seed])
    kv, lag = 10.0 ** random.uniform(-1.7, -0.3), 10.0 ** random.uniform(-1.5, -0.5)
    truth = Parameters({"kv": kv, "ka": kv * lag, "ks": random.uniform(0.2, 0.8)}, ("coulomb_friction",))
    kind = list(Kind)[int(random.integers(3))]
    units = {Kind.SPEED: ("rad/s", "deg/s", "rpm"), Kind.POSITION: ("rad", "deg", "rev"), Kind.COUNT: ("count",)}[kind]
    rate = RATES[int(random.integers(len(RATES)))]
    time_unit = ("s", "ms", "us")[int(random.integers(3))]
    delimiter, comma = [(",", False), (";", False), (";", True), ("\t", True)][int(random.integers(4))]
    edges = int(random.choice([48, 96, 360, 1440, 4096]))
    held = int(random.choice([1, 1, 2, 4])) if rate >= 100.0 else 1
    turning = FULL / kv / tau / rate * held  # turns from one value to the next, at most
    return Case(
        seed=seed,
        truth=truth,
        kind=kind,
        unit=units[int(random.integers(len(units)))],
        rate=rate,
        held=held,
        jitter=float(random.choice([0.0, 0.0, 0.1, 0.2])),
        time_unit=time_unit,
        whole=time_unit == "us" or (time_unit == "ms" and bool(random.integers(2))),
        edges=edges,
        delimiter=delimiter,
        comma=comma,
        duty=bool(random.random() < 0.25),
        wraps=kind is Kind.POSITION and turning < 0.4 and bool(random.integers(2)),
    )


def write_case(case: Case, path: Path, seconds: float = 28.0) -> None:
    """Write the log of a case: `rich`, commanded at the rows."""
    random = np.random.default_rng([19, case.seed])
    count = int(seconds * case.rate)
    time = (np.arange(count) + case.jitter * random.uniform(-1.0, 1.0, count)) / case.rate
    chosen = profile("rich")
    voltage = chosen.voltage(np.arange(count) / count * chosen.duration, FULL)
    battery = np.round(7400.0 - 30.0 * time)
    if case.duty:
        duty = np.rint(voltage / FULL * 255.0)
        voltage = duty / 255.0 * battery * 1e-3
    else:
        voltage = np.round(voltage, 4)
    angle = simulate(case.truth, time, voltage, time).angle
    shown = np.floor(angle / tau * case.edges + random.random())  # whole counts
    shown = shown[np.arange(count) // case.held * case.held]
    motion = _motion(case, time, shown)
    header, cells = _columns(case, time, voltage, motion)
    if case.duty:
        header, cells = _with_battery(header, cells, duty, battery)
    lines = [case.delimiter.join(header)]
    for row in zip(*cells, strict=True):
        line = case.delimiter.join(row)
        lines.append(line.replace(".", ",") if case.comma else line)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _motion(case: Case, time: Floats, shown: Floats) -> Floats:
    if case.kind is Kind.COUNT:
        return shown
    angle = shown * tau / case.edges
    if case.kind is Kind.POSITION:
        turned = angle * UNITS[case.unit]
        return turned % (tau * UNITS[case.unit]) if case.wraps else turned
    fresh = np.arange(0, len(time), case.held)  # a speed is the mean since the fresh value before
    mean = np.concatenate(([0.0], np.diff(angle[fresh]) / np.diff(time[fresh])))
    return np.repeat(mean, case.held)[: len(time)] * UNITS[case.unit]


def _columns(case: Case, time: Floats, voltage: Floats, motion: Floats) -> tuple[list[str], list[list[str]]]:
    names = NAMES[case.kind][case.seed % 3]
    stamps = time * TIME_SIZES[case.time_unit]
    digits = {"s": 6, "ms": 3, "us": 0}[case.time_unit]
    times = [f"{value:.0f}" if case.whole else f"{value:.{digits}f}" for value in stamps]
    moved = [f"{value:.0f}" for value in motion] if case.kind is Kind.COUNT else [f"{value:.5f}" for value in motion]
    header = [names[0].format(case.time_unit), names[1], names[2].format(case.unit)]
    return header, [times, [f"{value:.4f}" for value in voltage], moved]


def _with_battery(
    header: list[str], cells: list[list[str]], duty: Floats, battery: Floats
) -> tuple[list[str], list[list[str]]]:
    columns = [cells[0], [f"{value:.0f}" for value in duty], [f"{value:.0f}" for value in battery], cells[2]]
    return [header[0], "pwm", "battery [mV]", header[2]], columns
