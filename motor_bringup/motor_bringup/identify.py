"""From a motor to its model: a plant, an experiment on it, and the analysis of what was recorded."""

from collections.abc import Mapping

from motor_bringup.argument import MODEL, NAMESPACE, PARAMETERS, PLANT, PORT, Argument, checked, namespace_of
from motor_bringup.plant import plant_programs
from motor_bringup.program import Program, Session

ARGUMENTS = (
    PLANT,
    MODEL,
    Argument("profile", "rich", "what the motor is driven through: see 'experiment --help'"),
    Argument("voltage", "", "peak of the profile [V]; empty: all there is"),
    Argument("bag", "experiment", "where the recording goes; must not exist"),
    Argument("analysis", "identify", "identify: fit a model; diagnose: find its effects", ("identify", "diagnose")),
    Argument("effects", "", "with identify: effects beyond kv and ka, separated by commas"),
    Argument("output", "model.yaml", "the model file that is written"),
    Argument("report", "", "directory for a report with pictures; empty: none"),
    NAMESPACE,
    PORT,
    PARAMETERS,
)


def session(told: Mapping[str, str]) -> Session:
    """Return what `identify.launch.py` starts: no controller, and everything ends with the analysis.

    Raises:
        MotorError: a word is none of the choices, or a file that was named cannot be read.
    """
    values = checked(ARGUMENTS, told)
    return Session(plant_programs(values), (_experiment(values), _analysis(values)))


def _experiment(values: Mapping[str, str]) -> Program:
    arguments = (values["profile"], "--output", values["bag"], *_option("--voltage", values["voltage"]))
    return Program("motor_identification", "experiment", (*arguments, *_where(values)), node=False)


def _analysis(values: Mapping[str, str]) -> Program:
    effects = _option("--effects", values["effects"]) if values["analysis"] == "identify" else ()
    written = (*_option("--output", values["output"]), *_option("--report", values["report"]))
    arguments = (values["bag"], *effects, *written, *_where(values))
    return Program("motor_identification", values["analysis"], arguments, node=False)


def _option(name: str, value: str) -> tuple[str, ...]:
    return (name, value) if value else ()


def _where(values: Mapping[str, str]) -> tuple[str, ...]:
    return _option("--topic-namespace", namespace_of(values))
