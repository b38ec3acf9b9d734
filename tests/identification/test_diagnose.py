"""Effects hidden in the independent plant are named and sized, shown on data that no fit has seen; and nothing else."""

from dataclasses import replace

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_counts
from swinging import noisy
from tiers import keep_fast

from motor_identification import diagnose as module
from motor_identification.diagnose import Request, Stage, Stopped, diagnose
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_test import likelihood_threshold
from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.diagnosis.start import Start
from motor_identification.diagnosis.thresholds import FALSE_ALARM_RATE, MOST_TORQUE
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.experiment import make_plan, simulate_plan
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.noise.error_model import Disturbance
from motor_identification.noise.likelihood import Noise, estimate_noise, log_likelihood
from motor_identification.recording import Recording, check, recording_of
from motor_identification.reporting.diagnosis_text import summarize_diagnosis
from motor_identification.validation.hold_out import make_hold_out
from motor_model.effects import EFFECTS
from motor_model.errors import ModelError, MotorError, RecordingError
from motor_model.excitation import profile
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sensing.board import BoardConfig

BASE = {"kv": 0.9 * PAPER_KV, "ka": 1.2 * PAPER_KA}


def made(hidden: dict[str, float], drive: profiles.Profile, seed: int, edges: int = 96) -> Recording:
    return check(record(BASE | hidden, *drive, seed=seed, disc_seed=3, irregularity=0.005, edges=edges)[0])


def diagnosed(hidden: dict[str, float], known: tuple[str, ...] = ()) -> Diagnosis:
    """Trained on all profiles, judged on other voltages from another start."""
    later = hidden | ({"step_time": 4.0} if "step_time" in hidden else {})
    return diagnose(
        [made(hidden, profiles.compact(), 1)], [made(later, profiles.random(12.0, 10.0, 5), 2)], Request(known)
    )


def test_of_a_motor_that_runs_on_at_0_volts_that_is_said_and_no_effect() -> None:
    """A mark, 0 and 1, was taken for volts: "coast drive (coast_share = 0.9964 ± 0.0026) may be missing"."""
    log = noisy(0.1)
    marked = log.time >= 8.0
    speed = np.where(marked, 100.0 - 40.0 * np.exp(-np.maximum(log.time - 8.0, 0.0) / 0.1), 60.0)
    found = diagnose([replace(log, voltage=marked.astype(float), speed=speed + 0.01 * log.speed)])
    assert found.verdict is Verdict.UNDECIDED and not found.findings and found.suggested_experiment == ""
    text = summarize_diagnosis(found)
    assert "the motor turns at 60" in text and "in the first 8 s, in which the voltage is 0" in text
    assert "coast" not in text.lower() and text.endswith("No effect was looked for.")


@pytest.mark.parametrize(
    ("seen", "torque", "silent"),
    [
        (True, 0.99 * MOST_TORQUE, False),
        (True, 1.01 * MOST_TORQUE, True),
        (True, None, False),
        (False, None, True),
    ],
)
def test_beside_a_torque_that_no_gear_makes_it_is_told_what_comes_nearest(
    variants: dict[Verdict, Diagnosis], seen: bool, torque: float | None, silent: bool
) -> None:
    """A coasting bridge halved the gap, and was not named: three levels leave too few places for what else it needs."""
    held = replace(variants[Verdict.UNDECIDED].after, seen=seen)
    largest = max(float(np.max(np.abs(one.voltage))) for one in held.recordings)
    disturbance = None if torque is None else Disturbance(torque * largest, 0.01, 1.0, 0.1)
    found = replace(variants[Verdict.UNDECIDED], findings=(), after=held, gap_after=1.0, noise_floor=1.0)
    assert module._is_silent(replace(found, disturbance=disturbance)) is silent
    walled = replace(found, model=replace(found.model, on_bound={"kv": True}), disturbance=disturbance)
    assert not module._is_silent(walled)  # no motor moves like this
    named = variants[Verdict.UNDECIDED]
    assert not module._is_silent(replace(named, after=held, disturbance=disturbance))


SINGLES = {
    "transport_delay": {"delay": 0.006},
    "dead_zone": {"dead_zone_voltage": 0.5},
    "load_step": {"step_voltage": 0.4, "step_time": 11.0},
    "coast_drive": {"coast_share": 0.4},
    "encoder_eccentricity": {"eccentricity": 0.03, "eccentricity_phase": 1.0},
}


