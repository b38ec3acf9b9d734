"""What the driver is told at its start."""

from dataclasses import dataclass, field
from fractions import Fraction
from math import inf

from motor_driver.current_limits import CurrentLimits
from motor_driver.frames.codes import BAUD, Decay, Pwm
from motor_driver.frames.from_board import Features, Hello, Protection
from motor_driver.frames.from_host import Configure, Protect, Setup
from motor_model.sample import Info, Measurement

SILENCE = 0.12  # [s] without telemetry, or for the board without commands: then it is 0 V within 150 ms
ROUND_TRIP = 0.1  # [s] that the board may take to answer: half of it is how much later the motor does as told
# [s] likewise, however old a command may be: by as much the user's own stop acts late, and pings are known for longer.
MOST_ROUND_TRIP = 1.0
LEAST_TIMEOUT = 0.05  # [s] of the board: no computer is quicker for certain
# Of the firmware: 1.0 has no pull-ups on the encoder's lines, so that a lost cable makes stray edges, and it counts a
# shaft that dithers over one flank as turning.
OLDEST = (1, 1)
SETUP = (1, 2)  # of the firmware: knows setup, and counts both channels
PROTECT = (1, 4)  # of the firmware: watches the motor's current
# Of the firmware: before, a period whose last step of the counter was this short made it go round once more at each
# sample, and a missing command was noticed ever later; LONGEST_STEP is what it waits for at once.
STEPS, SHORT_STEP, LONGEST_STEP = (1, 4, 5), 2_000, 0x8000  # [tick]
USUAL_TICK = 500  # [ns] of the boards there are, before one has said so
MOST_TOP = 32_767  # what a command's duty can say


