"""A differential drive closes a square: two motors of different friction, identified, with feed-forward and without.

Everything but ROS runs: the velocities of a user, `motor_examples`' drive and odometry, two controllers as their node
sets them up, two simulated boards with irregular discs. The velocities are open loop: nobody looks where the robot is.
Each motor is identified from half a minute of its own, offline, and its controller tuned by that.
"""

import os
import sys
from math import degrees, pi
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

from diff_drive_square import EFFECTS, FORWARD, GEOMETRY, SIDE, TRUE, TURN, Loop, board_of, drive_square
from machine import commit, machine
from page_sections import write_section

from motor_identification.experiment import make_plan, simulate_plan
from motor_identification.identify import Request, identify
from motor_identification.recording import check, recording_of
from motor_model.excitation import PROFILES
from motor_model.parameters import Parameters

PAGE = Path(__file__).with_name("results") / "diff_drive.md"
DISCS = 3
TRAVEL_GAINS = (0.0, 2.0)  # [1/s] off, and the default
JITTER = 0.003  # [s] around the drive's steps, of when velocities come: a program sends them, and a network passes them


def identified(truth: Parameters, seed: int) -> Parameters:
    """Identify a motor from the profile 'rich'."""
    board = board_of(seed)
    info = board.info(truth)
    plan = make_plan(PROFILES["rich"], None, truth.max_voltage, info.sample_period)
    samples = [sample for _, sample in simulate_plan(plan, truth, board)]
    return identify([check(recording_of(samples, info, truth.name))], Request(EFFECTS)).parameters


def row(loop: Loop, travel_gain: float, jitter: float = 0.0) -> str:
    """A line of the table: mean and worst of all discs and both ways; jitter [s] of when velocities come."""
    ways = [(seed, way) for seed in range(DISCS) for way in (1.0, -1.0)]
    squares = [drive_square(loop, seed, way, travel_gain, jitter) for seed, way in ways]
    gaps = [100.0 * square.gap / SIDE for square in squares]
    turns = [abs(degrees(abs(square.end.heading) - 2.0 * pi)) for square in squares]
    odometry = [1e3 * square.odometry_error for square in squares]
    healthy = all(square.healthy for square in squares)
    mean = sum(gaps) / len(gaps)
    corner = 1e3 * max(square.off for square in squares)
    cells = f"{mean:.2f} % | {max(gaps):.2f} % | {corner:.0f} mm | {max(turns):.1f}° | {max(odometry):.1f} mm"
    name = loop.name + (f", velocities up to {500.0 * jitter:g} ms sooner or later" if jitter else "")
    return f"| {name} | {travel_gain:g} | {cells} | {'yes' if healthy else 'no'} |"


def loops(models: tuple[Parameters, Parameters]) -> list[Loop]:
    """All that are compared."""
    ours: dict[str, object] = {"speed_source": "observer", "feedforward": True}
    left = models[0]
    return [
        Loop("observer and feed-forward, each its own model", models, ours),
        Loop("the same without feed-forward", models, {"speed_source": "observer"}),
        Loop("the same gains on the measured speed", models, {}),
        Loop("observer and feed-forward, the left motor's model for both", (left, left), ours),
    ]


def main() -> int:
    models = (identified(TRUE[0], 1), identified(TRUE[1], 2))
    found = [
        f"| {truth.name} | "
        + " | ".join(
            f"{model.value(name):.5g} ({truth.value(name):g})" for name in ("kv", "ka", "ks", "breakaway_voltage")
        )
        + " |"
        for truth, model in zip(TRUE, models, strict=True)
    ]
    lines = [
        "# A differential drive closes a square",
        "",
        f"`python benchmarks/diff_drive.py` at {commit()}, {machine()}; the other sections have commands of their own.",
        "",
        f"Simulated: wheels of {1e3 * GEOMETRY.wheel_radius:g} mm, {1e3 * GEOMETRY.wheel_separation:g} mm",
        f"apart, on two 6 V gearmotors of different friction; {DISCS} pairs of discs (1 % irregular, 374 counts a",
        f"turn), each both ways round. {SIDE:g} m at {FORWARD[0].linear} m/s, 90° at {degrees(TURN[0].angular):g}°/s,",
        "four times, by velocities alone: nobody corrects the path.",
        "",
        "| controllers | `travel_gain` | gap, mean | gap, worst | corner off | heading off | odometry off | well |",
        "|---|---:|---:|---:|---:|---:|---:|---|",
        *(row(loop, gain) for gain in TRAVEL_GAINS for loop in loops(models)),
        row(loops(models)[0], TRAVEL_GAINS[-1], JITTER),
        "",
        "Gap: from start to end, of the side's length. Corner, heading at the end, odometry (where the robot says it",
        "is beside where it is): the worst. `travel_gain` [1/s]: what a wheel is behind its way is made up for in the",
        "next motion; with 0 every start and stop leaves its own error, and it adds up.",
        "",
        "Each motor as it was identified from the profile 'rich' (in brackets as it is):",
        "",
        "| motor | kv [V·s/rad] | ka [V·s²/rad] | ks [V] | breakaway [V] |",
        "|---|---:|---:|---:|---:|",
        *found,
    ]
    write_section(PAGE, lines)
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
