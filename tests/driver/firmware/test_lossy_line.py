"""Frames of either direction lost, doubled, late or out of order around every switch: the motor never runs unasked."""

from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lossy_line import ACTS, DUTY, KINDS, Fault, LossyLink, faulty_turn

LAST = 45  # [turn] of a fault or an act
OFF, ON = 20, 24  # [turn] of motor/enable

some_acts = st.dictionaries(st.integers(12, LAST), st.lists(st.sampled_from(ACTS), max_size=2), max_size=4)
some_faults = st.lists(
    st.builds(
        Fault,
        st.sampled_from(KINDS),
        st.booleans(),
        st.integers(1, LAST),
        st.sampled_from([1, 1, 2, 3, 5, 10, 26]),
        st.sampled_from([1, 2, 6, 20]),
    ),
    max_size=3,
).map(tuple)


def test_a_whole_line_is_on_and_off_at_once() -> None:
    link = LossyLink()
    for _ in range(OFF):
        link.run()
    assert link.duty == DUTY and link.enable(False)
    link.run()
    link.run()
    assert link.duty == 0 and link.enable(True)
    for _ in range(4):
        link.run()
    assert link.duty == DUTY and link.stops == []


@pytest.mark.parametrize("act", ["trip", "reset"])
@pytest.mark.parametrize("lost", list(product((False, True), repeat=4)))
def test_what_ends_the_output_ends_it_whichever_telemetry_is_lost(act: str, lost: tuple[bool, ...]) -> None:
    """The board goes off by itself 1 to 4 turns after an enable, and any of the frames that say so are missing."""
    faults = tuple(Fault("lost", False, ON + k) for k in range(4) if lost[k])
    for after in range(1, 5):
        assert faulty_turn({OFF: ["off"], ON: ["on"], ON + after: [act]}, faults, LAST) == ""


@pytest.mark.parametrize("turns", [1, 4, 26])
@pytest.mark.parametrize("to_board", [True, False])
def test_no_frame_around_an_enable_and_a_stop_may_be_lost_to_any_harm(turns: int, to_board: bool) -> None:
    for first in range(OFF - 1, ON + 8):
        acts = {OFF: ["off"], ON: ["on"], ON + 5: ["off"]}
        assert faulty_turn(acts, (Fault("lost", to_board, first, turns),), LAST + turns) == "", first


@settings(deadline=None, max_examples=40)
@given(some_acts, some_faults)
def test_no_faults_of_the_line_make_the_motor_run_unasked(
    acts: dict[int, list[str]], faults: tuple[Fault, ...]
) -> None:
    assert faulty_turn(acts | {LAST + 1: ["wake"]}, faults, 100) == ""
