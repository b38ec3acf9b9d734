"""Hold the result of an identification: a motor, how sure each of its numbers is, and all that limits them."""

from dataclasses import dataclass

from motor_identification.estimation.request import SearchReport
from motor_identification.timing.timing import Timing
from motor_model.parameters import Parameters
from motor_model.physical.result import PhysicalResult


@dataclass(frozen=True)
class Whiteness:
    """What is left of regularity in white residuals; NaN where there are too few of them.

    The p-values are the chances of this much or more in the residuals of a right model. With many residuals any trifle
    is significant: judge by the correlations as well.
    """

    p_value: float  # of the portmanteau test
    autocorrelation: float  # the one of largest size
    lag: int  # in intervals, of that one
    input_p_value: float
    input_correlation: float  # of largest size between residual and voltage, its size or its sign
    input_lag: float  # [s] by which the residual follows


@dataclass(frozen=True)
class Fit:
    """An identified motor and how far it is to be trusted; dictionaries are by parameter name."""

    parameters: Parameters
    standard_errors: dict[str, float]  # NaN where not identifiable; ±1.96 of them cover 95 %
    correlations: dict[str, dict[str, float]]  # of the errors of two parameters; NaN where one is not identifiable
    on_bound: dict[str, bool]
    not_identifiable: tuple[str, ...]
    not_told_apart: dict[str, tuple[str, ...]]  # fitted effect → other effects with the same trace
    absent: tuple[str, ...]  # effects that were asked for, without which the fit is as good
    suggested_experiment: str  # a profile, or empty
    residual_rms: float  # [rad/s] time-weighted, of simulated − measured mean speed
    noise_floor: float  # [rad/s] what timer tick (or count quantisation) and irregular slots alone leave
    r_squared: float
    whiteness: Whiteness  # of the residuals
    slot_irregularity: tuple[float, ...]  # of every recording's disc, as a share of a slot; NaN where it has none
    start_speeds: tuple[float, ...]  # [rad/s] of every recording
    search: SearchReport
    evaluations: int  # simulations of one motor through all recordings
    duration: float  # [s]
    uris: tuple[str, ...]
    notes: tuple[str, ...]
    physical: PhysicalResult | None = None  # where a current was measured, or the resistance is known
    timing: Timing | None = None  # of its recordings' speeds, where they were not made as was assumed
