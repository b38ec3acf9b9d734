"""Recordings of the independent plant, requests for quick fits of them, and how far off those are."""

from plant import profiles, record

from motor_identification.identify import Request, SearchConfig
from motor_identification.recording import Recording, check
from motor_identification.uncertainty.result import Fit
from motor_model.parameters import PAPER_KA, PAPER_KV

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
Values = dict[str, float]


def made(values: Values, drive: profiles.Profile, **how: float) -> Recording:
    """A checked recording of the plant."""
    return check(record(BASE | values, *drive, **how)[0])  # type: ignore[arg-type]


def off(fit: Fit, values: Values) -> Values:
    """Relative errors of the parameters."""
    truth = BASE | values
    return {name: value / truth[name] - 1.0 for name, value in fit.parameters.values.items()}


def how_sure(fit: Fit, values: Values) -> list[float]:
    """Errors over standard errors, in the order of the parameters."""
    truth = BASE | values
    return [(value - truth[name]) / fit.standard_errors[name] for name, value in fit.parameters.values.items()]


def quick(*effects: str, seed: int = 0) -> Request:
    return Request(effects, SearchConfig(particles=30, epochs=60, seed=seed))
