"""Health from window to window: thresholds from both sides, and what is believed when."""

from math import inf, nan

import pytest

from motor_identification.monitoring.health import (
    BROKEN_SHARE,
    DRIFTING_RATIO,
    MOVING_RATIO,
    SHORT,
    STILL_SHARE,
    Health,
    Limits,
    State,
    Verdict,
    judge_gap,
    ratio_of,
    update_health,
)
from motor_identification.monitoring.model_gap import Gap, Model
from motor_identification.reporting.model_comparison import Identified
from motor_model.parameters import Parameters

MODEL = Model(Identified("motor", Parameters({"kv": 0.5, "ka": 0.02}, max_voltage=10.0), {}))  # 20 rad/s at most
LIMITS = Limits(window=10.0, tolerance=0.05)
MOVES = object()  # an estimate to fit from: only whether there is one counts


def gap(rms: float, expected: float = 0.1, measured: float = 10.0, duration: float = 10.0) -> Gap:
    return Gap(rms, expected, measured, measured, duration, MOVES)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "below, above, state",
    [
        (gap(0.99 * DRIFTING_RATIO * 1.0, 1.0), gap(1.01 * DRIFTING_RATIO * 1.0, 1.0), State.DRIFTING),
        (gap(0.99 * LIMITS.tolerance * 10.0), gap(1.01 * LIMITS.tolerance * 10.0), State.DRIFTING),
    ],
    ids=["beyond the noise", "beyond the tolerance"],
)
def test_a_motor_drifts_beyond_both_its_noise_and_the_tolerance(below: Gap, above: Gap, state: State) -> None:
    assert judge_gap(below, MODEL, LIMITS).state is State.FITS
    assert judge_gap(above, MODEL, LIMITS).state is state


def test_a_model_that_misses_half_of_the_speed_is_not_this_motors() -> None:
    assert judge_gap(gap(0.99 * BROKEN_SHARE * 10.0), MODEL, LIMITS).state is State.DRIFTING
    assert judge_gap(gap(1.01 * BROKEN_SHARE * 10.0), MODEL, LIMITS).state is State.BROKEN


def test_speeds_in_the_noise_and_short_windows_say_nothing() -> None:
    assert judge_gap(gap(0.1, 0.1, 0.99 * MOVING_RATIO * 0.1), MODEL, LIMITS).state is State.UNKNOWN
    assert judge_gap(gap(0.1, 0.1, 1.01 * MOVING_RATIO * 0.1), MODEL, LIMITS).state is State.FITS
    short = judge_gap(gap(0.1, duration=0.99 * SHORT * 10.0), MODEL, LIMITS)
    assert short.state is State.UNKNOWN and short.sentence == "Heard 4.0 s of motion so far, of 10 s."
    assert judge_gap(gap(0.1, duration=1.01 * SHORT * 10.0), MODEL, LIMITS).state is State.FITS


def test_a_motor_that_stands_is_broken_from_a_share_of_the_top_speed_on() -> None:
    def still(predicted: float) -> State:
        return judge_gap(Gap(predicted, 0.0, 0.0, predicted, 10.0), MODEL, LIMITS).state

    assert still(0.99 * STILL_SHARE * 20.0) is State.UNKNOWN
    assert still(1.01 * STILL_SHARE * 20.0) is State.BROKEN


FITS = Verdict(State.FITS, "fits", gap(0.1))
DRIFTS = Verdict(State.DRIFTING, "drifts", gap(1.0))
RESTS = Verdict(State.UNKNOWN, "rests", Gap(0.0, 0.0, 0.0, 0.0, 10.0))
SILENCE = Verdict(State.UNKNOWN, "nothing comes")


def after(*verdicts: Verdict) -> Health:
    health = Health(since=0)
    for now, verdict in enumerate(verdicts, 1):
        health = update_health(health, verdict, now)
    return health


def test_a_change_is_believed_when_two_windows_in_a_row_say_so() -> None:
    assert after(FITS).verdict.state is State.FITS, "at once, where nothing was known"
    assert after(FITS, DRIFTS).verdict.state is State.FITS
    assert after(FITS, DRIFTS, FITS, DRIFTS).verdict.state is State.FITS
    changed = after(FITS, DRIFTS, DRIFTS)
    assert changed.verdict is DRIFTS and changed.since == 3
    assert after(FITS, DRIFTS, DRIFTS, DRIFTS).since == 3
    assert after(FITS, DRIFTS, DRIFTS, FITS, FITS).verdict is FITS


def test_rest_keeps_what_was_seen_and_silence_does_not() -> None:
    assert after(FITS, DRIFTS, DRIFTS, RESTS, RESTS).verdict is DRIFTS
    assert after(FITS, DRIFTS, RESTS, DRIFTS).verdict is FITS, "two in a row"
    assert after(RESTS).verdict is RESTS
    assert after(FITS, SILENCE).verdict is SILENCE
    assert after(FITS, SILENCE, DRIFTS, DRIFTS).verdict is DRIFTS


def test_the_ratio_is_nan_without_a_window_and_infinite_where_nothing_is_expected() -> None:
    assert ratio_of(gap(0.3)) == pytest.approx(3.0)
    assert ratio_of(Gap(3.0, 0.0, 0.0, 3.0, 10.0)) == inf
    assert str(ratio_of(None)) == str(nan)
