"""What nobody has said is taken from the board; what was said has to be so."""

from first_run_bench import hello

from motor_driver.check.settings import Settings, config_of
from motor_driver.frames.codes import BAUD


def refusal(settings: Settings, channels: int = 1, edges: int = 0, board_id: int = 0) -> str:
    return config_of(settings, BAUD, 0).refusal(hello(channels, edges, board_id))


def test_an_unknown_board_is_taken_as_it_is() -> None:
    assert refusal(Settings(), 2, 96, 7) == ""
    assert Settings().edges(hello(edges=96)) == 96 and Settings().edges(hello()) is None
    assert Settings(edges_per_revolution=48).edges(hello(edges=96)) == 48


def test_what_was_said_and_is_not_so_is_refused() -> None:
    assert "the board number 7, and the parameter board_id is 9" in refusal(Settings(board_id=9), board_id=7)
    assert "the board without a number" in refusal(Settings(board_id=9))
    assert "flashed for an encoder with 96 edges" in refusal(Settings(edges_per_revolution=48), edges=96)
    assert "reads 1 encoder channel(s)" in refusal(Settings(single_channel=False))
    assert "quadrature is 4, and the board was flashed for one encoder channel" in refusal(Settings(quadrature=4))
    assert refusal(Settings(edges_per_revolution=11, quadrature=4), channels=2, edges=11) == ""


def test_the_motors_limits_and_the_supply_go_to_the_driver() -> None:
    config = config_of(Settings(max_voltage=6.0, supply_voltage=24.0), BAUD, 1)
    assert (config.max_voltage, config.full_voltage, config.stall_time, config.decay) == (6.0, 24.0, 0.0, 1)
    assert Settings(max_voltage=6.0).supply == 6.0 and Settings(max_voltage=6.0).highest == 3.0
