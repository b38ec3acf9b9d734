"""Packing loses nothing: every number comes back where it was."""

from motor_control.filter.direction_hypotheses import Hypotheses
from motor_control.filter.filter_state import (
    Consistency,
    Covariance,
    Estimate,
    FilterState,
    History,
    LatestEdge,
    Silence,
)
from motor_control.filter.load_jump import no_jumps
from motor_control.filter.packed_state import STATE, pack_hypotheses, unpack_hypotheses
from motor_model.dynamics.state import State


def numbered(first: float, stands: bool) -> FilterState:
    """A state all of whose numbers differ."""
    n = [first + k for k in range(STATE)]
    history = History(LatestEdge(*n[13:17]), Silence(n[17], stands), Consistency(*n[18:21]), n[21], n[22])
    return FilterState(Estimate(State(*n[:6]), n[6], Covariance(*n[7:13])), history, n[23])


def test_a_round_trip_is_exact() -> None:
    for stands in (False, True):
        pair = Hypotheses(numbered(1.0, stands), numbered(100.0, not stands), 7.5, no_jumps())
        memory = pack_hypotheses(pair)
        assert memory.numbers.shape == (2 * STATE + 1,)
        back = unpack_hypotheses(memory)
        assert back[:3] == pair[:3] and back.jumps is memory.jumps or (back.jumps == memory.jumps).all()
