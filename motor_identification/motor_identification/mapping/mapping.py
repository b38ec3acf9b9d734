"""A mapping: where in a bag a motor's voltage and motion stand, in which units; and its YAML file."""

import re
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

from motor_identification.bag.fields import FieldPath, parse_path
from motor_identification.logs.count_size import MOST_EDGES
from motor_identification.logs.form import UNITS, Kind
from motor_model import yaml_file
from motor_model.errors import MotorError, RecordingError

LARGEST_SCALE = 1e9
NUMBERS = ("units_per_revolution", "speed_window", "max_voltage")  # above 0
_KEYS = {"name", "voltage", "current", "edges_per_revolution", "speed_lag", "voltage_before", *NUMBERS}
_ORIGIN = re.compile(r"(?P<path>[^@*]+)(?:@(?P<unit>[\w/%]+))?(?:\*(?P<scale>[-+.\deE]+))?")


@dataclass(frozen=True)
class Origin:
    """A field, the unit of its numbers (empty: that of ROS, SI) and a factor."""

    path: FieldPath
    unit: str = ""
    scale: float = 1.0

    def __str__(self) -> str:
        return f"{self.path}{f'@{self.unit}' if self.unit else ''}{f'*{self.scale:g}' if self.scale != 1.0 else ''}"


@dataclass(frozen=True)
class Mapping:
    """One motor in the bags of a robot; None is "not said"."""

    voltage: Origin  # times its scale: volts
    motion: Origin
    kind: Kind
    current: Origin | None = None  # times its scale: amperes
    name: str = "motor"
    edges_per_revolution: int | None = None
    units_per_revolution: float | None = None
    speed_window: float | None = None  # [s]
    speed_lag: float | None = None  # [s]
    max_voltage: float | None = None  # [V]
    voltage_before: bool = False

    def __post_init__(self) -> None:
        if self.voltage.path == self.motion.path:
            raise RecordingError(f"{self.voltage.path} cannot be both voltage and {self.kind.value}: name two fields.")

    @property
    def paths(self) -> tuple[FieldPath, ...]:
        """The fields it reads: voltage, motion and, where there is one, current."""
        return tuple(one.path for one in (self.voltage, self.motion, self.current) if one is not None)

    @property
    def topics(self) -> tuple[str, ...]:
        """The topics that they are on, each once."""
        return tuple(dict.fromkeys(path.topic for path in self.paths))


def parse_origin(text: str, kind: Kind | None = None) -> Origin:
    """Read `TOPIC:FIELD[@UNIT][*SCALE]`, such as `/left/command:data*0.047` or `/wheel:speed@rpm`.

    Raises:
        RecordingError: it is written otherwise, or the unit is none of that kind.
    """
    match = _ORIGIN.fullmatch(text.strip())
    if match is None:
        raise RecordingError(
            f"'{text[:200]}' is no TOPIC:FIELD, with @UNIT and *FACTOR behind it where they are needed."
        )
    try:
        scale = float(match["scale"] or 1.0)
    except ValueError:
        scale = 0.0
    return _origin(parse_path(match["path"]), match["unit"] or "", scale, kind)


def _origin(path: FieldPath, unit: str, scale: float, kind: Kind | None) -> Origin:
    if unit and unit not in (UNITS[kind] if kind else {}):
        known = ", ".join(UNITS[kind]) if kind else "none: volts and amperes are made by a factor"
        raise RecordingError(f"{path} is in {unit[:40]}, which is no unit of it: take one of {known}.")
    if not isfinite(scale) or not 0.0 < abs(scale) <= LARGEST_SCALE:
        raise RecordingError(f"{path}: its factor has to be a number other than 0, up to {LARGEST_SCALE:g}.")
    return Origin(path, unit, scale)


def load_mapping(path: str | Path) -> Mapping:
    """Read a mapping file.

    Raises:
        RecordingError: it cannot be read, or is no mapping; the sentence says why.
    """
    try:
        content = yaml_file.read(path)
    except FileNotFoundError as error:
        raise RecordingError(f"There is no mapping {path}: check the path, or let `inspect BAG` write one.") from error
    except OSError as error:
        raise RecordingError(
            f"The mapping {path} cannot be read ({error.strerror}): name a mapping that `inspect BAG` wrote."
        ) from error
    except MotorError as error:
        raise RecordingError(f"The mapping {path} {error}." if not str(error).endswith(".") else str(error)) from error
    try:
        return read_mapping(content)
    except RecordingError as error:
        raise RecordingError(f"The mapping {path}: {error}") from error


