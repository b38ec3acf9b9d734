"""A robot of two simulated gearmotors drives a square: its motors, how they are controlled, where the square ended."""

from dataclasses import dataclass, field
from math import hypot, pi

import numpy as np

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.run import Config as ControlConfig
from motor_control.parameters import ROWS
from motor_examples.diff_drive import drive
from motor_examples.diff_drive.kinematics import STILL, Geometry, Limits, Twist
from motor_examples.diff_drive.odometry import Pose, advance_pose
from motor_examples.diff_drive.wheel import Wheel, follow_controller, follow_sample
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard

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


def board_of(seed: int) -> BoardConfig:
    """A board with two channels and a disc of its own."""
    return BoardConfig(
        sample_rate=RATE, edges_per_revolution=374, single_channel=False, slot_irregularity=0.01, seed=seed
    )


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


def arrivals_of(plan: list[tuple[Twist, float]], jitter: float, seed: int) -> list[tuple[float, Twist]]:
    """When [s] each velocity comes: by the plan, or up to half of `jitter` [s] sooner or later."""
    rng, at, arrivals = np.random.default_rng([seed, 3]), 0.0, []
    for twist, duration in plan:
        arrivals.append((at + jitter * float(rng.uniform(-0.5, 0.5)), twist))
        at += duration
    return [*arrivals, (at, STILL)]


def drive_square(loop: Loop, seed: int, way: float = 1.0, travel_gain: float = 0.0, jitter: float = 0.0) -> Square:
    """Drive one square on discs of a seed."""
    motors = []
    for side, name in enumerate(("left", "right")):
        board = board_of(100 + 2 * seed + side)
        wheel = Wheel(name, info=board.info(TRUE[side]), reference_timeout=0.5)
        motors.append(Motor(loop.config(side, board), SimulatedBoard(TRUE[side], board), wheel))
    config, state = drive.Config(GEOMETRY, LIMITS, travel_gain=travel_gain), drive.State()
    true = seen = Pose()
    corners, counted, healthy, twist = [], [0.0, 0.0], True, STILL
    coming = arrivals_of(plan_of(way), jitter, seed)
    for k in range(round(coming[-1][0] * RATE)):
        now, before = k / RATE, [motor.board.angle for motor in motors]
        for motor in motors:
            motor.sample(now)
        true = advance_pose(GEOMETRY, true, *(m.board.angle - b for m, b in zip(motors, before, strict=True)))
        while coming[0][0] <= now:
            at, twist = coming.pop(0)
            state = drive.take_command(config, state, twist, at)
            corners.append(true)
        if k % DRIVE_EVERY == 0:
            state = drive.take_command(config, state, twist, now)
            decision, state = drive.step(config, state, (motors[0].wheel, motors[1].wheel), now)
            healthy &= decision.healthy
            for motor, reference in zip(motors, decision.references or (), strict=False):
                motor.refer(reference, now)
            angles = [motor.wheel.angle for motor in motors]
            turned = [a - b for a, b in zip(angles, counted, strict=True)]
            seen, counted = advance_pose(GEOMETRY, seen, *turned), angles
    return Square(true, seen, (*corners[1:], true), healthy)
