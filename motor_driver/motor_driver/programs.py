"""The executables of motor_driver: each imports what it needs when it is started."""

from motor_model.program.entry_point import Main, entry_point


@entry_point
def motor_driver() -> Main:
    """`ros2 run motor_driver motor_driver`."""
    from motor_driver.node import main

    return main


@entry_point
def check() -> Main:
    """`ros2 run motor_driver check`."""
    from motor_driver.cli.check import main

    return main