def read_mapping(content: Any) -> Mapping:
    """Read the values of a mapping file.

    Raises:
        RecordingError: they are no mapping.
    """
    if not isinstance(content, dict):
        raise RecordingError("it needs voltage, and one of speed, position or count, each with `from: TOPIC:FIELD`.")
    kinds = [kind for kind in Kind if kind.value in content]
    unknown = sorted(str(key)[:40] for key in set(content) - _KEYS - {kind.value for kind in Kind})
    if unknown:
        known = ", ".join(sorted(_KEYS | {kind.value for kind in Kind}))
        raise RecordingError(f"it does not know {', '.join(unknown[:5])}: it may have {known}.")
    if len(kinds) != 1 or "voltage" not in content:
        raise RecordingError("it needs voltage, and one of speed, position or count, each with `from: TOPIC:FIELD`.")
    edges = content.get("edges_per_revolution")
    if edges is not None and (not isinstance(edges, int) or isinstance(edges, bool) or not 1 <= edges <= MOST_EDGES):
        raise RecordingError(f"edges_per_revolution is a whole number from 1 to {MOST_EDGES}.")
    before = content.get("voltage_before", False)
    if not isinstance(before, bool):
        raise RecordingError("voltage_before is true or false.")
    return Mapping(
        voltage=_listed(content["voltage"], "voltage", None),
        motion=_listed(content[kinds[0].value], kinds[0].value, kinds[0]),
        kind=kinds[0],
        current=_listed(content["current"], "current", None) if "current" in content else None,
        name=str(content.get("name", "motor"))[:200],
        edges_per_revolution=edges,
        speed_lag=_number(content, "speed_lag", signed=True),
        voltage_before=before,
        **{name: _number(content, name) for name in NUMBERS},
    )


def _listed(entry: Any, name: str, kind: Kind | None) -> Origin:
    """`{from: TOPIC:FIELD, unit: UNIT, scale: FACTOR}`, or all of it as one text."""
    if isinstance(entry, str):
        return parse_origin(entry, kind)
    if not isinstance(entry, dict) or not isinstance(entry.get("from"), str) or set(entry) - {"from", "unit", "scale"}:
        raise RecordingError(f"{name} is `{{from: TOPIC:FIELD}}`, with unit and scale where they are needed.")
    scale = entry.get("scale", 1.0)
    number = float(scale) if isinstance(scale, int | float) and not isinstance(scale, bool) else float("nan")
    return _origin(parse_path(entry["from"]), str(entry.get("unit", "")), number, kind)


def _number(content: dict[Any, Any], name: str, signed: bool = False) -> float | None:
    value = content.get(name)
    if value is None:
        return None
    usable = isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value) and abs(value) < 1e9
    if not usable or (value <= 0 and not signed):
        raise RecordingError(f"{name} is a number{'' if signed else ' above 0'}.")
    return float(value)


def mapping_text(mapping: Mapping) -> str:
    """Write the YAML of a mapping, with what else it may have as remarks."""
    lines = [f"name: {_quoted(mapping.name)}", f"voltage: {_entry(mapping.voltage)}  # times scale: volts"]
    lines.append(f"{mapping.kind.value}: {_entry(mapping.motion)}  # units: {', '.join(UNITS[mapping.kind])}")
    if mapping.current:
        lines.append(f"current: {_entry(mapping.current)}  # times scale: amperes")
    for name in ("edges_per_revolution", *NUMBERS, "speed_lag"):
        value = getattr(mapping, name)
        lines.append(f"{name}: {value}" if value is not None else f"# {name}:")
    return "\n".join(lines) + "\n"


def _entry(origin: Origin) -> str:
    unit = f", unit: {_quoted(origin.unit)}" if origin.unit else ""
    return f"{{from: {_quoted(str(origin.path))}{unit}, scale: {origin.scale!r}}}"


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"
