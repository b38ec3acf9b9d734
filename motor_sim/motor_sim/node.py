"""The simulated motor: pretends to be the board, in real time, with an honest encoder."""

import time
from dataclasses import replace

from rclpy.node import Node

from motor_model.gearing.encoder_count import read_encoder_count
from motor_model.model_file import load
from motor_model.parameters import paper_motor
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.sensing.encoder import Lines
from motor_model.sensing.motion_check import MotionCheck
from motor_ros.gate import Gate
from motor_ros.messages import time_message
from motor_ros.parameters import SHARED_PARAMETERS, Row, declare, max_voltage_row
from motor_ros.plant import Plant, steady_timer
from motor_ros.program import PLANT_PUBLISHES, Program
from motor_ros.run import quick_executor, run

PARAMETERS = (
    Row("model", "", "model file (YAML) to simulate; empty: the paper's motor", read_only=True),
    Row("edge_resolution", 4e-6, "tick of the timer that stamps edges; 0: exact", "s", 0.0, 1e-3, read_only=True),
    Row(
        "slot_irregularity",
        0.0,
        "scatter of the disc's flanks, share of a slot",
        "",
        0.0,
        0.2,
        read_only=True,
    ),
    Row(
        "resistance",
        0.0,
        "of the cold armature; with it motor/speed has a current; 0: the model file's, or none",
        "Ω",
        0.0,
        1000.0,
        read_only=True,
    ),
    Row(
        "torque_constant",
        0.0,
        "also the back-EMF constant: the rest of kv is viscous friction; 0: the model file's, or all of kv",
        "N·m/A",
        0.0,
        100.0,
        read_only=True,
    ),
    Row(
        "duty_cycle",
        0.5,
        "with quadrature 2 or 4: share of a period that a channel is high",
        "",
        0.3,
        0.7,
        read_only=True,
    ),
    Row(
        "channel_phase",
        0.25,
        "with quadrature 4: share of a period by which B is behind A",
        "",
        0.1,
        0.29,
        read_only=True,
    ),
    Row("seed", 0, "of the disc, its starting angle and missed edges", "", 0, 2**31 - 1, read_only=True),
)
PROGRAM = Program(
    "motor_sim",
    "motor_sim",
    "A simulated motor in real time, with an encoder as honest as the board's: start it instead of motor_driver.",
    (*SHARED_PARAMETERS, max_voltage_row(), *PARAMETERS),
    "ros2 run motor_sim motor_sim --ros-args -p model:=model.yaml -p sample_rate:=500.0 -r __ns:=/left",
    publishes=PLANT_PUBLISHES,
    subscribes=("motor/voltage",),
    services=("motor/enable",),
)
MOST_BEHIND = 0.5  # [s] a process that was held up longer than this does not catch up
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
        known = {name: float(values[name]) for name in ("resistance", "torque_constant") if values[name]}
        model = replace(model, max_voltage=supply, **known)
        fields = ("name", "sample_rate", "edge_resolution", "slot_irregularity", "seed")
        encoder = read_encoder_count(values)
        config = BoardConfig(
            **{field: values[field] for field in fields},  # type: ignore[arg-type]
            edges_per_revolution=encoder.edges_per_revolution,
            single_channel=encoder.single_channel,
            quadrature=encoder.quadrature,
            gear=encoder.gear if encoder.gear != 1 else None,
            lines=Lines(float(values["duty_cycle"]), float(values["channel_phase"])),
        )
        self._board = SimulatedBoard(model, config)
        self._board.sample(0.0)  # compiled now, not in the first sample
        gate = Gate(bool(values["enabled_at_start"]), float(values["command_timeout"]), 1.0 / config.sample_rate)
        self._check = MotionCheck(limit, config.single_channel, float(values["stall_time"]))
        info = replace(config.info(model), max_voltage=min(limit, supply), supply_voltage=supply)
        self._plant = Plant(self, info, gate)
        self._period = round(1e9 / config.sample_rate)  # [ns]
        self._next, self._late = time.monotonic_ns() + self._period, 0
        steady_timer(self, 1.0 / config.sample_rate, self._on_timer)
        steady_timer(self, 1.0, self._on_second)
        effects = ", ".join(model.effects) or "no effects beyond kv and ka"
        self.get_logger().info(
            f"Simulating '{model.name}' ({effects}): {config.sample_rate:g} Hz, {min(limit, supply):g} V."
        )

    def _on_timer(self) -> None:
        now = time.monotonic_ns()
        to_ros = self._plant.now() - now
        if now - self._next > MOST_BEHIND * 1e9:
            self._next, self._late = now, self._late + 1
        while self._next <= now:
            sample = self._board.sample(self._plant.voltage())
            self._plant.publish(sample, time_message(self._next + to_ros))
            self._check = self._check.see(sample)
            if self._check.stop and self._plant.gate.enabled:
                self._plant.stop(self._check.stop)
            self._next += self._period

    def _on_second(self) -> None:
        self._plant.diagnose(
            HELD_UP.format(self._late) if self._late else "",
            {"true speed [rad/s]": f"{self._board.speed:.4f}", "true angle [rad]": f"{self._board.angle:.4f}"},
        )
        self._late = 0


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_sim motor_sim`."""
    return run(MotorSim, args, quick_executor, PROGRAM)