@pytest.mark.parametrize("effect", keep_fast(SINGLES, "transport_delay"))
def test_a_hidden_effect_is_named_and_sized(effect: str) -> None:
    hidden = SINGLES[effect]
    found = diagnosed(hidden)
    assert found.verdict is Verdict.EXPLAINED and [one.effect for one in found.findings] == [effect]
    (finding,) = found.findings
    for name, (value, sigma) in finding.parameters.items():
        if not name.endswith("_phase"):
            assert value == pytest.approx(hidden[name], rel=2e-3)
            assert 0.0 < sigma < 0.01 * abs(value)
    for name, value in BASE.items():
        assert found.model.parameters.value(name) == pytest.approx(value, rel=1e-4)
    assert finding.gap_before == pytest.approx(found.gap_before, rel=0.1)
    assert found.gap_before > 2.0 * found.noise_floor
    assert 0.8 < found.gap_after / found.noise_floor < 1.25
    assert finding.evidence > 100.0 > likelihood_threshold() and finding.ambiguous_with == ()
    others = {other.effect: other for other in finding.alternatives}
    assert set(others) <= {effect.name for effect in EFFECTS} and effect not in others
    assert all(other.evidence < finding.evidence - 100.0 for other in others.values())
    assert finding.where and found.undetectable == () and found.suggested_experiment == ""


def test_play_of_whole_turns_is_named_and_sized() -> None:
    """Play of an output's degrees is whole turns of a motor's shaft before the gear: here eight rows of its travel."""
    hidden = {"ks": 0.5, "backlash_angle": 6.5, "load_fraction": 0.6}
    found = diagnose([made(hidden, profiles.random(12.0, 10.0, 7), 3)])
    assert found.verdict is Verdict.EXPLAINED
    assert {one.effect for one in found.findings} == {"coulomb_friction", "backlash"}
    assert found.model.parameters.value("backlash_angle") == pytest.approx(6.5, rel=0.03)
    assert found.model.parameters.value("load_fraction") == pytest.approx(0.6, rel=0.02)


@pytest.mark.slow
def test_static_friction_comes_with_coulomb_friction() -> None:
    found = diagnosed({"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 4.0})
    assert [one.effect for one in found.findings] == ["coulomb_friction", "static_friction"]
    assert np.all(np.diff(found.trace) < 0.0) and len(found.trace) == 3
    assert found.model.parameters.value("breakaway_voltage") == pytest.approx(0.9, rel=2e-3)


@pytest.mark.slow
def test_two_at_once_and_what_first_stood_in_for_both_is_replaced() -> None:
    """A load step at the very beginning explains more than a constant load while friction is still missing."""
    found = diagnosed({"ks": 0.4, "bias_voltage": 0.3})
    assert {one.effect for one in found.findings} == {"coulomb_friction", "load_bias"}
    assert found.model.parameters.value("bias_voltage") == pytest.approx(0.3, rel=1e-3)
    assert 0.8 < found.gap_after / found.noise_floor < 1.15


def simulated(motor: Parameters, name: str) -> Recording:
    """One of our own profiles on a perfect disc, as `experiment --model` records it."""
    config = BoardConfig()
    plan = make_plan(profile(name), 10.0, 12.0, 1.0 / config.sample_rate)
    samples = [sample for _, sample in simulate_plan(plan, motor, config)]
    return check(recording_of(samples, config.info(motor), name))


@pytest.mark.slow
@pytest.mark.long
def test_two_that_hide_each_other_are_found_beside_a_third() -> None:
    """Friction lifts a static curve at its beginning, drag at its end: a line with another gain is near to both."""
    hidden = {"ks": 0.3, "breakaway_voltage": 0.8, "stribeck_speed": 4.0, "drag": 5e-5, "delay": 0.006}
    names = {"coulomb_friction", "static_friction", "quadratic_drag", "transport_delay"}
    tried: list[str] = []
    drive = profiles.joined(profiles.staircase(12.0, 4, 0.25), profiles.random(12.0, 2.5, 1))
    recording = made({"kv": PAPER_KV, "ka": PAPER_KA} | hidden, drive, 1)
    found = diagnose([recording], request=Request(workers=2), progress=lambda stage: tried.append(stage.text))
    assert any(" with " in text for text in tried)  # pairs: none of what is left is a finding alone
    assert {one.effect for one in found.findings} == names and found.verdict is Verdict.EXPLAINED
    for name, value in hidden.items():
        assert found.model.parameters.value(name) == pytest.approx(value, rel=2e-3)
    assert 5.0 < found.gap_before / found.gap_after < 50.0


@pytest.mark.slow
def test_a_friction_that_is_a_hair_off_is_no_second_effect() -> None:
    """A fit just below the true friction creeps where the motor was held, and what stops it there is not missing."""
    motor = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.45}, ("coulomb_friction",))
    found = diagnose([simulated(motor, name) for name in ("step", "ramps")])
    assert [one.effect for one in found.findings] == ["coulomb_friction"] and found.verdict is Verdict.EXPLAINED
    assert found.model.parameters.value("ks") == pytest.approx(0.45, rel=1e-4)


