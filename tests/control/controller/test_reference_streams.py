"""A stream of references ends with what ends one, and is not obeyed again until it begins again."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from referred import CONFIG, OBSTACLES, feed, running

from motor_control.controller import controller
from motor_control.controller.controller import State
from motor_control.controller.output import DISABLED, RUNNING
from motor_model.sample import Sample


def restart(state: State) -> State:
    """The plant is started again 2 s later: its clock begins anew."""
    return replace(state, plant=replace(state.plant, sample_time=10**15)) if state.plant else state


def unplug(state: State) -> State:
    """Nothing is heard of the plant for 2 s; its clock goes on."""
    return state


def start_again(state: State) -> State:
    """As the node finds out: samples begin again, and another publishes them."""
    return controller.meet_other_plant(state)


def stop_and_reset(state: State) -> State:
    """A fault, which somebody clears."""
    return controller.reset(controller.stop(state, "It is blocked.", 0.0), 0.0)[1]


def let_go(state: State) -> State:
    """Somebody calls motor/release."""
    return controller.release(state, 0.0)[1]


@pytest.mark.parametrize("rate", [1, 5, 50])  # [Hz]
@pytest.mark.parametrize("interrupt", [restart, unplug, start_again, stop_and_reset, let_go])
def test_a_stream_of_references_does_not_survive_what_ends_one(rate: int, interrupt: Callable[[State], State]) -> None:
    """The motor started by itself when its plant came back: whoever goes on sending has not seen that it was away."""
    state, period = State(), 1000 // rate

    def hear(state: State, times: range, stream: bool = True, sampled: bool = True) -> tuple[set[str], State]:
        states = set()
        for time in times:
            if stream and time % period == 0:
                state = controller.refer(state, 60.0, 1e-3 * time)
            if sampled:
                output, state = feed(state, [time])
                states.add(output.state)
        return states, state

    states, state = hear(state, range(0, 3000, 5))
    assert states == {RUNNING}
    _, state = hear(state, range(3000, 5000, 5), sampled=False)
    states, state = hear(interrupt(state), range(5000, 12_000, 5))
    assert states == {DISABLED} and "until they begin again, with 0 or after a silence" in state.refused
    enough = 2000 if rate == 1 else 500
    early = hear(state, range(12_000, 12_000 - period + enough, 5), stream=False)[1]
    assert feed(early, [12_000 - period + enough], 60.0)[0].state == DISABLED
    assert feed(early, [12_005 - period + enough], 60.0)[0].state == RUNNING
    state = feed(state, [12_000], 0.0)[1]
    assert feed(state, [12_005], 60.0)[0].state == RUNNING


@pytest.mark.parametrize("interrupt", [restart, start_again, stop_and_reset, let_go])
@pytest.mark.parametrize("late", [200, 800])  # [ms] after the latest reference: before its time-out, and after it
def test_a_stream_slower_than_its_time_out_does_not_survive_what_else_ends_one(
    interrupt: Callable[[State], State], late: int
) -> None:
    """At 1 Hz with a `reference_timeout` of 0.5 s it started the motor 0.1 s after it had been released."""
    config, state, driven = replace(CONFIG, reference_timeout=0.5), State(), 0
    for time in range(0, 12_000, 5):
        if time == 4000 + late:
            state = interrupt(state)
        output, state = feed(state, [time], 60.0 if time % 1000 == 0 else None, config)
        assert time < 4000 + late or output.state == DISABLED
        driven += output.state == RUNNING
    assert driven > 400  # half of the time, before
    assert "until they begin again, with 0 or after a silence of 2 s" in state.refused
    assert feed(state, [13_005], 60.0, config)[0].state == RUNNING


def test_a_stream_slower_than_its_time_out_does_not_survive_an_output_that_was_off() -> None:
    """Its commands never lasted for as long as it takes to tell; it drove at once when `motor/enable` was called."""
    config, state = replace(CONFIG, reference_timeout=0.5), State()
    for time in range(0, 12_000, 5):
        on = not 4200 <= time < 7300
        output, state = feed(state, [time], 60.0 if time % 1000 == 0 else None, config, on=on)
        assert time < 7300 or output.state == DISABLED


@pytest.mark.parametrize("name", OBSTACLES)
def test_a_stream_of_references_does_not_survive_being_held_for_long(name: str) -> None:
    """Samples were no numbers for ten minutes, and the motor went on by itself."""
    config, speed, age = OBSTACLES[name]
    config, state = replace(config, latency_limit=0.02), controller.refer(State(), 60.0, 0.0)
    free = replace(config, unusable="", voltage_limit=CONFIG.voltage_limit)
    for k in range(700):
        held = 200 <= k < 500
        now = 0.005 * k + (age if held else 0.0)
        state = controller.refer(state, 60.0, now)
        sample = Sample(k * 5_000_000, speed if held else 0.0, 1.0, k // 20)
        output, state = controller.update(config if held else free, state, sample, None, now)
    assert output.state == DISABLED and output.terms.voltage == 0.0


def test_who_asks_for_a_motion_while_the_plant_is_away_is_obeyed_when_it_comes_soon() -> None:
    """As before; a stream that began long before it came is not."""
    for began, obeyed in ((2500, True), (1500, False)):
        state = State()
        for time in range(began, 3000, 20):
            state = controller.refer(state, 60.0, 1e-3 * time)
        assert (feed(state, [3000])[0].state == RUNNING) is obeyed


def test_what_may_be_an_old_reference_is_no_beginning() -> None:
    """A laptop is opened again, a joystick is still pressed: 3.5 s later the motor started by itself."""
    state, states = running(), []
    for time in range(200, 8000, 5):
        doubtful = 2000 <= time < 5500
        ask = controller.doubt(state, "It stood still.", 1e-3 * time) if doubtful else None
        state = ask or controller.refer(state, 60.0, 1e-3 * time)
        if not 200 <= time < 2000:
            output, state = feed(state, [time])
            states.append(output.state)
    assert set(states) == {DISABLED}
