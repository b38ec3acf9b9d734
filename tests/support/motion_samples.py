"""Samples of a board, and what a check of the motion says after some of them."""

from math import nan

from motor_model.sample import Sample
from motor_model.sensing.motion_check import MotionCheck


def sample(time: float, count: int, speed: float, voltage: float = 6.0, supply: float = nan) -> Sample:
    return Sample(round(time * 1e9), speed, voltage, count, edge_period=0.01, supply_voltage=supply)


def checked(single_channel: bool, *samples: Sample, max_voltage: float = 12.0) -> MotionCheck:
    check = MotionCheck(max_voltage, single_channel)
    for one in samples:
        check = check.see(one)
    return check
