"""From a motor model to the gains of the speed loop, and what they will do.

The zero of the law cancels the pole of the motor, ki/kp = kv/ka, which leaves L = e^(−Ds)/(τ s) with τ = ka/kp. All
that makes the loop late (`Plant.late`, Λ) then bounds τ from below: τ = 2 Λ leaves a gain margin of about 3, a phase
margin of about 60° and a delay margin of about 2 Λ (S. Skogestad, "Simple analytic rules for model reduction and PID
controller tuning", Journal of Process Control 13, 2003, his τc = θ); python-control says what they are.

The closed-loop time constant is the time after which 63 % of a small step are done, dead time included; it is about τ.
Without a wish it is the least that three bounds allow: the delay of sampling and bridge alone; what the encoder adds to
that, by its lag (`measured`) or by the observer's part in the loop (`observed`); and the swings that an irregular disc
causes, at any speed from the lowest of interest on.
"""

from dataclasses import dataclass

from motor_control.tuning.gain_search import quiet_kp, time_constant_of, wished_gains
from motor_control.tuning.linear_loop import Gains, Plant, plant_of
from motor_control.tuning.margins import Margins, least, margins_of
from motor_control.tuning.measured_speed import LATENESSES, Measured
from motor_control.tuning.observed_speed import Observed
from motor_control.tuning.speed_feedback import MEASURED, OBSERVER, Encoder, Ripple, Sight, cancelling
from motor_control.tuning.speed_range import choose_speeds, default_lowest_speed
from motor_control.tuning.step_response import StepResponse, respond, small_step
from motor_model.parameters import Parameters
from motor_model.sample import Info


@dataclass(frozen=True, slots=True)
class Wish:
    """What is wanted of the loop."""

    sample_period: float = 0.005  # [s]
    lowest_speed: float | None = None  # [rad/s] the slowest reference of interest; None: see `speed_range`
    time_constant: float | None = None  # [s] of the closed loop; None: as fast as the bounds allow
    oscillation: float = 0.02  # share of the speed, peak to peak, that the encoder may cause
    source: str = MEASURED  # where the law's speed comes from


@dataclass(frozen=True, slots=True)
class Bound:
    """One thing that keeps the loop from being faster."""

    name: str
    time_constant: float  # [s]


@dataclass(frozen=True)
class Tuning:
    """Gains, why they are not larger, and what is predicted of them."""

    wish: Wish
    lowest_speed: float  # [rad/s]
    sight: Sight
    plant: Plant  # at the lowest speed
    gains: Gains
    time_constant: float  # [s] 63 % of a small step
    bounds: tuple[Bound, ...]
    margins: Margins  # the least of all speeds
    step: StepResponse  # small
    large_step: StepResponse  # to the middle of the range, with the voltage limit
    ripples: tuple[tuple[float, Ripple], ...]  # at some speeds [rad/s]


def tune(parameters: Parameters, encoder: Encoder, wish: Wish) -> Tuning:
    """Find the gains for a motor, an encoder and a wish.

    Raises:
        MotorError: the wish is faster than the delays allow, or there is no such speed.
    """
    lowest = default_lowest_speed(parameters, encoder) if wish.lowest_speed is None else wish.lowest_speed
    speeds = choose_speeds(parameters, lowest)
    bare = plant_of(parameters, wish.sample_period)
    sight = sight_of(parameters, encoder, wish)
    possible = (
        bare.ka / (bare.gain * LATENESSES * bare.late),
        calm := sight.fastest(bare, speeds),
        quiet := quiet_kp(sight, bare, speeds, wish.oscillation, calm),
    )
    names = (
        "sampling and bridge delay",
        sight.bound.format(lowest),
        f"{100 * wish.oscillation:.3g} % ripple from the disc",
    )
    plants = (sight.plant(bare, speeds[-1]), *[sight.plant(bare, lowest)] * 2)
    bounds = tuple(
        Bound(name, time_constant_of(sight, plant, cancelling(bare, kp)))
        for name, plant, kp in zip(names, plants, possible, strict=True)
    )
    gains = cancelling(bare, quiet)
    if wish.time_constant is not None:
        gains = wished_gains(sight, plants[-1], wish.time_constant, calm)
    return _predicted(parameters, wish, sight, bare, gains, bounds, speeds)


def sight_of(parameters: Parameters, encoder: Encoder, wish: Wish) -> Sight:
    """Return how the law will see the speed."""
    if wish.source != OBSERVER:
        return Measured(encoder)
    from motor_control.controller.observer import Observer

    info = Info(
        edges_per_revolution=encoder.edges_per_revolution,
        edge_resolution=encoder.edge_resolution,
        sample_period=wish.sample_period,
        gear_ratio=encoder.gear_ratio,
    )
    noise = Observer(parameters, info, encoder.slot_irregularity).noise
    return Observed(encoder, noise.walk, noise.shake)


def _predicted(
    parameters: Parameters,
    wish: Wish,
    sight: Sight,
    bare: Plant,
    gains: Gains,
    bounds: tuple[Bound, ...],
    speeds: tuple[float, ...],
) -> Tuning:
    middle = 0.5 * parameters.max_voltage / bare.kv
    plant, law = sight.plant(bare, speeds[0]), sight.law(gains)
    there, limit = sight.plant(bare, middle), parameters.max_voltage
    brake = -limit if sight.name == OBSERVER else 0.0  # a single channel that is only measured is never braked
    duration = 4.0 * bare.ka / bare.kv
    return Tuning(
        wish=wish,
        lowest_speed=speeds[0],
        sight=sight,
        plant=plant,
        gains=gains,
        time_constant=time_constant_of(sight, plant, gains),
        bounds=bounds,
        margins=least([margins_of(sight.loop(bare, gains, speed), bare.sample_period, bare.late) for speed in speeds]),
        step=small_step(plant, law, sight.forward(plant, 1.0)),
        large_step=respond(there, law, middle, duration, brake, limit, sight.forward(there, middle)),
        ripples=tuple((speed, sight.ripple(bare, gains, speed)) for speed in speeds),
    )