def test_seconds_in_which_no_winding_warms_up_are_enough_for_nothing_to_be_missing() -> None:
    found = diagnose([made({}, profiles.random(12.0, 8.0, 7), 3)])
    assert found.verdict is Verdict.NOTHING_MISSING and found.findings == () and "warm_up" in found.undetectable


def test_nothing_hidden_nothing_named() -> None:
    found = diagnosed({})
    assert found.verdict is Verdict.NOTHING_MISSING and found.findings == ()
    assert found.gap_before == found.gap_after and 0.8 < found.gap_after / found.noise_floor < 1.15


@pytest.mark.slow
def test_what_is_known_is_not_found_again() -> None:
    found = diagnosed({"ks": 0.4, "delay": 0.006}, ("coulomb_friction",))
    assert found.baseline.parameters.effects == ("coulomb_friction",)
    assert [one.effect for one in found.findings] == ["transport_delay"]


def test_missed_edges_are_counted() -> None:
    found = diagnosed({"miss_rate": 0.005})
    assert [one.effect for one in found.findings] == ["missed_edges"]
    rate, sigma = found.findings[0].parameters["miss_rate"]
    assert abs(rate - 0.005) < 4.0 * sigma and 1e-4 < sigma < 1e-3


def test_missed_edges_among_many_in_a_row_are_counted_and_no_slower_motor() -> None:
    """A constant share of what lies between two rows would be a larger kv by as much."""
    rows = [made({"miss_rate": 0.03}, profiles.random(9.0, 4.0, seed), seed, edges=1024) for seed in (3, 4)]
    found = diagnose(rows[:1], validation=rows[1:])
    assert [one.effect for one in found.findings] == ["missed_edges"]
    rate, sigma = found.findings[0].parameters["miss_rate"]
    assert abs(rate - 0.03) < 4.0 * sigma and 1e-4 < sigma < 3e-3
    assert found.model.parameters.value("kv") == pytest.approx(BASE["kv"], rel=2e-3)


def test_a_single_step_cannot_tell_and_says_what_would() -> None:
    step = made({"ks": 0.4}, profiles.step(10.0, 1.0), 4)
    alone = diagnose([step])
    assert alone.verdict is Verdict.UNDECIDED and alone.findings == ()
    assert "coulomb_friction" in alone.undetectable and alone.suggested_experiment == "ramps"
    both = diagnose([step, made({"ks": 0.4}, profiles.ramps(12.0, 1.5), 5)])
    assert [one.effect for one in both.findings] == ["coulomb_friction"] and both.verdict is Verdict.EXPLAINED
    assert both.model.parameters.value("ks") == pytest.approx(0.4, rel=2e-3)


@pytest.mark.slow
def test_a_part_of_one_recording_is_kept_out_of_every_fit() -> None:
    recording = made({"ks": 0.4}, profiles.compact(), 6)
    problem = make_problem([recording], ("coulomb_friction",))
    theta = np.array([np.log(BASE["kv"]), np.log(BASE["ka"]), 0.4])
    model = validate_model(make_hold_out([recording], []), Estimate(problem, theta))
    (scored,) = model.held.scored
    assert 0.2 < scored.mean() < 0.3
    found = diagnose([recording])
    assert [one.effect for one in found.findings] == ["coulomb_friction"]
    (fitted,), (judge,) = found.after.intervals, found.after.scored
    assert 0.2 < judge.sum() / len(fitted.first) < 0.3


