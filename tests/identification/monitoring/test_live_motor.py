"""A running motor out of what was heard: our own plant's, one that stands, one that turns the other way."""

from dataclasses import replace

from watched import BAGS, IDLE, REVERSED, SPEED, STANDS, hear, judged, model

from motor_identification.monitoring.evaluation import Watch, evaluate
from motor_identification.monitoring.health import State
from motor_identification.monitoring.heard import Heard
from motor_identification.monitoring.live_motor import LiveMotor
from motor_identification.monitoring.model_gap import Model
from motor_identification.reporting.model_comparison import Identified
from motor_model.model_file import load


def test_a_motor_that_turns_the_other_way_is_broken(wheel: tuple[Heard, int]) -> None:
    for mapping in (REVERSED, replace(SPEED, voltage=REVERSED.voltage)):
        assert judged(wheel, mapping, model()).state is State.BROKEN
    assert judged(wheel, REVERSED, model()).sentence.startswith("The motor turns against its voltage")


def test_a_motor_that_stands_under_voltage_is_broken_and_one_that_rests_is_not(wheel: tuple[Heard, int]) -> None:
    blocked = judged(wheel, STANDS, model())
    assert blocked.state is State.BROKEN and blocked.gap is not None
    assert (
        f"would run at {blocked.gap.predicted:.3g} rad/s RMS" in blocked.sentence and 5.0 < blocked.gap.predicted < 12.0
    )
    rest = judged(wheel, IDLE, model())
    assert rest.state is State.UNKNOWN and rest.gap is not None and "nothing can be said" in rest.sentence


def test_our_own_plant_needs_no_mapping() -> None:
    heard, now = hear(BAGS / "rich", 12.0)
    paper = Model(Identified("motor", load(BAGS / "rich.yaml"), {}))
    assert evaluate(Watch(LiveMotor(), paper), heard, now).state is State.FITS
    values = {**paper.parameters.values, "kv": 1.5 * paper.parameters.value("kv")}
    other = Model(Identified("motor", replace(paper.parameters, values=values), {}))
    verdict = evaluate(Watch(LiveMotor(), other), heard, now)
    assert verdict.state is State.DRIFTING and "kv" in [change.name for change in verdict.changes], verdict.sentence
