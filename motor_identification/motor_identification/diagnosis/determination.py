"""Drop what is not determined: an effect of which nothing can be said but that something like it is missing."""

from motor_identification.diagnosis.backward_elimination import drop_step
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.forward_selection import Selection
from motor_identification.uncertainty.standard_errors import estimate_uncertainty
from motor_model.effects import EFFECT_BY_NAME


def drop_undetermined(selection: Selection) -> tuple[Selection, tuple[str, ...]]:
    """Drop the findings whose one parameter the training data do not determine, the least likely first; and name them.

    A parameter that belongs to a recording, such as an instant, says nothing of the motor.
    """
    dropped: list[str] = []
    while weak := [step for step in selection.steps if step.found.effect in find_undetermined(selection.model)]:
        step = min(weak, key=lambda one: one.found.evidence)
        dropped.append(step.found.effect)
        selection = drop_step(selection, step)
    return selection, tuple(dropped)


def find_undetermined(model: Model) -> tuple[str, ...]:
    """Find the effects of a model none of whose own parameters its training data determine.

    Size and time constant of one effect may each be unsure, because the other is, where both together are not.
    """
    if not model.effects:
        return ()
    fit = model.whitened
    unknown = estimate_uncertainty(fit, fit.residuals.jacobian(fit.theta)).not_identifiable
    return tuple(name for name in model.effects if is_undetermined(name, unknown))


def is_undetermined(effect: str, not_identifiable: tuple[str, ...]) -> bool:
    """Decide whether an effect's one own parameter is not determined."""
    own = [spec.name for spec in EFFECT_BY_NAME[effect].parameters if not spec.of_recording]
    return len(own) == 1 and own[0] in not_identifiable
