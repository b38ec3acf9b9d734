"""A node goes on when the system's clock is set back."""

from types import SimpleNamespace

import pytest

from motor_ros.clocks.clock_watch import SET_BACK, ClockWatch


@pytest.mark.parametrize(("set_by", "resets"), [(-3600.0, 1), (-1.1 * SET_BACK, 1), (-0.9 * SET_BACK, 0), (3600.0, 0)])
def test_timers_begin_anew_when_the_clock_is_set_back(set_by: float, resets: int) -> None:
    """A simulated plant stood for an hour after its clock had been set back by one, and a robot's drive with it."""
    done: list[str] = []
    node = SimpleNamespace(timers=[SimpleNamespace(reset=lambda: done.append("reset"))] * 2)
    executor = SimpleNamespace(wake=lambda: done.append("wake"))
    ahead = [1.7e9]
    watch = ClockWatch(node, executor, lambda: ahead[0])  # type: ignore[arg-type]
    watch.look()
    assert done == []
    ahead[0] += set_by
    watch.look()
    watch.look()
    assert done == ["reset", "reset", "wake"] * resets
    ahead[0] -= 2 * SET_BACK  # again
    watch.look()
    assert done == ["reset", "reset", "wake"] * (resets + 1)


def test_it_looks_while_a_node_runs() -> None:
    looks: list[float] = []

    def ahead() -> float:
        looks.append(0.0)
        return 0.0

    node, executor = SimpleNamespace(timers=[]), SimpleNamespace(wake=lambda: None)
    with (watch := ClockWatch(node, executor, ahead)):  # type: ignore[arg-type]
        while len(looks) < 3:
            pass
    assert not watch._thread.is_alive()
