"""Counts of a turn, as a speed beside the counts tells them."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.guess import guess_forms
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.motion.turn_counts import TurnCounts, find_turn_counts
from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind
from motor_model.errors import RecordingError

PERIOD = 0.01
STAMPS = np.arange(400) * PERIOD
DRIVE = np.repeat([0.0, 200.0, -120.0, 255.0], 100)
ANGLE = np.cumsum(DRIVE * 0.2 * PERIOD) + 0.3 * np.sin(7.0 * STAMPS)


def columns(counts: float, slip: float = 1.0) -> dict[str, np.ndarray]:
    """A log of an encoder, with the speed that its counts of every row make, as firmware computes it."""
    count = np.floor(ANGLE * counts / (2.0 * np.pi))
    fresh = np.diff(count, prepend=count[0])
    rpm = np.round(fresh / (counts * slip) / PERIOD * 60.0, 2)
    return {"t_ms": 1e3 * STAMPS, "pwm": DRIVE, "enc_count": count, "Pulses": fresh, "rpm": rpm}


def table(cells: dict[str, np.ndarray], *names: str) -> Table:
    return Table(Path("log.csv"), np.arange(2, 402), {name: cells[name] for name in names})


@pytest.mark.parametrize("counts", [12, 315, 2400])
def test_counts_that_go_on_and_counts_of_a_row(counts: int) -> None:
    cells = columns(counts)
    going = find_turn_counts(table(cells, "t_ms", "enc_count", "rpm"), read_heading("enc_count"), STAMPS)
    assert going == TurnCounts(counts, False, "rpm", "rpm")
    anew = find_turn_counts(table(cells, "t_ms", "Pulses", "rpm"), read_heading("Pulses"), STAMPS)
    assert anew == TurnCounts(counts, True, "rpm", "rpm")


@pytest.mark.parametrize(("slip", "told"), [(1.01, True), (1.06, False)])  # 12 counts: 12.12, and 12.7, which is none
def test_the_counts_of_a_turn_are_whole(slip: float, told: bool) -> None:
    found = find_turn_counts(table(columns(12, slip), "enc_count", "rpm"), read_heading("enc_count"), STAMPS)
    assert (found is not None and found.counts == 12) is told


@pytest.mark.parametrize("digit", [1.0, 5.0])
@pytest.mark.parametrize("counts", [360, 2400, 4096])
def test_digits_that_firmware_cuts_off_do_not_make_more_counts(counts: int, digit: float) -> None:
    cells = columns(counts)
    fresh = cells["Pulses"] / counts / PERIOD * 60.0
    for cells["rpm"] in (np.trunc(fresh / digit) * digit, np.round(fresh / digit) * digit):
        found = find_turn_counts(table(cells, "enc_count", "rpm"), read_heading("enc_count"), STAMPS)
        assert found is not None and abs(found.counts / counts - 1.0) < 0.007


def test_what_is_cut_off_of_few_counts_in_a_row_does_not_tell_them() -> None:
    cells = columns(24)
    fresh = cells["Pulses"] * 31.25
    cells["rpm"] = np.trunc(fresh / 5.0) * 5.0
    few = np.abs(cells["Pulses"]) < 4
    stamps = np.cumsum(np.full(400, 0.02))
    cells["rpm"], cells["Pulses"] = cells["rpm"] * few, cells["Pulses"] * few
    assert find_turn_counts(table(cells, "Pulses", "rpm"), read_heading("Pulses"), stamps) is None


def test_another_shafts_speed_says_nothing_and_is_not_taken() -> None:
    cells = columns(48)
    cells["rpm"] = np.abs(np.sin(3.0 * STAMPS)) * 100.0
    assert find_turn_counts(table(cells, "enc_count", "rpm"), read_heading("enc_count"), STAMPS) is None
    cells = columns(48)
    cells["right_rpm"] = cells["rpm"]
    assert find_turn_counts(table(cells, "enc_count", "right_rpm"), read_heading("enc_count"), STAMPS) is None


def test_nobody_is_asked_for_the_counts_that_a_speed_tells() -> None:
    cells = columns(2400)
    guess = guess_forms(table(cells, "t_ms", "pwm", "enc_count", "rpm"), Said(supply_voltage=12.0))
    (form,) = guess.forms
    assert (form.motion, form.kind, form.edges_per_revolution, form.increments) == (
        "enc_count",
        Kind.COUNT,
        2400,
        False,
    )
    assert any(
        "enc_count: 2400 counts a turn, counted from the beginning, as rpm in rpm says" in one for one in guess.findings
    )
    anew = guess_forms(table(columns(12), "t_ms", "pwm", "Pulses", "rpm"), Said(supply_voltage=12.0)).forms[0]
    assert (anew.edges_per_revolution, anew.increments) == (12, True)
    said = guess_forms(
        table(cells, "t_ms", "pwm", "enc_count", "rpm"), Said(supply_voltage=12.0, edges_per_revolution=600)
    )
    assert said.forms[0].edges_per_revolution == 600
    with pytest.raises(RecordingError, match="how many counts there are in a turn"):
        guess_forms(table(cells, "t_ms", "pwm", "enc_count"), Said(supply_voltage=12.0))


@pytest.mark.parametrize(("name", "turn"), [("raw_angle", 4096), ("angle", 1024), ("position", 16384)])
def test_a_magnetic_sensor_begins_again_at_its_turn(name: str, turn: int) -> None:
    count = np.floor(ANGLE * turn / (2.0 * np.pi)) % turn
    cells = {"t_ms": 1e3 * STAMPS, "pwm": DRIVE, name: count}
    found = guess_forms(table(cells, *cells), Said(supply_voltage=12.0))
    (form,) = found.forms
    assert (form.kind, form.unit, form.edges_per_revolution) == (Kind.COUNT, "count", turn)
    assert f"{name}: {turn} counts a turn, where they begin again" in "".join(found.findings)
    said = guess_forms(table(cells, *cells), Said(supply_voltage=12.0, unit="count", edges_per_revolution=500)).forms[0]
    assert said.edges_per_revolution == 500
    for other in (np.where(count > 0.96 * turn, 0.0, count), np.minimum(np.cumsum(np.full(400, turn / 401.0)), turn)):
        with pytest.raises(RecordingError, match="which the numbers do not tell: say --unit"):
            guess_forms(table({**cells, name: np.floor(other)}, *cells), Said(supply_voltage=12.0))
