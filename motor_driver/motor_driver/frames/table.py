"""Every kind of frame by its number on the wire."""

from typing import TypeAlias

from motor_driver.frames.from_board import Features, FromBoard, Hello, Pong, Protection, Sensed, Telemetry
from motor_driver.frames.from_host import Command, Configure, Enable, FromHost, Identify, Ping, Protect, Setup

Frame: TypeAlias = FromHost | FromBoard
FRAMES: dict[int, type[Frame]] = {
    kind.TYPE: kind
    for kind in (
        *(Identify, Configure, Setup, Protect, Enable, Command, Ping),
        *(Hello, Telemetry, Sensed, Pong, Features, Protection),
    )
}
