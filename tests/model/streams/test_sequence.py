"""References that begin, and those that go on: after how long a silence, on either side."""

import pytest

from motor_model.streams.sequence import LONGEST, SHORTEST, TIMES, Sequence


def heard(*times: float) -> Sequence:
    """References that came at these times [s], none of them 0."""
    sequence = Sequence()
    for time in times:
        sequence = sequence.hear(time, False)
    return sequence


def stream(rate: float, seconds: float = 5.0) -> list[float]:
    """The times [s] of references that come at a rate [Hz] from 10 s on."""
    return [10.0 + k / rate for k in range(round(rate * seconds))]


def test_the_first_one_begins_and_the_next_goes_on() -> None:
    assert heard(3.0).begins and not heard(3.0, 3.1).begins and not heard(3.0, 3.0).begins


@pytest.mark.parametrize(
    ("times", "silence"),
    [
        ([10.0], SHORTEST),
        (stream(50.0), SHORTEST),
        (stream(4.01), SHORTEST),
        (stream(2.0), 1.0),
        (stream(1.0), LONGEST),
        ([10.0, 11.996, 13.0, 14.996], LONGEST),
        ([*stream(1.0), 14.001, 14.002], LONGEST),  # two that a busy computer lets come at once
        ([8.0, 9.0, *stream(50.0)], LONGEST),
        ([8.0, 9.0, *[time + 2.0 for time in stream(50.0)]], SHORTEST),  # long after: another one
    ],
)
def test_a_silence_is_long_beside_the_time_between_them(times: list[float], silence: float) -> None:
    """At 1 Hz as `ros2 topic pub` sends them half a second is none."""
    assert heard(*times).silence == pytest.approx(silence, rel=1e-3)
    assert not heard(*times, times[-1] + 0.999 * silence).begins and heard(*times, times[-1] + 1.001 * silence).begins


def test_a_speed_of_0_begins_and_so_does_what_follows_it() -> None:
    """A sender that has let go of the motor and is asked again within half a second."""
    stopped = heard(*stream(50.0)).hear(15.0, True)
    assert stopped.begins and stopped.hear(15.02, True).begins and stopped.hear(15.02, False).begins
    assert not stopped.hear(15.02, False).hear(15.04, False).begins


@pytest.mark.parametrize("period", [6.5, 15.0, 3600.0])
@pytest.mark.parametrize(("uneven", "begins"), [(0.0, False), (0.045, False), (0.055, True)])
def test_what_comes_as_seldom_and_evenly_is_a_schedule(period: float, uneven: float, begins: bool) -> None:
    """Every 15 s, or a loop of a shell: the motor started by itself within that time of its plant's coming back."""
    times = [10.0 + k * period for k in range(4)]
    sequence = heard(*times[:3])
    assert sequence.even and sequence.needed == TIMES * period
    assert heard(*times[:3], times[3] + uneven * period).begins is begins
    assert heard(*times[:3], times[3] - uneven * period).begins is begins
    assert heard(*times[:2], times[2] + uneven * period, times[3] + uneven * period).begins is begins
    assert sequence.hear(times[3], True).begins and sequence.hear(times[3], True).hear(times[3] + period, False).begins


def test_two_that_come_as_far_apart_are_a_hand() -> None:
    assert heard(10.0, 25.0, 40.0).begins and not heard(10.0, 25.0, 40.0, 55.0).begins
