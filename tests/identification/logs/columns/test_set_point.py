"""A controlled speed beside its set-point is told from one beside a drive."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns import drive
from motor_identification.logs.columns.drive import find_same_levels
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log

RANDOM = np.random.default_rng(2)
LEVELS = np.repeat([0.0, 40.0, -25.0, 60.0, 20.0, -60.0], 150)


def answered(gain: float, friction: float = 0.0) -> "np.ndarray[tuple[int], np.dtype[np.float64]]":
    """What a lag of 12 rows makes of the levels, with noise."""
    speed = np.zeros(len(LEVELS))
    for k in range(1, len(speed)):
        speed[k] = speed[k - 1] + (gain * LEVELS[k - 1] - friction * np.sign(LEVELS[k - 1]) - speed[k - 1]) / 12.0
    return np.round(speed + RANDOM.normal(0.0, 0.3, len(speed)), 2)


def test_only_the_same_numbers_are_a_set_point() -> None:
    assert find_same_levels(LEVELS, answered(1.0)) == 5
    assert find_same_levels(LEVELS, answered(1.05)) == 0
    assert find_same_levels(LEVELS, answered(1.0, friction=2.0)) == 0
    assert find_same_levels(np.abs(LEVELS[:300]), np.abs(answered(1.0)[:300])) == 0  # one level, beside 0
    assert find_same_levels(np.zeros(9), np.zeros(9)) == find_same_levels(np.ones(9), np.ones(9)) == 0


@pytest.mark.parametrize(("wrong", "found"), [(5, 5), (20, 0)])
def test_a_few_cells_that_lost_their_point_hide_no_set_point(wrong: int, found: int) -> None:
    damaged = LEVELS.copy()
    damaged[np.linspace(160, 280, wrong).astype(int)] = 400.0
    assert find_same_levels(damaged, answered(1.0)) == found


@pytest.mark.parametrize(("limit", "value"), [("SAME", 1e-4), ("LEAST_LEVELS", 6), ("LEAST_ROWS", 0.5), ("BANDS", 1)])
def test_every_limit_decides(limit: str, value: float, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drive, limit, value)
    assert find_same_levels(LEVELS, answered(1.0)) == 0


@pytest.mark.parametrize("motion", ["speed", "position"])
@pytest.mark.parametrize(("gain", "cautions"), [(1.0, 1), (2.3, 0)])
def test_an_import_tells_of_a_set_point(gain: float, cautions: int, motion: str, tmp_path: Path) -> None:
    log = tmp_path / "log.csv"
    rows = zip(np.arange(len(LEVELS)) * 0.01, LEVELS, answered(gain), strict=True)
    log.write_text(f"t,input,{motion}\n" + "".join(f"{t:.2f},{u:g},{w:g}\n" for t, u, w in rows))
    unit = {"speed": "rad/s", "position": "deg"}[motion]
    told = import_log(log, Said(full_duty=100.0, supply_voltage=12.0, unit=unit)).findings
    caution = f"at 5 levels {motion} comes to the numbers of input themselves, as a {motion} comes to its set-point"
    assert sum(caution in one for one in told) == cautions
