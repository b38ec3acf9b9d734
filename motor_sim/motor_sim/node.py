"""The simulated motor: pretends to be the board, in real time, with an honest encoder."""

import time
from dataclasses import replace

from rclpy.node import Node

from motor_model.model_file import load
from motor_model.parameters import paper_motor
from motor_model.sensing.board import SimulatedBoard
from motor_model.sensing.motion_check import MotionCheck
from motor_ros.clocks.steady_timer import steady_timer
from motor_ros.gate import Gate
from motor_ros.messages import time_message
from motor_ros.parameters import SHARED_PARAMETERS, declare, max_voltage_row
from motor_ros.plant import Plant
from motor_ros.run import quick_executor, run
from motor_sim.parameters import PARAMETERS, PROGRAM, board_config_of

MOST_BEHIND = 500_000_000  # [ns] a process that was held up longer than this does not catch up
# [ns] without a sample, then: to who estimates their age, a clock that stood still is a link that holds samples back,
# for minutes, unless nothing comes for 0.4 s (`motor_control/controller/timing/latency.py`).
STILL = 500_000_000
HELD_UP = (
    "The simulation was held up {} times in the last second, which is not real time: close other programs, or lower "
    "sample_rate."
)


class MotorSim(Node):
    """Samples a `SimulatedBoard` on the wall clock and publishes what it reports."""

    def __init__(self) -> None:
        super().__init__("motor_sim")
        values = declare(self, (*SHARED_PARAMETERS, *PARAMETERS))
        model = load(str(values["model"])) if values["model"] else paper_motor()
        limit = declare(self, (max_voltage_row(model.max_voltage),))["max_voltage"]
        limit, supply = float(limit), float(values["supply_voltage"]) or float(limit)
        resistance = float(values["resistance"]) or model.resistance
        torque_constant = float(values["torque_constant"]) or model.torque_constant
        model = replace(model, max_voltage=supply, resistance=resistance, torque_constant=torque_constant)
        config = board_config_of(values)
        self._board = SimulatedBoard(model, config)
        self._board.sample(0.0)  # compiled now, not in the first sample
        gate = Gate(bool(values["enabled_at_start"]), float(values["command_timeout"]), 1.0 / config.sample_rate)
        self._check = MotionCheck(limit, config.single_channel, float(values["stall_time"]))
        info = replace(config.info(model), max_voltage=min(limit, supply), supply_voltage=supply)
        self._plant = Plant(self, info, gate)
        self._period = round(1e9 / config.sample_rate)  # [ns]
        self._sampled = time.monotonic_ns()
        self._next, self._late = self._sampled + self._period, 0
        steady_timer(self, 1.0 / config.sample_rate, self._on_timer)
        steady_timer(self, 1.0, self._on_second)
        effects = ", ".join(model.effects) or "no effects beyond kv and ka"
        self.get_logger().info(
            f"Simulating '{model.name}' ({effects}): {config.sample_rate:g} Hz, {min(limit, supply):g} V."
        )

    def doubt(self, why: str) -> None:
        """Leave the output off: what was given does not reach the node, and the motor may be another than it takes."""
        self._plant.stop(why)

    def _on_timer(self) -> None:
        now = time.monotonic_ns()
        to_ros = self._plant.now() - now
        due = find_due(self._next, now, self._sampled)
        self._next, self._late = due, self._late + (due != self._next)
        while self._next <= now:
            sample = self._board.sample(self._plant.voltage(self._next))
            self._plant.publish(sample, time_message(self._next + to_ros))
            self._check = self._check.see(sample)
            if self._check.stop and self._plant.gate.enabled:
                self._plant.stop(self._check.stop, motor=True)
            self._next += self._period
            self._sampled = time.monotonic_ns()

    def _on_second(self) -> None:
        self._plant.diagnose(
            HELD_UP.format(self._late) if self._late else "",
            {"true speed [rad/s]": f"{self._board.speed:.4f}", "true angle [rad]": f"{self._board.angle:.4f}"},
        )
        self._late = 0


def find_due(due: int, now: int, sampled: int) -> int:
    """Find when [ns] a sample is due that was at `due`: later, where the process was held up for too long.

    sampled: when the latest one was made.
    """
    return max(now, sampled + STILL) if now - due > MOST_BEHIND else due


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_sim motor_sim`."""
    return run(MotorSim, args, quick_executor, PROGRAM)
