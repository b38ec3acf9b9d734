"""A diagnosis in words: complete, and true to the numbers."""

import re
from dataclasses import replace

import pytest

from motor_identification.diagnosis.evidence.command_evidence import Ignored
from motor_identification.diagnosis.result import Diagnosis, Imitated, Nearest, Verdict
from motor_identification.diagnosis.thresholds import EXPLAINED_GAP
from motor_identification.discrepancy.structure import Structure
from motor_identification.noise.error_model import Disturbance
from motor_identification.reporting import diagnosis_text
from motor_identification.reporting.diagnosis_table import format_parameters
from motor_identification.reporting.diagnosis_text import SEEN, UNPREDICTED, summarize_diagnosis
from motor_identification.reporting.names import capitalize, join_effects
from motor_model.effects import EFFECTS


def test_summaries(variants: dict[Verdict, Diagnosis]) -> None:
    said = {verdict: summarize_diagnosis(one) for verdict, one in variants.items()}
    one = variants[Verdict.EXPLAINED]
    ratio = f"{one.gap_after / one.noise_floor:.2g} × the noise floor of {one.noise_floor:.3g} rad/s"
    fell = f"validation RMS error (gap) falls from {one.gap_before:.3g} to {one.gap_after:.3g} rad/s ({ratio})"
    assert re.match(r"Coulomb friction \(ks = 0\.4\d* ± [\d.e-]+ V\) was missing\.", said[Verdict.EXPLAINED])
    hidden = f" This recording could not show {join_effects(one.undetectable)}." if one.undetectable else ""
    assert said[Verdict.EXPLAINED].endswith(f"With it, the {fell}.{hidden}")
    assert said[Verdict.NOTHING_MISSING] == (
        f"Nothing is missing: the validation RMS error (gap) is {one.gap_after:.3g} rad/s, {ratio}."
    )
    assert said[Verdict.UNDECIDED] == (
        "Coulomb friction, dead zone or load bias is missing; this recording cannot distinguish them. "
        f"The {fell}. Record the profile 'coast' and diagnose both recordings together."
    )
    assert said[Verdict.UNEXPLAINED].startswith("An effect that is not in the table is missing: the validation RMS")
    assert f"{capitalize(one.findings[0].where)}. Residual torque over the speed: -0.3" in said[Verdict.UNEXPLAINED]


@pytest.mark.parametrize("rivals", [(), ("transport_delay",)])
def test_a_lag_that_may_be_of_the_sensor_is_told_as_one_of_both(
    variants: dict[Verdict, Diagnosis], rivals: tuple[str, ...]
) -> None:
    one, lag = variants[Verdict.EXPLAINED], {"electrical_time_constant": (0.0675, 0.0007)}
    named = replace(one.findings[0], effect="armature_inductance", parameters=lag, ambiguous_with=rivals)
    doubted = replace(named, sensor_may_lag=True)
    said = summarize_diagnosis(replace(one, verdict=Verdict.UNDECIDED, findings=(one.findings[0], doubted)))
    names = "Armature inductance or transport delay" if rivals else "Armature inductance"
    size = re.escape(format_parameters(named))
    assert re.match(
        rf"Coulomb friction \(ks = .* V\) was missing\. {names} is missing \({size}\), or the speeds were smoothed or "
        r"late before they were logged; this recording cannot distinguish them\. Log the encoder's counts, or say how",
        said,
    )
    assert "were smoothed or late" not in summarize_diagnosis(replace(one, findings=(named,)))


def test_a_gap_that_rises_beside_a_random_torque_is_said_to_rise(variants: dict[Verdict, Diagnosis]) -> None:
    one = variants[Verdict.EXPLAINED]
    said = summarize_diagnosis(replace(one, gap_before=1.0, gap_after=1.05))
    assert "(gap) rises from 1 to 1.05 rad/s" in said and "most of it is of a random torque" in said
    assert "rises" not in summarize_diagnosis(one) and "random torque" not in summarize_diagnosis(one)


