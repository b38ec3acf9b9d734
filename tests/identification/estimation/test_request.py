"""A request that cannot be met is refused, and what nobody asks for has the same default everywhere."""

import pytest

from motor_identification.cli.identify import parser
from motor_identification.estimation.request import Request, SearchConfig
from motor_identification.service.parameters import PARAMETERS
from motor_model.errors import MotorError


@pytest.mark.parametrize("wrong", [{"particles": 1}, {"epochs": 0}, {"seed": -1}])
def test_numbers_that_no_search_can_do_with_are_refused(wrong: dict[str, int]) -> None:
    with pytest.raises(MotorError, match="particles must be at least 2, epochs at least 1, and the seed not negative"):
        SearchConfig(**wrong)
    assert SearchConfig(particles=2, epochs=1, seed=0).budget == 4


def test_command_and_node_search_as_hard_as_the_library() -> None:
    search, options = Request().search, parser().parse_args(["bag"])
    rows = {row.name: row.default for row in PARAMETERS}
    assert (options.particles, options.epochs, options.seed) == (search.particles, search.epochs, search.seed)
    assert (rows["particles"], rows["epochs"], rows["seed"]) == (50, 200, 0)
