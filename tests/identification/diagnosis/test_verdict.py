"""How a diagnosis ends."""

from dataclasses import replace
from typing import Any, cast

import pytest
from diagnosed import fitted, with_effect
from stub_models import StubModel, stub_model, stub_test, with_effects
from stub_selections import selection_of, step_of

from motor_identification.diagnosis import findings, thresholds
from motor_identification.diagnosis import verdict as verdicts
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.evidence.command_evidence import Falling
from motor_identification.diagnosis.findings import doubt_lags
from motor_identification.diagnosis.result import Finding, Verdict
from motor_identification.diagnosis.selection.selection import Selection, begin_selection
from motor_identification.diagnosis.verdict import conclude, decide, list_unjudged_effects
from motor_identification.discrepancy.structure import LEAST_SHARE, Structure
from motor_identification.estimation.request import SearchReport
from motor_identification.estimation.whitened_fit import WhitenedFit
from motor_identification.noise.error_model import ErrorModel
from motor_identification.uncertainty.result import Fit
from motor_identification.uncertainty.summary import summarise_fit
from motor_model.effects import EFFECT_BY_NAME


def finding(*rivals: str) -> Finding:
    return Finding("coulomb_friction", 5.0, 1.0, 100.0, "", {}, (), rivals, "coast" if rivals else "")


def chosen(model: Model, outside: Structure | None = None) -> Selection:
    """A selection that ended with a model, and maybe without a backlash that stood in for something."""
    return replace(selection_of(model), outside=outside)


AT, OVER = 0.999 * thresholds.EXPLAINED_GAP, 1.001 * thresholds.EXPLAINED_GAP


@pytest.mark.parametrize(
    ("gap", "findings", "hidden", "verdict", "profile"),
    [
        (AT, (), (), Verdict.NOTHING_MISSING, ""),
        (AT, (finding(),), (), Verdict.EXPLAINED, ""),
        (AT, (finding("dead_zone"),), (), Verdict.UNDECIDED, "coast"),
        (AT, (finding("dead_zone"),), ("warm_up",), Verdict.UNDECIDED, "coast"),
        (AT, (finding(),), ("coulomb_friction",), Verdict.EXPLAINED, ""),
        (AT, (), ("coulomb_friction",), Verdict.UNDECIDED, "ramps"),
        (OVER, (), (), Verdict.UNEXPLAINED, ""),
        (OVER, (finding(),), ("warm_up",), Verdict.UNEXPLAINED, "rich"),
        (OVER, (finding("dead_zone"),), ("warm_up",), Verdict.UNEXPLAINED, "coast"),
    ],
)
def test_how_it_ended(
    gap: float, findings: tuple[Finding, ...], hidden: tuple[str, ...], verdict: Verdict, profile: str
) -> None:
    assert decide(findings, chosen(stub_model(gap, 0.0)), hidden) == (verdict, profile)


@pytest.mark.parametrize("said", [(), (finding(),)])
def test_what_nothing_predicts_is_not_said_to_be_outside_the_table(
    monkeypatch: pytest.MonkeyPatch, said: tuple[Finding, ...]
) -> None:
    """Missed edges of a fine encoder leave a noise that grows with the speed, which no torque makes."""
    model, sure = stub_model(OVER, 0.0), Structure("speed", 0.5, 90.0)
    monkeypatch.setattr(type(model), "complete", False)  # no torque makes it
    for left, verdict in (((sure,), Verdict.UNEXPLAINED), ((replace(sure, share=0.01),), Verdict.UNDECIDED)):
        monkeypatch.setattr(type(model), "structure", left)
        assert decide(said, chosen(model), ()) == (verdict, "")
    monkeypatch.setattr(type(model), "structure", ())
    assert decide(said, chosen(model), ())[0] is Verdict.UNDECIDED
    assert decide(said, chosen(model, sure), ())[0] is Verdict.UNEXPLAINED


@pytest.mark.parametrize(("times", "seen", "outside"), [(1.01, True, True), (0.99, True, False), (0.99, False, True)])
def test_a_small_share_of_motion_that_was_fitted_is_no_effect_outside_the_table(
    monkeypatch: pytest.MonkeyPatch, times: float, seen: bool, outside: bool
) -> None:
    """Of a real robot whose rows come late, a friction over the angle would have left 4 %, and nothing else did."""
    model = stub_model(OVER, 0.0)
    model = replace(model, held=replace(model.held, seen=seen))
    monkeypatch.setattr(type(model), "complete", False)
    monkeypatch.setattr(type(model), "structure", ())
    cause = Structure("angle", times * LEAST_SHARE, 90.0, relevant=True, cause="a friction that goes with the angle")
    verdict = Verdict.UNEXPLAINED if outside else Verdict.UNDECIDED
    assert decide((finding(),), chosen(model, cause), ()) == (verdict, "")


