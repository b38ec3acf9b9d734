"""Every term of the equation of motion in the plant's own words; all compiled, all in volts at the armature.

    ka dω/dt = drive − friction(ω) − loads,    drive = u_eff − kv ω,    dθ/dt = ω

The state is (angle θ, speed ω, lagged drive, bristle, angle and speed behind the spring). Where `interfaces.md` leaves
room, these are the readings taken:

- The command passes delay → slew → limit → dead zone → asymmetry → supply ripple and is then u_eff. The dead zone
  therefore subtracts from the limited voltage, and the gain acts on what the dead zone leaves.
- |u_eff|/u_max in coast drive and sag is the share after that chain, so a dead zone also coasts and sags less.
- Sag divides the whole drive (u_eff − kv ω with coasting in it), the lag of the inductance comes last and acts on the
  whole sagged drive; at rest it is the lagged drive that has to overcome friction.
- Warm-up multiplies ka, all friction (drag too) and all loads (bias, step, ripple, spring) by the same factor; kv does
  not grow. It starts cold at the recording's start. What holds at rest grows with it.
- With a torque constant, back-EMF is that alone, and what kv has beyond it is viscous friction: a torque, which no
  lag delays, no coasting bridge spares, and warm copper makes dear. The current is (lagged) drive over warm resistance.
- The Stribeck term is (breakaway − ks)·exp(−(ω/ω_s)²) on top of ks, so friction at ω = 0 is the breakaway voltage.
- Ripple takes θ from the recording's start. The load step is there from step_time on, counted from the same instant.
"""

from math import copysign, exp, pi, sin
from typing import Any

from numba import njit

Balance = tuple[float, float, float, float, float, float]
State = tuple[float, float, float, float, float, float]
# Into its callers: a second of motion is a hundred thousand calls, and takes a third less so.
inlined = njit(cache=True, error_model="numpy", forceinline=True)


@inlined
def bridge(v: float, t: float, p: Any) -> float:
    """u_eff [V] for a delayed command v [V] at time t [s]."""
    limited = min(max(v, -p.limit_voltage), p.limit_voltage)
    u = copysign(max(abs(limited) - p.dead_zone_voltage, 0.0), limited)
    if u < 0.0:
        u *= p.reverse_gain
    if p.supply_ripple != 0.0:
        u *= 1.0 + p.supply_ripple * sin(2.0 * pi * p.supply_ripple_frequency * t)
    return u


@inlined
def back_emf_constant(p: Any) -> float:
    """[V*s/rad] what the winding itself makes of speed."""
    return p.torque_constant if p.torque_constant > 0.0 else p.kv


@inlined
def drive(u: float, speed: float, p: Any) -> float:
    """Drive [V] before the lag: effective voltage less back-EMF, shared with a sagging supply."""
    pull = u - back_emf_constant(p) * speed
    if p.coast_share != 0.0 or p.sag != 0.0:
        duty = abs(u) / p.max_voltage
        back_emf = back_emf_constant(p) * speed * (1.0 - p.coast_share * (1.0 - duty))
        pull = (u - back_emf) / (1.0 + p.sag * duty * duty)
    return min(max(pull, -p.current_limit_voltage), p.current_limit_voltage)


@inlined
def warmth(t: float, p: Any) -> float:
    """How many times its cold value the armature's resistance has."""
    if p.resistance_rise == 0.0:
        return 1.0
    if p.warm_up_time <= 0.0:
        return 1.0 + p.resistance_rise
    return 1.0 + p.resistance_rise * (1.0 - exp(-t / p.warm_up_time))


@inlined
def outer_load(t: float, stepped: bool, random: float, p: Any) -> float:
    """Load [V] that comes from outside at a time [s]: the step, a wave, and a random torque [V]."""
    load = random
    if stepped:
        load += p.step_voltage
    if p.load_wave != 0.0:
        load += p.load_wave * sin(2.0 * pi * p.load_wave_frequency * t)
    return load


@inlined
def loads(angle: float, outer: float, p: Any) -> float:
    """Loads [V] of the cold motor: bias, torque ripple and, as `outer`, what comes from outside (see `outer_load`)."""
    load = p.bias_voltage + outer
    if p.ripple_voltage != 0.0:
        load += p.ripple_voltage * sin(p.ripple_cycles * angle + p.ripple_phase)
    return load


@inlined
def dry_friction(angle: float, speed: float, pull: float, p: Any) -> float:
    """Level [V] of the cold motor's dry friction; at speed 0 it is what holds the motor."""
    level = p.ks + p.load_friction * abs(pull)
    extra = p.breakaway_voltage - p.ks
    if extra > 0.0:
        if p.stribeck_speed > 0.0:
            ratio = speed / p.stribeck_speed
            level += extra * exp(-ratio * ratio) if abs(ratio) < 7.0 else 0.0  # exp(-49) is lost in rounding
        elif speed == 0.0:
            level += extra
    if p.angle_friction != 0.0:
        level += 0.5 * p.angle_friction * (1.0 + sin(angle))
    return level


@inlined
def balance(y: State, t: float, u: float, outer: float, p: Any) -> Balance:
    """(pull, loads, dry friction, warmth, rate of the lagged drive, torque of the spring), all [V] but the rate."""
    angle, speed, lagged, _, far_angle, far_speed = y
    pull = drive(u, speed, p)
    lag_rate = 0.0
    if p.electrical_time_constant > 0.0:
        lag_rate = (pull - lagged) / p.electrical_time_constant
        pull = lagged
    spring = 0.0
    if p.compliance_fraction > 0.0:
        spring = p.compliance_stiffness * (angle - far_angle) + p.compliance_damping * (speed - far_speed)
    dry = dry_friction(angle, speed, pull, p)
    return pull, loads(angle, outer, p) + spring, dry, warmth(t, p), lag_rate, spring


@inlined
def rates(y: State, t: float, u: float, outer: float, way: float, share: float, p: Any) -> State:
    """dy/dt while the motor moves one way (+1, -1) or is held (0), with `share` of ka on the shaft; u is u_eff [V]."""
    _, speed, _, bristle, _, far_speed = y
    pull, load, dry, warm, lag_rate, spring = balance(y, t, u, outer, p)
    grip = way
    bristle_rate = 0.0
    if p.presliding_angle > 0.0:
        grip = bristle
        bristle_rate = (speed - abs(speed) * bristle) / p.presliding_angle
    acceleration = 0.0
    if way != 0.0:
        resisting = load + dry * grip + (p.kv - back_emf_constant(p)) * speed + p.drag * speed * abs(speed)
        if p.speed_wave != 0.0:
            resisting += p.speed_wave * sin(speed / p.speed_wave_scale)
        acceleration = ((pull / warm if warm != 1.0 else pull) - resisting) / (p.ka * share)
    far_acceleration = 0.0
    if p.compliance_fraction > 0.0:
        far_acceleration = spring / (p.ka * p.compliance_fraction)
    return speed, acceleration, lag_rate, bristle_rate, far_speed, far_acceleration


@inlined
def push_at_rest(y: State, t: float, v: float, outer: float, p: Any) -> tuple[float, float]:
    """(push, hold) [V]: what is left of drive and loads on a motor at rest, and what holds it there."""
    pull, load, dry, warm, _, _ = balance(y, t, bridge(v, t, p), outer, p)
    if p.presliding_angle > 0.0:
        return pull - warm * (load + dry * y[3]), 0.0
    return pull - warm * load, warm * dry