def test_the_stop_rule_keeps_its_word() -> None:
    """A likelihood ratio on unseen data exceeds e^k with a chance of at most e^−k; here: a false wave."""
    data = make_intervals(made({}, profiles.step(8.0, 0.5), 7))
    data = replace(data, slack=0.0 * data.slack)
    random = np.random.default_rng(0)
    truth, wrong = Noise(0.01, 0.0), 0.003 * data.slot * np.sin(np.arange(len(data.first)) / 30.0)
    edges = 0.01 * data.slot * random.standard_normal((4000, len(data.first) + 1))
    ratios = np.array(
        [log_likelihood(data, row, truth) - log_likelihood(data, row - wrong, truth) for row in np.diff(edges, axis=1)]
    )
    for level in (1.0, 2.0, 3.0):
        assert np.mean(-ratios > level) < np.exp(-level)
    assert np.mean(ratios) > 0.5  # and it was a model that differs
    assert likelihood_threshold() == pytest.approx(np.log(len(EFFECTS) / FALSE_ALARM_RATE))
    found = estimate_noise([(data, np.diff(edges[0]))])
    assert 0.006 < found.share < 0.016 and found.drift == 0.0


def test_a_time_limit_ends_the_look_at_a_timing(monkeypatch: pytest.MonkeyPatch) -> None:
    """It takes longer than a selection where a log has a hundred thousand rows; without it the first fit is known."""
    recording, asked = made({"ks": 0.4}, profiles.staircase(10.0, 3, 0.3), 8), []

    def look(first: Start, selection: Selection) -> None:
        asked.append(selection is first.selection)
        first.selection.hold_out.problem.raise_if_stopped()
        asked.append("not stopped")

    monkeypatch.setattr("motor_identification.diagnosis.selection.timed_selection.find_timing_beside", look)
    hurried = diagnose([recording], request=Request(time_limit=1e-9))
    assert asked == [True] and hurried.verdict is Verdict.UNDECIDED and hurried.time_limit == 1e-9


def test_progress_stop_and_refusals() -> None:
    recording = made({"ks": 0.4}, profiles.staircase(10.0, 3, 0.3), 8)
    heard: list[Stage] = []
    diagnose([recording], progress=heard.append)
    shares = [stage.share for stage in heard]
    assert shares == sorted(shares) and shares[0] == 0.0 and 0.5 < shares[-1] <= 1.0
    assert any(stage.best_effect == "coulomb_friction" for stage in heard)
    with pytest.raises(Stopped, match="stopped"):
        diagnose([recording], stopped=lambda: True)
    hurried = diagnose([recording], request=Request(time_limit=1e-9))  # the first fit is always made
    assert hurried.verdict is Verdict.UNDECIDED and hurried.time_limit == 1e-9 and hurried.findings == ()
    assert summarize_diagnosis(hurried).startswith("The time limit of 1e-09 s ended the search: ")
    assert hurried.gap_after == hurried.gap_before and np.isfinite(hurried.model.parameters.value("kv"))
    with pytest.raises(MotorError, match="positive number of seconds"):
        Request(time_limit=0.0)
    with pytest.raises(ModelError, match="not an effect"):
        diagnose([recording], request=Request(("gremlins",)))
    with pytest.raises(RecordingError, match="no recording"):
        diagnose([])


QUICK = {"kv": 0.078, "ka": 0.00184}  # 23.6 ms
STAIRS = np.array([0.3, 0.7, 1.0, 0.5, 0.8]) * 12.0


@pytest.mark.parametrize("seed", [4, 5])
def test_a_slow_torque_beside_a_quick_motor_is_no_unknown_effect(seed: int) -> None:
    """Least squares leave less of what they have seen than any fit beside a torque does: 1.32 rad/s, not 1.39."""
    hidden = {"random_torque": 0.12, "random_torque_time": 0.7, "random_torque_seed": float(seed)}
    time = np.arange(len(STAIRS)) * 1.8
    recording, _ = record(
        QUICK | hidden, time, STAIRS, duration=9.0, seed=seed, edges=4096, sample_rate=200.0, single_channel=False
    )
    found = diagnose([check(as_counts(recording))])
    assert found.verdict in (Verdict.UNDECIDED, Verdict.NOTHING_MISSING) and not found.findings
    assert found.disturbance is not None
    assert 0.06 < found.disturbance.rms_voltage < 0.25
