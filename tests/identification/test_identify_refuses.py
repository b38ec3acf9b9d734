"""Recordings and requests that cannot answer are refused in a sentence."""

import errno
from collections.abc import Callable
from dataclasses import replace
from typing import NoReturn

import numpy as np
import pytest
from fits import made, quick
from plant import profiles

from motor_identification.diagnose import diagnose
from motor_identification.identify import SearchConfig, identify
from motor_identification.recording import Recording, check
from motor_model.errors import ModelError, MotorError, RecordingError
from motor_model.program import memory

REFUSED = {
    "no voltage": (lambda r: replace(r, voltage=0.0 * r.voltage), "the voltage is always 0"),
    "one sample": (
        lambda r: r.at_rows(np.arange(len(r)) < 1),
        r"is too short \(samples: 1\): record at least a second",
    ),
    "no motion": (lambda r: r.at_rows(np.arange(len(r)) < 2), "the motor never moves"),
    "a voltage that is no number": (
        lambda r: replace(r, voltage=np.where(np.arange(len(r)) == 20, np.nan, r.voltage)),
        r"has 1 voltage values that are not numbers \(the first at 0.100 s\)",
    ),
    "a speed that is no number": (lambda r: replace(r, speed=r.speed + np.inf), "speed values that are not numbers"),
    "a clock that stands": (
        lambda r: replace(r, sample_time=np.maximum(r.sample_time, r.sample_time[9])),
        "the plant's clock stands still or steps back after 0.000 s",
    ),
    "no edges on the disc": (
        lambda r: replace(r, info=replace(r.info, edges_per_revolution=0)),
        "motor/info says 0 edges per revolution",
    ),
    "a count that wraps": (lambda r: replace(r, edge_count=r.edge_count % 64), "edge_count falls after 0.*one channel"),
    "a plant that restarts": (
        lambda r: replace(r, sample_time=r.sample_time % 500_000_000, edge_count=r.edge_count % 64),
        "clock stands still or steps back",
    ),
    "hardly any motion": (
        lambda r: replace(r, edge_count=np.minimum(r.edge_count, 2)),
        "shows only . intervals of motion: record longer",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_recordings_that_cannot_answer_are_refused_in_a_sentence(case: str) -> None:
    change, said = REFUSED[case]
    recording = made({}, profiles.step(10.0, 1.0), seed=0)
    with pytest.raises(RecordingError, match=said) as caught:
        identify([check(change(recording))], quick())
    assert str(caught.value).startswith("plant") and str(caught.value).endswith(".")
    assert "\n" not in str(caught.value)


def test_windows_outside_the_recording_are_refused() -> None:
    recording = made({}, profiles.step(10.0, 1.0), seed=0)
    assert recording.between(0.0, 0.0) is recording
    assert recording.between(0.2, 0.0).duration == pytest.approx(0.8, abs=1e-9)
    assert len(recording.between(0.2, 0.4)) == 41
    for start, stop in ((0.5, 0.2), (0.3, 0.3)):
        with pytest.raises(RecordingError, match=r"--start .* must be before --stop"):
            recording.between(start, stop)
    for start, stop in ((-0.1, 0.5), (0.0, -1.0), (0.2, -1.0), (0.0, np.nan), (np.nan, 0.5), (np.inf, 0.0)):
        with pytest.raises(RecordingError, match="--start and --stop are seconds after the first sample, 0 or more"):
            recording.between(start, stop)
    with pytest.raises(RecordingError, match=r"is 1 s long: --start 1\.5 s is after its end\."):
        recording.between(1.5, 2.0)
    with pytest.raises(RecordingError, match=r"fewer than two samples from 0\.101 to 0\.104 s: take more\."):
        recording.between(0.101, 0.104)


def test_requests_that_cannot_be_met_are_refused() -> None:
    recording = made({}, profiles.step(10.0, 0.5), seed=0)
    with pytest.raises(ModelError, match="'gravity' is not an effect"):
        identify([recording], quick("gravity"))
    with pytest.raises(RecordingError, match="there is no recording to fit"):
        identify([], quick())
    for wrong in ({"particles": 1}, {"epochs": 0}, {"seed": -1}):
        with pytest.raises(
            MotorError, match="particles must be at least 2, epochs at least 1, and the seed not negative"
        ):
            SearchConfig(**wrong)


@pytest.mark.parametrize("ask", [lambda one: identify([one], quick()), lambda one: diagnose([one])])
def test_who_has_no_room_to_compute_is_told_before(
    ask: Callable[[Recording], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A diagnosis under `ulimit -v 500000` went round in OpenBLAS for ever."""

    def no_room(fileno: int, length: int) -> NoReturn:
        raise OSError(errno.ENOMEM, "Cannot allocate memory")

    monkeypatch.setattr(memory, "_limit", lambda: 500 * memory.MIB)
    monkeypatch.setattr(memory.mmap, "mmap", no_room)
    with pytest.raises(memory.NotEnoughMemory, match=r"MiB are needed .* may have 500 MiB \(ulimit -v\)"):
        ask(made({}, profiles.step(10.0, 1.0), seed=0))
