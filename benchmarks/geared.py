"""A gearmotor with both channels on the emulated board: recorded, identified, diagnosed, tuned, and held at two speeds.

11 pulses a motor turn, counted fourfold by an uneven sensor, behind 34.014:1 with backlash and friction, beside a
random torque of 0.1 V RMS. Firmware on the emulated chip, driver and controller are the real ones, in lockstep; judged
on the true output.
"""

import sys
from math import isnan
from pathlib import Path

import numpy as np
from geared_rig import CONFIG, GEAR, HELD, MS, PAGE_MOTOR, SETTLED, TRUTH, Bench, drive, hold, record
from machine import commit, machine
from page_sections import write_section

from motor_control.tuning.design import Tuning, Wish, tune
from motor_control.tuning.speed_feedback import Encoder
from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.result import Diagnosis
from motor_identification.estimation.request import Request
from motor_identification.experiment import make_plan
from motor_identification.identify import identify
from motor_identification.uncertainty.result import Fit
from motor_model.excitation import profile
from motor_model.parameters import Parameters

PAGE = Path(__file__).with_name("results") / "geared.md"
OTHERS = range(2, 8)  # seeds
SPEEDS = (0.2, 10.0)  # [rad/s] of the output
WISH = Wish(lowest_speed=1.0, source="observer", oscillation=0.05)

NOTE = """\
# A gearmotor with both channels, from the board to the loop

`python benchmarks/geared.py` at {commit}, {machine}.

{text}

## Identified

{duration:.0f} s of every profile to 10 V; effects said. Flanks are off by {share:.1%} of a count.

{fit}

## Diagnosed, with nothing said

Named: {named}. Verdict: {verdict}. Gap {before:.3g}, now {after:.3g} rad/s.

Other recordings of it, each with a disc, a random torque and voltages of its own; errors in standard errors:

{others}

## Held

`tune` was asked for a lowest speed of {wish.lowest_speed:g} rad/s and ripples up to {wish.oscillation:.0%}: \
at 0.2 rad/s and 2 % it finds no gains for flanks as uneven as these.
Observer and feed-forward of the identified model; by `tune` kp = {gains.kp:.3g}, \
ki = {gains.ki:.3g}; {held_for:g} s after {settled:g} s.

{held}

## The motor of [the gearmotor's page](../../docs/gearmotor.md)

No random torque, an even sensor, 6 V; in lockstep, so that no sample is late.

{page_motor}
"""


def list_names(found: Diagnosis) -> str:
    """List the effects that a diagnosis names."""
    return ", ".join(f"`{finding.effect}`" for finding in found.findings) or "nothing"


def tabulate_fit(fit: Fit) -> list[str]:
    """Found values beside the truth."""
    rows = ["| | truth | found | error, in its standard errors |", "|---|---:|---:|---:|"]
    for name, value in TRUTH.values.items():
        found, error = fit.parameters.values[name], fit.standard_errors[name]
        rows.append(f"| `{name}` | {value:g} | {found:.5g} ± {error:.2g} | {(found - value) / error:+.1f} |")
    print("\n".join(rows), flush=True)
    return rows


def tabulate_others() -> list[str]:
    """Errors of other recordings and discs in their own standard errors, and what a diagnosis names in each."""
    names = list(TRUTH.values)
    rows = [
        f"| recording | {' | '.join(f'`{name}`' for name in names)} | named |",
        "|---|" + "---:|" * len(names) + "---|",
    ]
    for seed in OTHERS:
        recording = record(seed)
        fit = identify([recording], Request(TRUTH.effects))
        off = [(fit.parameters.values[name] - TRUTH.values[name]) / fit.standard_errors[name] for name in names]
        found = diagnose([recording])
        errors = " | ".join("not sure" if isnan(one) else f"{one:+.1f}" for one in off)
        rows.append(f"| {seed} | {errors} | {list_names(found)}; {found.verdict.value} |")
        print(rows[-1], flush=True)
    return rows


def tabulate_page_motor() -> list[str]:
    """Diagnose the motor of docs/gearmotor.md from the profile `rich` to 6 V, with nothing said."""
    bench = Bench(0, PAGE_MOTOR)
    plan = make_plan(profile("rich"), None, 6.0, 5 * MS)
    found = diagnose([drive(bench, plan.commands, "rich")])
    rows = ["| effect | gap before [rad/s] | after | found (truth) |", "|---|---:|---:|---|"]
    for finding in found.findings:
        values = (
            f"{name} {value:.6f} ± {error:.1g} ({PAGE_MOTOR.truth.value(name):g})"
            for name, (value, error) in finding.parameters.items()
        )
        gaps = f"{finding.gap_before:.3g} | {finding.gap_after:.3g}"
        rows.append(f"| `{finding.effect}` | {gaps} | {', '.join(values)} |")
    print("\n".join(rows), flush=True)
    return [*rows, "", f"Verdict: {found.verdict.value}."]


def tabulate_speeds(model: Parameters, tuning: Tuning, share: float) -> list[str]:
    """What is held of each reference."""
    held = ["| reference | mean of the true speed | its RMS error | largest error |", "|---:|---:|---:|---:|"]
    for reference in SPEEDS:
        error = hold(model, tuning, share, reference) - reference
        held.append(
            f"| {reference:g} rad/s | {reference + error.mean():.4f} rad/s | {np.sqrt(np.mean(error**2)):.4f} rad/s "
            f"| {np.abs(error).max():.4f} rad/s |"
        )
        print(held[-1], flush=True)
    return held


def main() -> int:
    """Write results/geared.md."""
    recording = record(1)
    fit = identify([recording], Request(TRUTH.effects))
    fitted, share = tabulate_fit(fit), fit.slot_irregularity[0]
    tuning = tune(fit.parameters, Encoder(44, share, CONFIG.info(None).edge_resolution, float(GEAR)), WISH)
    held = tabulate_speeds(fit.parameters, tuning, share)
    found = diagnose([recording])
    page = NOTE.format(
        commit=commit(),
        machine=machine(),
        text="\n".join((__doc__ or "").splitlines()[2:]),
        duration=recording.duration,
        share=share,
        fit="\n".join(fitted),
        named=list_names(found),
        verdict=found.verdict.value,
        before=found.before.gap,
        after=found.after.gap,
        others="\n".join(tabulate_others()),
        wish=WISH,
        gains=tuning.gains,
        held_for=HELD,
        settled=SETTLED,
        held="\n".join(held),
        page_motor="\n".join(tabulate_page_motor()),
    )
    for section in page.split("\n## "):
        write_section(PAGE, [section if section.startswith("# ") else f"## {section}"])  # what was concluded stays
    print(page)
    return 0


if __name__ == "__main__":
    sys.exit(main())
