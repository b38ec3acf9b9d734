"""Describe where the error of a model is largest: the condition, the size beside the noise floor, the share of it."""

from motor_identification.discrepancy.angle_harmonics import AngleHarmonic, find_angle_harmonic
from motor_identification.discrepancy.worst_regions import Region, find_worst_regions
from motor_identification.validation.held_out import HeldOut

LOCATABLE_GAP = 1.1  # times the floor: below, no region is worse than chance makes it
REPEATING_SHARE = 0.3  # share of the excess that has to repeat with the angle, to be worth saying before anything else


def describe_error(held: HeldOut, share: float) -> str:
    """Say where the error is largest; `share` is the irregularity of the slots behind the floor, as a share of a slot.

    The phrase begins in lower case and has no full stop.
    """
    if not held.counted.any():
        return "no motion was kept for validation"
    floor = held.floor(share)
    if held.gap <= LOCATABLE_GAP * floor:
        return f"the error is at the noise floor everywhere ({_size(held.gap, floor)})"
    repeat = find_angle_harmonic(held, share)
    if repeat is not None and repeat.share > REPEATING_SHARE:
        excess = f"about {100 * repeat.share:.0f} % of the excess error"
        return f"the error repeats {_often(repeat)} per revolution ({_size(held.gap, floor)}; {excess})"
    said = f"largest error {describe_region(find_worst_regions(held, share, 1)[0])}"
    return said if repeat is None else f"{said}; a part of it repeats {_often(repeat)} per revolution"


def describe_region(region: Region) -> str:
    """Describe a region: where, how large the error is there, which share of the excess it holds, and its sign."""
    text = f"{region.words} ({_size(region.gap, region.floor)}"
    if region.time < 1.0:
        text += f"; {100 * region.excess:.0f} % of the excess error in {100 * region.time:.2g} % of the time"
    if abs(region.bias) > 0.5 * region.gap:
        text += f"; the simulation is {abs(region.bias):.2g} rad/s too {'fast' if region.bias > 0.0 else 'slow'}"
    elif abs(region.offset) > 0.5 * region.gap:
        way, other = ("forward", "backward") if region.offset > 0.0 else ("backward", "forward")
        text += f"; the simulation is {abs(region.offset):.2g} rad/s too fast {way} and too slow {other}"
    return text + ")"


def _size(gap: float, floor: float) -> str:
    """An RMS error beside the noise floor, where there is one: at standstill, no encoder noise is in the error."""
    if floor <= 0.0:
        return f"RMS {gap:.3g} rad/s"
    ratio = gap / floor
    return f"RMS {gap:.3g} rad/s, {f'{ratio:.2g}' if ratio < 99.5 else f'{ratio:.0f}'} × the noise floor"


def _often(repeat: AngleHarmonic) -> str:
    return "once" if repeat.cycles == 1 else f"{repeat.cycles} times"
