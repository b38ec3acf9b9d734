"""What is generated from the wire table is current."""

from typing import Any

import pytest

from motor_board.wire_header import files


@pytest.mark.parametrize(("path", "text"), files().items(), ids=lambda value: getattr(value, "name", ""))
def test_what_is_generated_is_current(path: Any, text: str) -> None:
    assert path.read_text(encoding="utf-8") == text, "run python -m motor_board.wire_header"
