"""The square on two emulated boards in lockstep: the real firmware, driver, controller and drive, on the chips' clock.

Motors, discs and geometry are those of `diff_drive.py`; the controllers have the true models. `diff_drive_live.py` is
the same in real time, over ROS 2, where the machine has the time for it.
"""

import argparse
import sys
from dataclasses import dataclass, field
from math import degrees, pi
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

from diff_drive_square import DRIVE_EVERY, GEOMETRY, LIMITS, SIDE, TRUE, Loop, Square, board_of, plan_of
from driver_rig import Rig
from machine import commit, machine
from page_sections import write_section

from motor_board.build import FirmwareConfig
from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.shaft import EncoderConfig
from motor_control.controller import controller
from motor_driver.config import Config
from motor_examples.diff_drive import drive
from motor_examples.diff_drive.odometry import Pose, advance_pose
from motor_examples.diff_drive.wheel import Wheel, follow_controller, follow_sample
from motor_model.sample import Sample

PAGE = Path(__file__).with_name("results") / "diff_drive.md"
RATE, EDGES = 200.0, 374
LOOK = FREQUENCY // 2000  # [cycle] between two looks at the port
OURS = Loop("", TRUE, {"speed_source": "observer", "feedforward": True, "voltage_limit": 6.0})


@dataclass
class BoardWheel:
    """One wheel: emulated board with its driver, controller, and what the drive knows of it."""

    side: int
    seed: int
    state: controller.State = field(default_factory=controller.State)

    def __post_init__(self) -> None:
        told = Config(sample_rate=RATE, edges_per_revolution=EDGES, single_channel=False, max_voltage=6.0)
        self.rig = Rig(
            config=told,
            parameters=TRUE[self.side],
            firmware=FirmwareConfig(channels=2),
            encoder=EncoderConfig(EDGES, 0.01, self.seed),
            step=LOOK,
            hear=self._answer,
        )
        self.config = OURS.config(self.side, board_of(self.seed))
        self.wheel, self._sent = Wheel(TRUE[self.side].name, info=self.rig.driver.info, reference_timeout=0.5), 0
        self.rig.plug()

    @property
    def now(self) -> float:
        """[s]."""
        return self.rig.now * 1e-9

    def _answer(self, sample: Sample) -> None:
        output, self.state = controller.update(self.config, self.state, sample, None, self.now)
        if output.drives:
            self._sent += 1
            self.rig.gate = self.rig.gate.take(output.terms.voltage, self.rig.now, "", self._sent)
        self.wheel = follow_sample(self.wheel, sample, self.now)
        self.wheel = follow_controller(self.wheel, output.state, output.reason, output.terms.voltage, self.now)


def square(seed: int, way: float) -> Square:
    """Drive one square."""
    wheels = [BoardWheel(side, 100 + 2 * seed + side) for side in (0, 1)]
    config, state = drive.Config(GEOMETRY, LIMITS), drive.State()
    true = seen = Pose()
    counted, corners, healthy, step = [0.0, 0.0], [], True, DRIVE_EVERY / RATE
    for one in wheels:
        one.rig.run(1000.0)
    for twist, duration in plan_of(way):
        for _ in range(round(duration / step)):
            before = [one.rig.emulator.shaft.angle for one in wheels]
            for one in wheels:
                one.rig.run(1000.0 * step)
            now = wheels[0].now
            after = [one.rig.emulator.shaft.angle for one in wheels]
            true = advance_pose(GEOMETRY, true, *(a - b for a, b in zip(after, before, strict=True)))
            state = drive.take_command(config, state, twist, now)
            decision, state = drive.step(config, state, (wheels[0].wheel, wheels[1].wheel), now)
            healthy &= decision.healthy
            for one, reference in zip(wheels, decision.references or (), strict=False):
                one.state = controller.refer(one.state, reference, now)
            angles = [one.wheel.angle for one in wheels]
            seen = advance_pose(GEOMETRY, seen, *(a - b for a, b in zip(angles, counted, strict=True)))
            counted = angles
        corners.append(true)
    for one in wheels:
        one.rig.close()
    return Square(true, seen, tuple(corners), healthy)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--discs", type=int, default=3)
    options = parser.parse_args()
    lines = [
        "## On two emulated boards",
        "",
        f"`python benchmarks/diff_drive_boards.py --discs {options.discs}` at {commit()}, {machine()}.",
        "",
        "The real firmware of both boards on emulated chips, the driver, the controllers with observer and",
        "feed-forward (the true models) and the drive with its default `travel_gain`, in lockstep on the chips' clock;",
        f"two channels of {EDGES} edges, {RATE:g} Hz.",
        "",
        "| discs | way | gap | corner off | heading off | odometry off | well |",
        "|---|---|---:|---:|---:|---:|---|",
    ]
    for seed in range(options.discs):
        for way in (1.0, -1.0):
            one = square(seed, way)
            turned = abs(degrees(abs(one.end.heading) - 2.0 * pi))
            cells = f"{one.gap / SIDE:.2%} | {1e3 * one.off:.0f} mm | {turned:.1f}° | {1e3 * one.odometry_error:.1f} mm"
            side = "left" if way > 0 else "right"
            lines.append(f"| {seed} | {side} | {cells} | {'yes' if one.healthy else 'no'} |")
            print(lines[-1], flush=True)
    write_section(PAGE, lines)
    return 0


if __name__ == "__main__":
    sys.exit(main())
