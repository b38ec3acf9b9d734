"""Evaluate one window of what was heard: read it, compare it with the model, judge; errors become sentences."""

from dataclasses import dataclass

from motor_identification.measurement.sanity_checks import BACKWARDS, compare_motion_with_voltage
from motor_identification.monitoring.health import Limits, State, Verdict, add_changes, judge_gap
from motor_identification.monitoring.heard import Heard
from motor_identification.monitoring.live_motor import LiveMotor
from motor_identification.monitoring.model_gap import Model, find_changes, measure_gap
from motor_identification.recording import Recording
from motor_model.errors import MotorError

SILENT = 2.0  # [s] without a message, after which a motor that is watched is not heard any more
NOTHING = "Nothing comes on {}: does its node run, in this ROS_DOMAIN_ID? (ros2 topic info -v {} shows who publishes.)"
ENDED = "Nothing has come on {} for {:.0f} s."

BACKWARD = (
    "The motor turns against its voltage: are its leads or the encoder's channels exchanged? (In a mapping, a factor "
    "below 0 turns one of them round.)"
)


@dataclass(frozen=True)
class Watch:
    """Which motor is watched, by which model, and how closely."""

    motor: LiveMotor
    model: Model
    limits: Limits = Limits()


def evaluate(watch: Watch, heard: Heard, now: int) -> Verdict:
    """Judge the motor by what was heard of it until `now` [ns]."""
    for topic in watch.motor.topics:
        if heard.latest(topic) is None and topic not in watch.motor.optional:
            return Verdict(State.UNKNOWN, NOTHING.format(topic, topic))
    silent = (now - (heard.latest(watch.motor.motion) or now)) * 1e-9
    if silent > SILENT:
        return Verdict(State.UNKNOWN, ENDED.format(watch.motor.motion, silent))
    try:
        motion = watch.motor.read(heard)
        if isinstance(motion, Recording) and _runs_backwards(motion):
            return Verdict(State.BROKEN, BACKWARD)
        gap = measure_gap(motion, watch.model)
        verdict = judge_gap(gap, watch.model, watch.limits)
        if verdict.state is State.DRIFTING:
            return add_changes(verdict, find_changes(gap, watch.model))
    except MotorError as error:
        return Verdict(State.UNKNOWN, str(error))
    return verdict


def _runs_backwards(recording: Recording) -> bool:
    agreement = compare_motion_with_voltage(recording)
    return not recording.info.single_channel and agreement is not None and agreement < BACKWARDS
