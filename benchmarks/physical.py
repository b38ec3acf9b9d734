"""R, L, torque constant, inertia and friction of random motors with a measured current: how close, and how surely.

Motors of the tests' independent plant: R 0.5 to 10 Ω, torque constant 15 to 100 mN·m/A, mechanical time constant 20 to
150 ms, viscous friction 1 to 6 % of kv, dry friction 0.1 to 0.8 V of the armature, L/R 0.2 to 1.5 ms in every other
motor and 0 in the rest. 96 irregular slots (1 %), 4 µs timer, 200 Hz; the current is read by ten bits over ±2.2 stall
currents, with one step RMS of noise and a zero that is off by up to 2 %. Half a staircase and 5 s of random voltages;
`identify --effects coulomb_friction --physical` (beside a warm winding with warm_up). On the emulated board: the real
firmware flashed with --current-sense, 0 to 5 V on A1 for ±2.1 stall currents.
"""

import argparse
import os
import sys
from dataclasses import dataclass
from math import isnan
from pathlib import Path
from time import perf_counter

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

import numpy as np
from machine import commit, machine
from paper_emulated import EmulatedBoard, available
from plant import profiles, record
from plant.ammeter import Ammeter

from motor_identification.estimation.request import PhysicalRequest
from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.recording import check, recording_of
from motor_model.parameters import Parameters
from motor_model.physical.quantities import PHYSICAL_BY_NAME, lumped_values

RESULTS = Path(__file__).with_name("results")
NORMAL = {68: 0.994458, 95: 1.959964}  # standard errors that an interval of so many per cent reaches
Values = dict[str, float]


@dataclass(frozen=True)
class Scenario:
    """What the motors have beside friction, and what is fitted."""

    name: str
    effects: tuple[str, ...]
    hidden: tuple[tuple[str, tuple[float, float]], ...] = ()
    seconds: float = 5.0
    share: float = 1.0  # of the motors asked for


EMULATED = Scenario("sensors alone, emulated board", ("coulomb_friction",))
SCENARIOS = (
    Scenario("sensors alone", ("coulomb_friction",)),
    Scenario(
        "random torque, 0.1 V, 50 ms",
        ("coulomb_friction",),
        (("random_torque", (0.1, 0.1)), ("random_torque_time", (0.05, 0.05))),
    ),
    Scenario(
        "warm winding, 5 to 20 %",
        ("coulomb_friction", "warm_up"),
        (("resistance_rise", (0.05, 0.2)), ("warm_up_time", (4.0, 8.0))),
        seconds=20.0,
        share=0.25,
    ),
)


def draw_motor(random: np.random.Generator, inductive: bool) -> Values:
    """A motor in physical units."""
    resistance, constant = np.exp(random.uniform(np.log([0.5, 0.015]), np.log([10.0, 0.1])))
    share, friction = random.uniform(0.01, 0.06), random.uniform(0.1, 0.8)
    kv = constant / (1.0 - share)
    return {
        "resistance": float(resistance),
        "torque_constant": float(constant),
        "viscous_friction": float(share * kv * constant / resistance),
        "inertia": float(np.exp(random.uniform(np.log(0.02), np.log(0.15))) * kv * constant / resistance),
        "friction_torque": float(friction * constant / resistance),
        **({"inductance": float(random.uniform(2e-4, 1.5e-3) * resistance)} if inductive else {}),
    }


def score(scenario: Scenario, seed: int) -> dict[str, tuple[float, float]]:
    """Relative error and standard error of every quantity of one motor; NaN where it is not identifiable."""
    random = np.random.default_rng([seed, 19])
    motor = draw_motor(random, seed % 2 == 0)
    hidden = {name: float(random.uniform(*span)) for name, span in scenario.hidden}
    if "random_torque" in hidden:
        hidden["random_torque_seed"] = float(seed)
    electric = {name: motor[name] for name in ("resistance", "torque_constant")}
    reach = 2.2 * 12.0 / motor["resistance"]
    step = 2.0 * reach / 1024
    ammeter = Ammeter(step, float(random.uniform(-0.02, 0.02)) * reach, step)
    drive = profiles.joined(profiles.staircase(12.0, 4, 0.3), profiles.random(12.0, scenario.seconds, seed))
    values = lumped_values(motor) | electric | hidden
    recording = check(record(values, *drive, seed=seed, irregularity=0.01, disc_seed=seed, ammeter=ammeter)[0])
    found = identify([recording], Request(scenario.effects, SearchConfig(20, 60), physical=PhysicalRequest())).physical
    assert found is not None
    truth = dict(motor)
    if "resistance_rise" in hidden:
        truth["warm_resistance"] = motor["resistance"] * (1.0 + hidden["resistance_rise"])
    if "inductance" not in motor:  # it must not be found
        bad = "inductance" not in found.not_identifiable
        truth["no inductance"] = 1.0
        return _relative(found.values, found.standard_errors, motor | truth) | {"no inductance": (float(bad), 1.0)}
    return _relative(found.values, found.standard_errors, truth)


