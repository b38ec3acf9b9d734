"""What a plant's parameters say of its encoder, put together: how many counts a turn, of which shaft."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from motor_model.errors import MotorError
from motor_model.gearing.gear import parse_gear_ratio

DEFAULT_EDGES = 96
MOST_EDGES = 100_000


@dataclass(frozen=True, slots=True)
class EncoderCount:
    """Counts of an encoder, and the gear between it and the output."""

    edges_per_revolution: int  # counts in a turn of the encoder's shaft
    quadrature: int  # of them in a period of one channel: 1, 2, 4
    single_channel: bool
    gear: Fraction  # encoder turns per output turn


def read_encoder_count(values: Mapping[str, object]) -> EncoderCount:
    """Read `edges_per_revolution`, `single_channel`, `quadrature`, `pulses_per_revolution` and `gear_ratio`.

    Counts in a turn of the encoder's shaft are quadrature × pulses_per_revolution, or edges_per_revolution where no
    pulses are said. Two- and fourfold counting takes both channels, whatever single_channel says.

    Raises:
        MotorError: they contradict each other, or are those of no encoder.
    """
    edges, pulses = int(str(values["edges_per_revolution"])), int(str(values["pulses_per_revolution"]))
    quadrature = int(str(values["quadrature"]))
    if quadrature not in (1, 2, 4):
        raise MotorError(f"quadrature is {quadrature}: it must be 1, 2 or 4 counts in a period of a channel.")
    if pulses == 0 and quadrature > 1:
        raise MotorError(
            f"quadrature is {quadrature}, and pulses_per_revolution is not said: give the periods of one channel in a "
            "turn of the encoder's shaft (11 on many gearmotors)."
        )
    counted = quadrature * pulses or edges
    if edges not in (DEFAULT_EDGES, counted):
        raise MotorError(
            f"edges_per_revolution is {edges}, and {quadrature} × {pulses} pulses make {counted}: leave one out."
        )
    if counted > MOST_EDGES:
        raise MotorError(
            f"{quadrature} × {pulses} pulses make {counted} counts a turn, and {MOST_EDGES:,} are the most."
        )
    single = bool(values["single_channel"]) and quadrature == 1
    return EncoderCount(counted, quadrature, single, parse_gear_ratio(str(values["gear_ratio"])))
