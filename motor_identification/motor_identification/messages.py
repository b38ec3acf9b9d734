"""Service requests and responses of identification, and the plain values behind them."""

from builtin_interfaces.msg import Time

from motor_identification.findings import sentence
from motor_identification.fit import Fit
from motor_identification.identify import Request
from motor_identification.job import Job
from motor_msgs.msg import MotorModel
from motor_msgs.srv import Identify


def job_of(request: Identify.Request, particles: int, epochs: int, seed: int, workers: int) -> Job:
    """What a request asks for; its zeros stand for the node's own parameters, given here."""
    wanted = Request(
        effects=tuple(request.effects),
        particles=request.particles or particles,
        epochs=request.epochs or epochs,
        seed=request.seed or seed,
        workers=workers,
    )
    return Job(tuple(request.bag_uris), wanted, request.topic_namespace, request.start, request.stop)


def model_message(fit: Fit, stamp: Time) -> MotorModel:
    """A fit as it goes out on `motor/model`."""
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


def fill_response(response: Identify.Response, fit: Fit, stamp: Time) -> None:
    """Put a fit into the service's answer."""
    response.success = True
    response.message = sentence(fit)
    response.model = model_message(fit, stamp)
    response.r_squared = fit.r_squared
    response.duration = fit.duration
    response.not_identifiable = list(fit.not_identifiable)
    response.suggested_experiment = fit.suggested_experiment
