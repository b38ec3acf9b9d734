"""How far a model is from the motion, and which of its parameters have changed."""

import pytest
from foreign_bags import KA, KS, KV
from watched import ANGLE, SPEED, judged, model

from motor_identification.mapping import Mapping
from motor_identification.monitoring.health import State
from motor_identification.monitoring.heard import Heard


@pytest.mark.parametrize("mapping", [ANGLE, SPEED], ids=["position", "speed"])
def test_a_motor_as_it_was_fits_with_the_residual_that_its_sensor_leaves(
    wheel: tuple[Heard, int], mapping: Mapping
) -> None:
    verdict = judged(wheel, mapping, model())
    assert verdict.state is State.FITS and verdict.gap is not None and not verdict.changes, verdict.sentence
    assert 0.8 < verdict.gap.rms / verdict.gap.expected < 1.3
    assert verdict.gap.duration == pytest.approx(10.0, abs=0.1)
    assert f"residual {verdict.gap.rms:.3g} rad/s RMS in 10 s, {verdict.gap.expected:.3g} expected" in verdict.sentence


@pytest.mark.parametrize("name, was", [("kv", 1.2 * KV), ("kv", 0.8 * KV), ("ka", 1.3 * KA), ("ks", 3.0 * KS)], ids=str)
def test_a_motor_that_has_changed_drifts_and_what_has_changed_is_named(
    wheel: tuple[Heard, int], name: str, was: float
) -> None:
    verdict = judged(wheel, ANGLE, model(**{name: was}))
    assert verdict.state is State.DRIFTING and [change.name for change in verdict.changes] == [name], verdict.sentence
    (change,) = verdict.changes
    truth = {"kv": KV, "ka": KA, "ks": KS}[name]
    assert change.value == pytest.approx(truth, rel=0.01) and 0.0 < change.error < 0.02 * truth and change.was == was
    assert f"Now {name} = " in verdict.sentence and f"(was {was:.4g})" in verdict.sentence


def test_a_change_that_hardly_matters_is_none(wheel: tuple[Heard, int]) -> None:
    verdict = judged(wheel, ANGLE, model(kv=1.04 * KV))
    assert verdict.state is State.FITS and verdict.gap is not None, verdict.sentence
    assert verdict.gap.rms < 0.05 * verdict.gap.measured, "of its speed"
