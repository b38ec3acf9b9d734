"""Sensors that nobody described: what fits and diagnoses make of them, end to end."""

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_counts
from servo import AXIS, record_servo
from swinging import RUBBING, held_late, noisy

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.result import Verdict
from motor_identification.identify import Request, identify
from motor_identification.recording import check
from motor_identification.reporting.diagnosis_text import summarize_diagnosis


@pytest.mark.slow
@pytest.mark.parametrize("sigma", [0.1, 5.0])
def test_a_fit_of_speeds_with_white_noise_is_right_to_within_its_standard_errors(sigma: float) -> None:
    score = []
    for seed in range(4):
        fit = identify([check(noisy(sigma, seed))], Request(("coulomb_friction",)))
        score += [(fit.parameters.values[name] - RUBBING[name]) / fit.standard_errors[name] for name in RUBBING]
        assert fit.parameters.values["ks"] == pytest.approx(RUBBING["ks"], rel=0.002 + 0.02 * sigma)
        assert sigma * 0.9 < fit.residual_rms < 1.1 * sigma
        assert not any("effect is missing" in note for note in fit.notes)
    assert 0.3 < np.sqrt(np.mean(np.square(score))) < 2.0


def test_friction_is_named_beside_white_noise_and_nothing_where_there_is_none() -> None:
    found = diagnose([check(noisy(1.0))])
    assert [one.effect for one in found.findings] == ["coulomb_friction"] and found.verdict is Verdict.EXPLAINED
    assert 0.87 < found.gap_after / found.noise_floor < 1.1 and 0.9 < found.noise_floor < 1.15


@pytest.mark.slow
def test_a_sensor_that_is_held_and_late_is_a_delay() -> None:
    """Frames of 20 ms, 80 ms late, in a log of 5 ms; a motor with a time constant of 0.3 s. Or the motor is late."""
    log = check(held_late(noisy(0.3, ka=0.02), rows=4, late=16))
    found = diagnose([log])
    named = {one.effect: one.parameters for one in found.findings}
    assert set(named) == {"coulomb_friction", "transport_delay"} and found.verdict is Verdict.UNDECIDED
    assert [one.sensor_may_lag for one in found.findings] == [one == "transport_delay" for one in named]
    assert "or the speeds were smoothed or late before they were logged" in summarize_diagnosis(found)
    assert 0.079 < named["transport_delay"]["delay"][0] < 0.081
    assert 0.47 < named["coulomb_friction"]["ks"][0] < 0.53
    assert "gives a new speed every 20 ms" in found.model.notes[0]


def test_a_scale_of_50_nm_fits_the_axis() -> None:
    """A sensor finer than anything else leaves the random force alone: within 5 % of the truth."""
    fit = identify([record_servo(duration=10.0)[0]], Request(("coulomb_friction", "load_bias")))
    for name, value in AXIS.items():
        assert fit.parameters.values[name] == pytest.approx(value, rel=0.05)
        assert fit.parameters.values[name] != pytest.approx(value, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("instant", [True, False], ids=["of an instant", "of the whole row"])
def test_a_ripple_is_named_in_speeds_with_white_noise(instant: bool) -> None:
    """Nothing counts the angle: it is summed up from the speeds, and is lost in what is held out."""
    ripple = {"ripple_voltage": 0.4, "ripple_cycles": 1.3, "ripple_phase": 0.5}
    found = diagnose([check(noisy(1.0, instant=instant, **ripple))])
    named = {one.effect: one.parameters for one in found.findings}
    assert set(named) == {"coulomb_friction", "torque_ripple"}
    assert 1.27 < named["torque_ripple"]["ripple_cycles"][0] < 1.33
    assert 0.3 < named["torque_ripple"]["ripple_voltage"][0] < 0.44  # the phase is not known better


@pytest.mark.slow
@pytest.mark.parametrize("held_out", [True, False])
def test_an_eccentric_disc_is_named_where_only_its_count_is_read(held_out: bool) -> None:
    """The angle in held-out motion is measured there; and where nothing is held out, a disc has its price."""
    wave = {"eccentricity": 0.03, "eccentricity_phase": 0.5}
    drive = profiles.random(6.0, 10.0, seed=1) if held_out else profiles.staircase(6.0, 3, 0.8)
    recording = record(RUBBING | wave, *drive, seed=1, edges=480, sample_rate=100.0, single_channel=False)[0]
    found = diagnose([check(as_counts(recording))])
    assert found.after.seen is not held_out
    named = {one.effect: one.parameters for one in found.findings}
    assert set(named) == {"coulomb_friction", "encoder_eccentricity"} and found.verdict is Verdict.EXPLAINED
    assert 0.0285 < named["encoder_eccentricity"]["eccentricity"][0] < 0.0315
