"""What the log says: one line a change, none that repeats, and a reference that cannot be reached."""

from dataclasses import replace

import numpy as np
import pytest
from bench_board import DEFAULTS, drive, motor, settings

from motor_control.announcements import Line, Told, announce, describe_start, top_speed_of
from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.output import DISABLED, NO_SAMPLES, RUNNING, STOPPED, Output, halt
from motor_model.sample import Info

CONFIG = config_of(DEFAULTS, Info())
RAW = {"speed_source": "measured", "feedforward": False, **{key: DEFAULTS[key] for key in ("kp", "ki")}}


def say(rows: list[tuple[Output, float | None]], every: float = 0.005) -> list[str]:
    told, said = Told(), []
    for k, (output, wanted) in enumerate(rows):
        lines, told = announce(told, output, wanted, CONFIG, k * every)
        said += [line.text for line in lines]
    return said


def running(reason: str = "") -> Output:
    return replace(halt(RUNNING, reason, 50.0, 49.0), drives=True)


def test_the_start_says_gains_source_and_limit() -> None:
    text = describe_start(settings(motor(), Info(), voltage_limit=9.0))
    assert "ki" in text and "speed source observer, feed-forward on, at most 9 V" in text


def test_a_run_is_one_line_and_how_to_let_go() -> None:
    said = say(
        [(controller.WAITING, None), (halt(DISABLED, "No reference yet.", 0.0, 0.0), None)] + [(running(), 50.0)] * 500
    )
    assert said == [
        "No reference yet.",
        "Reference 50 rad/s. To let go of the motor call motor/release; 0 rad/s stops it.",
    ]


def test_what_was_not_said_is_not_said_to_be_over() -> None:
    """A sample that comes before motor/info, as at a start on a busy computer, made a line more."""
    unheard, waits = (
        halt(STOPPED, "No motor/info has come yet.", 0.0, 0.0),
        halt(DISABLED, "No reference yet.", 0.0, 0.0),
    )
    started = [(unheard, None)] * 3 + [(waits, None)] * 20
    assert say(started) == []
    again = [(running(), 50.0), (unheard, 50.0), (waits, 50.0)]
    assert say(started + again)[1:] == ["No motor/info has come yet.", "No reference yet."]


def test_each_new_reference_is_a_line_and_a_joystick_a_few() -> None:
    said = say([(running(), 50.0)] * 300 + [(running(), 60.0)] * 300 + [(running(), 50.0)] * 3)
    assert [line.split(".")[0] for line in said] == [f"Reference {wanted} rad/s" for wanted in (50, 60, 50)]
    joystick = say([(running(), 50.0 + 0.1 * k) for k in range(400)])  # 2 s
    assert 3 <= len(joystick) <= 6


def test_silence_is_said_once_and_its_end_too() -> None:
    silent = [(halt(NO_SAMPLES, f"No sample on motor/speed for {0.1 * k:.1f} s.", 0.0, 0.0), 50.0) for k in range(1, 9)]
    said = say([(running(), 50.0)] * 5 + silent + [(running(), 50.0)] * 5)
    assert said[1:] == ["No sample on motor/speed for 0.1 s.", "Running again."]


def test_a_plant_whose_output_is_off_is_said_once() -> None:
    rows = [
        (running(f"The plant's output is off: it applies 0 V where {k:.2f} V were asked for."), 50.0) for k in range(40)
    ]
    assert len(say([(running(), 50.0), *rows])) == 2


def test_a_reason_that_comes_and_goes_with_every_sample_is_said_once_in_a_while() -> None:
    late = halt(
        STOPPED, "The sample is 30 ms old and latency_limit is 20 ms: give the controller more time.", 50.0, 9.0
    )
    said = say([(running(), 50.0), (late, 50.0)] * 200)  # 2 s
    assert len(said) <= 5 and sum("ms old" in line for line in said) <= 2


