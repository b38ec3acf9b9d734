"""One window of what was heard as a verdict, whatever was heard."""

from dataclasses import replace

import pytest
from foreign_bags import KV
from watched import ANGLE, judged, model

from motor_identification.mapping import parse_origin
from motor_identification.monitoring.evaluation import Watch, evaluate
from motor_identification.monitoring.health import State
from motor_identification.monitoring.heard import Heard
from motor_identification.monitoring.live_motor import LiveMotor
from motor_identification.monitoring.model_gap import Model


@pytest.mark.parametrize("one", [model(kv=3.0 * KV), model(ks=4.5)], ids=["another motor's", "hardly moves"])
def test_a_motion_that_is_not_the_models_is_broken(wheel: tuple[Heard, int], one: Model) -> None:
    verdict = judged(wheel, ANGLE, one)
    assert verdict.state is State.BROKEN and "does not move as its model says" in verdict.sentence, verdict.sentence


def test_what_is_not_heard_is_said(wheel: tuple[Heard, int]) -> None:
    nowhere = judged(wheel, replace(ANGLE, motion=parse_origin("/other:x")), model())
    assert nowhere.state is State.UNKNOWN and nowhere.sentence.startswith("Nothing comes on /other: does its node run")
    silent = judged(wheel, ANGLE, model(), late=3.0)
    assert silent.state is State.UNKNOWN and silent.sentence == "Nothing has come on /joint_states for 3 s."
    assert judged(wheel, ANGLE, model(), late=1.0).state is State.FITS
    absent = judged(wheel, replace(ANGLE, motion=parse_origin("/joint_states:position[middle]")), model())
    assert absent.state is State.UNKNOWN and "no number at /joint_states:position[middle]" in absent.sentence
    early = evaluate(Watch(LiveMotor(ANGLE), model()), Heard(10.0), 0)
    assert early.state is State.UNKNOWN and early.gap is None
