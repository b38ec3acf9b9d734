"""Parts of a recording, and recordings that identification refuses, each with what to do."""

from dataclasses import replace

import numpy as np
import pytest
from handmade import PERIOD, turning

from motor_identification.recording import Recording, check, once, recording_of
from motor_model.errors import RecordingError
from motor_model.sample import Info, Measurement, Sample

GOOD = turning(lambda time: 700.0 * time, 1.0)


def test_times_are_exact_and_a_part_is_a_part() -> None:
    assert len(GOOD) == 201 and GOOD.duration == pytest.approx(1.0) and GOOD.time[1] == pytest.approx(PERIOD, rel=1e-9)
    part = GOOD.between(0.25, 0.5)
    assert (part.time[0], part.duration) == (0.0, pytest.approx(0.25)) and part.edge_count[0] == GOOD.edge_count[50]
    assert GOOD.between(0.0, 0.0) is GOOD and len(GOOD.between(0.5, 0.0)) == 101


@pytest.mark.parametrize(("start", "stop"), [(0.5, 0.5), (0.6, 0.5), (-0.1, 0.5), (2.0, 3.0)])
def test_a_window_without_samples_is_refused(start: float, stop: float) -> None:
    with pytest.raises(RecordingError) as refused:
        GOOD.between(start, stop)
    assert str(refused.value).endswith(".")


def test_samples_become_columns() -> None:
    samples = [Sample(1_000_000_000 + k * 5_000_000, 0.5 * k, 6.0, edge_count=k) for k in range(4)]
    recording = recording_of(samples, Info(), "bag", ("a note",))
    assert recording.speed.tolist() == [0.0, 0.5, 1.0, 1.5] and recording.edge_count.tolist() == [0, 1, 2, 3]
    assert recording.sample_time.dtype == np.int64 and recording.notes == ("a note",)
    assert np.isnan(recording.current).all()


@pytest.mark.parametrize(
    ("period", "window", "measurement", "steady"),
    [
        (20.0, 1.0, Measurement.SPEED, True),
        (20.0, 5.0, Measurement.SPEED, True),
        (20.0, 5.01, Measurement.SPEED, False),  # most of the way there is in it
        (20.0, 0.0, Measurement.SPEED, False),  # nobody said over what time
        (19.9, 1.0, Measurement.SPEED, False),  # a large motor may be on its way yet
        (20.0, 1.0, Measurement.COUNTS, False),
    ],
)
def test_what_was_held_for_long_is_a_steady_state(
    period: float, window: float, measurement: Measurement, steady: bool
) -> None:
    info = Info(sample_period=period, speed_window=window, measurement=measurement)
    assert replace(GOOD, info=info).has_steady_states is steady


def changed(**columns: object) -> Recording:
    return replace(GOOD, **columns)  # type: ignore[arg-type]


def put(values: np.ndarray, index: int, value: float) -> np.ndarray:
    values = values.copy()
    values[index] = value
    return values


BAD = {
    "one sample": GOOD.at_rows(np.arange(len(GOOD)) == 0),
    "a voltage that is no number": changed(voltage=put(GOOD.voltage, 7, np.nan)),
    "a speed that is infinite": changed(speed=put(GOOD.speed, 7, np.inf)),
    "a voltage that no motor has": changed(voltage=put(GOOD.voltage, 7, -1.01e5)),
    "a speed that no motor has": changed(speed=put(GOOD.speed, 7, 1e308)),
    "a clock that stands": changed(sample_time=put(GOOD.sample_time, 50, GOOD.sample_time[49])),
    "a clock that steps back": changed(sample_time=put(GOOD.sample_time, 50, GOOD.sample_time[40])),
    "an encoder without edges": changed(info=replace(GOOD.info, edges_per_revolution=0)),
    "one channel that counts down": changed(
        info=replace(GOOD.info, single_channel=True), edge_count=put(GOOD.edge_count, 50, 0)
    ),
    "no motion": changed(speed=0.0 * GOOD.speed, edge_count=0 * GOOD.edge_count),
}


@pytest.mark.parametrize("case", BAD)
def test_what_no_fit_can_use_is_refused_in_a_sentence(case: str) -> None:
    assert check(GOOD) is GOOD
    with pytest.raises(RecordingError, match="by hand") as refused:
        check(BAD[case])
    assert str(refused.value).endswith(".") and "\n" not in str(refused.value)


def test_a_high_voltage_may_be() -> None:
    high = changed(voltage=put(GOOD.voltage, 7, -9.9e4))
    assert check(high) is high


def test_two_channels_may_count_down() -> None:
    two = changed(edge_count=put(GOOD.edge_count, 50, GOOD.edge_count[50] - 2))
    assert check(two) is two


def test_what_is_measured_once_is_kept_with_the_recording_and_with_no_other() -> None:
    asked = []

    @once
    def length(recording: Recording) -> int:
        asked.append(recording)
        return len(recording)

    other = GOOD.between(0.25, 0.5)
    assert [length(one) for one in (GOOD, GOOD, other)] == [len(GOOD), len(GOOD), len(other)]
    assert len(asked) == 2 and asked[0] is GOOD and asked[1] is other
    assert length(replace(GOOD)) == len(GOOD) and len(asked) == 3  # a changed one is another
