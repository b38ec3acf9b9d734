"""A gearmotor with both channels on the emulated board, with the real driver: speeds and angles of the output."""

from collections.abc import Callable
from fractions import Fraction
from math import tau

import numpy as np
import pytest
from driver_rig import Rig
from tiers import keep_fast

from motor_board.build import FirmwareConfig
from motor_board.emulation.shaft import EncoderConfig
from motor_driver import status
from motor_driver.config import Config
from motor_driver.frames.codes import Decay, Pwm
from motor_model.parameters import Parameters
from motor_model.sensing.encoder import Lines

GEAR = Fraction("34.014")
MOTOR = Parameters({"kv": 0.9, "ka": 0.05, "ks": 0.7}, ("coulomb_friction",))  # of the output: 12.5 rad/s at 12 V
ENCODER = EncoderConfig(11, 0.02, 3, lines=Lines(0.44, 0.21), gear=GEAR)
TWO = FirmwareConfig(channels=2, edges_per_revolution=11)


@pytest.mark.parametrize("quadrature", keep_fast([1, 2, 4], 4))
def test_speed_and_count_are_of_the_output(make_rig: Callable[..., Rig], quadrature: int) -> None:
    """Forward, backward, and at rest: the count is the angle within a count, the speed that of the output."""
    config = Config(edges_per_revolution=11 * quadrature, single_channel=False, quadrature=quadrature, gear=GEAR)
    rig = make_rig(config=config, parameters=MOTOR, firmware=TWO, encoder=ENCODER)
    rig.plug()
    rig.voltage = 6.0
    rig.run(700)
    errors = [reading.sample.speed / rig.emulator.shaft.speed - 1.0 for reading in rig.readings[-20:]]
    assert abs(np.mean(errors)) < 0.01 and np.max(np.abs(errors)) < (0.03 if quadrature > 1 else 0.1)
    rig.voltage = -6.0
    rig.run(1_500)
    assert rig.readings[-1].sample.speed == pytest.approx(rig.emulator.shaft.speed, rel=0.1) and rig.stops == []
    rig.voltage = 0.0
    rig.run(400)
    slot = tau / 11 / quadrature / float(GEAR)
    counted = rig.readings[-1].sample.edge_count * slot
    assert counted < -1.0 and abs(counted - rig.emulator.shaft.angle) < 1.6 * slot
    assert rig.driver.info.edge_angle == pytest.approx(slot) and rig.driver.encoder_errors == 0
    assert status.values(rig.driver, status.Tally(), rig.now)["encoder errors"] == "0"


def test_pwm_above_hearing_drives_as_well_in_coarser_steps(make_rig: Callable[..., Rig]) -> None:
    rig = make_rig(config=Config(decay=Decay.COAST, pwm=Pwm.SILENT))
    rig.plug()
    rig.voltage = 5.03
    rig.run(300)
    assert rig.pins == pytest.approx(12.0 * 42 / 100, abs=0.025)  # the emulator's pins are in 1/256
    assert rig.readings[-1].sample.voltage == pytest.approx(12.0 * 42 / 100)


@pytest.mark.parametrize(
    ("config", "firmware", "sentence"),
    [
        (Config(pwm=Pwm.SILENT), FirmwareConfig(), "no PWM above hearing with decay brake: set decay to coast"),
        (
            Config(edges_per_revolution=44, quadrature=4, single_channel=False),
            FirmwareConfig(),
            "flashed for one encoder channel: flash it again (ros2 run motor_board flash --channels 2)",
        ),
        (
            Config(edges_per_revolution=44, quadrature=4, single_channel=False),
            FirmwareConfig(channels=2, edges_per_revolution=12),
            "flashed for an encoder with 12 edges per revolution, and the parameter pulses_per_revolution is 11",
        ),
    ],
)
def test_a_board_that_cannot_is_refused_with_a_sentence(
    make_rig: Callable[..., Rig], config: Config, firmware: FirmwareConfig, sentence: str
) -> None:
    rig = make_rig(config=config, firmware=firmware)
    rig.plug()
    rig.run(60)
    assert sentence in status.problem(rig.driver, status.Tally(), rig.now) and not rig.driver.runs
