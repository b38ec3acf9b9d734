"""What a speed's filter begins with."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.logs.rows.absurd_speeds import ABSURD, FEWEST, mark_absurd_beginning

SPEED = 50.0 * (1.0 - np.exp(-np.arange(400) / 30.0))


def begun(size: float, keeps: float = 0.85) -> np.ndarray:
    return SPEED - size * keeps ** np.arange(400)


def test_a_filter_that_began_with_garbage_is_left_out_until_it_has_faded() -> None:
    speed = begun(1e7)
    marks = mark_absurd_beginning(speed)
    first = int(np.argmin(marks))
    assert marks[:first].all() and not marks[first:].any()
    assert np.max(np.abs(speed[first:] - SPEED[first:])) < 0.05
    assert first < 200


@pytest.mark.parametrize(
    ("speed", "marked"),
    [
        (SPEED, False),
        (-SPEED, False),
        (begun(0.9 * ABSURD * 50.0), False),
        (begun(1.3 * ABSURD * 50.0 / 0.85 ** (FEWEST - 1)), True),
        (np.zeros(400), False),
        (begun(1e7, 0.999), False),  # most of a run is no accident
        (np.where(np.arange(400) == 1, -1e7, SPEED), False),  # one row is told elsewhere
        (begun(1e7)[::-1], False),
        (begun(1e7)[:2], False),
    ],
)
def test_only_beginnings_far_beyond_all_others(speed: np.ndarray, marked: bool) -> None:
    assert mark_absurd_beginning(speed).any() == marked


def test_an_imported_log_keeps_the_sign_of_its_motion(tmp_path: Path) -> None:
    """Garbage of the other sign had it turned round."""
    rows = [f"{0.01 * k:.2f},{6 if k > 2 else 0},{value:.3f}" for k, value in enumerate(begun(1e7))]
    (tmp_path / "log.csv").write_text("\n".join(["time,voltage,rpm", *rows]) + "\n")
    (motor,) = import_log(tmp_path / "log.csv", Said()).motors
    assert not any(line.startswith("Caution") for line in motor.log.findings)
    assert any("as of a filter that began with garbage" in line for line in motor.log.findings)
    speeds = [sample.speed for run in motor.log.runs for sample in run.samples]
    assert min(speeds) > 0.0 and max(speeds) < 50.0 * 2.0 * np.pi / 60.0
