"""What a board says, for tests of the driver's modules: a hello and telemetry with what matters changed."""

from dataclasses import replace

from motor_driver.frames.codes import NOT_MEASURED, Decay, Flag, ResetCause
from motor_driver.frames.from_board import Hello, Telemetry

HELLO = Hello(
    firmware_major=1,
    firmware_minor=1,  # it has no choice of counting: see SETUP of the driver
    firmware_patch=3,
    board=1,
    board_id=0,
    edges_per_revolution=96,
    channels=1,
    tick_ns=500,
    pwm_top=256,
    decay=Decay.BRAKE,
    sample_period=10_000,
    shortest_period=2_000,
    command_timeout=100,
    reset_cause=ResetCause.POWER_ON,
    boot=7,
    latch=1,
)
TELEMETRY = Telemetry(
    time=10_000,
    duty=0,
    edge_count=0,
    edge_time=0,
    edge_period=0,
    supply=NOT_MEASURED,
    command=0,
    flags=0,
    errors=0,
    boot=7,
    latch=2,
)


def enabled(on: bool = True) -> Telemetry:
    """Telemetry of a board whose output follows commands, or not."""
    return replace(TELEMETRY, flags=Flag.ENABLED if on else 0)
