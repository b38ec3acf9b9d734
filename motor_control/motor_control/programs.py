"""The executables of motor_control: each imports what it needs when it is started."""

from motor_model.program.entry_point import Main, entry_point


@entry_point
def motor_control() -> Main:
    """`ros2 run motor_control motor_control`."""
    from motor_control.node import main

    return main


@entry_point
def tune() -> Main:
    """`ros2 run motor_control tune`."""
    from motor_control.cli.tune import main

    return main
