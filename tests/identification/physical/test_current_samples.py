"""Which readings of a current are used, and what is said where none can be."""

from dataclasses import replace

import numpy as np
import pytest
from electrical import known

from motor_identification.physical.current_samples import select_current
from motor_model.errors import RecordingError


def test_all_but_the_first_reading() -> None:
    recording, _ = known()
    samples = select_current(recording)
    assert samples.note == "" and len(samples.time) == len(recording) - 1
    assert np.array_equal(samples.current, recording.current[1:])


def test_missing_readings_are_no_zeros() -> None:
    recording, _ = known()
    holes = np.where(np.arange(len(recording)) % 3 == 0, np.nan, recording.current)
    samples = select_current(replace(recording, current=holes))
    assert len(samples.time) == pytest.approx(len(recording) * 2 / 3, abs=2) and np.all(np.isfinite(samples.current))


def test_what_piles_up_at_the_end_of_the_range_is_left_out() -> None:
    recording, _ = known()
    clipped = select_current(replace(recording, current=np.clip(recording.current, -9.0, 2.004)))
    lost = len(recording) - 1 - len(clipped.time)
    assert lost == np.count_nonzero(recording.current[1:] >= 2.004) > 20
    assert f"{lost} of {len(recording) - 1} readings of the current were left out" in clipped.note


@pytest.mark.parametrize(
    ("current", "words"), [(np.nan, "no measured current: record with a current sensor"), (0.3, "never changes")]
)
def test_a_current_that_says_nothing_is_refused(current: float, words: str) -> None:
    recording, _ = known()
    with pytest.raises(RecordingError, match=words):
        select_current(replace(recording, current=np.full(len(recording), current)))
