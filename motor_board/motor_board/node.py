"""The emulated board as a program: the real firmware behind a pseudo-terminal, faults as parameters."""

import time
from dataclasses import fields, replace
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulator import Emulator
from motor_board.faults import Faults
from motor_board.live import LiveBoard
from motor_board.port import Port
from motor_board.shaft import EncoderConfig
from motor_model.model_file import load
from motor_model.parameters import paper_motor
from motor_ros import qos
from motor_ros.parameters import Row, declare
from motor_ros.plant import steady_timer
from motor_ros.program import Program
from motor_ros.run import run

SET_UP = (
    Row("link", "/tmp/motor_board", "path under which the board's serial port appears", read_only=True),
    Row("model", "", "model file (YAML) of the motor on the pins; empty: the paper's motor", read_only=True),
    Row("edges_per_revolution", 96, "encoder edges of one polarity per turn", "", 1, 65535, read_only=True),
    Row("single_channel", True, "the encoder has one channel and does not measure direction", read_only=True),
    Row("slot_irregularity", 0.0, "scatter of the disc's flanks, share of a slot", "", 0.0, 0.2, read_only=True),
    Row("seed", 0, "of the disc, its starting angle, missed edges and faults", "", 0, 2**31 - 1, read_only=True),
    Row("bridge", "l298n", "bridge that the firmware is built for: l298n or tb6612", read_only=True),
    Row(
        "supply_voltage",
        0.0,
        "voltage at full duty, which the board measures; 0: as max_voltage of the model, not measured",
        "V",
        0.0,
        60.0,
        read_only=True,
    ),
)
FAULTS = (
    Row("bit_error_rate", 0.0, "share of bits that flip on the line, both ways", "", 0.0, 0.5),
    Row("drop_rate", 0.0, "share of bytes lost on the line, both ways", "", 0.0, 1.0),
    Row("delay", 0.0, "bytes come late by 0 to this, both ways, in order", "s", 0.0, 1.0),
    Row("plugged", True, "false: the serial port is gone"),
    Row("stuck_telemetry", False, "the board is heard no more, but hears"),
    Row("encoder_connected", True, "false: no edges reach the board"),
    Row("stray_edges", 0.0, "edges that the encoder's line picks up, at random times", "1/s", 0.0, 10000.0),
    Row("reset_on_open", False, "opening the port resets the board, as an Uno's does"),
    Row("clock_error", 0.0, "by which the board's crystal is fast", "ppm", -10000.0, 10000.0),
)
PROGRAM = Program(
    "motor_board",
    "board_emulator",
    "The board's real firmware on an emulated ATmega328P behind a serial port, with a simulated motor on its pins.\n"
    "Faults are parameters that can be set while it runs; ~/reset presses its button, ~/hang hangs its firmware.",
    (*SET_UP, *FAULTS),
    "ros2 run motor_board board_emulator --ros-args -p link:=board -p model:=model.yaml",
    publishes=("/diagnostics",),
)
HELD_UP = "The emulated board was held up {} times, which is not real time: close other programs."
SUPPLY_FULL_SCALE = 60_000  # [mV] on A0's divider


class BoardEmulator(Node):
    """Declares parameters, starts the board, passes faults on."""

    def __init__(self) -> None:
        super().__init__("board_emulator")
        values, faults = declare(self, SET_UP), declare(self, FAULTS)
        model = load(str(values["model"])) if values["model"] else paper_motor()
        edges, supply = int(values["edges_per_revolution"]), float(values["supply_voltage"])
        model = replace(model, max_voltage=supply) if supply > 0.0 else model
        config = FirmwareConfig(
            bridge=str(values["bridge"]),
            edges_per_revolution=edges,
            channels=1 if values["single_channel"] else 2,
            supply_full_scale=SUPPLY_FULL_SCALE if supply > 0.0 else 0,
        )
        encoder = EncoderConfig(
            edges,
            float(values["slot_irregularity"]),
            int(values["seed"]),
            channels=1 if values["single_channel"] else 2,
        )
        emulator = Emulator(firmware(config), model, encoder)
        emulator.chip.supply(5e3 * supply / SUPPLY_FULL_SCALE)
        self._board = LiveBoard(emulator, Port(Path(str(values["link"]))), int(values["seed"]))
        self._board.faults = Faults(**faults)  # type: ignore[arg-type]
        self.add_on_set_parameters_callback(self._on_parameters)
        self.create_service(Trigger, "~/reset", self._on_reset)
        self.create_service(Trigger, "~/hang", self._on_hang)
        self._diagnostics = self.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
        steady_timer(self, 1.0, self._on_second)
        self.get_logger().info(f"The board's serial port is {values['link']}; the motor on its pins is '{model.name}'.")

    def _on_parameters(self, parameters: list[Parameter]) -> SetParametersResult:
        names = {field.name for field in fields(Faults)}
        changes = {parameter.name: parameter.value for parameter in parameters if parameter.name in names}
        self._board.faults = replace(self._board.faults, **changes)
        return SetParametersResult(successful=True)

    def _on_reset(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self._board.reset()
        response.success, response.message = True, "The board's reset button was pressed."
        return response

    def _on_hang(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self._board.hang()
        response.success, response.message = True, "The firmware is in an endless loop, which its watchdog ends."
        return response

    def _on_second(self) -> None:
        if self._board.error is not None:
            raise self._board.error
        truth = self._board.truth()
        values = truth.named(time.time_ns() - time.monotonic_ns())
        status = DiagnosticStatus(
            name=f"{self.get_fully_qualified_name()}: truth",
            message=HELD_UP.format(truth.held_up) if truth.held_up else "",
            values=[KeyValue(key=key, value=str(value)) for key, value in values.items()],
        )
        array = DiagnosticArray(status=[status])
        array.header.stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(array)

    def destroy_node(self) -> None:
        """Take the port away, then the node."""
        self._board.close()
        super().destroy_node()


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_board board_emulator`."""
    return run(BoardEmulator, args, program=PROGRAM)
