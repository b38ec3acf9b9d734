"""What the driver is told at its start."""

from dataclasses import dataclass

from motor_driver.frames import BAUD, Configure, Decay, Hello
from motor_model.sample import Info, Measurement

SILENCE = 0.12  # [s] without telemetry, or for the board without commands: then it is 0 V within 150 ms
LEAST_TIMEOUT = 0.05  # [s] of the board: no computer is quicker for certain
# Of the firmware: 1.0 has no pull-ups on the encoder's lines, so that a lost cable makes stray edges, and it counts a
# shaft that dithers over one flank as turning.
OLDEST = (1, 1)
USUAL_TICK = 500  # [ns] of the boards there are, before one has said so


@dataclass(frozen=True, slots=True)
class Config:
    """The plant's parameters that the driver's logic needs."""

    name: str = "motor"
    sample_rate: float = 200.0  # [Hz]
    edges_per_revolution: int = 96
    single_channel: bool = True
    max_voltage: float = 12.0  # [V] of the motor
    supply_voltage: float = 0.0  # [V] at full duty, where the board does not measure it; 0: as max_voltage
    command_timeout: float = 0.1  # [s]
    stall_time: float = 0.4  # [s] 0: the driver never stops the motor
    decay: Decay = Decay.BRAKE
    baud: int = BAUD
    board_id: int | None = None  # None: any
    reverse_motor: bool = False  # its two wires are exchanged
    reverse_encoder: bool = False  # its two channels are exchanged

    @property
    def silence(self) -> float:
        """[s] without telemetry after which the output is switched off."""
        return max(SILENCE, 1.5 / self.sample_rate)

    @property
    def full_voltage(self) -> float:
        """[V] at full duty, as far as the parameters say."""
        return self.supply_voltage or self.max_voltage

    def configure(self, board: Hello) -> Configure:
        """What to ask of this board."""
        period = max(round(1e9 / self.sample_rate / board.tick_ns), board.shortest_period)
        timeout = min(max(1.2 * self.command_timeout, LEAST_TIMEOUT), SILENCE)
        return Configure(period, round(timeout * 1e3), self.decay)

    def refusal(self, board: Hello) -> str:
        """Why this board cannot be used as configured; empty if it can."""
        edges, channels = self.edges_per_revolution, 1 if self.single_channel else 2
        if (board.firmware_major, board.firmware_minor) < OLDEST:
            return (
                f"The board runs firmware {board.firmware_major}.{board.firmware_minor}, and this driver needs "
                f"{OLDEST[0]}.{OLDEST[1]} or a newer one: flash the board again (ros2 run motor_board flash)."
            )
        if self.board_id not in (None, board.board_id):
            number = f"number {board.board_id}" if board.board_id else "without a number"
            return (
                f"This is the board {number}, and the parameter board_id is {self.board_id}: plug the right board in, "
                "set port or board_id, or flash its number (ros2 run motor_board flash --board-id)."
            )
        if board.edges_per_revolution not in (0, edges):
            return (
                f"The board was flashed for an encoder with {board.edges_per_revolution} edges per revolution, and the "
                f"parameter edges_per_revolution is {edges}: set the parameter, or flash the board again."
            )
        if board.channels != channels:
            return (
                f"The board reads {board.channels} encoder channel(s), and single_channel is "
                f"{str(self.single_channel).lower()}: set the parameter, or flash the board again."
            )
        return ""

    def info(self, board: Hello | None) -> Info:
        """How to read the samples; `board` is None before it has said who it is."""
        tick = board.tick_ns if board else USUAL_TICK
        return Info(
            name=self.name,
            source="hardware",
            measurement=Measurement.EDGES,
            edges_per_revolution=self.edges_per_revolution,
            single_channel=self.single_channel,
            edge_resolution=tick / 1e9,
            sample_period=board.sample_period * tick / 1e9 if board else 1.0 / self.sample_rate,
            max_voltage=min(self.max_voltage, self.full_voltage),
            supply_voltage=self.full_voltage,
            decay=Decay(board.decay).name.lower() if board else self.decay.name.lower(),
        )