def test_an_undecided_recording_without_findings_says_what_it_hides(variants: dict[Verdict, Diagnosis]) -> None:
    one = replace(variants[Verdict.NOTHING_MISSING], verdict=Verdict.UNDECIDED, undetectable=("dead_zone", "backlash"))
    assert "Nothing is missing that this recording could show" in summarize_diagnosis(one)
    assert summarize_diagnosis(one).endswith("This recording could not show dead zone or backlash.")
    beside = replace(one, imitated=Imitated("dead_zone", 0.351, 0.1419))
    assert summarize_diagnosis(beside).endswith(
        "show dead zone or backlash. kv and its ± hold without those: beside dead zone (dead_zone_voltage = 0.35 V), "
        "say, kv would be 0.142 V·s/rad."
    )
    alike = replace(
        variants[Verdict.UNDECIDED], undetectable=("dead_zone",), imitated=Imitated("dead_zone", 0.351, 0.1419)
    )
    assert "could not show: beside dead zone" in summarize_diagnosis(alike)
    assert "could not show dead" not in summarize_diagnosis(alike)
    bent = replace(one, imitated=Imitated("coast_drive", 0.2, 0.1419))
    assert "beside coast drive (coast_share = 0.2), say" in summarize_diagnosis(bent)
    assert join_effects(tuple(effect.name for effect in EFFECTS)).endswith(f" and {len(EFFECTS) - 6} others")


