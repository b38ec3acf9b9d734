"""Limit the voltage: to what keeps a single channel's direction, and to what the bridge should carry in a reversal.

A single channel counts edges and does not see which way they pass. The plant's sign is a guess that it can only revise
at a standstill, or where the period has a maximum while the voltage opposes the motion; so under an opposing voltage
everything that makes the motor faster (a load, a narrow slot) reads as a turn, and a careless plant takes the sign from
the voltage outright. A wrong sign makes the loop push the wrong way. With the reference r and the reported speed w:

    toward r only      the voltage has the sign of r or is 0 V; r = 0 is 0 V, friction and back-EMF do the braking
    no brake at speed  while r w < 0 and |w| > reversal_speed it is 0 V
    turn and carry on  a reversal that has begun below reversal_speed goes on until the sign of w has changed, up to
                       GIVE_UP times that speed: the plant sees the turn an edge or two later, when the motor is
                       faster again, and by this very voltage

And once a motor of one channel has come to rest at a reference of 0, it gets 0 V until another one comes: friction
holds it there. An edge would be of a hand, a hit or noise on the line, and an observer that drives against the motion
it takes that for would turn the motor by itself if the line is lost. With two channels and an observer it gets
`AT_REST` of the voltage there, for a load that is larger than friction.

It mends itself. Should the sign be wrong after all, the voltage is still toward the reference, so the motor ends up
turning that way, through a standstill or a period maximum that the plant can see.

Against a motion, voltage and back-EMF add up: full voltage backwards at top speed is twice the stall current. So the
voltage is kept within `plug_limit` times the limit of the back-EMF.
"""

from math import copysign, inf
from typing import NamedTuple

AT_REST = 0.5  # of the voltage limit, that a motor with two channels gets there: twice a load that is allowed
GIVE_UP = 2.0  # of 1, 2, 4, 8 in simulation the least that loses no time with a plant that is slow to see the turn


class Span(NamedTuple):
    """The allowed voltages, and whether the motor is being turned round."""

    low: float  # [V]
    high: float  # [V]
    reversing: bool
    braking: bool  # 0 V until the motor is slow enough to be turned round


def both_ways(limit: float) -> Span:
    """Allow anything within +-limit [V]: the direction is measured."""
    return Span(-limit, limit, False, False)


def toward(reference: float, speed: float, limit: float, reversal_speed: float, reversing: bool) -> Span:
    """Allow what drives toward the reference: reference, speed [rad/s], limit [V]; `reversing` of the last sample."""
    against = reference * speed < 0.0
    slow_enough = abs(speed) <= reversal_speed * (GIVE_UP if reversing else 1.0)
    if reference == 0.0 or (against and not slow_enough):
        return Span(0.0, 0.0, False, against)
    end = copysign(limit, reference)
    return Span(min(end, 0.0), max(end, 0.0), against, False)


def known(reference: float, speed: float, forward: float, limit: float, reversal_speed: float) -> Span:
    """Allow what an observer's direction makes safe: it is known, but near a standstill not for sure.

    Toward the reference anything within +-limit [V] goes; against it only what brakes a motion faster than
    reversal_speed [rad/s], and what the reference by itself asks for: the feed-forward without any estimate, `forward`
    [V]. Should the direction be wrong, nothing drives the motor away from the reference.
    """
    low, high = max(min(forward, 0.0), -limit), min(max(forward, 0.0), limit)
    if reference > 0.0 or (speed < -reversal_speed and reference <= 0.0):
        high = limit
    if reference < 0.0 or (speed > reversal_speed and reference >= 0.0):
        low = -limit
    return Span(low, high, False, False)


def limit_plugging(span: Span, back_emf: float, limit: float) -> Span:
    """Keep the voltage within a limit [V] of the back-EMF [V] where it would work against the motion.

    An infinite back-EMF is one that is not known: then nothing works against the motion.
    """
    low, high = span.low, span.high
    if back_emf > 0.0:
        low = max(low, min(back_emf - limit, 0.0))
    elif back_emf < 0.0:
        high = min(high, max(back_emf + limit, 0.0))
    return span._replace(low=low, high=max(high, low))


def limit_at_rest(span: Span, limit: float) -> Span:
    """Keep the voltage within +-limit [V] where the motor has come to rest and shall stay there."""
    return span._replace(low=max(span.low, -limit), high=min(span.high, limit))


def back_emf_of(speed: float, kv: float, reversal_speed: float) -> float:
    """Compute the back-EMF [V] at a speed [rad/s]; kv [V·s/rad], 0: not known, then infinite beyond reversal_speed."""
    if kv > 0.0:
        return kv * speed
    return copysign(inf, speed) if abs(speed) > reversal_speed else 0.0
