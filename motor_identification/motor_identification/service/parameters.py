"""The identification node's parameters as a table, and what it says of itself."""

from motor_identification.estimation.request import SearchConfig
from motor_ros.parameters import Row
from motor_ros.program import Program

LIMITS = SearchConfig()
PARAMETERS = (
    Row("bag_directory", "", "where relative bag_uris are looked for; empty: the working directory"),
    Row("model_file", "", "file for the model that was identified or diagnosed last (YAML); empty: none"),
    Row(
        "report_directory",
        "",
        "where motor/diagnose writes (and replaces) BAG_diagnosis.html; empty: beside its first bag",
    ),
    Row("particles", LIMITS.particles, "of the swarm", "", 2, 100_000),
    Row("epochs", LIMITS.epochs, "of the swarm at most", "", 1, 1_000_000),
    Row("seed", LIMITS.seed, "of the swarm", "", 0, 2**31 - 1),
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
    services=("motor/identify", "motor/diagnose"),
)
