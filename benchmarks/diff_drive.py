"""A differential drive closes a square: two motors of different friction, identified, with feed-forward and without.

Everything but ROS runs: the velocities of a user, `motor_examples`' drive and odometry, two controllers as their node
sets them up, two simulated boards with irregular discs. The velocities are open loop: nobody looks where the robot is.
Each motor is identified from half a minute of its own, offline, and its controller tuned by that.
"""

import os
import sys
from dataclasses import dataclass, field
from math import degrees, hypot, pi
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

from machine import machine

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.run import Config as ControlConfig
from motor_control.parameters import ROWS
from motor_examples.diff_drive import drive
from motor_examples.diff_drive.kinematics import STILL, Geometry, Limits, Twist
from motor_examples.diff_drive.odometry import Pose, advance_pose
from motor_examples.diff_drive.wheel import Wheel, follow_controller, follow_sample
from motor_identification.experiment import make_plan, simulate_plan
from motor_identification.identify import Request, identify
from motor_identification.recording import check, recording_of
from motor_model.excitation import PROFILES
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard

RESULTS = Path(__file__).with_name("results")
RATE = 200.0  # [Hz] of both boards
DRIVE_EVERY = 4  # samples: the drive runs at 50 Hz
TAU = 0.03  # [s] closed-loop time constant
GEOMETRY = Geometry(wheel_radius=0.033, wheel_separation=0.16)
LIMITS = Limits(linear_acceleration=0.5, angular_acceleration=4.0)
SIDE = 1.0  # [m]
FORWARD, TURN, PAUSE = (Twist(0.2, 0.0), 5.0), (Twist(0.0, pi / 4.0), 2.0), (STILL, 1.0)  # velocity, [s]
EFFECTS = ("static_friction",)
# A 6 V gearmotor at its output shaft, 11 pulses a motor turn and 34:1: what differs between the two is friction and kv.
LEFT = {"kv": 0.50, "ka": 0.030, "ks": 0.5, "breakaway_voltage": 0.7, "stribeck_speed": 0.3}
RIGHT = {"kv": 0.52, "ka": 0.031, "ks": 1.1, "breakaway_voltage": 1.6, "stribeck_speed": 0.3}
TRUE = tuple(Parameters(values, EFFECTS, 6.0, name) for values, name in ((LEFT, "left"), (RIGHT, "right")))
DISCS = 3
TRAVEL_GAINS = (0.0, 2.0)  # [1/s] off, and the default


def board_of(seed: int) -> BoardConfig:
    """A board with two channels and a disc of its own."""
    return BoardConfig(
        sample_rate=RATE, edges_per_revolution=374, single_channel=False, slot_irregularity=0.01, seed=seed
    )


def identified(truth: Parameters, seed: int) -> Parameters:
    """Identify a motor from the profile 'rich'."""
    board = board_of(seed)
    info = board.info(truth)
    plan = make_plan(PROFILES["rich"], None, truth.max_voltage, info.sample_period)
    samples = [sample for _, sample in simulate_plan(plan, truth, board)]
    return identify([check(recording_of(samples, info, truth.name))], Request(EFFECTS)).parameters


@dataclass(frozen=True)
class Loop:
    """How both motors are controlled."""

    name: str
    models: tuple[Parameters, Parameters]
    values: dict[str, object]

    def config(self, side: int, board: BoardConfig) -> ControlConfig:
        model = self.models[side]
        gains = {"kp": model.value("ka") / TAU, "ki": model.value("kv") / TAU}
        values = {row.name: row.default for row in ROWS} | gains | self.values
        return config_of(values, board.info(TRUE[side]), model)  # type: ignore[arg-type]


@dataclass
class Motor:
    """One wheel: board, controller, and what the drive knows of it."""

    config: ControlConfig
    board: SimulatedBoard
    wheel: Wheel
    state: controller.State = field(default_factory=controller.State)
    voltage: float = 0.0
    states: set[str] = field(default_factory=set)

    def sample(self, now: float) -> None:
        sample = self.board.sample(self.voltage)
        output, self.state = controller.update(self.config, self.state, sample, None, now)
        self.voltage = output.terms.voltage if output.drives else 0.0
        self.wheel = follow_sample(self.wheel, sample, now)
        self.wheel = follow_controller(self.wheel, output.state, output.reason, self.voltage, now)
        self.states.add(output.state)

    def refer(self, reference: float, now: float) -> None:
        self.state = controller.refer(self.state, reference, now)


