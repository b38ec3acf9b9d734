"""Detect a speed that the model's motor cannot reach."""

from motor_control.controller.faults.evidence import Config, Seen

OVERSPEED, OVERSPEED_TIME = 1.3, 0.05  # of what the supply gives; [s]: not one period of a doubtful edge
SENTENCE = (
    "The motor turns at {:.4g} rad/s, and by its model no more than {:.4g} are possible: see whether the encoder's line"
    " is disturbed, or the model is another motor's."
)


def check(config: Config, lasted: float, seen: Seen) -> tuple[str, float]:
    """Check one sample, after a too high speed has lasted for so long [s]: a sentence if the motor has to stop."""
    fast = abs(seen.speed)
    if fast <= OVERSPEED * config.fastest:
        return "", 0.0
    lasted += seen.dt
    return (SENTENCE.format(fast, config.fastest) if lasted >= OVERSPEED_TIME else ""), lasted
