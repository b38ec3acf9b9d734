"""Load what a monitor is to watch: a model file and, for other robots, a mapping."""

from motor_identification.mapping import load_mapping
from motor_identification.monitoring.evaluation import Watch
from motor_identification.monitoring.health import Limits
from motor_identification.monitoring.live_motor import LiveMotor
from motor_identification.monitoring.model_gap import Model
from motor_identification.reporting.model_comparison import Identified
from motor_identification.timing.speed_filter import SpeedFilter, parse_filter
from motor_model.errors import ModelError, MotorError
from motor_model.model_file import load, load_errors, load_residual_rms, load_speed_filter


def load_watch(model: str, mapping: str, namespace: str, limits: Limits) -> Watch:
    """Load a motor's model, the topics it is watched on, and how closely.

    Raises:
        MotorError: there is no model, or a file cannot be used.
    """
    if not model:
        raise MotorError(
            "There is no model to compare with: name one (-p model:=model.yaml, made by identify --output)."
        )
    identified = Identified(model, load(model), load_errors(model))
    motor = LiveMotor(load_mapping(mapping) if mapping else None, namespace, identified.parameters.max_voltage)
    return Watch(motor, Model(identified, load_residual_rms(model), _load_filter(model)), limits)


def _load_filter(model: str) -> SpeedFilter | None:
    """Load the filter that the speeds had passed which a model file's motor was fitted to."""
    try:
        return parse_filter(load_speed_filter(model))
    except ModelError as error:
        raise ModelError(f"{model}: {error}") from error
