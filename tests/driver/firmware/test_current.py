"""The motor's current switches the real firmware off; the driver sets the limits, and says why."""

from dataclasses import replace

import pytest
from driver_rig import MakeRig, problem
from electrical import ELECTRIC, LUMPED

from motor_board.build import FirmwareConfig
from motor_board.emulation.wiring import Wiring
from motor_driver.config import Config
from motor_driver.current_limits import CurrentLimits
from motor_model.parameters import Parameters

SENSING = FirmwareConfig(edges_per_revolution=96, current_sense=True)
MOTOR = Parameters(LUMPED, ("coulomb_friction",), **ELECTRIC)
LIMITED = Config(current_gain=0.185, current_limits=CurrentLimits(4.0, 2.0, 0.2))


@pytest.mark.parametrize(("volts", "stops"), [(11.0, True), (4.0, False)])
def test_a_blocked_motor_is_off_before_anything_else_notices(make_rig: MakeRig, volts: float, stops: bool) -> None:
    """2.3 ohm: 4.8 A and 1.7 A."""
    rig = make_rig(config=LIMITED, parameters=MOTOR, firmware=SENSING)
    rig.emulator.wiring = Wiring(shaft_stuck=True)
    rig.plug()
    rig.voltage = volts
    rig.until(lambda: rig.pins > 0.9 * volts, 500)
    rig.run(100)
    assert (rig.pins == 0.0) == stops
    assert ("current was above current_limit" in " ".join(rig.stops)) == stops
    if stops:
        assert rig.enable() == ""
        rig.until(lambda: rig.pins > 0.9 * volts, 200)
        rig.run(100)  # as a stop for what the motor did it counts
        assert rig.pins == 0.0 and "It has stopped 2 times" in rig.enable()


def test_a_driver_without_limits_takes_those_of_the_one_before_away(make_rig: MakeRig) -> None:
    rig = make_rig(config=LIMITED, parameters=MOTOR, firmware=SENSING)
    rig.emulator.wiring = Wiring(shaft_stuck=True)
    other = make_rig(config=replace(LIMITED, current_limits=CurrentLimits()), emulator=rig.emulator)
    for one, off in ((rig, True), (other, False)):
        one.plug()
        one.voltage = 11.0
        one.until(lambda: rig.pins > 10.0, 500)
        one.run(100)
        assert (rig.pins == 0.0) == off
        one.unplug()


def test_a_board_without_a_sensor_is_refused(make_rig: MakeRig) -> None:
    rig = make_rig(config=LIMITED, parameters=MOTOR)
    rig.plug()
    rig.run(600)
    assert "does not sense the motor's current, and current_limit is 4 A: flash it with a sensor" in problem(rig)
    assert rig.readings == [] and rig.pins == 0.0
