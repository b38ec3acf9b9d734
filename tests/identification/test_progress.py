"""Progress goes out, and a stop comes in, before the next stage is told."""

import pytest

from motor_identification.progress import ProgressReporter, Stage, Stopped


def test_stages_are_told_until_it_is_stopped() -> None:
    told: list[Stage] = []
    stop = [False]
    reporter = ProgressReporter(told.append, lambda: stop[0])
    reporter.report("step 1: load_bias", 0.3, "load_bias", 1.5)
    assert told == [Stage("step 1: load_bias", 0.3, "load_bias", 1.5)]
    stop[0] = True
    with pytest.raises(Stopped, match="stopped"):
        reporter.report("step 2", 0.5, "", 1.0)
    assert len(told) == 1
