"""The limits of a diagnosis in sentences, with their numbers."""

from dataclasses import replace

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.reporting.diagnosis_text import SEEN
from motor_identification.reporting.html.limits import NO_NOISE, list_limits
from motor_model.sample import Measurement


def test_every_limit_has_its_sentence(found: Diagnosis) -> None:
    said = list_limits(replace(found, miscounted=7))
    assert said[0].startswith("This recording could not show warm up (") and said[0].endswith("' would.")
    assert f"The gap is computed over {int(found.after.counted.sum())} intervals that no fit has seen." in said
    seen = list_limits(replace(found, validation=(), after=replace(found.after, seen=True)))
    assert SEEN in seen and any(one.endswith("intervals that the fits have seen, too.") for one in seen)
    assert any(
        one.startswith(f"{found.left_out} intervals were left out because they contain a reversal") for one in said
    )
    assert "7 intervals were left out because they are off by whole slots: edges were missed or counted twice." in said
    tick, rest = found.after.floor(0.0), (found.noise_floor**2 - found.after.floor(0.0) ** 2) ** 0.5
    assert (
        f"The noise floor is {found.noise_floor:.3g} rad/s: {tick:.3g} rad/s from the timer's tick of 4 µs and "
        f"{rest:.3g} rad/s from slots that are irregular by {100 * found.slot_share:.2g} % (root sum of squares)."
    ) in said
    alone = list_limits(replace(found, slot_share=0.0))
    assert f"The noise floor is {tick:.3g} rad/s from the timer's tick of 4 µs." in alone  # one part is no sum
    (rises,) = (one for one in list_limits(replace(found, gap_before=0.5 * found.gap_after)) if "need not fall" in one)
    assert rises.endswith("Compare the first with the last.") and rises not in said
    assert "Validated on held_out.bag; no physical parameter was fitted to this motion." in said


def test_nothing_left_out_is_not_said_and_notes_come_once(found: Diagnosis) -> None:
    model = replace(found.model, notes=("a bag was cut off.", "a bag was cut off."))
    said = list_limits(replace(found, left_out=0, miscounted=0, undetectable=(), validation=(), model=model))
    assert not any("left out" in one or "could not show" in one for one in said)
    assert said.count("a bag was cut off.") == 1
    assert any("a quarter of the recorded motion" in one and "--validate" in one for one in said)


def test_an_unknown_noise_level_is_said(found: Diagnosis) -> None:
    info = replace(found.after.recordings[0].info, measurement=Measurement.SPEED, edges_per_revolution=0)
    recordings = tuple(replace(one, info=info) for one in found.after.recordings)
    quiet = tuple(replace(data, blur=0.0 * data.blur, slot=0.0) for data in found.after.intervals)
    after = replace(found.after, recordings=recordings, intervals=quiet)
    assert NO_NOISE in list_limits(replace(found, after=after, noise_floor=0.0, slot_share=0.0))
