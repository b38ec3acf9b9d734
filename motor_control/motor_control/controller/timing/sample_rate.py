"""Lower gains that so few samples do not bear, so that a loop with a slow plant does not swing.

Between two samples, T [s] apart, a motor of kv and time constant τ goes on under one voltage. Around it the law

    kp = g kv / (exp(T/τ) - 1)        ki = g kv / T

cancels its pole, and takes back the share g of an error in each sample. More than all of it (`find_longest_hold` says
the same of kp: T > τ ln(1 + kv/kp)) answers each error by a larger one: the motor swings from end to end, for ever.
Where gains are larger than for g = 1, and fewer samples come than faults are told by, the loop works with those for
`SHARE`, which a speed that is measured over the period before bears, too.

kv and τ are the model's. Without one the gains are taken for those of a loop `USUAL` times as quick as its motor, as
the default ones are around the paper's, with their zero on the motor's pole, τ being no more than the paper's; and the
speed that the motor has had shows that kv is no more than the voltage limit over it.
"""

from math import expm1, inf

from motor_control.controller import pi
from motor_control.controller.faults.evidence import Config as FaultConfig
from motor_model.parameters import PAPER_KA, PAPER_KV

SLOWEST = 100.0  # samples a second: from there on faults are told as at 200, and the default gains hold a speed
ROUNDED = 1.01  # times the period: a board rounds it
SHARE, GUESSED = 0.3, 0.2  # the latter without a model: still without a swing where kv is three times less
USUAL = 0.2 / PAPER_KV  # kp/kv
TIME_CONSTANT = PAPER_KA / PAPER_KV  # [s]
BRIEF = 1e-6  # [s] no motor is quicker
MOST = 50.0  # exponent: beyond, there is no proportional gain left
LOWERED = (
    "Only {:.3g} samples a second come: kp and ki would let the motor swing, the loop works with {:.2g} and {:.2g}, "
    "and some faults of the encoder's line are not noticed below {:g}: raise the plant's sample_rate."
)
WILD = (
    "By its model the motor would swing under kp and ki with {:.3g} samples a second: compute them with ros2 run "
    "motor_control tune, or raise the plant's sample_rate."
)
BY_GUESS = " Without a model it is guessed how low they have to be."


def are_few(sample_period: float) -> bool:
    """Tell whether samples [s] apart are too few for the checks for faults; 0: that is not known."""
    return sample_period * SLOWEST > ROUNDED


def lower_gains(
    gains: pi.Config, faults: FaultConfig, most: float, voltage_limit: float, sample_period: float
) -> pi.Config:
    """Give the gains for samples [s] apart: these, where they bear them; most [rad/s]: the motor's speed so far."""
    if not are_few(sample_period):
        return gains
    kv, time_constant, share = faults.kv, faults.time_constant, SHARE
    if kv == 0.0:
        (kv, time_constant), share = _guess(gains), GUESSED
        kv = min(kv, voltage_limit / most) if most > 0.0 else kv
    kp, ki = _find_most(kv, time_constant, sample_period)
    if gains.kp <= kp and gains.ki <= ki:
        return gains
    return pi.Config(min(gains.kp, share * kp), min(gains.ki, share * ki), gains.limit)


def warn_of_swing(gains: pi.Config, faults: FaultConfig, sample_period: float) -> str:
    """Say, as a sentence, that gains are too large for samples [s] apart, and not lowered; "" if they are not.

    Known with a model alone; the gains are their user's, who may know better.
    """
    if faults.kv == 0.0 or sample_period == 0.0 or are_few(sample_period):
        return ""
    kp, ki = _find_most(faults.kv, faults.time_constant, sample_period)
    return WILD.format(1.0 / sample_period) if gains.kp > kp or gains.ki > ki else ""


def explain_lowering(lower: pi.Config, faults: FaultConfig, sample_period: float) -> str:
    """Say, as a sentence, that the loop works with lower gains than those that are set."""
    said = LOWERED.format(1.0 / sample_period, lower.kp, lower.ki, SLOWEST)
    return said if faults.kv > 0.0 else said + BY_GUESS


def _find_most(kv: float, time_constant: float, sample_period: float) -> tuple[float, float]:
    """Find kp and ki which take back all of an error in one sample, and beyond which a motor swings."""
    return kv / expm1(min(sample_period / max(time_constant, BRIEF), MOST)), kv / sample_period


def _guess(gains: pi.Config) -> tuple[float, float]:
    """Guess kv [V·s/rad] and the time constant [s] of the motor that gains are for."""
    zero = gains.kp / gains.ki if gains.kp > 0.0 and gains.ki > 0.0 else inf
    return (gains.kp or gains.ki * TIME_CONSTANT) / USUAL, min(zero, TIME_CONSTANT)
