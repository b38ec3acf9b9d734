"""An error that nobody foresaw says that it is ours, and its traceback is kept."""

from pathlib import Path

import pytest

from motor_model.program.internal_error import log_directory, report


def stumbled() -> ZeroDivisionError:
    try:
        1 / 0  # noqa: B018
    except ZeroDivisionError as error:
        return error
    raise AssertionError


def test_the_sentence_names_the_log_which_has_the_traceback(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    sentence = str(report(stumbled()))
    (log,) = (tmp_path / "log").iterdir()
    assert sentence.startswith("this is a mistake of the workbench, not yours (ZeroDivisionError: division by zero); ")
    assert f"the log is {log}: please report it" in sentence and "\n" not in sentence
    assert "test_internal_error.py" in log.read_text() and "ZeroDivisionError" in log.read_text()


def test_where_no_log_can_be_written_the_sentence_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "file"))
    assert "no log could be written (" in str(report(stumbled()))


def test_logs_stand_where_those_of_ros_stand(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ROS_LOG_DIR", raising=False)
    monkeypatch.setenv("ROS_HOME", "/home/of/ros")
    assert log_directory() == Path("/home/of/ros/log")
    monkeypatch.delenv("ROS_HOME")
    assert log_directory() == Path.home() / ".ros" / "log"
