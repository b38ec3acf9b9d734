"""The command line: completion of lists, help that keeps its lines."""

from motor_ros.command.parser import CommandParser, listed_names


def test_a_list_with_commas_is_completed_name_by_name() -> None:
    complete = listed_names(["friction", "drag", "delay"])
    assert complete("") == ["friction", "drag", "delay"]
    assert complete("drag,d") == ["drag,friction", "drag,delay"]


def test_a_table_keeps_its_lines_and_a_paragraph_is_filled() -> None:
    text = CommandParser("motor_ros", "tool", "word " * 60, "profiles:\n  step   4 s\n  rich  28 s").format_help()
    assert "profiles:\n  step   4 s\n  rich  28 s" in text
    assert all(len(line) < 200 for line in text.splitlines()) and "word word" in text
