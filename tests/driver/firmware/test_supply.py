"""A supply above or below the motor's voltage: the motor gets its own, as duty of what there is."""

from dataclasses import replace

import pytest
from driver_rig import MakeRig, problem

from motor_board.build import FirmwareConfig
from motor_driver.config import Config
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters, paper_motor


@pytest.mark.parametrize(("supply", "duty"), [(24.0, 128), (48.0, 64), (0.0, 256)])
def test_a_motor_gets_its_own_voltage_from_a_higher_supply(make_rig: MakeRig, supply: float, duty: int) -> None:
    """12 V at most, as duty of what the supply gives."""
    full = supply or 12.0
    model = Parameters({"kv": PAPER_KV, "ka": PAPER_KA}, max_voltage=full)
    rig = make_rig(config=Config(supply_voltage=supply), parameters=model)
    rig.plug()
    rig.voltage = 100.0
    rig.until(lambda: rig.pins > 0.0, 500)
    rig.run(50)
    assert rig.driver.session and rig.driver.session.latest
    assert (rig.driver.session.latest.duty, rig.pins, rig.readings[-1].sample.voltage) == (duty, 12.0, 12.0)
    assert rig.driver.info.max_voltage == 12.0


def test_a_supply_below_the_motors_voltage_is_all_there_is(make_rig: MakeRig) -> None:
    rig = make_rig(config=Config(supply_voltage=9.0), parameters=replace(paper_motor(), max_voltage=9.0))
    rig.plug()
    rig.voltage = 12.0
    rig.until(lambda: rig.pins == 9.0, 500)
    rig.run(50)
    assert (rig.readings[-1].sample.voltage, rig.driver.info.max_voltage) == (9.0, 9.0)


@pytest.mark.parametrize(
    ("told", "words"), [(0.0, ""), (24.0, ""), (12.0, "a supply of 24.0 V, and supply_voltage is 12")]
)
def test_a_measured_supply_prevails(make_rig: MakeRig, told: float, words: str) -> None:
    """A 12 V motor on 24 V gets 12 V, even where the parameter is wrong."""
    board = FirmwareConfig(edges_per_revolution=96, supply_full_scale=40_000)
    motor = replace(paper_motor(), max_voltage=24.0)
    rig = make_rig(config=Config(supply_voltage=told), firmware=board, parameters=motor)
    rig.emulator.chip.supply(3.0)  # of 5 V, for 40 V
    rig.plug()
    rig.voltage = 12.0
    rig.until(lambda: rig.pins > 0.0, 500)
    rig.run(500)
    assert rig.pins == pytest.approx(12.0, abs=0.1)
    assert rig.readings[-1].sample.voltage == pytest.approx(12.0, abs=0.1)
    assert (words in problem(rig)) if words else problem(rig) == ""
    rig.emulator.chip.supply(0.1)  # switched off: nothing to divide by
    rig.run(200)
    assert rig.readings[-1].sample.voltage == pytest.approx(12.0, abs=0.1)
