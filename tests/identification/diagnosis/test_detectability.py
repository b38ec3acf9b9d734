"""What a recording could not have shown: traces that the model's own parameters imitate."""

from typing import Any

import numpy as np
import pytest
from diagnosed import fitted
from plant import profiles, record

from motor_identification.diagnosis import detectability, thresholds
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.detectability import (
    find_imitated,
    find_imitation,
    find_undetectable,
    list_unturned_discs,
)
from motor_identification.diagnosis.selection.selection import begin_selection
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.recording import check
from motor_identification.validation.hold_out import make_hold_out
from motor_model.parameters import PAPER_KA, PAPER_KV


def test_what_columns_imitate_is_removed_and_no_more() -> None:
    random = np.random.default_rng(0)
    columns, weight = random.standard_normal((50, 3)), random.uniform(0.1, 2.0, 50)
    own = random.standard_normal(50)
    own -= columns @ np.linalg.solve(columns.T @ (weight[:, None] * columns), columns.T @ (weight * own))
    imitated = columns @ [1.0, -2.0, 0.5]
    for trace, left in ((imitated, np.zeros(50)), (own + imitated, own)):
        assert trace - columns @ find_imitation(columns, trace, weight) == pytest.approx(left, abs=1e-9)


def test_a_rich_recording_shows_nearly_everything() -> None:
    estimate, hold_out = fitted()
    assert find_undetectable(validate_model(hold_out, estimate)) == ()


def test_a_single_step_does_not_show_friction() -> None:
    """At one level of voltage, friction is a smaller gain."""
    recording = check(
        record({"kv": PAPER_KV, "ka": PAPER_KA}, *profiles.step(10.0, 1.0), irregularity=0.003, seed=1)[0]
    )
    hold_out = make_hold_out([recording], [])
    problem = hold_out.restrict(make_problem([recording], ()))
    estimate = fit_speeds(Estimate(problem, np.log([PAPER_KV, PAPER_KA])))
    hidden = find_undetectable(validate_model(hold_out, estimate))
    assert {"coulomb_friction", "load_bias", "dead_zone", "direction_asymmetry"} <= set(hidden)
    assert "transport_delay" not in hidden  # of a step it is the first that one sees
    assert {"load_step", "warm_up"} <= set(hidden)  # which would be judged by what they were fitted to
    assert {"torque_ripple", "encoder_eccentricity"} <= set(hidden)  # of which any motion that was seen has some line


