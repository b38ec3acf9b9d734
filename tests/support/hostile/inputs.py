"""The table of the kinds of hostile inputs."""

from hostile import foreign
from hostile.bags import contents, database, mcap, playing
from hostile.command_lines import arguments, csv, pipes, serial
from hostile.kind import Kind, command
from hostile.log_files import json_log, matlab, refused, wpilog
from hostile.node_inputs import fill_values, parameters, values
from hostile.sandbox import Main
from hostile.workbooks import workbook
from hostile.yaml_files import metadata, model


def main_of(name: str) -> Main:
    """The main function of a command, of a node, or of what stands here for a part of one."""
    own = {"values": fill_values, "watch": foreign.watch}
    return own[name] if name in own else command(name)


KINDS = (
    Kind("MCAP file, by its records", 1100, main_of, mcap),
    Kind("bag with odd messages", 600, main_of, contents),
    Kind("database (.db3)", 250, main_of, database),
    Kind("metadata.yaml", 200, main_of, metadata),
    Kind("model file", 300, main_of, model),
    Kind("CSV", 250, main_of, csv),
    Kind("lines of a serial monitor", 150, main_of, serial),
    Kind("arguments", 250, main_of, arguments),
    Kind("pipes, devices, links", 100, main_of, pipes),
    Kind("values on the command line", 200, main_of, values),
    Kind("parameters of nodes", 140, main_of, parameters, interrupt=1.0),
    Kind("MATLAB file", 200, main_of, matlab),
    Kind("JSON log", 200, main_of, json_log),
    Kind("WPILOG", 200, main_of, wpilog),
    Kind("workbook of Excel", 200, main_of, workbook),
    Kind("formats that are not read", 60, main_of, refused),
    Kind("mapping of a bag", 150, main_of, foreign.mapping),
    Kind("bag of another robot", 250, main_of, foreign.bag),
    Kind("robot heard by a monitor", 150, main_of, foreign.heard),
    Kind("bag to play", 40, main_of, playing, interrupt=8.0),
)
