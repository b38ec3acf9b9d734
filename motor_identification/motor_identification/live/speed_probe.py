"""Finds the voltage that keeps a live motor within a speed: moves it a little, identifies it, and scales the plan."""

import time

from motor_identification.experiment import Plan, slowed
from motor_identification.identify import Request, identify
from motor_identification.live.experiment_node import Driver
from motor_identification.recording import check, recording_of
from motor_model.errors import MotorError
from motor_model.excitation import Profile
from motor_ros.run import Interrupt, spin

RAMP = Profile("probe", 4.0, "how fast a motor runs: up slowly, until it is fast enough", lambda time: time / 4.0)
ENOUGH = 0.7  # of the limit: where the ramp ends
TARGET = 0.95  # of the limit: reported speeds scatter with the slots
REST = 0.3  # [s] without motion
PATIENCE = 10.0  # [s] to come to rest at 0 V


def scale(node: Driver, interrupt: Interrupt) -> None:
    """Lower the peak of the node's plan as far as its limit takes.

    Raises:
        MotorError: the motor cannot be identified, does not come to rest, or is too fast whatever it gets.
    """
    plan, limit, info = node.plan, node.limit, node.info
    if plan is None or limit is None or info is None:
        return
    node.follow(Plan(RAMP, plan.voltage, plan.sample_period), ENOUGH * limit)
    spin(node, lambda: node.done or node.failed() or bool(interrupt))
    node.stop()
    deadline = time.monotonic() + PATIENCE
    rest = round(REST / plan.sample_period)
    spin(node, lambda: _resting(node, rest) or node.failed() or bool(interrupt) or time.monotonic() > deadline)
    if interrupt:
        return
    if node.problem:
        raise MotorError(node.problem)
    if not _resting(node, rest):
        raise MotorError(f"the motor still turns {PATIENCE:g} s after 0 V: hold what drives it, or leave out --speed.")
    fit = identify(
        [check(recording_of(node.samples, info, "the ramp before the experiment"))], Request(("coulomb_friction",))
    )
    node.heard = time.monotonic()  # nobody has listened meanwhile
    node.plan = slowed(plan, fit.parameters, TARGET * limit)
    print(f"A short ramp says: {node.plan.voltage:g} V at most keep the motor below {limit:g} rad/s.", flush=True)


def _resting(node: Driver, count: int) -> bool:
    return len(node.samples) > count and not any(sample.speed for sample in node.samples[-count:])
