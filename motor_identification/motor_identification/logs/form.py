"""Which columns of a log mean what, and in which units."""

from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from math import pi, radians

from motor_model.gearing.gear import edge_angle


class Kind(str, Enum):
    """What the motion column of a log holds."""

    SPEED = "speed"
    POSITION = "position"
    COUNT = "count"


# By kind: what one unit is in rad/s or in rad; the first row is the default. How large a count is, the encoder says;
# how far a turn goes, `units_per_revolution`.
UNITS: dict[Kind, dict[str, float | None]] = {
    Kind.SPEED: {
        "rad/s": 1.0,
        "deg/s": radians(1.0),
        "rpm": 2.0 * pi / 60.0,
        "rev/s": 2.0 * pi,
        "krpm": 2000.0 * pi / 60.0,
        "m/s": None,
        "cm/s": None,
        "mm/s": None,
        "km/h": None,
        "in/s": None,
        "ft/s": None,
        "count/s": None,
    },
    Kind.POSITION: {
        "rad": 1.0,
        "deg": radians(1.0),
        "rev": 2.0 * pi,
        "m": None,
        "cm": None,
        "mm": None,
        "in": None,
        "ft": None,
        "count": None,
    },
    Kind.COUNT: {"count": None},
}
# Of a wheel or a belt: in which length a turn is said (`units_per_revolution`), and how many of it (a second) one is.
LENGTHS = {
    "m": ("m", 1.0),
    "m/s": ("m", 1.0),
    "cm": ("cm", 1.0),
    "cm/s": ("cm", 1.0),
    "mm": ("mm", 1.0),
    "mm/s": ("mm", 1.0),
    "km/h": ("m", 1.0 / 3.6),
    "in": ("in", 1.0),
    "in/s": ("in", 1.0),
    "ft": ("ft", 1.0),
    "ft/s": ("ft", 1.0),
}
TIME_UNITS = {"s": 10**9, "ms": 10**6, "us": 10**3, "ns": 1}  # in nanoseconds


def time_unit_size(unit: str) -> int:
    """[ns] of a unit of times: a row of TIME_UNITS, or seconds a tick as text."""
    return TIME_UNITS[unit] if unit in TIME_UNITS else max(round(float(unit) * 1e9), 1)


@dataclass(frozen=True)
class CsvForm:
    """How to read a file; None is "not said"."""

    time: str | None  # column of times; None where every row is a steady state
    voltage: str  # column; times `voltage_scale` (and the supply) it is volts
    motion: str  # column of what `kind` says, in `unit`
    kind: Kind
    unit: str
    voltage_scale: float = 1.0
    edges_per_revolution: int | None = None
    gear: Fraction = Fraction(1)  # turns of the encoder's shaft, whose those edges are, in a turn of the output
    count_quantum: float | None = None  # the size of one count in `unit`
    speed_window: float | None = None  # [s] what a speed is the mean over
    speed_lag: float | None = None  # [s] how old the middle of that window is at the row's time
    split: str | None = None  # column; each run of one value is a recording of its own
    rest_until: float | None = None  # [s] by the time column: the motor stood until the first voltage came, then
    voltage_before: bool | None = (
        None  # a row's voltage was applied until its time; else until the next row; None: find
    )
    even_clock: bool | None = None  # rows are put on an even clock, or kept at their stamps; None: as motion shows
    nominal_period: bool | None = None  # speeds were divided by one period, whatever a row took; None: as motion shows
    name: str = "motor"
    max_voltage: float | None = None  # [V]
    time_unit: str = "s"  # of `time_unit_size`
    supply: str | None = None  # column of the supply's voltage, which a duty is a share of
    supply_scale: float = 1.0  # volts per unit of it
    current: str | None = None  # column
    current_scale: float = 1.0  # A per unit of it
    units_per_revolution: float | None = None  # metres (or whatever) of a turn, for unit m and m/s
    wrap: float | None = None  # a position begins again at 0 after this much of its unit
    direction: str | None = None  # column that says which way a drive without a sign goes
    backward: tuple[str, ...] = ()  # its values that mean backward
    codes: tuple[float, ...] = ()  # numbers of the driving column that are no duties
    increments: bool = False  # a row's counts are those since the row before
    signs_as_they_are: bool = False  # else a motion against its voltage all the time is turned round
    label: str = ""  # of this motor, where a file has several

    @property
    def columns(self) -> list[str]:
        """The columns that are read."""
        named = (self.time, self.voltage, self.motion, self.split, self.supply, self.current, self.direction)
        return [name for name in named if name]

    @property
    def unit_size(self) -> float | None:
        """What one unit is in rad/s or rad; None where counts are to be sized by the encoder."""
        if self.unit in LENGTHS and self.units_per_revolution:
            return LENGTHS[self.unit][1] * 2.0 * pi / self.units_per_revolution
        if self.unit == "count/s" and self.edges_per_revolution:
            return edge_angle(self.edges_per_revolution, self.gear)
        return UNITS[self.kind][self.unit]
