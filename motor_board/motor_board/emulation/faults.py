"""What can be wrong around an emulated board: its wiring, and between it and its computer bytes, plug and clock."""

from dataclasses import dataclass

from motor_board.emulation.wiring import Wiring


@dataclass(frozen=True)
class Faults(Wiring):
    """The switches; as they stand here, nothing is wrong."""

    bit_error_rate: float = 0.0  # share of bits flipped, both ways
    drop_rate: float = 0.0  # share of bytes lost, both ways
    delay: float = 0.0  # [s] bytes come late by 0 … delay, both ways, in order
    plugged: bool = True  # false: the port is gone; the board runs on its own supply
    stuck_telemetry: bool = False  # the board is heard no more, but hears
    encoder_connected: bool = True
    stray_edges: float = 0.0  # [1/s] that the encoder's line picks up
    reset_on_open: bool = False  # as an Uno, which is reset when its port is opened
    clock_error: float = 0.0  # [ppm] by which the board's crystal is fast