def test_a_stop_is_a_warning_with_its_reason() -> None:
    lines, _ = announce(Told(state=RUNNING, wanted=50.0), halt(STOPPED, "Blocked.", 0.0, 0.0), 50.0, CONFIG, 1.0)
    assert lines == [Line(True, "Blocked.")]


def test_a_reference_beyond_the_top_speed_is_said_with_it() -> None:
    """500 rad/s asked of a motor that turns 168 rad/s with friction."""
    for source, words in (
        ("observer", "top speed at 12 V is 168 rad/s by its model"),
        ("measured", "turns at 167 rad/s with all the 12 V"),
    ):
        run = drive(motor(), 500.0, 4.0, speed_source=source, feedforward=source == "observer", model=motor())
        config = settings(motor(), Info(), speed_source=source) if source == "observer" else CONFIG
        told, said = Told(), []
        for time, output in zip(run.time, run.outputs, strict=True):
            lines, told = announce(told, output, 500.0, config, float(time))
            said += [line.text for line in lines]
        saturated = [line for line in said if line.startswith("Saturated: 500 rad/s are not reached.")]
        assert len(saturated) == 1 and words in saturated[0] and said[-1] == saturated[0]


def test_a_reference_that_is_reached_saturates_nothing() -> None:
    run = drive(motor(), 100.0, 2.0)
    told, said = Told(), []
    for time, output in zip(run.time, run.outputs, strict=True):
        lines, told = announce(told, output, 100.0, CONFIG, float(time))
        said += lines
    assert len(said) == 1


def test_the_top_speed_is_the_models() -> None:
    assert 166.0 < top_speed_of(settings(motor(), Info())) < 170.0
    assert top_speed_of(CONFIG) == float("inf")


@pytest.mark.parametrize(
    ("kv", "ka", "rate", "count"),
    [
        (0.02, 0.001, 100.0, 1),
        (0.02, 0.001, 200.0, 1),
        (0.02, 0.001, 50.0, 0),  # at which gains are lowered
        (0.07, 0.0055, 100.0, 0),
        (0.4, 0.02, 200.0, 0),
        (2.0, 0.1, 200.0, 0),
    ],
)
def test_a_voltage_that_swings_between_all_and_nothing_is_said_once(
    kv: float, ka: float, rate: float, count: int
) -> None:
    """A motor of 600 rad/s with the gains of one of 174 went from 218 to 381 rad/s and back, and nobody said so."""
    reference = 0.5 * 12.0 / kv
    for wanted in (reference, -reference):
        run = drive(motor(kv=kv, ka=ka), wanted, 4.0, rate=rate, configs=((0.0, {"model": None}),), **RAW)
        told, said = Told(), []
        for time, output in zip(run.time, run.outputs, strict=True):
            lines, told = announce(told, output, wanted, CONFIG, float(time))
            said += [line for line in lines if "swings between all and nothing, 8 times in 0." in line.text]
        assert len(said) == count and all(line.severe for line in said)
        assert all("kp 0.2 and ki 2.5 are too much for this motor" in line.text for line in said)
        speeds = run.speed[len(run.speed) // 2 :] / wanted
        assert bool(np.std(speeds) > 0.05) is (count > 0)


@pytest.mark.parametrize(("turns", "said"), [(7, False), (8, True)])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_it_takes_eight_swings_within_two_seconds_at_one_reference(turns: int, said: bool, way: float) -> None:
    def count(every: float, restart: bool = False, off: bool = False) -> int:
        told, lines, time = Told(), list[Line](), 0.0
        for k in range(turns):
            wanted = way * (50.0 + restart * (k == 4))
            output = running()
            terms = replace(output.terms, voltage=way * (11.9 if k % 2 == 0 else 0.1))
            state = halt(DISABLED, "off", 50.0, 49.0) if off and k == 4 else replace(output, terms=terms)
            new, told = announce(told, state, wanted, CONFIG, time)
            lines, time = [*lines, *(line for line in new if "swings" in line.text)], time + every
        return len(lines)

    assert count(0.28) == said
    assert count(0.3) == count(0.1, restart=True) == count(0.1, off=True) == 0
