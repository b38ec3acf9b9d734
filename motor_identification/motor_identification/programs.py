"""The executables of motor_identification: each imports what it needs when it is started."""

from motor_model.program.entry_point import Main, entry_point


@entry_point
def motor_identification() -> Main:
    """`ros2 run motor_identification motor_identification`."""
    from motor_identification.service.node import main

    return main


@entry_point
def identify() -> Main:
    """`ros2 run motor_identification identify`."""
    from motor_identification.cli.identify import main

    return main


@entry_point
def diagnose() -> Main:
    """`ros2 run motor_identification diagnose`."""
    from motor_identification.cli.diagnose import main

    return main


@entry_point
def explore() -> Main:
    """`ros2 run motor_identification explore`."""
    from motor_identification.cli.explore import main

    return main


@entry_point
def compare() -> Main:
    """`ros2 run motor_identification compare`."""
    from motor_identification.cli.compare import main

    return main


@entry_point
def experiment() -> Main:
    """`ros2 run motor_identification experiment`."""
    from motor_identification.cli.experiment import main

    return main


@entry_point
def record() -> Main:
    """`ros2 run motor_identification record`."""
    from motor_identification.cli.record import main

    return main


@entry_point
def play() -> Main:
    """`ros2 run motor_identification play`."""
    from motor_identification.cli.play import main

    return main


@entry_point
def monitor() -> Main:
    """`ros2 run motor_identification monitor`."""
    from motor_identification.live.monitor_node import main

    return main


@entry_point
def import_csv() -> Main:
    """`ros2 run motor_identification import_csv`."""
    from motor_identification.cli.import_csv import main

    return main


@entry_point
def inspect() -> Main:
    """`ros2 run motor_identification inspect`."""
    from motor_identification.cli.inspect import main

    return main


@entry_point
def import_log() -> Main:
    """`ros2 run motor_identification import_log`."""
    from motor_identification.cli.import_log import main

    return main
