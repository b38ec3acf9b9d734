"""How small may an effect be and still be found? The smallest size that the diagnosis names in 9 motors of 10.

Random motors with a friction, a delay or whatever of a given size hidden in the tests' independent plant, on discs of 0
to 1 % irregular slots, `rich` training and a random validation recording, as in `hidden.py`. Sizes are halved from
the smallest of that table on; the first that is found less often ends the search. What else is named does not count
against it here; the table of `diagnosis.py` does that. A column for each random torque beside the motor.
"""

import argparse
import math
import re
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from hidden import FRICTION, QUIET, SIZES, Torque, one
from machine import commit, machine

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
TORQUES = {"": QUIET} | {f"{rms:g} V, 50 ms": Torque(rms, 0.05) for rms in (0.03, 0.1, 0.3)}  # columns
HEAD = (
    "# Diagnosis: the smallest effects that are found",
    "",
    f"{machine()}. Found in at least {NEEDED} of {MOTORS} random motors with a 28 s recording, alone and beside a "
    "random torque; sizes in steps of one half. Each entry with the commit that it is of.",
    "",
    "| effect | " + " | ".join(f"beside {name}" if name else "smallest size" for name in TORQUES) + " |",
    "|---" * (1 + len(TORQUES)) + "|",
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


def found(effect: str, halvings: int, torque: Torque, first: int, pool: ProcessPoolExecutor) -> int:
    """In how many motors it is named; two that miss it end the count."""
    hidden, count, missed = (*BESIDE.get(effect, ()), effect), 0, 0
    seeds = range(first, first + MOTORS)
    jobs = [pool.submit(one, hidden, seed, sized(effect, halvings), torque) for seed in seeds]
    for job in jobs:
        if missed > MOTORS - NEEDED:
            job.cancel()
            continue
        count += (hit := effect in job.result().named)
        missed += not hit
    return count


def smallest(effect: str, torque: Torque, guess: int, first: int, pool: ProcessPoolExecutor) -> int | None:
    """The largest number of halvings at which it is found often enough; None: not even at none.

    It is looked for around the guess, one step off, then two more, then four more; then by bisection.
    """
    low, high, middle, step = -1, HALVINGS + 1, guess, 1
    while high - low > 1:
        if found(effect, middle, torque, first, pool) >= NEEDED:
            low, middle = middle, middle + step
        else:
            high, middle = middle, middle - step
        step *= 2
        if not low < middle < high:
            middle = (low + high) // 2
    return low if low >= 0 else None


def likely(before: list[int | None]) -> int:
    """The halvings to begin with: those that the entry had, or two less than beside a third of the torque."""
    off = next((i for i, halvings in enumerate(reversed(before)) if halvings is not None), 0)
    return max((before[-1 - off] or 0) - 2 * off, 0)


def entry(effect: str, halvings: int | None) -> str:
    """An entry of the table."""
    name, none = SIZE[effect]
    unit = SPEC_BY_NAME[name].unit.strip("–")
    least = sized(effect, halvings or 0)[name]
    what = f"{name} {abs(least - none):.2g} {unit}".rstrip() + (f" off {none:g}" if none else "")
    if halvings is None:
        return f"not found in {NEEDED} of {MOTORS} at {what} ({commit()})"
    return f"{what}{' or less' if halvings == HALVINGS else ''} ({commit()})"


def halvings_of(effect: str, entry: str) -> int | None:
    """How often the size was halved that an entry of the page says; None where it says none that was found."""
    name, none = SIZE[effect]
    said = None if entry.startswith("not found") else re.search(rf"{name} ([0-9.e-]+)", entry)
    return said and round(math.log2(abs(sized(effect, 0)[name] - none) / float(said[1])))


def smallest_found(effect: str, rms: float) -> tuple[float, float]:
    """The size that the page has beside a torque of so many volts, and the value where there is none of the effect.

    Where it has no entry, the next weaker torque's grows as the torque.
    """
    (name, none), torques = SIZE[effect], list(TORQUES.values())
    entries = zip(torques, [halvings_of(effect, cell) for cell in kept()[effect]], strict=True)
    known = [(torque.rms, halvings) for torque, halvings in entries if halvings is not None and 0.0 < torque.rms <= rms]
    beside, halvings = max(known, default=(rms, 0))
    return abs(sized(effect, halvings)[name] - none) * rms / beside, none


def kept() -> dict[str, list[str]]:
    """The entries that the page has already, by effect."""
    page = RESULTS.read_text(encoding="utf-8") if RESULTS.exists() else ""
    rows = [line.strip("|").split("|") for line in page.splitlines() if line.startswith("| ")]
    return {row[0].strip(): [cell.strip() for cell in row[1:]] for row in rows if len(row) == 1 + len(TORQUES)}


def main() -> int:
    """Print the entries as they come, and put them on the page beside those that are not run now."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--effects", nargs="+", choices=list(SIZE), default=list(SIZE), metavar="EFFECT")
    parser.add_argument("--torques", nargs="+", choices=list(TORQUES), default=list(TORQUES), metavar="TORQUE")
    parser.add_argument("--first-seed", type=int, default=0, help="of the motors (default 0)")
    options = parser.parse_args()
    rows = kept()
    with ProcessPoolExecutor(2) as pool:
        for name in options.torques:
            for effect in options.effects:
                cells = rows.setdefault(effect, ["–"] * len(TORQUES))
                column = list(TORQUES).index(name)
                guess = likely([halvings_of(effect, cell) for cell in cells[: column + 1]])
                cells[column] = entry(effect, smallest(effect, TORQUES[name], guess, options.first_seed, pool))
                print(effect, name, cells, flush=True)
                table = ["| " + " | ".join((one, *rows[one])) + " |" for one in SIZE if one in rows]
                RESULTS.write_text("\n".join([*HEAD, *table, NOTE]), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
