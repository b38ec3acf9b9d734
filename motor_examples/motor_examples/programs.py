"""The executables of motor_examples: each imports what it needs when it is started."""

from motor_model.program.entry_point import Main, entry_point


@entry_point
def diff_drive() -> Main:
    """`ros2 run motor_examples diff_drive`."""
    from motor_examples.diff_drive.node import main

    return main
