"""What a user said about a log; everything else is guessed."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from motor_identification.logs.form import Kind


@dataclass(frozen=True)
class Pair:
    """One motor of a file that has several."""

    label: str
    voltage: str  # column
    motion: str  # column


@dataclass(frozen=True)
class Said:
    """Options as they were given; None (or the default) is "not said", and a name is that of a column."""

    time: str | None = None
    time_unit: str | None = None
    sample_period: float | None = None  # [s] from row to row of a log without times
    voltage: str | None = None
    motion: str | None = None
    kind: Kind | None = None
    unit: str | None = None
    constant_voltage: float | None = None  # [V] in every row of a log without a column of it
    voltage_scale: float | None = None
    full_duty: float | None = None  # what the voltage column shows at full voltage
    neutral: float | None = None  # what it shows at 0 V; full voltage is then so far from there
    supply: str | None = None
    supply_voltage: float | None = None  # [V] at full duty
    edges_per_revolution: int | None = None
    gear: Fraction = Fraction(1)  # encoder turns per turn of the output
    count_quantum: float | None = None
    units_per_revolution: float | None = None
    wrap: float | None = None
    speed_window: float | None = None
    speed_lag: float | None = None
    direction: str | None = None  # column; NONE where a guessed one is none
    increments: bool | None = None  # whether counts are those of one row; None: as name and numbers say
    split: str | None = None
    rest_until: float | None = None
    voltage_before: bool | None = None
    even_clock: bool | None = None
    nominal_period: bool | None = None
    steady: bool = False
    max_voltage: float | None = None
    name: str = "motor"
    motors: tuple[Pair, ...] = ()
    sheet: str | None = None  # of a workbook

    def columns(self) -> frozenset[str]:
        """The names, or numbers, of columns that were said."""
        own = (self.time, self.voltage, self.motion, self.supply, self.direction, self.split)
        return frozenset(filter(None, (*own, *(name for one in self.motors for name in (one.voltage, one.motion)))))

    def with_names(self, names: Sequence[str]) -> "Said":
        """Name the columns that were said by number: 4 is the fourth, if none is called 4."""

        def name(said: str | None) -> str | None:
            place = int(said) if said and said.isascii() and said.isdigit() and len(said) < 6 else 0
            return names[place - 1] if said not in names and 0 < place <= len(names) else said

        return replace(
            self,
            time=name(self.time),
            voltage=name(self.voltage),
            motion=name(self.motion),
            supply=name(self.supply),
            direction=name(self.direction),
            split=name(self.split),
            motors=tuple(Pair(one.label, name(one.voltage) or "", name(one.motion) or "") for one in self.motors),
        )
