"""The executables of motor_sim: each imports what it needs when it is started."""

from motor_model.program.entry_point import Main, entry_point


@entry_point
def motor_sim() -> Main:
    """`ros2 run motor_sim motor_sim`."""
    from motor_sim.node import main

    return main
