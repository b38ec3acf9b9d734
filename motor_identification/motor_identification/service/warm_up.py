"""Compile everything a fit needs ahead of time: `python -m motor_identification.service.warm_up`."""

from dataclasses import replace

import numpy as np

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.evidence.slewing_evidence import slew
from motor_identification.diagnosis.fits.torque_jumps import list_likely_jumps
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.joined_commands import join_commands
from motor_identification.estimation.problem import make_problem
from motor_identification.experiment import make_plan, simulate_plan
from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.noise.error_model import ErrorModel
from motor_identification.recording import Recording, recording_of
from motor_identification.sensor.pulses.pulse_periods import find_slot_by_stays
from motor_model import warm_up
from motor_model.effects import EFFECTS
from motor_model.excitation import profile
from motor_model.parameters import PAPER_KA, PAPER_KV, paper_motor
from motor_model.sensing.board import BoardConfig

LEAST = SearchConfig(4, 1)
MANY_SLOTS = 1000  # whose table is not solved by its modes
PERIODIC = tuple(effect.name for effect in EFFECTS if effect.periodic)


def prepare() -> None:
    """Load what every fit needs, or compile it: what a node does before the first request comes."""
    warm_up.main()
    identify([_record_step()], Request((), LEAST))


def main() -> None:
    """Fit a simulated step, as small as it gets; with what a diagnosis looks for in a spectrum and in what is left.

    Also of a disc of many slots, and beside a random torque.
    """
    prepare()
    recording = _record_step()
    identify([recording], Request(PERIODIC, LEAST))
    identify([_record_step(MANY_SLOTS)], Request((), LEAST))
    disturbed = recording.voltage + np.random.default_rng(0).normal(0.0, 2.0, len(recording))
    diagnose([replace(recording, voltage=disturbed)], request=Request((), LEAST, time_limit=20.0))
    _look_for_the_rarest(recording)


def _look_for_the_rarest(recording: Recording) -> None:
    """Look for jumps of the load beside a random torque, and for a bridge that slews: no diagnosis above gets there.

    Nor does one where rows are joined, or where speeds may be over times between edges.
    """
    join_commands(recording, 2)
    find_slot_by_stays(recording.time, recording.speed)
    estimate = Estimate(make_problem([recording], ()), np.log([PAPER_KV, PAPER_KA]))
    list_likely_jumps(estimate, ErrorModel(0.01, 0.0, 0.1, 0.05), 1)
    slew(recording, 1.0)


def _record_step(slots: int = 96) -> Recording:
    motor, config = paper_motor(), BoardConfig(edges_per_revolution=slots)
    plan = make_plan(profile("step"), 10.0, motor.max_voltage, 1.0 / config.sample_rate)
    return recording_of([sample for _, sample in simulate_plan(plan, motor, config)], config.info(motor), "warm-up")


if __name__ == "__main__":
    main()
