"""The picture of a tuning is written in the format its name says, and not anywhere it cannot be."""

from pathlib import Path

import pytest
from tuning_bench import RUBBING, tuning

from motor_control.configuration import config_of
from motor_control.parameters import ROWS
from motor_control.tuning.figure import draw_tuning
from motor_control.tuning.simulated_loop import rehearse
from motor_model.errors import MotorError
from motor_model.sensing.board import BoardConfig


def test_it_is_drawn_with_the_numbers(tmp_path: Path) -> None:
    one, board = tuning(), BoardConfig()
    config = config_of({row.name: row.default for row in ROWS}, board.info(RUBBING))
    rehearsal = rehearse(RUBBING, board, config, lambda _: one.large_step.reference, 0.3)
    path = tmp_path / "step.svg"
    draw_tuning(one, rehearsal, "bench", path)
    text = path.read_text(encoding="utf-8")
    assert text.count("<path") > 30 and "<svg" in text
    for name, words in (("step.txt", "must end in .png, .pdf or .svg"), ("no/step.png", "No such file")):
        with pytest.raises(MotorError, match=words):
            draw_tuning(one, rehearsal, "bench", tmp_path / name)
