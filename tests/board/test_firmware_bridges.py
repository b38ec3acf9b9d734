"""What the firmware's pins do for bridges without an enable, and with PWM above hearing."""

from collections.abc import Callable

import pytest
from emulated_board import Bench, on_each_chip, on_the_larger_chip_slowly

from motor_board.build import FirmwareConfig
from motor_driver.frames.from_board import Features, Hello, Telemetry
from motor_driver.frames.from_host import Configure, Enable, Setup

MakeBench = Callable[..., Bench]


@on_the_larger_chip_slowly
@pytest.mark.parametrize("decay", [0, 1], ids=["brake", "coast"])
def test_a_bridge_without_an_enable_brakes_and_coasts_by_its_inputs(make_bench: MakeBench, decay: int) -> None:
    """To brake both inputs are high in the off part, and at 0 V; to coast both are low."""
    bench = make_bench(config=FirmwareConfig("drv8871"))
    bench.start(2_000, decay=decay)
    for duty in (256, 100, 1, 0, -1, -100, -256, 0):
        bench.drive(duty, 4, 1)
        pins, rest = bench.chip.pins, 0 if decay else 256
        assert pins.share == duty / 256 and pins.enable == 256
        assert (pins.forward, pins.reverse) == (
            (max(duty, 0), max(-duty, 0)) if decay else (256 - max(-duty, 0), 256 - max(duty, 0))
        )
        assert duty or (pins.forward, pins.reverse) == (rest, rest)


@on_each_chip
@pytest.mark.parametrize("silent", [0, 1], ids=["standard", "silent"])
@pytest.mark.parametrize("decay", [0, 1], ids=["brake", "coast"])
@pytest.mark.parametrize("bridge", ["l298n", "tb6612", "drv8871"])
def test_0_volt_does_not_hang_on_the_enable_alone(make_bench: MakeBench, bridge: str, decay: int, silent: int) -> None:
    """From boot on, configured, on, after either direction, switched off, timed out: an enable that is tied high, as by
    a jumper that was left on, drove the motor with the whole supply, whether or not anything was switched on."""
    bench = make_bench(config=FirmwareConfig(bridge))

    def alike() -> bool:
        pins = bench.chip.pins
        return pins.forward == pins.reverse and pins.forward in (0, 256)

    bench.run(1)
    assert alike()
    bench.start(2_000, decay=decay)
    assert alike()
    bench.send(Setup(1, silent), Configure(2_000, 100, decay))
    bench.run(8)
    assert alike() and not bench.last(Telemetry).enabled
    bench.enable()
    assert alike()
    for duty in (40, -40):
        bench.drive(duty, 4, 1)
        assert bench.chip.pins.share * duty > 0
        bench.drive(0, 4, 1)
        assert alike() and bench.last(Telemetry).duty == 0
    bench.drive(-40, 4, 1)
    bench.send(Enable(0))
    bench.run(4)
    assert alike() and not bench.last(Telemetry).enabled
    bench.enable()
    bench.drive(40, 4, 1)
    bench.run(130)
    assert alike() and not bench.last(Telemetry).enabled


@on_the_larger_chip_slowly
@pytest.mark.parametrize(
    ("bridge", "decay", "top"),
    [("l298n", 1, 100), ("l298n", 0, 256), ("tb6612", 0, 100), ("tb6612", 1, 256), ("drv8871", 0, 256)],
)
def test_silent_pwm_has_so_many_steps(make_bench: MakeBench, bridge: str, decay: int, top: int) -> None:
    """Every step is one of its own, up to all; an L298N, too slow for it on its inputs, is driven as before there."""
    bench = make_bench(config=FirmwareConfig(bridge))
    bench.start(2_000, decay=decay)
    bench.send(Setup(1, 1))
    bench.run(4)
    assert bench.last(Features) == Features(1, 1, {"l298n": 2, "tb6612": 3, "drv8871": 3}[bridge])
    bench.send(Configure(2_000, 100, decay))
    bench.run(6)
    assert bench.last(Hello).pwm_top == top and bench.last(Telemetry).duty == 0
    bench.enable()
    for duty in (1, 2, top // 2, top - 1, top, -top, -1):
        bench.drive(duty, 3, 1)
        assert bench.chip.pins.share == pytest.approx(duty / top, abs=0.51 / 256)
