"""How small may an effect be and still be found? The smallest size that the diagnosis names in 9 motors of 10.

Random motors with a friction, a delay or whatever of a given size hidden in the tests' independent plant, on discs of 0
to 1 % irregular slots, `rich` training and a random validation recording, as in `hidden.py`. Sizes are halved from
the smallest of that table on; the first that is found less often ends the search. What else is named does not count
against it here; the table of `diagnosis.py` does that.
"""

import argparse
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from hidden import FRICTION, SIZES, one
from machine import machine

from motor_model.effects import SPEC_BY_NAME

RESULTS = Path(__file__).with_name("results") / "power.md"
MOTORS, NEEDED = 10, 9
HALVINGS = 10  # of the smallest size of the confusion table
# The parameter that says how large an effect is, and its value where there is none of it.
SIZE = {
    "coulomb_friction": ("ks", 0.0),
    "static_friction": ("breakaway_voltage", 0.3),  # above a ks of that much
    "quadratic_drag": ("drag", 0.0),
    "load_bias": ("bias_voltage", 0.0),
    "load_step": ("step_voltage", 0.0),
    "dead_zone": ("dead_zone_voltage", 0.0),
    "voltage_limit": ("limit_voltage", 12.0),
    "direction_asymmetry": ("reverse_gain", 1.0),
    "coast_drive": ("coast_share", 0.0),
    "supply_sag": ("sag", 0.0),
    "armature_inductance": ("electrical_time_constant", 0.0),
    "transport_delay": ("delay", 0.0),
    "torque_ripple": ("ripple_voltage", 0.0),
    "encoder_eccentricity": ("eccentricity", 0.0),
    "backlash": ("backlash_angle", 0.0),
    "warm_up": ("resistance_rise", 0.0),
    "missed_edges": ("miss_rate", 0.0),
}
HEAD = (
    "# Diagnosis: the smallest effects that are found",
    "",
    f"{machine()}. Found in at least {NEEDED} of {MOTORS} random motors with a 28 s recording; "
    "sizes in steps of one half.",
    "",
    "| effect | smallest size | |",
    "|---|---|---|",
)
NOTE = """
"or less": still found after ten halvings. A backlash shows in the time that a motor without its load gains at every
reversal, which falls only with the square root of the angle; angle and load share are then strongly correlated.
"""
BESIDE = {"torque_ripple": (FRICTION,)}  # without friction a motor swings on its ripple


def sized(effect: str, halvings: int) -> dict[str, float]:
    """The parameters of an effect of the smallest size in the confusion table, halved so many times."""
    name, none = SIZE[effect]
    low, high = SIZES[effect][name]
    smallest = low if abs(low - none) < abs(high - none) else high
    fixed = {"ks": none} if effect == "static_friction" else {}
    return {name: none + (smallest - none) * 0.5**halvings} | fixed


def found(effect: str, halvings: int, pool: ProcessPoolExecutor) -> int:
    """In how many motors it is named; two that miss it end the count."""
    hidden, count, missed = (*BESIDE.get(effect, ()), effect), 0, 0
    jobs = [pool.submit(one, hidden, seed, sized(effect, halvings)) for seed in range(MOTORS)]
    for job in jobs:
        if missed > MOTORS - NEEDED:
            job.cancel()
            continue
        count += (hit := effect in job.result().named)
        missed += not hit
    return count


def smallest(effect: str, pool: ProcessPoolExecutor) -> int | None:
    """The largest number of halvings at which it is found often enough, by bisection; None: not even at none."""
    low, high = -1, HALVINGS + 1
    while high - low > 1:
        middle = max((low + high) // 2, 0)
        if found(effect, middle, pool) >= NEEDED:
            low = middle
        else:
            high = middle
    return low if low >= 0 else None


def row(effect: str, halvings: int | None) -> str:
    """A line of the table."""
    name, none = SIZE[effect]
    unit = SPEC_BY_NAME[name].unit.strip("–")
    least = sized(effect, halvings or 0)[name]
    what = f"{name} {abs(least - none):.2g} {unit}".rstrip() + (f" off {none:g}" if none else "")
    if halvings is None:
        return f"| {effect} | not found in {NEEDED} of {MOTORS} | at {what} |"
    return f"| {effect} | {what} | {'or less' if halvings == HALVINGS else ''} |"


def kept() -> dict[str, str]:
    """The rows that the page has already, by effect."""
    page = RESULTS.read_text(encoding="utf-8") if RESULTS.exists() else ""
    return {line.split(" | ")[0].removeprefix("| "): line for line in page.splitlines() if line.startswith("| ")}


def main() -> int:
    """Print the rows as they come, and put them on the page beside those that are not run now."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--effects", nargs="+", choices=list(SIZE), default=list(SIZE), metavar="EFFECT")
    options = parser.parse_args()
    rows = kept()
    with ProcessPoolExecutor(2) as pool:
        for effect in options.effects:
            rows[effect] = row(effect, smallest(effect, pool))
            print(rows[effect], flush=True)
            table = [rows[name] for name in SIZE if name in rows]
            RESULTS.write_text("\n".join([*HEAD, *table, NOTE]), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