@pytest.mark.parametrize(("limit", "told"), [(0.99, True), (1.01, False)])
@pytest.mark.parametrize("of_errors", [True, False])
def test_a_step_tells_what_kv_would_be_beside_a_friction_that_it_does_not_show(
    limit: float, told: bool, of_errors: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At 10 V a friction of 0.3 V is 3 % of kv, of which the standard error of a motor without any says nothing."""
    recording = check(record({"kv": PAPER_KV, "ka": PAPER_KA}, *profiles.step(10.0, 1.0), seed=1)[0])
    hold_out = make_hold_out([recording], [])
    estimate = fit_speeds(Estimate(hold_out.restrict(make_problem([recording], ())), np.log([PAPER_KV, PAPER_KA])))
    model = validate_model(hold_out, estimate)
    found = find_imitated(model, ("coulomb_friction", "torque_ripple"))
    assert found is not None and found.effect == "coulomb_friction"
    assert found.kv == pytest.approx((1.0 - found.size / 10.0) * PAPER_KV, rel=2e-3)
    change = abs(found.kv / estimate.parameters.value("kv") - 1.0)
    assert thresholds.IMITATION < change < 0.05
    if of_errors:
        sure = -np.log(found.kv / estimate.parameters.value("kv")) / model.uncertainty.errors[0]
        monkeypatch.setattr(thresholds, "SURE_IMITATION", limit * sure)
    else:
        monkeypatch.setattr(thresholds, "IMITATION", limit * change)
    assert (find_imitated(model, ("coulomb_friction",)) is not None) is told
    assert find_imitated(model, ()) is None and find_imitated(model, ("torque_ripple",)) is None
    monkeypatch.setattr(thresholds, "MOST_IMITATION", change * (1.01 if told else 0.99))
    worst = find_imitated(model, ("direction_asymmetry", "coulomb_friction", "transport_delay"))
    assert (worst is not None) is told  # what it shows, or what changes nothing, is none


@pytest.mark.parametrize(("turns", "shown"), [(1.8, False), (2.3, True)])
def test_what_repeats_shows_from_two_turns_on(turns: float, shown: bool) -> None:
    """A joint that swings by less than that has no angle twice."""
    seconds = turns * np.pi * 2.0 * PAPER_KV / 3.0
    drive = profiles.joined(profiles.pieces([3.0], [seconds]), *4 * [profiles.pieces([-3.0, 3.0], [seconds, seconds])])
    recording = check(record({"kv": PAPER_KV, "ka": 0.02 * PAPER_KV}, *drive, single_channel=False, seed=1)[0])
    hold_out = make_hold_out([recording], [])
    problem = hold_out.restrict(make_problem([recording], ()))
    model = validate_model(hold_out, fit_speeds(Estimate(problem, np.log([PAPER_KV, 0.02 * PAPER_KV]))))
    assert model.turns == pytest.approx(turns, abs=0.15)
    assert {"torque_ripple", "encoder_eccentricity"}.isdisjoint(find_undetectable(model)) is shown


@pytest.mark.parametrize(
    ("eccentricity", "turns", "told"),
    [(0.1, 0.3, ("encoder_eccentricity",)), (0.0, 0.3, ()), (0.1, 2.4, ())],  # of more turns it is a finding, or none
)
def test_a_disc_that_hardly_comes_round_may_be_eccentric_where_the_motion_speaks_for_it(
    eccentricity: float, turns: float, told: tuple[str, ...]
) -> None:
    """A shaft of an angle loop turned by 0.14, likelier by 118 with an eccentricity, which it "could not show"."""
    kv, volts = 40.0 * PAPER_KV, np.random.default_rng(3).uniform(0.3, 1.0, 40) * 6.0
    seconds = turns * np.pi * 2.0 * kv / volts
    pieces = [profiles.pieces([v, -v], [s, s]) for v, s in zip(volts[:6], seconds[:6], strict=True)]
    values = {"kv": kv, "ka": 0.02 * kv} | ({"eccentricity": eccentricity} if eccentricity else {})
    drive = profiles.joined(*pieces)
    recording = check(record(values, *drive, single_channel=False, edges=2400, seed=1)[0])
    hold_out = make_hold_out([recording], [])
    problem = hold_out.restrict(make_problem([recording], ()))
    fit = fit_speeds(Estimate(problem, np.log([kv, 0.02 * kv])))
    assert list_unturned_discs(begin_selection(fit, hold_out, 1)) == told


def test_what_is_not_determined_beside_kv_may_go_anywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """The speed over which a breakaway of a real motor fades went to 1e-58 rad/s, which is not physical."""
    recording = check(record({"kv": PAPER_KV, "ka": PAPER_KA}, *profiles.step(10.0, 1.0), seed=1)[0])
    hold_out = make_hold_out([recording], [])
    estimate = fit_speeds(Estimate(hold_out.restrict(make_problem([recording], ())), np.log([PAPER_KV, PAPER_KA])))
    model = validate_model(hold_out, estimate)
    lstsq = np.linalg.lstsq
    assert "kv" not in model.uncertainty.not_identifiable

    def far(columns: np.ndarray, *rest: Any, **options: Any) -> Any:
        found = lstsq(columns, *rest, **options)
        found[0][1:] = 130.0  # of all but kv, logarithms of most
        return found

    monkeypatch.setattr(detectability, "_expect_evidence", lambda model, left: 0.0)
    monkeypatch.setattr(np.linalg, "lstsq", lambda columns, *_, **__: (np.full(columns.shape[1], -1e3),))
    assert find_imitated(model, ("dead_zone", "quadratic_drag")) is None
    monkeypatch.setattr(np.linalg, "lstsq", far)
    found = find_imitated(model, ("dead_zone", "quadratic_drag"))
    assert found is not None and 0.5 * PAPER_KV < found.kv < PAPER_KV
