"""The loops that `control.py` compares: one motor with friction, one disc a seed, and the controllers around it."""

from collections.abc import Callable
from dataclasses import dataclass

from paper_loop import COUNT, PAIRS

from motor_control.configuration import config_of
from motor_control.parameters import ROWS
from motor_control.tuning.simulated_loop import Rehearsal, rehearse
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sensing.board import BoardConfig

TAU = 0.02  # [s] closed-loop time constant: what `tune` gives at 200 Hz
BREAKAWAY = 0.9  # [V]
FRICTION = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4, "breakaway_voltage": BREAKAWAY, "stribeck_speed": 4.0}
MOTOR = Parameters(FRICTION, ("static_friction",), name="the paper's motor with friction")


@dataclass(frozen=True)
class Loop:
    """A controller and the rate it runs at."""

    name: str
    rate: float  # [Hz]
    values: dict[str, object]

    def run(
        self, reference: float | Callable[[float], float], duration: float, seed: int, load: float = 0.0
    ) -> Rehearsal:
        """From rest, for so long [s]; a load [V] comes 0.6 s after the start."""
        plant = MOTOR
        if load != 0.0:
            step = {"step_voltage": load, "step_time": 0.6 + 0.0013 * seed}
            plant = Parameters({**FRICTION, **step}, ("static_friction", "load_step"))
        board = BoardConfig(sample_rate=self.rate, slot_irregularity=0.01, seed=seed)
        config = config_of({row.name: row.default for row in ROWS} | self.values, board.info(plant), MOTOR)
        wanted = reference if callable(reference) else lambda _: reference
        return rehearse(plant, board, config, wanted, duration)


GAINS: dict[str, object] = {"kp": PAPER_KA / TAU, "ki": PAPER_KV / TAU}
OURS = {**GAINS, "speed_source": "observer", "feedforward": True}
SLOW, FAST = (
    Loop("observer and feed-forward, 200 Hz", 200.0, OURS),
    Loop("observer and feed-forward, 1 kHz", 1000.0, OURS),
)
PERIOD = Loop("the same gains on the period, 1 kHz", 1000.0, GAINS)
PAPERS = [
    Loop(f"[{kp:g}, {ki:g}], integral per {unit}", 1000.0, {"kp": kp * COUNT, "ki": ki * COUNT * scale})
    for unit, scale in (("second", 1.0), ("sample", 1000.0))
    for kp, ki in PAIRS
]
