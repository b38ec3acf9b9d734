"""What no fit has seen stays unseen: corrupted held-out samples leave every fit of a diagnosis bit for bit the same."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from plant import profiles, record
from tiers import keep_fast

from motor_identification.diagnosis.effect_test import try_effects
from motor_identification.diagnosis.selection.selection import begin_beside_torque
from motor_identification.diagnosis.start import fit_known
from motor_identification.estimation.request import Request, SearchConfig
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.measurement.initial_speed import estimate_initial_speed
from motor_identification.measurement.time_blocks import TimeBlocks
from motor_identification.recording import Recording, check
from motor_identification.validation.hold_out import BlocksOfSame, HoldOut, OtherRecordings, make_hold_out
from motor_model.parameters import PAPER_KA, PAPER_KV

TRUE = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4, "delay": 0.006}
KNOWN = Request(("coulomb_friction",), SearchConfig(particles=8, epochs=4))
TRIED = ("transport_delay", "load_step", "torque_ripple")  # by least squares, with an instant of its own, by a spectrum
FAST = 3  # edges a sample: one more or less of them is no reversal


def made(drive: profiles.Profile, seed: int) -> Recording:
    return check(record(TRUE, *drive, seed=seed, irregularity=0.003, disc_seed=3, name=f"{seed}.bag")[0])


def corrupt(recording: Recording, blocks: TimeBlocks) -> Recording:
    """The recording with every other count off by one, where no interval begins or ends that a fit may see."""
    data = make_intervals(recording)
    held = blocks.mark(data, recording.sample_period)
    seen = np.unique(np.concatenate([data.time[data.first[~held]], data.time[data.last[~held]]]))
    latest = (recording.edge_time - recording.sample_time[0]) * 1e-9 + 0.5 * recording.info.edge_resolution
    tick = 0.1 * recording.info.edge_resolution
    among = np.searchsorted(seen, latest - recording.edge_period - tick) == np.searchsorted(seen, latest + tick)
    steps = np.abs(np.diff(recording.edge_count, prepend=0))
    fast = (steps >= FAST) & (np.append(steps[1:], 0) >= FAST)
    return replace(recording, edge_count=recording.edge_count + (among & fast & (np.arange(len(recording)) % 2 == 0)))


def list_fits(train: Recording, hold_out: HoldOut) -> tuple[list[Any], int]:
    """All that a diagnosis fits at its first step, and how many held-out intervals are seen to be miscounted."""
    start, _ = fit_known([train], KNOWN, hold_out)
    tests = try_effects(start.model, start.hold_out, TRIED, 1, lambda test: None)
    beside = begin_beside_torque(start.model, start.hold_out, 1)
    fits: list[Any] = [start.model.noise, beside.model.learned]
    for model in (start.model, beside.model, *(test.model for test in sorted(tests, key=lambda test: test.effect))):
        fits += [model.estimate.theta, model.whitened.theta, hold_out.apply(model.estimate).theta]
    return fits, start.model.held.miscounted


@pytest.mark.parametrize("rule", keep_fast([BlocksOfSame, OtherRecordings], BlocksOfSame))
def test_corrupted_held_out_samples_change_no_fit(rule: type[HoldOut]) -> None:
    swinging = profiles.joined(*[profiles.staircase(10.0, 3, 0.3)] * 4)  # enough for blocks of it to be held out
    train, other = made(swinging, 1), made(profiles.random(9.0, 5.0), 2).between(1.0, 0.0)
    assert estimate_initial_speed(other) != 0.0  # a nuisance parameter of its own
    if rule is BlocksOfSame:
        spoilt = corrupt(train, TimeBlocks(4))
        (fits, few), (again, many) = (list_fits(one, make_hold_out([one], [])) for one in (train, spoilt))
    else:
        spoilt = corrupt(other, TimeBlocks(2))
        (fits, few), (again, many) = (list_fits(train, make_hold_out([train], [one])) for one in (other, spoilt))
    assert few < 5 and many > 20  # what was corrupted is seen where the model is judged
    assert all(np.array_equal(*pair) for pair in zip(fits, again, strict=True))
