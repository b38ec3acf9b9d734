"""Pages of several commands: each writes its own section and keeps the others'."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "benchmarks"))

from page_sections import replace_section

PAGE = "# Title\n\nFirst.\n\n## One\n\na\n\n## Two\n\n### Part\n\nb\n"


def test_a_section_is_replaced_and_the_others_stay() -> None:
    assert replace_section(PAGE, "## One\n\nnew\n") == PAGE.replace("\na\n", "\nnew\n")
    assert replace_section(PAGE, "## Two\n\nnew") == PAGE.replace("\n### Part\n\nb\n", "\nnew\n")
    assert replace_section(PAGE, "# Other title\n\nSecond.") == PAGE.replace("Title\n\nFirst", "Other title\n\nSecond")
    assert replace_section(PAGE, "## Three\n\nc") == PAGE + "\n## Three\n\nc\n"
    assert replace_section("", "## Three\n\nc") == "## Three\n\nc\n"
