"""What a person says of motor, supply and encoder before the first run, and how far the run may go."""

from dataclasses import dataclass, replace
from fractions import Fraction

from motor_driver.config import Config
from motor_driver.frames.codes import Decay, Pwm
from motor_driver.frames.from_board import Hello
from motor_model.gearing.gear import edge_angle

HIGHEST = 0.5  # of the motor's voltage: turns any motor that is meant for it, with half of its stall current at most
RAMP_TIME = 4.0  # [s] from 0 to the highest voltage
HOLD_TIME = 2.0  # [s] on one voltage at most
DRIVE_TIME = RAMP_TIME + HOLD_TIME  # [s] with voltage on at a stretch at most


@dataclass(frozen=True)
class Settings:
    """The run's settings; None where a person does not know."""

    max_voltage: float = 12.0  # [V] of the motor
    supply_voltage: float = 0.0  # [V] expected; 0: as max_voltage
    edges_per_revolution: int | None = None  # of one polarity, of the encoder's shaft; None: as the board was flashed
    quadrature: int = 1  # with which the driver is to count; the run itself counts one polarity of A
    gear: Fraction = Fraction(1)  # encoder turns per turn of the output
    gear_said: str = ""  # as somebody has written it
    single_channel: bool | None = None  # None: as the board was flashed
    board_id: int | None = None  # None: any
    current_gain: float = 0.0  # [V/A] of a sensor of the motor's current; 0: none
    current_offset: float = 2.5  # [V]
    hand: bool = True  # somebody is there to turn the shaft, and to say what it does
    turns: int = 1  # by hand
    hand_time: float = 30.0  # [s] that a person may take for an answer

    @property
    def supply(self) -> float:
        """[V] expected at full duty."""
        return self.supply_voltage or self.max_voltage

    @property
    def highest(self) -> float:
        """[V] that the motor gets at most in this run."""
        return HIGHEST * self.max_voltage

    def edges(self, board: Hello) -> int | None:
        """Edges of one polarity per turn of the encoder's shaft, as far as somebody has said so."""
        return self.edges_per_revolution or board.edges_per_revolution or None

    def edges_of_output(self, board: Hello) -> float | None:
        """The same per turn of the output."""
        edges = self.edges(board)
        return None if edges is None else float(edges * self.gear)

    def slot(self, board: Hello) -> float | None:
        """[rad] of the output from one edge to the next."""
        edges = self.edges(board)
        return None if edges is None else edge_angle(edges, self.gear)


@dataclass(frozen=True, slots=True)
class AnyBoard(Config):
    """The driver's configuration for a board of which little is known: what nobody has said is taken from it."""

    known_edges: bool = False
    known_channels: bool = False
    wanted_quadrature: int = 1

    def refusal(self, board: Hello) -> str:
        """Why this board is not the one that was meant; empty if it may be."""
        edges = self.edges_per_revolution if self.known_edges else board.edges_per_revolution or 1
        own = replace(
            self,
            edges_per_revolution=edges * self.wanted_quadrature,
            quadrature=self.wanted_quadrature,
            single_channel=self.single_channel if self.known_channels else board.channels == 1,
        )
        return Config.refusal(own, board)


def config_of(settings: Settings, baud: int, decay: int, pwm: Pwm = Pwm.STANDARD) -> AnyBoard:
    """Return the driver's configuration for this run; the run watches the motion itself."""
    return AnyBoard(
        edges_per_revolution=settings.edges_per_revolution or 1,
        single_channel=settings.single_channel is not False,
        max_voltage=settings.max_voltage,
        supply_voltage=settings.supply,
        stall_time=0.0,
        decay=Decay(decay),
        pwm=pwm,
        baud=baud,
        board_id=settings.board_id,
        current_gain=settings.current_gain,
        current_offset=settings.current_offset,
        known_edges=settings.edges_per_revolution is not None,
        known_channels=settings.single_channel is not None,
        wanted_quadrature=settings.quadrature,
    )