def score_emulated(seed: int) -> dict[str, tuple[float, float]]:
    """The same of a motor on the pins of the emulated board: the real firmware senses its current on A1."""
    random = np.random.default_rng([seed, 19])
    motor = draw_motor(random, True)
    effects = ("coulomb_friction", "armature_inductance")
    electric = {name: motor[name] for name in ("resistance", "torque_constant")}
    plant = Parameters(lumped_values(motor), effects, **electric)
    board = EmulatedBoard(plant, 200.0, 0.01, seed, current_gain=2.4 * motor["resistance"] / (2.0 * 12.0))
    samples = []
    for volts in profiles.joined(profiles.staircase(12.0, 4, 0.3), profiles.random(12.0, 3.0, seed))[1]:
        samples.append(board.sample())
        board.command(float(volts))
    board.close()
    recording = check(recording_of(samples, board.info, "emulated"))
    request = Request(effects[:1], SearchConfig(20, 60), physical=PhysicalRequest())
    found = identify([recording], request).physical
    assert found is not None
    return _relative(found.values, found.standard_errors, motor)


def _relative(values: Values, errors: Values, truth: Values) -> dict[str, tuple[float, float]]:
    return {name: (values[name] / true - 1.0, errors[name] / true) for name, true in truth.items() if name in values}


def row(scenario: Scenario, name: str, pairs: list[tuple[float, float]]) -> str:
    """One line of the table."""
    known = np.array([pair for pair in pairs if not isnan(pair[1]) and not isnan(pair[0])])
    if not len(known):
        return f"| {scenario.name} | {name} | 0 of {len(pairs)} | | | | | |"
    z = np.abs(known[:, 0] / known[:, 1])
    covered = [f"{100 * np.mean(z < width):.0f} ± {50 / np.sqrt(len(z)):.0f} %" if level == 68 else
               f"{100 * np.mean(z < width):.0f} ± {100 * np.sqrt(0.0475 / len(z)):.0f} %"
               for level, width in NORMAL.items()]  # fmt: skip
    size = np.abs(known[:, 0])
    return (
        f"| {scenario.name} | {name} | {len(known)} of {len(pairs)} | {100 * np.median(size):.3g} % | "
        f"{100 * size.max():.3g} % | {100 * np.median(known[:, 1]):.3g} % | {covered[0]} | {covered[1]} |"
    )


def rows(scenario: Scenario, motors: int) -> list[str]:
    """All lines of one scenario."""
    begun, seeds = perf_counter(), range(max(4, round(motors * scenario.share)))
    scores = [score_emulated(seed) if scenario == EMULATED else score(scenario, seed) for seed in seeds]
    names = [name for name in PHYSICAL_BY_NAME if any(name in one for one in scores)]
    lines = [row(scenario, name, [one[name] for one in scores if name in one]) for name in names]
    wrong = [one["no inductance"][0] for one in scores if "no inductance" in one]
    if wrong:
        lines.append(f"| {scenario.name} | L of motors without | {sum(wrong):.0f} of {len(wrong)} have one | | | | | |")
    print("\n".join(lines), f"\n{perf_counter() - begun:.0f} s", flush=True)
    return lines


def main() -> int:
    """Print and write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--motors", type=int, default=40, help="motors of each kind")
    motors = parser.parse_args().motors
    lines = [
        "# Ohms and newton-metres",
        "",
        *__doc__.splitlines()[2:],
        "",
        f"`python benchmarks/physical.py --motors {motors}` at commit {commit()}, {machine()}. Errors are relative to "
        "the truth; intervals of 68 and 95 % should hold it that often (± the binomial error of so many motors).",
        "",
        "| beside friction | quantity | identified | error, median | error, largest | standard error, median | in 68 "
        "% | in 95 % |",
        "|---|---|---|---:|---:|---:|---:|---:|",
    ]
    for scenario in (*SCENARIOS, *(() if available() else (EMULATED,))):
        lines += rows(scenario, motors)
        (RESULTS / "physical.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