@dataclass(frozen=True, slots=True)
class Config:
    """The plant's parameters that the driver's logic needs."""

    name: str = "motor"
    sample_rate: float = 200.0  # [Hz]
    edges_per_revolution: int = 96  # counted in a turn of the encoder's shaft
    single_channel: bool = True
    quadrature: int = 1  # of these, in a period of one channel: 1, 2, 4
    gear: Fraction = Fraction(1)  # encoder turns per turn of the output, which speeds are of
    max_voltage: float = 12.0  # [V] of the motor
    supply_voltage: float = 0.0  # [V] at full duty, where the board does not measure it; 0: as max_voltage
    command_timeout: float = 0.1  # [s]
    stall_time: float = 0.4  # [s] 0: the driver never stops the motor
    decay: Decay = Decay.BRAKE
    pwm: Pwm = Pwm.STANDARD
    baud: int = BAUD
    current_gain: float = 0.0  # [V/A] of the sensor on the board's A1; 0: none
    current_offset: float = 2.5  # [V] of it without a current
    current_limits: CurrentLimits = field(default_factory=CurrentLimits)
    board_id: int | None = None  # None: any
    reverse_motor: bool = False  # its two wires are exchanged
    reverse_encoder: bool = False  # its two channels are exchanged

    def __post_init__(self) -> None:
        """Check what contradicts itself.

        Raises:
            MotorError: the current's sensor does not show the limits.
        """
        self.current_limits.check(self.current_gain, self.current_offset)

    @property
    def silence(self) -> float:
        """[s] without telemetry after which the output is switched off."""
        return max(SILENCE, 1.5 / self.sample_rate)

    @property
    def round_trip(self) -> float:
        """[s] that the board may take to answer; who lets commands be older has a slow link, and knows it."""
        return min(max(ROUND_TRIP, self.command_timeout), MOST_ROUND_TRIP)

    @property
    def confirmation(self) -> float:
        """[s] within which telemetry says that the output is on, once that was asked for."""
        return 2.0 * (self.round_trip + 1.0 / self.sample_rate)

    @property
    def full_voltage(self) -> float:
        """[V] at full duty, as far as the parameters say."""
        return self.supply_voltage or self.max_voltage

    def configure(self, board: Hello) -> Configure:
        """What to ask of this board."""
        period = max(round(1e9 / self.sample_rate / board.tick_ns), board.shortest_period)
        last = period % LONGEST_STEP
        if (*_firmware(board), board.firmware_patch) < STEPS and period > LONGEST_STEP and last < SHORT_STEP:
            period -= last
        timeout = min(max(1.2 * self.command_timeout, LEAST_TIMEOUT), SILENCE)
        return Configure(period, round(timeout * 1e3), self.decay)

    def setup(self, board: Hello) -> Setup | None:
        """How this board shall count and pulse; None where it has no choice."""
        return Setup(self.quadrature, self.pwm) if _firmware(board) >= SETUP else None

    def protect(self, board: Hello) -> Protect | None:
        """Which current shall switch this board off, also where none shall; None where it watches none."""
        if _firmware(board) < PROTECT:
            return None
        return self.current_limits.protect(self.current_gain, self.current_offset, board.tick_ns)

    def refusal_to_protect(self, held: Protection) -> str:
        """Why a board that holds these limits cannot be used as configured; empty if it can."""
        if self.current_limits.most == 0.0 or held.most > 0:
            return ""
        return (
            "The board does not sense the motor's current, and current_limit is "
            f"{self.current_limits.most:g} A: flash it with a sensor (ros2 run motor_board flash --current-sense), or "
            "set current_limit to 0."
        )

    def refusal_of(self, features: Features) -> str:
        """Why a board with these cannot be used as configured; empty if it can."""
        if self.pwm is Pwm.SILENT and not features.silent_decays >> self.decay & 1:
            return (
                f"This board's bridge has no PWM above hearing with decay {self.decay.name.lower()}: set decay to "
                f"{Decay(1 - self.decay).name.lower()}, or silent_pwm to false."
            )
        return ""

    def refusal(self, board: Hello) -> str:
        """Why this board cannot be used as configured; empty if it can."""
        pulses, channels = self.edges_per_revolution // self.quadrature, 1 if self.single_channel else 2
        if impossible := _find_impossible(board):
            return impossible
        if _firmware(board) < OLDEST:
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
        if board.edges_per_revolution not in (0, pulses):
            name = "edges_per_revolution" if self.quadrature == 1 else "pulses_per_revolution"
            return (
                f"The board was flashed for an encoder with {board.edges_per_revolution} edges per revolution, and the "
                f"parameter {name} is {pulses}: set the parameter, or flash the board again."
            )
        if self.quadrature > 1 and board.channels == 1:
            return (
                f"quadrature is {self.quadrature}, and the board was flashed for one encoder channel: flash it again "
                "(ros2 run motor_board flash --channels 2), or set quadrature to 1."
            )
        for wanted, needed in self._wishes():
            if _firmware(board) < needed:
                return (
                    f"The board runs firmware {board.firmware_major}.{board.firmware_minor}, and {wanted} needs "
                    f"{needed[0]}.{needed[1]}: flash the board again (ros2 run motor_board flash)."
                )
        if board.channels != channels:
            return (
                f"The board reads {board.channels} encoder channel(s), and single_channel is "
                f"{str(self.single_channel).lower()}: set the parameter, or flash the board again."
            )
        return ""

    def _wishes(self) -> list[tuple[str, tuple[int, int]]]:
        """What not every firmware has, and the first that has it."""
        wishes = [(f"quadrature {self.quadrature}", SETUP)] if self.quadrature > 1 else []
        wishes += [("silent_pwm", SETUP)] if self.pwm else []
        return wishes + ([("current_limit", PROTECT)] if self.current_limits.most else [])

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
            quadrature=self.quadrature,
            gear_ratio=float(self.gear),
        )


def _firmware(board: Hello) -> tuple[int, int]:
    return board.firmware_major, board.firmware_minor


def _find_impossible(board: Hello) -> str:
    """Find what a board says of itself and cannot be, as a sentence; "" if nothing: all times and voltages need it."""
    for name, value, most in (("tick_ns", board.tick_ns, inf), ("pwm_top", board.pwm_top, MOST_TOP)):
        if not 1 <= value <= most:
            return (
                f"The board says {name} = {value}, which cannot be: its firmware is another one or broken; flash it "
                "again (ros2 run motor_board flash)."
            )
    return ""
