"""The emulated board as a program: the real firmware behind a pseudo-terminal, faults as parameters."""

import time
from dataclasses import fields, replace
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulation.emulator import CurrentSensor, Emulator
from motor_board.emulation.faults import Faults
from motor_board.emulation.live import LiveBoard
from motor_board.emulation.port import Port
from motor_board.emulation.shaft import EncoderConfig
from motor_board.parameters import FAULTS, PROGRAM, SET_UP
from motor_model.gearing.encoder_count import read_encoder_count
from motor_model.model_file import load
from motor_model.parameters import paper_motor
from motor_model.sensing.encoder import Lines
from motor_ros import qos
from motor_ros.clocks.steady_timer import steady_timer
from motor_ros.messages import diagnostic_message
from motor_ros.parameters import declare
from motor_ros.run import run

HELD_UP = "The emulated board was held up {} times, which is not real time: close other programs."
SUPPLY_FULL_SCALE = 60_000  # [mV] on A0's divider


class BoardEmulator(Node):
    """Declares parameters, starts the board, passes faults on."""

    def __init__(self) -> None:
        super().__init__("board_emulator")
        values, faults = declare(self, SET_UP), declare(self, FAULTS)
        model = load(str(values["model"])) if values["model"] else paper_motor()
        count, supply = read_encoder_count(values), float(values["supply_voltage"])
        pulses, channels = count.edges_per_revolution // count.quadrature, 1 if count.single_channel else 2
        model = replace(model, max_voltage=supply) if supply > 0.0 else model
        config = FirmwareConfig(
            bridge=str(values["bridge"]),
            chip=str(values["chip"]),
            board_id=int(values["board_id"]),
            edges_per_revolution=pulses,
            channels=channels,
            supply_full_scale=SUPPLY_FULL_SCALE if supply > 0.0 else 0,
            current_sense=bool(values["current_sense"]),
        )
        encoder = EncoderConfig(
            pulses,
            float(values["slot_irregularity"]),
            int(values["seed"]),
            channels=channels,
            lines=Lines(float(values["duty_cycle"]), float(values["channel_phase"])) if channels == 2 else None,
            gear=count.gear if count.gear != 1 else None,
        )
        emulator = Emulator(firmware(config), model, encoder)
        emulator.sensor = CurrentSensor(float(values["current_gain"]), float(values["current_offset"]))
        emulator.supply(5e3 * supply / SUPPLY_FULL_SCALE)
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
        told = diagnostic_message(
            f"{self.get_fully_qualified_name()}: truth",
            DiagnosticStatus.OK,
            HELD_UP.format(truth.held_up) if truth.held_up else "",
            {key: str(value) for key, value in values.items()},
            self.get_clock().now().to_msg(),
        )
        self._diagnostics.publish(told)

    def destroy_node(self) -> None:
        """Take the port away, then the node."""
        self._board.close()
        super().destroy_node()


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_board board_emulator`."""
    return run(BoardEmulator, args, program=PROGRAM)
