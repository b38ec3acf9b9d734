"""A gearmotor with both channels on the emulated board: recorded, identified, diagnosed, tuned, and held at two speeds.

11 pulses a motor turn, counted fourfold by an uneven sensor, behind 34.014:1 with backlash and friction, beside a
random torque of 0.1 V RMS. Firmware on the emulated chip, driver and controller are the real ones, in lockstep; judged
on the true output.
"""

import sys
from dataclasses import dataclass, replace
from fractions import Fraction
from math import isnan
from pathlib import Path

import numpy as np
from machine import commit, machine

sys.path[:] = [folder for folder in sys.path if Path(folder).name != "benchmarks"]  # its control.py is not the library
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

from driver_rig import Rig
from plant import profiles

from motor_board.build import FirmwareConfig
from motor_board.emulation.shaft import EncoderConfig
from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.parameters import ROWS
from motor_control.tuning.design import Tuning, Wish, tune
from motor_control.tuning.speed_feedback import Encoder
from motor_driver.config import Config
from motor_identification.diagnose import diagnose
from motor_identification.estimation.request import Request
from motor_identification.experiment import make_plan
from motor_identification.identify import identify
from motor_identification.recording import Recording, check, recording_of
from motor_identification.uncertainty.result import Fit
from motor_model.excitation import profile
from motor_model.parameters import Parameters
from motor_model.sensing.encoder import Lines

PAGE = Path(__file__).with_name("results") / "geared.md"
GEAR = Fraction("34.014")
TRUTH = Parameters(
    {"kv": 0.9, "ka": 0.06, "ks": 0.7, "backlash_angle": 0.03, "load_fraction": 0.3},
    ("coulomb_friction", "backlash"),
    gear_ratio=float(GEAR),
)
TORQUE, CORRELATION = 0.1, 0.05  # [V] RMS, [s] of the random torque
CONFIG = Config(edges_per_revolution=44, single_channel=False, quadrature=4, gear=GEAR)
OTHERS = range(2, 8)  # seeds
SPEEDS = (0.2, 10.0)  # [rad/s] of the output
SETTLED, HELD = 2.0, 6.0  # [s]
MS = 1e-3


@dataclass(frozen=True)
class Case:
    """A motor, its sensor, and what else turns it."""

    truth: Parameters
    config: Config
    lines: Lines
    irregularity: float  # of the disc, share of a slot
    torque: float  # [V] RMS


HARD = Case(TRUTH, CONFIG, Lines(0.44, 0.21), 0.02, TORQUE)
PAGE_MOTOR = Case(
    Parameters(
        {"kv": 0.5, "ka": 0.03, "ks": 0.5, "breakaway_voltage": 0.7, "stribeck_speed": 0.3}
        | {"backlash_angle": 0.02, "load_fraction": 0.3},
        ("static_friction", "backlash"),
        max_voltage=6.0,
        gear_ratio=float(GEAR),
    ),
    replace(CONFIG, max_voltage=6.0),
    Lines(),
    0.0,
    0.0,
)  # of docs/gearmotor.md


@dataclass
class Bench:
    """Board, driver and a random torque on the shaft, a millisecond at a time."""

    seed: int
    case: Case = HARD

    def __post_init__(self) -> None:
        encoder = EncoderConfig(11, self.case.irregularity, self.seed, lines=self.case.lines, gear=GEAR)
        firmware = FirmwareConfig("tb6612", edges_per_revolution=11, channels=2)
        self.rig = Rig(
            config=self.case.config, parameters=self.case.truth, firmware=firmware, encoder=encoder, step=16_000
        )
        self.random, self.torque = np.random.default_rng(self.seed), 0.0
        self.rig.plug()
        self.rig.voltage = 0.0
        self.run(100)

    def run(self, milliseconds: int) -> None:
        """Let time pass under an Ornstein–Uhlenbeck torque."""
        fade = np.exp(-MS / CORRELATION)
        for _ in range(milliseconds):
            self.torque = fade * self.torque + self.case.torque * np.sqrt(1.0 - fade**2) * self.random.standard_normal()
            self.rig.emulator.shaft.hold(False, self.torque)
            self.rig.run(1)


