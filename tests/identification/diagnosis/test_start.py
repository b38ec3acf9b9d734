"""A diagnosis begins with what is not held out, and with speeds as their motion shows that they were made."""

from functools import cache

import numpy as np
import pytest
from swinging import noisy

from motor_identification.diagnosis.start import Start, begin, begin_as_timed, find_timing_beside
from motor_identification.estimation.request import Request
from motor_identification.recording import check
from motor_identification.timing.timing import INSTANT, OTHERS


@cache
def begun(*effects: str) -> Start:
    """Of values of their rows' own instants."""
    return begin([check(noisy(0.05, instant=True))], (), Request(effects=effects), lambda: False)


def test_the_known_model_is_fitted_to_what_is_not_held_out() -> None:
    start = begun("coulomb_friction")
    model = start.selection.model
    assert model.effects == ("coulomb_friction",) and start.selection.steps == () and start.timing is None
    seen = sum(len(data.first) for data in model.estimate.problem.intervals)
    held = sum(np.count_nonzero(scored) for scored in model.held.scored)
    assert 0.15 < held / (seen + held) < 0.35  # a quarter
    assert 0.45 < model.estimate.parameters.value("ks") < 0.55 and start.search.evaluations > 0


def test_speeds_are_read_again_as_they_were_made() -> None:
    start = begun()
    timing = find_timing_beside(start, start.selection)
    assert timing == OTHERS[0]
    again = begin_as_timed(start, timing, Request(), lambda: False)
    (recording,) = again.recordings
    assert again.timing is timing and recording.info.speed_window == pytest.approx(
        INSTANT * recording.info.sample_period
    )
    assert begin_as_timed(start, None, Request(), lambda: False) is start