@pytest.mark.parametrize(("swept", "above"), [(True, 1.31), (True, 1.29), (False, 1.31)])
def test_what_a_sweep_does_not_tell_is_said(
    swept: bool, above: float, variants: dict[Verdict, Diagnosis], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(diagnosis_text, "goes_with_sweep", lambda structure, held: swept)
    one = variants[Verdict.EXPLAINED]
    left = (Structure("time", 0.15, 90.0),)
    one = replace(one, verdict=Verdict.UNDECIDED, structure=left, gap_after=above * one.sensor_floor, disturbance=None)
    open_ = swept and above > EXPLAINED_GAP
    said = summarize_diagnosis(replace(one, findings=()))
    assert said.startswith("Something is missing that a sweep does not tell") is open_
    assert ("Of what is left, 15 % can be predicted from the time within the recording." in said) is open_
    assert "not in the table" not in said
    found = summarize_diagnosis(one)
    assert (" may be missing" in found) is open_ and (" was missing" in found) is not open_


def test_a_motor_that_no_voltage_moves_like_this_is_said(variants: dict[Verdict, Diagnosis]) -> None:
    one = replace(variants[Verdict.NOTHING_MISSING], verdict=Verdict.UNDECIDED)
    assert "But kv ended" not in summarize_diagnosis(one)
    walled = replace(one, model=replace(one.model, on_bound=one.model.on_bound | {"kv": True}))
    assert "But kv ended at the limit of what is searched: no motor moves like this" in summarize_diagnosis(walled)
    named = replace(walled, findings=variants[Verdict.EXPLAINED].findings)
    said = summarize_diagnosis(named)
    assert walled.is_of_no_motor and " may be missing" in said and "was missing" not in said


def test_what_was_found_until_a_time_limit_is_not_sure(found: Diagnosis) -> None:
    """No elimination has looked at it: an inductance that a dead time was found beside, and that was none."""
    hurried = summarize_diagnosis(replace(found, verdict=Verdict.UNDECIDED, time_limit=30.0))
    assert hurried.startswith("The time limit of 30 s ended") and " may be missing" in hurried
    assert "was missing" not in hurried and "is missing" not in hurried


@pytest.mark.parametrize(
    ("above", "undetermined", "sure"), [(1.31, ("warm_up",), False), (1.29, ("warm_up",), True), (1.31, (), True)]
)
def test_a_finding_beside_what_is_not_determined_may_stand_in_for_it(
    above: float, undetermined: tuple[str, ...], sure: bool, variants: dict[Verdict, Diagnosis]
) -> None:
    """A coasting bridge and a dead time were left of a disc that was not determined, and nearly all of the gap."""
    found = variants[Verdict.EXPLAINED]
    left = replace(found, disturbance=None, gap_after=above * found.sensor_floor, undetermined=undetermined)
    said = summarize_diagnosis(replace(left, verdict=Verdict.UNDECIDED))
    assert ("was missing" in said or "were missing" in said) is sure
    assert ("may be missing" in said) is not sure


def test_of_a_motion_that_does_not_follow_its_command_kv_is_not_said_as_well(
    variants: dict[Verdict, Diagnosis], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A propeller's pendulum was told to check its columns twice, the second time with a But."""
    monkeypatch.setattr(diagnosis_text, "find_ignored", lambda held: Ignored(0.0629, 0.039))
    one = replace(variants[Verdict.NOTHING_MISSING], verdict=Verdict.UNDECIDED)
    walled = replace(one, model=replace(one.model, on_bound=one.model.on_bound | {"kv": True}))
    said = summarize_diagnosis(walled)
    assert said.startswith("The motion hardly follows the command: a motor leaves 0.0629 rad/s") and "kv" not in said
    named = replace(walled, findings=variants[Verdict.EXPLAINED].findings)
    assert "But kv ended at the limit" in summarize_diagnosis(named)


def test_what_has_no_size_is_told_without_a_contradiction(variants: dict[Verdict, Diagnosis]) -> None:
    open_ones = ("warm_up", "load_step")
    nothing = replace(variants[Verdict.UNDECIDED], findings=(), undetermined=open_ones)
    for times, missing in ((1.31, "is"), (1.29, "may be")):  # of the floor: a torque, or gains, may be all that is left
        said = summarize_diagnosis(replace(nothing, gap_after=times * nothing.noise_floor))
        assert said.startswith(f"Something {missing} missing that this recording does not determine: the")
    assert "It may be warm up or load step, but this recording does not tell how much." in summarize_diagnosis(nothing)
    for verdict in (Verdict.EXPLAINED, Verdict.UNDECIDED):
        said = summarize_diagnosis(replace(variants[verdict], undetermined=open_ones[:1]))
        assert "Warm up may be there, too, but this recording does not tell how much." in said
        assert "does not tell" not in summarize_diagnosis(variants[verdict])


@pytest.mark.parametrize(
    ("turns", "effect", "scaled"),
    [(0.9, "encoder_eccentricity", True), (1.1, "encoder_eccentricity", False), (0.9, "warm_up", False)],
)
def test_a_disc_of_less_than_a_turn_may_scale_the_motor(
    turns: float, effect: str, scaled: bool, variants: dict[Verdict, Diagnosis], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A back-EMF was off by 3.5 %, 4.7 of its standard errors, and nothing said so."""
    monkeypatch.setattr(diagnosis_text, "count_turns", lambda intervals, angles: turns)
    said = summarize_diagnosis(replace(variants[Verdict.EXPLAINED], undetermined=(effect,)))
    assert ("kv and ka may be off by more than their errors" in said) is scaled


def test_a_finding_of_no_determined_size_may_be_missing_beside_one_that_is(variants: dict[Verdict, Diagnosis]) -> None:
    one = variants[Verdict.EXPLAINED]
    (found,) = one.findings
    vague = replace(found, effect="dead_zone", parameters={"dead_zone_voltage": (0.1, float("nan"))})
    said = summarize_diagnosis(replace(one, verdict=Verdict.UNDECIDED, findings=(found, vague)))
    assert re.match(
        r"Coulomb friction \(ks = [^)]*\) was missing\. "
        r"Dead zone \(dead_zone_voltage = 0\.1 V \(not identifiable\)\) may be missing; "
        r"this recording does not tell how much\. The",
        said,
    )
    assert "tell how much" not in summarize_diagnosis(replace(one, verdict=Verdict.UNDECIDED))


@pytest.mark.parametrize(
    ("other", "errors", "said"),
    [
        ("static_friction", 2.9, False),
        ("static_friction", 3.1, True),
        ("dead_zone", 2.9, True),  # which can be without it
    ],
)
def test_what_has_no_size_and_is_implied_is_not_said_to_be_missing(
    variants: dict[Verdict, Diagnosis], other: str, errors: float, said: bool
) -> None:
    """Three real motors broke away, and 'Coulomb friction (ks = 0 ± 0.014 V)' was said to be missing, too."""
    one = variants[Verdict.EXPLAINED]
    (found,) = one.findings
    friction = replace(found, effect="coulomb_friction", parameters={"ks": (errors * 0.014, 0.014)})
    second = replace(found, effect=other, parameters={"breakaway_voltage": (0.46, 0.05)})
    for verdict in (Verdict.EXPLAINED, Verdict.UNDECIDED):
        text = summarize_diagnosis(replace(one, verdict=verdict, findings=(friction, second)))
        assert ("Coulomb friction" in text) is said and ("were missing" in text) is said and "0.46" in text
    unsure = replace(second, ambiguous_with=("torque_ripple",))
    text = summarize_diagnosis(replace(one, verdict=Verdict.UNDECIDED, findings=(friction, unsure)))
    assert ("Coulomb friction" in text) is said and "or torque ripple is missing" in text


def test_where_nothing_was_held_out_the_gap_is_no_validation(variants: dict[Verdict, Diagnosis]) -> None:
    for verdict, one in variants.items():
        said = summarize_diagnosis(replace(one, after=replace(one.after, seen=True)))
        assert (
            "validation RMS" not in said
            and "the RMS error (gap) " in said.replace("The RMS", "the RMS")
            and SEEN in said
        )
        assert "may be" not in said and SEEN not in summarize_diagnosis(variants[verdict])


def test_what_one_response_shows_may_be_missing(variants: dict[Verdict, Diagnosis]) -> None:
    once = {
        verdict: replace(one, after=replace(one.after, seen=True, confirms=False)) for verdict, one in variants.items()
    }
    clear = replace(once[Verdict.EXPLAINED], verdict=Verdict.UNDECIDED)
    assert re.match(
        r"Coulomb friction \(ks = 0\.4\d* ± [\d.e-]+ V\) may be missing\. The RMS", summarize_diagnosis(clear)
    )
    more = replace(once[Verdict.UNEXPLAINED], verdict=Verdict.UNDECIDED, findings=())
    assert summarize_diagnosis(more).startswith("Something may be missing that one response does not tell: the RMS")
    rivals = summarize_diagnosis(once[Verdict.UNDECIDED])
    assert rivals.startswith("Coulomb friction, dead zone or load bias may be missing; this recording cannot")


@pytest.mark.parametrize(("times", "told"), [(0.99, True), (1.01, False)])
def test_nothing_is_missing_is_not_said_where_a_random_torque_may_hide_it(
    variants: dict[Verdict, Diagnosis], times: float, told: bool
) -> None:
    """Where it leaves more than the sensor does: a tenth of the voltage was learnt of a real coasting bridge."""
    one = replace(variants[Verdict.NOTHING_MISSING], verdict=Verdict.UNDECIDED, undetectable=("backlash",))
    torque = Disturbance(1.274, 0.07, 0.175, 0.014)
    said = summarize_diagnosis(
        replace(one, disturbance=torque, gap_after=times * EXPLAINED_GAP * one.sensor_floor, noise_floor=one.gap_after)
    )
    headline = (
        "Nothing is missing that this recording could show:"
        if told
        else "Nothing can be told apart from a random torque"
    )
    assert said.startswith(headline) and "a torque of 1.274 ± 0.07 V RMS" in said


def test_the_variable_that_predicts_the_rest_is_named(variants: dict[Verdict, Diagnosis]) -> None:
    left = (Structure("speed", 0.62, 90.0), Structure("angle", 0.2, 50.0))
    said = summarize_diagnosis(replace(variants[Verdict.UNEXPLAINED], structure=left))
    assert "Of what is left, 62 % can be predicted from the speed." in said
    cause = (Structure("past", 0.94, 90.0, True, "a ramp of 25 V/s"), *left)
    said = summarize_diagnosis(replace(variants[Verdict.UNEXPLAINED], structure=cause))
    assert "Of what is left, 94 % is what a ramp of 25 V/s would leave." in said and "predicted" not in said
    faint = (Structure("speed", 0.05, 90.0),)
    assert "predicted" not in summarize_diagnosis(replace(variants[Verdict.UNEXPLAINED], structure=faint))


@pytest.mark.parametrize(
    ("effects", "come", "they"),
    [
        (("coulomb_friction",), "Coulomb friction comes nearest: with it", "it"),
        (("dead_zone", "coast_drive"), "Dead zone and coast drive come nearest: with them", "they"),
    ],
)
def test_what_comes_nearest_is_told_where_nothing_is_named(
    effects: tuple[str, ...], come: str, they: str, variants: dict[Verdict, Diagnosis]
) -> None:
    nothing = replace(variants[Verdict.UNEXPLAINED], findings=(), nearest=Nearest(effects, 11.23))
    said = f"{come} the gap would be 11.2 rad/s, but {they} may only stand in for what is missing."
    assert said in summarize_diagnosis(nothing)
    assert "nearest" not in summarize_diagnosis(replace(nothing, nearest=None))
    undecided = summarize_diagnosis(replace(nothing, verdict=Verdict.UNDECIDED))
    assert said in undecided and undecided.startswith("Something may be missing")
    unsized = replace(nothing, verdict=Verdict.UNDECIDED, undetermined=("load_step",))
    assert f"does not tell how much. {said}" in summarize_diagnosis(unsized)
    one = replace(nothing, verdict=Verdict.UNDECIDED, after=replace(nothing.after, confirms=False))
    assert said in summarize_diagnosis(one) and "one response does not tell" in summarize_diagnosis(one)
    without = summarize_diagnosis(replace(nothing, verdict=Verdict.UNDECIDED, nearest=None))
    assert without.startswith("More is left than the sensor leaves by what is known of it") and UNPREDICTED in without
    at_floor = replace(nothing, verdict=Verdict.UNDECIDED, nearest=None, sensor_floor=nothing.gap_after)
    said = summarize_diagnosis(at_floor)
    assert said.startswith("Nothing is missing that this recording could show") and UNPREDICTED not in said
