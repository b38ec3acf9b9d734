"""Imports other people's logs: a file in, a motor's samples and what they are exact about out; no ROS, no bags."""

from motor_identification.logs.form import UNITS, CsvForm, Kind
from motor_identification.logs.log import Log, read_log
from motor_identification.logs.run import Run

__all__ = ["UNITS", "CsvForm", "Kind", "Log", "Run", "read_log"]
