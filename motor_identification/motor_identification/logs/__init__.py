"""Imports other people's logs: CSV in, a motor's samples and what they are exact about out; no ROS, no bags."""

from motor_identification.logs.csv_form import UNITS, CsvForm, Kind
from motor_identification.logs.csv_log import Log, Run, read_log

__all__ = ["UNITS", "CsvForm", "Kind", "Log", "Run", "read_log"]
