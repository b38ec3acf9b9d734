"""What an identification says of a motor in physical units."""

from dataclasses import dataclass


@dataclass(frozen=True)
class PhysicalResult:
    """An identified motor in physical units, and how far it is to be trusted; dictionaries are by PHYSICAL_SPECS."""

    source: str  # "current": measured; "resistance": known otherwise
    values: dict[str, float]
    standard_errors: dict[str, float]  # NaN where not identifiable, or taken as exact
    not_identifiable: tuple[str, ...] = ()
    current_noise: tuple[float, ...] = ()  # [A] RMS error of every recording's current
    notes: tuple[str, ...] = ()
