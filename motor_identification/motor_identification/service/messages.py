"""Requests and answers of identification and diagnosis as messages, and the plain values behind them."""

from builtin_interfaces.msg import Time

from motor_identification.bag import Source, Window
from motor_identification.estimation.request import Request, SearchConfig
from motor_identification.progress import Stage
from motor_identification.reporting.fit_text import summarize_fit
from motor_identification.service.job import DiagnosisJob, Job, Reported, notes_of
from motor_identification.service.limits import MOST_EPOCHS, MOST_PARTICLES
from motor_identification.uncertainty.result import Fit
from motor_model.errors import MotorError
from motor_msgs.action import Diagnose
from motor_msgs.msg import MotorModel
from motor_msgs.srv import Identify


def job_of(request: Identify.Request, particles: int, epochs: int, seed: int, workers: int) -> Job:
    """Return what a request asks for; its zeros stand for the node's own parameters, given here.

    Raises:
        MotorError: it asks for more than the parameters allow.
    """
    _check_range("particles", request.particles, MOST_PARTICLES)
    _check_range("epochs", request.epochs, MOST_EPOCHS)
    search = SearchConfig(request.particles or particles, request.epochs or epochs, request.seed or seed)
    wanted = Request(tuple(request.effects), search, workers)
    window = Window(request.start, request.stop)
    return Job(Source(tuple(request.bag_uris), request.topic_namespace, window), wanted)


def _check_range(name: str, value: int, most: int) -> None:
    if value > most:
        raise MotorError(f"{name} is {value}: it must be {most} at most, 0 for the node's parameter.")


def model_message(fit: Fit, stamp: Time) -> MotorModel:
    """Return a fit as it goes out on `motor/model`."""
    names = list(fit.parameters.values)
    message = MotorModel(
        name=fit.parameters.name,
        effects=list(fit.parameters.effects),
        parameter_names=names,
        parameter_values=[fit.parameters.values[name] for name in names],
        standard_errors=[fit.standard_errors[name] for name in names],
        on_bound=[fit.on_bound[name] for name in names],
        residual_rms=fit.residual_rms,
        noise_floor=fit.noise_floor,
        bag_uris=list(fit.uris),
    )
    message.header.stamp = stamp
    message.header.frame_id = fit.parameters.name
    return message


def fill_response(response: Identify.Response, fit: Fit, model: MotorModel, trouble: str = "") -> None:
    """Put a fit, and the message of its model, into the service's answer; `trouble` is what went wrong beside it."""
    response.success = True
    response.message = f"{summarize_fit(fit)} {trouble}".rstrip()
    response.model = model
    response.r_squared = fit.r_squared
    response.duration = fit.duration
    response.not_identifiable = list(fit.not_identifiable)
    response.suggested_experiment = fit.suggested_experiment


def diagnosis_job_of(goal: Diagnose.Goal, workers: int) -> DiagnosisJob:
    """Return what a goal asks for."""
    return DiagnosisJob(
        source=Source(tuple(goal.bag_uris), goal.topic_namespace),
        validation=tuple(goal.validation_uris),
        request=Request(tuple(goal.known_effects), workers=workers),
    )


def feedback_message(stage: Stage, progress: float) -> Diagnose.Feedback:
    """Return how far a diagnosis is, 0 to 1; its gap is NaN as long as there is none."""
    return Diagnose.Feedback(stage=stage.text, progress=progress, best_effect=stage.best_effect, gap=float(stage.gap))


def result_message(reported: Reported, model: MotorModel, trouble: str = "") -> Diagnose.Result:
    """Return a diagnosis, and the message of its model, as the action's result; `trouble` is what else went wrong."""
    from motor_identification.reporting.diagnosis_text import summarize_diagnosis

    diagnosis = reported.diagnosis
    return Diagnose.Result(
        success=True,
        message=" ".join(
            filter(None, (summarize_diagnosis(diagnosis), *notes_of(diagnosis), reported.trouble, trouble))
        ),
        verdict=diagnosis.verdict.value,
        effects=[finding.effect for finding in diagnosis.findings],
        model=model,
        gap_before=float(diagnosis.gap_before),
        gap_after=float(diagnosis.gap_after),
        noise_floor=float(diagnosis.noise_floor),
        undetectable=list(diagnosis.undetectable),
        suggested_experiment=diagnosis.suggested_experiment,
        report_uri=reported.report,
    )
