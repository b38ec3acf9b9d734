"""A load that is periodic in time is a line in the spectrum of what is left, and so is a supply that swings."""

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from motor_identification.discrepancy.rest import Rest
from motor_identification.discrepancy.spectrum_lines import LINES, find_lines
from motor_identification.noise.error_model import ErrorModel, Lag

COUNT, STEP = 4000, 0.005  # intervals of 20 s


def left(white: np.ndarray, voltage: np.ndarray) -> Rest:
    """A recording whose white residual is this."""
    nothing = np.zeros(COUNT, dtype=bool)
    errors = SimpleNamespace(
        duration=np.full(COUNT, STEP), still=nothing, whiten=lambda *_: (0.0, np.asarray(white)[None])
    )
    index = np.arange(COUNT)
    history = SimpleNamespace(time=STEP * (index + 0.5), voltage=voltage, at_start=index, at_end=index)
    return cast(Rest, SimpleNamespace(errors=errors, history=history, learnt=~nothing))


@pytest.mark.parametrize(("frequency", "by_command"), [(3.0, False), (7.3, False), (2.5, True)])
def test_a_line_is_found_to_a_small_part_of_a_wave(frequency: float, by_command: bool) -> None:
    random, time = np.random.default_rng(5), STEP * (np.arange(COUNT) + 0.5)
    voltage = 6.0 * np.where(random.integers(2, size=COUNT // 40).repeat(40) == 1, 1.0, -1.0)
    wave = np.sin(2.0 * np.pi * frequency * time) * (voltage / 6.0 if by_command else 1.0)
    lines = find_lines(
        [left(random.normal(size=COUNT) + 0.5 * wave, voltage)], ErrorModel(0.0, 0.0, 0.1, 0.1), Lag(10.0, 1.0)
    )
    assert len(lines) == LINES and abs(lines[0] - frequency) < 0.03
    assert all(abs(one - lines[0]) * COUNT * STEP > 1.5 for one in lines[1:])


def test_what_changes_slowly_is_no_line() -> None:
    time = STEP * (np.arange(COUNT) + 0.5)
    slow = np.sin(2.0 * np.pi * 0.05 * time) + 1e-3 * np.random.default_rng(6).normal(size=COUNT)
    assert min(find_lines([left(slow, np.ones(COUNT))], ErrorModel(0.0, 0.0, 0.1, 0.1), Lag(10.0, 1.0))) >= 0.1
