"""Steady states become stairs, each compared at its end."""

from math import isnan, tau

import numpy as np
import pytest

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.effect_test import is_static
from motor_identification.identify import Request, identify
from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.steady import HOLD, LONGEST, read_steady
from motor_identification.recording import Floats, check, recording_of
from motor_model.errors import RecordingError
from motor_model.sample import Info, Measurement

FORM = CsvForm(None, "u", "y", Kind.SPEED, "rpm", count_quantum=6.0)


def test_every_row_is_a_stair_whose_speed_comes_at_its_end() -> None:
    steady = read_steady(FORM, Info(), np.array([2.0, 4.0, 6.0]), np.array([60.0, 120.0, 180.0]), [slice(0, 3)])
    (samples,) = steady.samples
    assert [sample.sample_time for sample in samples] == [round(k * HOLD * 1e9) for k in range(4)]
    assert [sample.voltage for sample in samples] == [2.0, 4.0, 6.0, 6.0]
    assert [sample.speed for sample in samples] == pytest.approx([0.0, tau, 2 * tau, 3 * tau])
    assert steady.info.measurement is Measurement.SPEED and steady.info.sample_period == HOLD
    assert (steady.info.speed_window, steady.info.speed_lag) == (1.0, 0.5)
    assert steady.info.edges_per_revolution == 10  # a count of 6 rpm within 1 s is a tenth of a turn


def test_every_run_begins_from_rest() -> None:
    steady = read_steady(FORM, Info(), np.arange(4.0), np.arange(4.0), [slice(0, 2), slice(2, 4)])
    assert [len(samples) for samples in steady.samples] == [3, 3]
    assert all(samples[0].speed == 0.0 and samples[0].sample_time == 0 for samples in steady.samples)


def test_a_mean_over_more_than_a_stairs_end_is_refused() -> None:
    rows = np.arange(3.0), np.arange(3.0), [slice(0, 3)]
    at_most = CsvForm(None, "u", "y", Kind.SPEED, "rad/s", speed_window=LONGEST)
    assert read_steady(at_most, Info(), *rows).info.speed_window == LONGEST
    with pytest.raises(RecordingError, match="the mean over 5 s at most: reduce --speed-window"):
        read_steady(CsvForm(None, "u", "y", Kind.SPEED, "rad/s", speed_window=LONGEST + 0.01), Info(), *rows)


def bend(voltage: Floats) -> Floats:
    """Turns a minute of a motor on a bridge that lets it coast, from 1.2 V on, counted in sixths of a turn."""
    over = np.maximum(voltage - 1.2, 0.0)
    return 60.0 * np.round(6.0 * 38.0 * over / (over + 6.0)) / 6.0


def test_steady_states_tell_nothing_that_takes_time() -> None:
    """A static curve's bend was taken for a time constant of 4.8 s, "or transport delay", and a load step at 797 s."""
    voltage = np.linspace(0.0, 12.0, 80)
    steady = read_steady(FORM, Info(max_voltage=12.0), voltage, bend(voltage), [slice(0, 80)])
    found = diagnose([check(recording_of(steady.samples[0], steady.info, "curve"))])
    names = {name for one in found.findings for name in (one.effect, *one.ambiguous_with)}
    assert names == {"coast_drive", "coulomb_friction", "dead_zone"} and all(map(is_static, names))
    assert "ka" in found.model.not_identifiable and "kv" not in found.model.not_identifiable
    assert not any(" s after" in one.where or " t " in one.where for one in found.findings)


@pytest.mark.parametrize("seed", range(4_360_300, 4_360_306))
def test_what_steady_states_do_not_show_is_at_no_limit(seed: int) -> None:
    """A curve that bends for another reason pushes it to the end of a box that is next to nothing."""
    voltage, scatter = np.linspace(0.0, 12.0, 41), np.random.default_rng(seed).normal(0.0, 9.5, 41)
    driven = np.minimum(voltage, 9.3) - 0.8
    form = CsvForm(None, "u", "y", Kind.SPEED, "rpm")
    values = np.where(driven > 0.0, 190.0 * driven + scatter, 0.0)
    steady = read_steady(form, Info(max_voltage=12.0), voltage, np.round(values, 1), [slice(0, 41)])
    fit = identify([check(recording_of(steady.samples[0], steady.info, "curve"))], Request(("coulomb_friction",)))
    assert isnan(fit.standard_errors["ka"]) and not fit.on_bound["ka"]
