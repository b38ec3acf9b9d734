"""Which columns of a CSV log mean what, and in which units."""

from dataclasses import dataclass
from enum import Enum
from math import pi, radians


class Kind(str, Enum):
    """What the motion column of a log holds."""

    SPEED = "speed"
    POSITION = "position"
    COUNT = "count"


# By kind: what one unit is in rad/s or in rad; the first row is the default. How large a count is, the encoder says.
UNITS: dict[Kind, dict[str, float | None]] = {
    Kind.SPEED: {"rad/s": 1.0, "deg/s": radians(1.0), "rpm": 2.0 * pi / 60.0},
    Kind.POSITION: {"rad": 1.0, "deg": radians(1.0), "rev": 2.0 * pi, "count": None},
    Kind.COUNT: {"count": None},
}


@dataclass(frozen=True)
class CsvForm:
    """How to read a file; None is "not said"."""

    time: str | None  # column of seconds; None where every row is a steady state
    voltage: str  # column; times `voltage_scale` it is volts
    motion: str  # column of what `kind` says, in `unit`
    kind: Kind
    unit: str
    voltage_scale: float = 1.0
    edges_per_revolution: int | None = None
    count_quantum: float | None = None  # the size of one count in `unit`
    speed_window: float | None = None  # [s] what a speed is the mean over
    speed_lag: float | None = None  # [s] how old the middle of that window is at the row's time
    split: str | None = None  # column; each run of one value is a recording of its own
    rest_until: float | None = None  # [s] by the time column: the motor stood until the first voltage came, then
    voltage_before: bool = False  # a row's voltage was applied until its time; else from then until the next row
    name: str = "motor"
    max_voltage: float | None = None  # [V]

    @property
    def columns(self) -> list[str]:
        """The columns that are read."""
        return [name for name in (self.time, self.voltage, self.motion, self.split) if name]
