"""A row's voltage held until the row where its motion answers it, and nothing else makes it so."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import lfilter

from motor_identification.logs import voltage_timing
from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.log import read_log
from motor_identification.logs.voltage_timing import acts_before

Floats = NDArray[np.float64]

ROWS, LAG = 400, 0.8  # of a motor's speed, what is left of it in the next row
FORM = CsvForm("t", "u", "w", Kind.SPEED, "rad/s")
DATA = Path(__file__).parents[2] / "data" / "undc"


def levels(seed: int = 0, rows: int = ROWS, hold: int = 8) -> Floats:
    """A voltage that jumps every few rows."""
    return np.repeat(np.random.default_rng(seed).uniform(-6.0, 6.0, rows // hold + 1), hold)[:rows]


def speeds(voltage: Floats, lead: float = 0.0, noise: float = 0.05, seed: int = 1) -> Floats:
    """Speeds that answer the voltage of the row before, or by a share the row's own."""
    drive = lead * voltage + (1.0 - lead) * np.append(0.0, voltage[:-1])
    motion = lfilter([1.0 - LAG], [1.0, -LAG], drive)
    return np.asarray(motion + noise * np.random.default_rng(seed).standard_normal(len(voltage)))


def test_a_motion_that_answers_its_own_row_is_told() -> None:
    volts = levels()
    assert acts_before([(volts, speeds(volts, 1.0))])
    assert not acts_before([(volts, speeds(volts))])
    means = [np.convolve(speeds(volts, lead), [0.5, 0.5])[: len(volts)] for lead in (1.0, 0.0)]
    assert acts_before([(volts, means[0])]) and not acts_before([(volts, means[1])])


def test_less_than_half_a_row_is_no_row() -> None:
    volts = levels()
    assert not acts_before([(volts, speeds(volts, 0.15, noise=0.0))])
    assert acts_before([(volts, speeds(volts, 0.6, noise=0.0))])


def test_it_takes_as_many_rows_and_as_little_noise_as_are_sure() -> None:
    volts = levels()
    assert not acts_before([(volts, speeds(volts, 1.0, noise=10.0))])
    assert not acts_before([(volts[:20], speeds(volts, 1.0)[:20])])
    parts = [slice(first, first + 20) for first in range(0, ROWS, 20)]
    assert acts_before([(volts[part], speeds(volts, 1.0)[part]) for part in parts])
    assert not acts_before([(volts[:6], speeds(volts, 1.0)[:6])]) and not acts_before([])
    assert not acts_before([(np.full(ROWS, 3.0), np.random.default_rng(0).standard_normal(ROWS))])


def test_a_smooth_voltage_tells_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """What it says of its own time is no more than what a model is wrong by."""
    volts = 6.0 * np.sin(0.0005 * np.arange(ROWS) ** 2)
    assert not acts_before([(volts, speeds(volts, 1.0, noise=1e-6))])
    monkeypatch.setattr(voltage_timing, "JUMP", 0.0)
    assert acts_before([(volts, speeds(volts, 1.0, noise=1e-6))])


def test_a_controller_that_answers_its_own_row_is_not_answered() -> None:
    random = np.random.default_rng(3)
    wanted, volts, motion = levels(4), np.zeros(ROWS), np.zeros(ROWS)
    speed = 0.0
    for k in range(ROWS):
        motion[k] = speed + 0.3 * random.standard_normal()
        volts[k] = 2.0 * (wanted[k] - motion[k])
        speed = LAG * speed + (1.0 - LAG) * volts[k]
    assert not acts_before([(volts, motion)])
    assert acts_before([(np.append(0.0, volts[:-1]), motion)])


@pytest.mark.parametrize(
    ("limit", "value"), [("SIGNIFICANT", 1e3), ("SHARE", 0.99), ("TOLD_BY_JUMPS", 1.0), ("LEAST_ROWS", ROWS)]
)
def test_every_limit_decides(limit: str, value: float, monkeypatch: pytest.MonkeyPatch) -> None:
    volts = levels()
    monkeypatch.setattr(voltage_timing, limit, value)
    assert not acts_before([(volts, speeds(volts, 1.0))])


def write(path: Path, volts: Floats, motion: Floats) -> Path:
    rows = "".join(f"{0.01 * k:.2f},{u:.4f},{w:.4f}\n" for k, (u, w) in enumerate(zip(volts, motion, strict=True)))
    path.write_text("t,u,w\n" + rows, encoding="utf-8")
    return path


def test_an_import_believes_the_motion_unless_it_is_told_otherwise(tmp_path: Path) -> None:
    """Positions tell by their way from row to row."""
    volts = levels()
    counts = replace(FORM, kind=Kind.COUNT, unit="count", edges_per_revolution=1000)
    late = write(tmp_path / "late.csv", volts, np.round(np.cumsum(50.0 * speeds(volts, 1.0))))
    log = read_log(late, counts)
    assert [one.voltage for one in log.runs[0].samples[:-1]] == pytest.approx(volts[1:], abs=1e-4)
    assert any("answers its own voltage" in line and "--no-voltage-before" in line for line in log.findings)
    assert not log.info.voltage_assumed
    told = read_log(late, replace(counts, voltage_before=False))
    assert not told.info.voltage_assumed
    assert [one.voltage for one in told.runs[0].samples] == pytest.approx(volts, abs=1e-4)
    usual = read_log(write(tmp_path / "usual.csv", volts, np.round(np.cumsum(50.0 * speeds(volts)))), counts)
    assert [one.voltage for one in usual.runs[0].samples] == pytest.approx(volts, abs=1e-4)
    assert not any("answers" in line for line in usual.findings)
    assert usual.info.voltage_assumed  # a fit sees more than an import, and may yet find it otherwise


def test_logged_speeds_may_be_made_of_rows_after_their_own(tmp_path: Path) -> None:
    """Such as numpy.gradient of positions: when they were made is for a fit to find."""
    volts = levels()
    place = np.cumsum(speeds(volts, noise=0.0))
    log = read_log(write(tmp_path / "log.csv", volts, np.gradient(place)), FORM)
    assert acts_before([(volts, np.gradient(place))]) and not any("answers" in line for line in log.findings)


def test_a_real_rig_whose_rows_hold_what_was_applied_until_then_is_told() -> None:
    """UNDC's Arduino writes the voltage that it applied before it read the encoder; a loop at 200 Hz."""
    form = CsvForm("t", "u", "y", Kind.POSITION, "deg", edges_per_revolution=2800)
    log = read_log(DATA / "profile_closed_2026-08-18.csv", form)
    assert any("answers its own voltage" in line for line in log.findings)
