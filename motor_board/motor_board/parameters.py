"""The parameters of the emulated board, as tables: how it is set up, and its faults."""

from motor_ros.parameters import Row
from motor_ros.program import Program

SET_UP = (
    Row("link", "/tmp/motor_board", "path under which the board's serial port appears", read_only=True),
    Row("model", "", "model file (YAML) of the motor on the pins; empty: the paper's motor", read_only=True),
    Row("edges_per_revolution", 96, "encoder edges of one polarity per turn", "", 1, 65535, read_only=True),
    Row("single_channel", True, "the encoder has one channel and does not measure direction", read_only=True),
    Row("quadrature", 1, "the driver's; 2 and 4: the encoder has two channels", "", 1, 4, read_only=True),
    Row("pulses_per_revolution", 0, "periods of one channel per encoder turn", "", 0, 65535, read_only=True),
    Row("gear_ratio", "1", "encoder turns per turn of the output: 34.014, 9291/273", read_only=True, any_kind=True),
    Row("duty_cycle", 0.5, "share of a period that a channel is high", "", 0.3, 0.7, read_only=True),
    Row("channel_phase", 0.25, "share of a period by which B is behind A", "", 0.1, 0.29, read_only=True),
    Row("slot_irregularity", 0.0, "scatter of the disc's flanks, share of a slot", "", 0.0, 0.2, read_only=True),
    Row("seed", 0, "of the disc, its starting angle, missed edges and faults", "", 0, 2**31 - 1, read_only=True),
    Row("bridge", "l298n", "bridge that the firmware is built for: l298n, tb6612 or drv8871", read_only=True),
    Row("chip", "atmega328p", "chip that the firmware is built for: atmega328p or atmega2560", read_only=True),
    Row("board_id", 0, "number that the board is flashed with; 0: none", "", 0, 65535, read_only=True),
    Row("current_sense", False, "the board senses the current, of a model that has a resistance", read_only=True),
    Row("current_gain", 0.185, "of the sensor on A1", "V/A", -10.0, 10.0, read_only=True),
    Row("current_offset", 2.5, "of the sensor on A1, without a current", "V", 0.0, 5.0, read_only=True),
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
    Row("motor_swapped", False, "the motor's two wires are exchanged"),
    Row("channels_swapped", False, "the encoder's two channels are exchanged"),
    Row("a_connected", True, "false: channel A does not reach the board"),
    Row("b_connected", True, "false: channel B does not reach the board"),
    Row("powered", True, "false: the motor's supply is off"),
    Row("bridge_stuck", 0.0, "share of the full voltage that the bridge gives whatever it is told", "", -1.0, 1.0),
    Row("shaft_stuck", False, "something holds the shaft"),
    Row("hum", 0.0, "of the mains, on encoder lines that no pull-up holds; 0: none", "Hz", 0.0, 400.0),
    Row("hand", 0.0, "with which a hand turns the shaft, as if it were at the motor", "V", -1000.0, 1000.0),
    Row("reset_on_open", False, "opening the port resets the board, as an Uno's does"),
    Row("clock_error", 0.0, "by which the board's crystal is fast", "ppm", -10000.0, 10000.0),
)
PROGRAM = Program(
    "motor_board",
    "board_emulator",
    "The board's real firmware on an emulated chip behind a serial port, with a simulated motor on its pins.\n"
    "Faults are parameters that can be set while it runs; ~/reset presses its button, ~/hang hangs its firmware.",
    (*SET_UP, *FAULTS),
    "ros2 run motor_board board_emulator --ros-args -p link:=board -p model:=model.yaml",
    publishes=("/diagnostics",),
)
