"""The identification node's parameters as a table, and what it says of itself."""

from motor_identification.estimation.request import SearchConfig
from motor_identification.service.limits import MOST_EPOCHS, MOST_PARTICLES
from motor_ros.parameters import Row
from motor_ros.program import Program

LIMITS = SearchConfig()
PARAMETERS = (
    Row(
        "bag_directory",
        "",
        "where bag_uris are looked for, and nowhere else; empty: the working directory",
        read_only=True,
    ),
    Row("absolute_uris", False, "bag_uris may name any bag, also outside of bag_directory", read_only=True),
    Row(
        "model_file",
        "",
        "file for the model that was identified or diagnosed last (YAML); empty: none",
        read_only=True,
    ),
    Row(
        "report_directory",
        "",
        "where motor/diagnose writes (and replaces) BAG_diagnosis.html; empty: beside its first bag",
        read_only=True,
    ),
    Row(
        "mapping",
        "",
        "file that says where voltage and motion stand in bags of another robot (YAML); empty: motor/speed",
        read_only=True,
    ),
    Row("particles", LIMITS.particles, "of the swarm", "", 2, MOST_PARTICLES),
    Row("epochs", LIMITS.epochs, "of the swarm at most", "", 1, MOST_EPOCHS),
    Row("seed", LIMITS.seed, "of the swarm", "", 0, 2**31 - 1),
    Row("queue_length", 8, "motor/identify requests that wait while one is computed; more are told: busy", "", 0, 100),
    Row("time_limit", 3600.0, "that a fit or a diagnosis may take", "s", 1.0, 1e6),
    Row("workers", 0, "threads that simulate; 0: all cores", "", 0, 1024),
)
PROGRAM = Program(
    "motor_identification",
    "motor_identification",
    "Fits motor models to bags (motor/identify) and finds what a model lacks (motor/diagnose), in a process of its\n"
    "own; the latest model stays on motor/model. The commands identify and diagnose do the same without a graph.",
    PARAMETERS,
    "ros2 run motor_identification motor_identification --ros-args -p bag_directory:=bags -p model_file:=model.yaml",
    publishes=("motor/model",),
    services=("motor/identify", "motor/cancel", "motor/diagnose"),
)
