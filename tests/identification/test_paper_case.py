"""The paper's own case: static friction is named from a low-gain PI run and a ramp, and then the loop is predicted."""

from dataclasses import replace

import numpy as np
import pytest
from pi_runs import (
    BASE,
    EFFECTS,
    HIDDEN,
    HUNTING,
    JUDGE,
    STARTS,
    Run,
    as_before,
    disc_seen,
    hidden_run,
    loop_simulated,
    ramps,
    standing,
)
from plant.loop import close_loop

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.result import Verdict
from motor_identification.recording import Floats
from motor_model.errors import ModelError

FOUND = HIDDEN | {"kv": HIDDEN["kv"] * (1.0 + 2e-6), "ka": HIDDEN["ka"] * (1.0 - 5e-6), "ks": 0.4 + 2e-6}  # so well
SEED = 1


def of_floor(run: Run, values: dict[str, float], voltage: Floats) -> float:
    return run.scored(values, voltage).gap() / run.floor


def test_static_friction_is_named_from_a_pi_run_and_a_ramp() -> None:
    run, judge = hidden_run(HUNTING, SEED, 200.0), hidden_run(JUDGE, SEED, 200.0, begin=1)
    assert 0.05 < np.mean(run.truth.speed == 0.0) < 0.4  # it sticks, again and again
    found = diagnose([run.recording, ramps(SEED)], [judge.recording])
    assert [finding.effect for finding in found.findings] == EFFECTS and found.verdict is Verdict.EXPLAINED
    for name, value in HIDDEN.items():
        assert found.model.parameters.value(name) == pytest.approx(value, rel=2e-4)
    assert found.gap_before > 30.0 * found.noise_floor and 0.8 < found.gap_after / found.noise_floor < 1.3
    voltage = judge.recording.voltage
    assert judge.scored(dict(found.model.parameters.values), voltage).gap() == pytest.approx(found.gap_after, rel=1e-3)


@pytest.mark.slow
def test_the_loop_with_the_effect_added_meets_the_gap_on_another_reference() -> None:
    """At 1 kHz, started and stopped; on the disc that an earlier run has shown, and on a regular one."""
    earlier = replace(HUNTING, levels=HUNTING.levels[3:6])  # some turns, which pass every hole
    before, run = hidden_run(earlier, SEED, 1000.0), hidden_run(STARTS, SEED, 1000.0, begin=2)
    assert 0.8 < of_floor(run, HIDDEN, run.recording.voltage) < 1.25
    seen = standing(run.recording, FOUND, disc_seen(before.recording, FOUND))
    regular = standing(run.recording, FOUND, None)
    assert 0.8 < of_floor(run, FOUND, loop_simulated(run, FOUND, *seen)) < 1.3
    assert 0.8 < of_floor(run, FOUND, loop_simulated(run, FOUND, *regular)) < 1.3
    assert 2.0 < of_floor(run, BASE, loop_simulated(run, BASE, *seen)) < 3.0  # the paper's model: it never sticks


@pytest.mark.slow
def test_where_the_loop_hunts_no_model_can_be_near_enough() -> None:
    """A millionth in kv is another motion after some slips, on the very same disc from the very same angle."""
    run = hidden_run(JUDGE, SEED, 200.0, begin=1)
    assert np.array_equal(loop_simulated(run, HIDDEN, *as_before(run)), run.recording.voltage)
    near = HIDDEN | {"kv": HIDDEN["kv"] * (1.0 + 1e-6)}
    assert of_floor(run, near, run.recording.voltage) < 1.3
    assert of_floor(run, near, loop_simulated(run, near, *as_before(run))) > 2.0


def test_a_motor_that_remembers_is_refused() -> None:
    with pytest.raises(ModelError, match="delay"):
        close_loop(BASE | {"delay": 0.01}, lambda sample: 1.0, 0.1)