@pytest.mark.parametrize(
    ("variable", "share", "judged", "barred"),
    [
        ("time", 0.76, ["coulomb_friction"], ("warm_up",)),
        ("time", 0.01, ["coulomb_friction"], ()),  # by chance
        ("angle", 0.76, ["coulomb_friction", "torque_ripple"], ("encoder_eccentricity",)),
        ("angle", 0.76, ["torque_ripple", "encoder_eccentricity"], ()),
        ("speed", 0.76, ["coulomb_friction"], ()),
        ("time", 0.76, ["coulomb_friction", "warm_up"], ()),  # which was tried, and is not it
    ],
)
def test_what_goes_with_time_or_angle_may_be_what_could_not_be_judged(
    variable: str, share: float, judged: list[str], barred: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A warming-up in a sweep was said not to be in the table."""
    monkeypatch.setattr(type(stub_model(OVER, 0.0)), "structure", (Structure(variable, share, 90.0),))
    monkeypatch.setattr(verdicts, "list_candidates", lambda *_: judged)
    assert list_unjudged_effects(chosen(stub_model(OVER, 0.0))) == barred
    assert list_unjudged_effects(chosen(stub_model(OVER, 0.0), Structure("past", 0.9, 90.0, True, "a ramp"))) == ()
    monkeypatch.setattr(verdicts, "is_over_too_soon", lambda effect, _: effect == "warm_up")
    assert list_unjudged_effects(chosen(stub_model(OVER, 0.0))) == tuple(set(barred) - {"warm_up"})


@pytest.mark.parametrize(
    ("variable", "effects", "judged", "barred"),
    [
        ("speed", ("coulomb_friction",), [], ("static_friction",)),
        ("speed", ("coulomb_friction",), ["static_friction"], ()),  # which was tried, and is not it
        ("speed", ("dead_zone",), [], ()),  # beside which no breakaway is tried
        ("past", ("coulomb_friction",), [], ()),
    ],
)
def test_what_goes_with_the_speed_may_be_a_breakaway_that_could_not_be_judged(
    variable: str, effects: tuple[str, ...], judged: list[str], barred: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Under a PRBS of two levels it was said not to be in the table."""
    model = stub_model(OVER, 0.0)
    monkeypatch.setattr(type(model), "structure", (Structure(variable, 0.9, 90.0),))
    monkeypatch.setattr(type(model), "effects", effects)
    monkeypatch.setattr(verdicts, "list_candidates", lambda *_: judged)
    assert list_unjudged_effects(chosen(model)) == barred


@pytest.mark.parametrize(
    ("confirms", "verdict", "profile"), [(False, Verdict.UNDECIDED, "ramps"), (True, Verdict.EXPLAINED, "")]
)
def test_one_response_explains_nothing(confirms: bool, verdict: Verdict, profile: str) -> None:
    model = stub_model(AT, 0.0)
    model = replace(model, held=replace(model.held, confirms=confirms))
    assert decide((finding(),), chosen(model), ()) == (verdict, profile)
    assert decide((), chosen(model), ()) == (Verdict.NOTHING_MISSING, "")
    more = stub_model(OVER, 0.0)
    left = decide((), chosen(replace(more, held=replace(more.held, confirms=confirms))), ())
    assert left == ((Verdict.UNDECIDED, "rich") if not confirms else (Verdict.UNEXPLAINED, ""))


@pytest.mark.parametrize(("gap", "found"), [(AT, False), (OVER, False), (OVER, True)])
def test_what_is_not_determined_is_undecided_and_no_finding(gap: float, found: bool) -> None:
    verdict, profile = decide((finding(),) * found, chosen(stub_model(gap, 0.0)), (), ("transport_delay",))
    assert verdict is Verdict.UNDECIDED and profile == EFFECT_BY_NAME["transport_delay"].shown_by


@pytest.mark.parametrize(("times", "verdict"), [(0.99, Verdict.EXPLAINED), (1.01, Verdict.UNDECIDED)])
def test_what_no_torque_leaves_in_few_moments_is_undecided(times: float, verdict: Verdict) -> None:
    """Ten runs of a motor, each of which began late by another time, beside one dead time for all."""
    model = replace(stub_model(times * thresholds.MOMENTS_GAP), random=True)
    assert model.complete and model.noise_floor == pytest.approx(1.0)
    assert decide((finding(),), chosen(model), ()) == (verdict, "")


@pytest.mark.parametrize(("tossed", "verdict"), [(False, Verdict.EXPLAINED), (True, Verdict.UNDECIDED)])
def test_nothing_is_explained_beside_a_torque_larger_than_those_of_gears(
    monkeypatch: pytest.MonkeyPatch, tossed: bool, verdict: Verdict
) -> None:
    monkeypatch.setattr(Model, "is_tossed", tossed)
    assert decide((finding(),), chosen(stub_model(AT, 0.0)), ()) == (verdict, "")
    nothing = decide((), chosen(stub_model(AT, 0.0)), ())
    assert nothing == (Verdict.UNDECIDED if tossed else Verdict.NOTHING_MISSING, "")


@pytest.mark.parametrize(
    ("falling", "verdict"), [(None, Verdict.EXPLAINED), (Falling(5.2, 286.0, 11.2, 213.0), Verdict.UNDECIDED)]
)
def test_nothing_is_explained_where_the_speed_falls_as_the_voltage_rises(
    monkeypatch: pytest.MonkeyPatch, falling: Falling | None, verdict: Verdict
) -> None:
    """A real motor at 12 V was slower than at 5: its sensor missed edges, and a limit of the voltage explained it."""
    monkeypatch.setattr(verdicts, "find_falling", lambda held: falling)
    assert decide((finding(),), chosen(stub_model(AT, 0.0)), ()) == (verdict, "")


def test_a_lag_that_may_be_of_the_sensor_is_undecided() -> None:
    lag = replace(finding(), effect="armature_inductance")
    assert [one.sensor_may_lag for one in doubt_lags((finding(), lag))] == [False, True]
    for gap, sure in ((AT, Verdict.EXPLAINED), (OVER, Verdict.UNEXPLAINED)):
        assert decide((finding(), lag), chosen(stub_model(gap, 0.0)), ()) == (sure, "")
        doubted = decide(doubt_lags((finding(), lag)), chosen(stub_model(gap, 0.0)), ())
        assert doubted == (Verdict.UNDECIDED if gap == AT else Verdict.UNEXPLAINED, "")


def test_what_is_not_determined_takes_nothing_from_what_explains_everything() -> None:
    assert decide((finding(),), chosen(stub_model(AT, 0.0)), (), ("warm_up",)) == (Verdict.EXPLAINED, "")


@pytest.mark.parametrize(
    ("error", "verdict"),
    [(float("nan"), Verdict.UNDECIDED), (0.0501, Verdict.UNDECIDED), (0.0499, Verdict.EXPLAINED)],  # of 0.1 V
)
def test_a_finding_of_no_determined_size_may_be_missing(error: float, verdict: Verdict) -> None:
    profile = EFFECT_BY_NAME["coulomb_friction"].shown_by if verdict is Verdict.UNDECIDED else ""
    sized = replace(finding(), parameters={"ks": (0.1, error)})
    assert decide((finding(), sized), chosen(stub_model(AT, 0.0)), ()) == (verdict, profile)


@pytest.mark.parametrize("findings", [(), (finding(),)])
def test_a_backlash_that_stood_in_for_a_friction_that_builds_up_leaves_that_unexplained(
    findings: tuple[Finding, ...],
) -> None:
    outside = Structure("past", 0.005, 25.0, relevant=True)
    selection = chosen(stub_model(AT, 0.0), outside)
    assert outside.certain and selection.structure == (outside,) and not selection.complete
    assert decide(findings, selection, ()) == (Verdict.UNEXPLAINED, "")


@pytest.mark.parametrize(
    ("floor", "ended"), [(1.1 * OVER, (Verdict.UNDECIDED, "rich")), (0.5 * OVER, (Verdict.UNEXPLAINED, ""))]
)
def test_what_leaves_less_than_its_own_sensor_lacks_nothing_for_sure(
    monkeypatch: pytest.MonkeyPatch, floor: float, ended: tuple[Verdict, str]
) -> None:
    """As motors that were fitted as one: it was said to lack something outside the table at 0.36 times its floor."""
    monkeypatch.setattr(StubModel, "sensor_floor", floor)
    assert decide((), chosen(stub_model(OVER, 0.0)), ()) == ended


@pytest.mark.parametrize(("swept", "verdict"), [(True, Verdict.UNDECIDED), (False, Verdict.UNEXPLAINED)])
def test_what_goes_with_the_time_of_a_sweep_may_be_in_the_table(
    swept: bool, verdict: Verdict, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In a chirp of 4 s, too short to warm up in, that may be whatever depends on the frequency."""
    monkeypatch.setattr(verdicts, "goes_with_sweep", lambda structure, held: swept)
    assert decide((), chosen(stub_model(OVER, 0.0)), ())[0] is verdict
    assert decide((finding(),), chosen(stub_model(OVER, 0.0)), ())[0] is verdict


def test_what_a_model_lacks_that_is_no_motor_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two logs of what was no motor's axis were explained by a friction."""
    estimate, hold_out = fitted()
    selection = begin_selection(estimate, hold_out, 1)
    bags = estimate.problem.recordings
    fit = summarise_fit(selection.model.whitened, cast(SearchReport, None), lambda: 0.0)
    for hit, verdict in ((False, Verdict.NOTHING_MISSING), (True, Verdict.UNDECIDED)):
        told = replace(fit, on_bound={**fit.on_bound, "kv": hit})
        monkeypatch.setattr(verdicts, "summarise_fit", lambda *_, told=told: told)
        monkeypatch.setattr(verdicts, "find_undetectable", lambda model: ())
        found = conclude(selection.model, selection, bags, (), cast(SearchReport, None), lambda: 0.0)
        assert (found.verdict, found.is_of_no_motor) == (verdict, hit)


@pytest.mark.parametrize("walled", [(), ("coulomb_friction",), ("", "coulomb_friction")])
def test_what_no_motor_moves_like_has_no_size(walled: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    """A friction of 6.2 V "may be missing" in a position loop whose kv was at the limit, with it or without, too."""
    estimate, hold_out = fitted(ks=0.4)
    base, bags = begin_selection(estimate, hold_out, 1).model, estimate.problem.recordings
    model = validate_model(hold_out, with_effect(estimate, "coulomb_friction", {"ks": 0.4}))
    step = replace(step_of(CandidateTest("coulomb_friction", base, model)), rivals=("load_bias",))
    summarise = verdicts.summarise_fit

    def summarised(fit: WhitenedFit, *how: Any) -> Fit:
        told, effects = summarise(fit, *how), fit.problem.unknowns.effects
        return replace(told, on_bound={**told.on_bound, "kv": (effects[0] if effects else "") in walled})

    monkeypatch.setattr(verdicts, "summarise_fit", summarised)
    found = conclude(base, selection_of(model, step), bags, (), cast(SearchReport, None), lambda: 0.0, ("dead_zone",))
    assert found.verdict is Verdict.UNDECIDED and found.is_of_no_motor is ("" in walled)
    assert [one.effect for one in found.findings] == ([] if walled else ["coulomb_friction"])
    assert found.undetermined == (("coulomb_friction", "load_bias", "dead_zone") if walled else ("dead_zone",))
    assert found.gap_after == pytest.approx((base if walled else model).held.gap)


@pytest.mark.parametrize("beside", [True, False])
def test_a_finding_says_what_it_was_found_beside_and_is_no_more(beside: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Gaps of 0.390, 0.326 and 0.385 rad/s had an eccentric disc in between, of which nothing was certain."""
    estimate, hold_out = fitted(ks=0.45)
    last = begin_selection(with_effect(estimate, "coulomb_friction", {"ks": 0.45}), hold_out, 1).model
    before = with_effects(stub_model(9.0), "encoder_eccentricity", "coulomb_friction")
    before = replace(before, learned=cast(ErrorModel, beside or None))
    selection = selection_of(last, step_of(stub_test("coulomb_friction", before, 5.0, 100.0)))
    monkeypatch.setattr(verdicts, "find_undetectable", lambda model: ())
    monkeypatch.setattr(findings, "find_missed_edges", lambda model: None)
    monkeypatch.setattr(findings, "_locate", lambda step: "")
    bags = estimate.problem.recordings
    (found,) = conclude(last, selection, bags, (), cast(SearchReport, None), lambda: 0.0).findings
    assert found.given_up == ("encoder_eccentricity",) and found.beside_torque is beside
