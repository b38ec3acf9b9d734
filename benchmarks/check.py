"""First runs on the emulated board, wired right and wrong: what `check` names, and how soon the pins are at 0 V.

The firmware is the real one on the emulated chip; somebody turns the shaft when asked, to within 4 %, and says what it
does. Voltages are those that the bridge's pins ask for, looked at every millisecond.
"""

from collections.abc import Iterator
from pathlib import Path

from check_runs import CASES, TOPS, run
from machine import commit, machine

from motor_driver.check.settings import DRIVE_TIME, HIGHEST

RESULTS = Path(__file__).with_name("results")
SEEDS = 2


def rows() -> Iterator[str]:
    """A row a case: named by all motors, and the worst of their times."""
    for case in CASES:
        tops = [top for top in TOPS if not case.gear or top < 100.0]  # a gearmotor's output
        runs = [run(case, top, seed) for top in tops for seed in range(SEEDS * len(TOPS) // len(tops))]
        named = sum(one.codes == case.codes for one in runs)
        said = ", ".join(sorted({f"`{code}`" for one in runs for code in one.codes})) or "nothing"
        off, driven = max(one.off for one in runs), max(one.driven for one in runs)
        highest, whole = max(one.highest for one in runs), max(one.whole for one in runs)
        written = sum(one.right for one in runs)
        alone = run(case, 30.0 if case.gear else 174.0, 0, hand=False)
        there = ", ".join(f"`{code}`" for code in alone.codes) or "nothing"
        yield (
            f"| {case.name} | {said} | {named} of {len(runs)} | {written} | {1e3 * off:.0f} ms | {driven:.1f} s | "
            f"{100.0 * highest:.0f} % | {whole:.0f} s | {there} |"
        )
        print(f"{case.name}: {named} of {len(runs)}, {said}", flush=True)


def accuracy() -> Iterator[str]:
    """What is measured of a motor that is wired right, beside the truth."""
    for top, volts in TOPS.items():
        runs = [run(CASES[0], top, seed) for seed in range(SEEDS)]
        spans = [
            (min(values), max(values))
            for values in ([getattr(one, name) for one in runs] for name in ("gain", "top", "breakaway"))
        ]
        shown = [f"{low:.3f} to {high:.3f}" for low, high in spans[:2]]
        late = f"{100.0 * spans[2][0]:+.1f} to {100.0 * spans[2][1]:+.1f} %"
        yield f"| {top:.0f} rad/s, {volts:.0f} V | {shown[0]} | {shown[1]} | {late} |"


def main() -> None:
    """Write the page."""
    table, numbers = list(rows()), list(accuracy())
    text = f"""# The first run with a new board

`python benchmarks/check.py`, commit {commit()}; {machine()}.

`check` on the emulated board: the real firmware on an emulated ATmega328P, a simulated motor on its pins, an encoder
with two channels and slots that are irregular by 1 %, a supply that the board measures (where nothing else is said).
{len(TOPS) * SEEDS} motors a row: top speeds of 6, 30, 174 and 600 rad/s at 6, 12, 12 and 24 V, {SEEDS} of each, with
time constants of 40 to 200 ms, friction of 3 to 8 % of the voltage, breakaway 1.4 times that, and 24 to 360 edges a
turn. Somebody turns the shaft when asked, to within 4 %, and answers. "Off": from the last sample at which the check
wants a voltage to 0 V at the pins, at most (with the board's sample period of 5 ms and frames in it). "Driven": the
longest stretch with voltage; the check allows {DRIVE_TIME:.0f} s. "Highest": of the motor's voltage; the check allows
{HIGHEST:.0%}.

| wired | said | right | file written | off | driven | highest | whole run | said with `--no-hand` |
|---|---|---|---|---|---|---|---|---|
{chr(10).join(table)}

A file is written where nothing is wrong, or where `reverse_motor` or `reverse_encoder` makes up for it. A bridge that
is stuck on turns the motor whatever the pins say: there the pins are at 0 V from the beginning, and the sentence says
to switch the supply off. With `--no-hand` wrong counts cannot be seen, one channel tells no direction, and where
nothing moves the sentence names all that it may be.

What is measured of a motor that is wired right, over the truth; the breakaway is where the first edge came, which is a
little later:

| motor | speed for a volt | top speed | breakaway, of the motor's voltage |
|---|---|---|---|
{chr(10).join(numbers)}
"""
    (RESULTS / "check.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
