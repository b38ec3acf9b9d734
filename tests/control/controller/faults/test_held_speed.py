"""A motor that has left its speed while the controller is held up, and may not give more than what held it."""

from dataclasses import replace

import pytest
from fault_bench import ENCODER, LIMIT, SLOT
from held_up import REFERENCE, Loop, Pause, run, steady

from motor_control.controller.faults import held_speed
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.parameters import INDEX
from motor_model.sample import Sample

EVERY = [Pause(0.3 * k + 0.001, 0.3 * k + 0.046) for k in range(20)]  # 45 ms
FELT = Motion(steady_way=1, held_speed=100.0, held_voltage=7.3, slow_speed=100.0)
STALL = ENCODER.stall_time


def follow(rate: float, seconds: float, config: Config = ENCODER, motion: Motion = FELT, **changes: object) -> float:
    """When [s] the check speaks, of a motor with so many edges a second, or 0."""
    state, period, edges = held_speed.State(), 0.005, 0.0
    for k in range(round(seconds / period)):
        before, edges = edges, edges + rate * period
        count = int(edges) - int(before)
        volts = changes.get("volts", 7.3)
        sample = Sample(0, rate * SLOT, volts, 0)  # type: ignore[arg-type]
        seen = Seen(sample, 0.0, replace(motion, edges=count), 100.0, period, LIMIT, cautious=True)
        if "cautious" in changes:
            seen = replace(seen, cautious=False)
        reason, state = held_speed.check(config, state, seen)
        if reason:
            assert "The voltage that held 100 rad/s holds the motor no more: 7." in reason
            return (k + 1) * period
    return 0.0


def test_no_edge_or_fewer_than_half_of_them() -> None:
    assert follow(0.0, 2.0) == pytest.approx(STALL)
    assert STALL <= follow(0.45 * 100.0 / SLOT, 2.0) <= STALL + 0.01
    assert follow(0.55 * 100.0 / SLOT, 2.0) == 0.0
    assert follow(0.0, 2.0, cautious=False) == 0.0  # where it may give more, it does
    assert follow(0.0, 2.0, volts=0.0) == follow(0.0, 2.0, volts=-7.3) == 0.0
    assert follow(0.0, 2.0, replace(ENCODER, stall_time=0.0)) == 0.0
    assert follow(0.0, 2.0, motion=replace(FELT, held_speed=50.0)) == 0.0  # of 100 rad/s nothing is known


def test_a_disc_of_few_slots_has_the_time_for_its_edges() -> None:
    """Of five slots at half the speed: of 8 a turn at 10 rad/s that is 0.79 s."""
    assert follow(0.0, 2.0, replace(ENCODER, slot=6.0)) == pytest.approx(0.6)
    assert follow(0.0, 2.0, replace(ENCODER, slot=4.0)) == pytest.approx(STALL)


def test_a_motor_that_spins_up_is_none_that_has_left_its_speed() -> None:
    rising = replace(FELT, slow_speed=79.0)
    assert follow(0.4 * 100.0 / SLOT, 2.0, motion=rising) == 0.0
    assert follow(0.0, 2.0, motion=rising) == pytest.approx(STALL)  # but it has to move
    assert follow(0.4 * 100.0 / SLOT, 2.0, motion=replace(FELT, slow_speed=81.0)) > 0.0


def test_a_plant_that_counts_no_edges_is_gone_by_its_speed() -> None:
    assert follow(0.0, 2.0, replace(ENCODER, slot=0.0)) == pytest.approx(STALL)
    assert follow(0.6 * 100.0 / SLOT, 2.0, replace(ENCODER, slot=0.0)) == 0.0


class WithoutEncoder:
    """A board whose encoder hangs loose; the motor turns."""

    def __init__(self, board: object) -> None:
        self.board, self.last = board, None

    def sample(self, command: float) -> Sample:
        now = self.board.sample(command)  # type: ignore[attr-defined]
        self.last = self.last or now
        return replace(now, speed=0.0, edge_count=self.last.edge_count, edge_time=self.last.edge_time, edge_period=0.0)

    @property
    def speed(self) -> float:
        return float(self.board.speed)  # type: ignore[attr-defined]


class WithoutSupply(WithoutEncoder):
    """A board whose bridge has no supply, which it does not measure."""

    def sample(self, command: float) -> Sample:
        return replace(self.board.sample(0.0), voltage=command)  # type: ignore[attr-defined]


@pytest.mark.parametrize("rate", [200.0, 1000.0])
@pytest.mark.parametrize("what", ["stuck", "encoder", "supply"])
def test_a_controller_that_is_held_up_now_and_then_stops_a_motor_that_is_gone(rate: float, what: str) -> None:
    """It drove a stuck one, and one without an encoder, for ever; and one whose supply came back ran by itself."""
    loop: Loop = steady(rate)
    run(loop, EVERY, 0.9)
    assert loop.board.speed == pytest.approx(REFERENCE, rel=0.06)
    if what == "stuck":
        loop.board._p[[INDEX["ks"], INDEX["breakaway_voltage"]]] = 1000.0
    else:
        loop.board = (WithoutEncoder if what == "encoder" else WithoutSupply)(loop.board)  # type: ignore[assignment]
    seen = run(loop, EVERY, 1.5)
    assert "holds the motor no more" in seen.reasons[-1] or "Edges do not fit" in seen.reasons[-1]
    assert not seen.voltages[round(0.75 * rate) :].any()