def record(seed: int) -> Recording:
    """Record half a minute of everything."""
    return drive(Bench(seed), profiles.rich(10.0, seed)[1], f"geared {seed}")


def drive(bench: Bench, voltages: np.ndarray, name: str) -> Recording:
    """Drive a motor through voltages, one a sample, and read what the driver says."""
    bench.rig.readings.clear()
    for volt in voltages:
        bench.rig.voltage = float(volt)
        bench.run(5)
    samples = [reading.sample for reading in bench.rig.readings]
    info = bench.rig.driver.info
    bench.rig.close()
    return check(recording_of(samples, info, name))


def hold(model: Parameters, tuning: Tuning, irregularity: float, reference: float) -> np.ndarray:
    """True speeds [rad/s] at every sample after settling, with observer and feed-forward of a model."""
    bench = Bench(7)
    values = {row.name: row.default for row in ROWS} | {"kp": tuning.gains.kp, "ki": tuning.gains.ki}
    values |= {"speed_source": "observer", "feedforward": True, "slot_irregularity": irregularity}
    config = config_of(values, bench.rig.driver.info, model)  # type: ignore[arg-type]
    state, wanted, speeds = controller.State(), reference, []
    bench.rig.readings.clear()
    for step in range(round((SETTLED + HELD) / (5 * MS))):
        bench.run(5)
        for reading in bench.rig.readings:
            now = reading.sample.sample_time * 1e-9
            output, state = controller.update(config, state, reading.sample, wanted, now)
            wanted, bench.rig.voltage = None, output.terms.voltage  # type: ignore[assignment]
        bench.rig.readings.clear()
        if step * 5 * MS >= SETTLED:
            speeds.append(bench.rig.emulator.shaft.speed)
    stops = bench.rig.stops
    bench.rig.close()
    if stops:
        raise SystemExit(f"the loop was stopped: {stops}")
    return np.array(speeds)


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
        named = ", ".join(f"`{finding.effect}`" for finding in found.findings) or "nothing"
        errors = " | ".join("not sure" if isnan(one) else f"{one:+.1f}" for one in off)
        rows.append(f"| {seed} | {errors} | {named}; {found.verdict.value} |")
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
    rows, share = tabulate_fit(fit), fit.slot_irregularity[0]
    wish = Wish(lowest_speed=1.0, source="observer", oscillation=0.05)
    tuning = tune(fit.parameters, Encoder(44, share, CONFIG.info(None).edge_resolution, float(GEAR)), wish)
    held = tabulate_speeds(fit.parameters, tuning, share)
    found = diagnose([recording])
    named = ", ".join(f"`{finding.effect}`" for finding in found.findings) or "nothing"
    lines = [
        "# A gearmotor with both channels, from the board to the loop",
        "",
        f"`python benchmarks/geared.py` at {commit()}, {machine()}.",
        "",
        *(__doc__ or "").splitlines()[2:],
        "",
        "## Identified",
        "",
        f"{recording.duration:.0f} s of every profile to 10 V; effects said. Flanks are off by {share:.1%} of a count.",
        "",
        *rows,
        "",
        "## Diagnosed, with nothing said",
        "",
        f"Named: {named}. Verdict: {found.verdict.value}. Gap {found.before.gap:.3g}, now {found.after.gap:.3g} rad/s.",
        "",
        "Other recordings of it, each with a disc, a random torque and voltages of its own; errors in standard errors:",
        "",
        *tabulate_others(),
        "",
        "## Held",
        "",
        f"`tune` was asked for a lowest speed of {wish.lowest_speed:g} rad/s and ripples up to {wish.oscillation:.0%}: "
        "at 0.2 rad/s and 2 % it finds no gains for flanks as uneven as these.",
        f"Observer and feed-forward of the identified model; by `tune` kp = {tuning.gains.kp:.3g}, "
        f"ki = {tuning.gains.ki:.3g}; {HELD:g} s after {SETTLED:g} s.",
        "",
        *held,
    ]
    lines += ["", "## The motor of [the gearmotor's page](../../docs/gearmotor.md)", ""]
    lines += [
        "No random torque, an even sensor, 6 V; in lockstep, so that no sample is late.",
        "",
        *tabulate_page_motor(),
    ]
    PAGE.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