@dataclass(frozen=True)
class Square:
    """Where a square ended, and where the odometry says it did."""

    end: Pose
    seen: Pose
    corners: tuple[Pose, ...]
    healthy: bool

    @property
    def gap(self) -> float:
        """[m] from the start."""
        return hypot(self.end.x, self.end.y)

    @property
    def off(self) -> float:
        """[m] from the corner of the square, at the worst of its four."""
        way = 1.0 if self.end.heading > 0.0 else -1.0
        wanted = ((SIDE, 0.0), (SIDE, way * SIDE), (0.0, way * SIDE), (0.0, 0.0))
        reached = self.corners[2::4]  # after the pause behind each side
        return max(hypot(pose.x - x, pose.y - y) for pose, (x, y) in zip(reached, wanted, strict=True))

    @property
    def odometry_error(self) -> float:
        """[m] between where the robot is and where it says it is."""
        return hypot(self.end.x - self.seen.x, self.end.y - self.seen.y)


def plan_of(way: float) -> list[tuple[Twist, float]]:
    """Velocities of a square to the left (way 1) or to the right (-1)."""
    twist, duration = TURN
    turn = (Twist(0.0, way * twist.angular), duration)
    return [PAUSE, *[FORWARD, PAUSE, turn, PAUSE] * 4]


def drive_square(loop: Loop, seed: int, way: float = 1.0, travel_gain: float = 0.0) -> Square:
    """Drive one square on discs of a seed."""
    motors = []
    for side, name in enumerate(("left", "right")):
        board = board_of(100 + 2 * seed + side)
        wheel = Wheel(name, info=board.info(TRUE[side]))
        motors.append(Motor(loop.config(side, board), SimulatedBoard(TRUE[side], board), wheel))
    config, state = drive.Config(GEOMETRY, LIMITS, travel_gain=travel_gain), drive.State()
    true = seen = Pose()
    corners, counted, k, healthy = [], [0.0, 0.0], 0, True
    for twist, duration in plan_of(way):
        for _ in range(round(duration * RATE)):
            now, before = k / RATE, [motor.board.angle for motor in motors]
            for motor in motors:
                motor.sample(now)
            true = advance_pose(GEOMETRY, true, *(m.board.angle - b for m, b in zip(motors, before, strict=True)))
            if k % DRIVE_EVERY == 0:
                state = drive.take_command(config, state, twist, now)
                wheels = (motors[0].wheel, motors[1].wheel)
                decision, state = drive.step(config, state, wheels, now)
                healthy &= decision.healthy
                for motor, reference in zip(motors, decision.references or (), strict=False):
                    motor.refer(reference, now)
                angles = [motor.wheel.angle for motor in motors]
                turned = [a - b for a, b in zip(angles, counted, strict=True)]
                seen, counted = advance_pose(GEOMETRY, seen, *turned), angles
            k += 1
        corners.append(true)
    return Square(true, seen, tuple(corners), healthy)


def row(loop: Loop, travel_gain: float) -> str:
    """A line of the table: mean and worst of all discs and both ways."""
    squares = [drive_square(loop, seed, way, travel_gain) for seed in range(DISCS) for way in (1.0, -1.0)]
    gaps = [100.0 * square.gap / SIDE for square in squares]
    turns = [abs(degrees(abs(square.end.heading) - 2.0 * pi)) for square in squares]
    odometry = [1e3 * square.odometry_error for square in squares]
    healthy = all(square.healthy for square in squares)
    mean = sum(gaps) / len(gaps)
    corner = 1e3 * max(square.off for square in squares)
    cells = f"{mean:.2f} % | {max(gaps):.2f} % | {corner:.0f} mm | {max(turns):.1f}° | {max(odometry):.1f} mm"
    return f"| {loop.name} | {travel_gain:g} | {cells} | {'yes' if healthy else 'no'} |"


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
        f"{machine()}. Simulated: wheels of {1e3 * GEOMETRY.wheel_radius:g} mm, {1e3 * GEOMETRY.wheel_separation:g} mm",
        f"apart, on two 6 V gearmotors of different friction; {DISCS} pairs of discs (1 % irregular, 374 counts a",
        f"turn), each both ways round. {SIDE:g} m at {FORWARD[0].linear} m/s, 90° at {degrees(TURN[0].angular):g}°/s,",
        "four times, by velocities alone: nobody corrects the path. `python benchmarks/diff_drive.py`",
        "",
        "| controllers | `travel_gain` | gap, mean | gap, worst | corner off | heading off | odometry off | well |",
        "|---|---:|---:|---:|---:|---:|---:|---|",
        *(row(loop, gain) for gain in TRAVEL_GAINS for loop in loops(models)),
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
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "diff_drive.md").write_text("\n".join([*lines, ""]), encoding="utf-8")
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
