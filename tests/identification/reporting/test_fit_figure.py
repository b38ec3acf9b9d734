"""The picture of a fit: measured stays visible under the model, and what cannot be written is said."""

from pathlib import Path

import pytest
from diagnosed import fitted

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.reporting.fit_figure import draw_fit, draw_overlay
from motor_model.errors import MotorError


def test_measured_lies_below_the_model_and_is_broader(found: Diagnosis) -> None:
    from matplotlib import pyplot as plt  # here: who only collects this does not wait for it

    recording = fitted(ks=0.4)[0].problem.recordings[0]
    _, axes = plt.subplots()
    draw_overlay(axes, recording, make_intervals(recording), found.model.parameters, 0.0)
    measured, simulated = axes.lines
    assert (measured.get_label(), simulated.get_label()) == ("measured", "simulated with the fitted model")
    assert measured.get_markersize() > 4.0 * simulated.get_linewidth()


def test_it_is_written_or_said(found: Diagnosis, tmp_path: Path) -> None:
    recording = fitted(ks=0.4)[0].problem.recordings[0]
    draw_fit(recording, found.model, tmp_path / "fit.png")
    assert (tmp_path / "fit.png").stat().st_size > 20_000
    with pytest.raises(MotorError, match=r"cannot write .*nowhere"):
        draw_fit(recording, found.model, tmp_path / "nowhere" / "fit.png")
