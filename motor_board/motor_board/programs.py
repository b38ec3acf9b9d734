"""The executables of motor_board: each imports what it needs when it is started."""

from motor_model.program.entry_point import Main, entry_point


@entry_point
def board_emulator() -> Main:
    """`ros2 run motor_board board_emulator`."""
    from motor_board.node import main

    return main


@entry_point
def flash() -> Main:
    """`ros2 run motor_board flash`."""
    from motor_board.cli.flash import main

    return main
