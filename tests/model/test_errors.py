"""What an error says is one line that steers no terminal."""

from motor_model.errors import ModelError, MotorError


def test_a_sentence_is_one_line_and_whole() -> None:
    assert str(MotorError("cannot read \x1b[2J\nx: rename it.")) == r"cannot read \x1b[2J\nx: rename it."
    assert str(ModelError("x" * 1000)) == "x" * 1000
