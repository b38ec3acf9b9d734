"""What the tests of the tuning share: the paper's motor as a plant, an encoder, a tuning."""

from motor_control.tuning.design import Tuning, Wish, tune
from motor_control.tuning.linear_loop import Plant
from motor_control.tuning.speed_feedback import Encoder
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

BARE = Plant(kv=PAPER_KV, ka=PAPER_KA, sample_period=0.005)
RUBBING = Parameters(
    {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 4.0}, ("static_friction",)
)


def tuning(**wish: object) -> Tuning:
    """Of the paper's motor with friction."""
    return tune(RUBBING, Encoder(), Wish(**wish))  # type: ignore[arg-type]
