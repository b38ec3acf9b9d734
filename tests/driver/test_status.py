"""The driver's state as a diagnostic: the most important sentence, and the link's numbers."""

from collections.abc import Callable

import pytest
from driver_rig import Rig

from motor_board.build import FirmwareConfig
from motor_driver import status
from motor_driver.config import Config

MakeRig = Callable[..., Rig]


def test_a_running_board_is_fine_and_its_numbers_are_told(running: Rig) -> None:
    was = status.tally(running.driver, running.now)
    running.run(500)
    assert status.problem(running.driver, was, running.now) == ""
    assert status.achieved(running.driver, was, running.now) == pytest.approx(200.0, rel=0.02)
    values = status.values(running.driver, was, running.now)
    assert (values["port"], values["output"], values["ports opened"], values["board resets"]) == (
        "the port",
        "on",
        "1",
        "0",
    )
    assert values["requested rate [Hz]"] == "200.0" and abs(float(values["achieved rate [Hz]"]) - 200.0) < 4.0
    assert abs(float(values["clock drift [ppm]"])) < 1000.0 and 0.0 < float(values["round trip [ms]"]) < 20.0
    connected = status.connection(running.driver)
    assert connected.startswith("Connected to the port: firmware ") and "96 edges per revolution, 12 V." in connected


def test_without_a_port_its_trouble_is_told(make_rig: MakeRig) -> None:
    rig = make_rig()
    assert status.connection(rig.driver) == ""
    rig.plug()
    rig.unplug()
    assert status.problem(rig.driver, status.tally(rig.driver, rig.now), rig.now) == rig.driver.trouble != ""
    assert status.values(rig.driver, status.tally(rig.driver, rig.now), rig.now)["port"] == "none"


def test_too_few_samples_are_told_where_the_board_ran_all_the_time(running: Rig) -> None:
    was = status.tally(running.driver, running.now)
    running.run(500)
    enough = running.now + 20_000_000  # 100 samples in 520 ms: 4 % too few
    assert status.problem(running.driver, was, enough) == ""
    late = running.now + 50_000_000  # in 550 ms: 9 %
    assert status.problem(running.driver, was, late).startswith("Only 18")
    reopened = status.Tally(was.at, was.readings, was.link, True, was.openings - 1)
    assert status.problem(running.driver, reopened, late) == ""


def test_damaged_frames_are_counted(running: Rig) -> None:
    was = status.tally(running.driver, running.now)
    running.driver.received(b"\x05abcd\x00\x05abcd\x00", running.now)
    running.run(500)
    assert status.problem(running.driver, was, running.now).startswith("2 damaged and 0 lost frames")


@pytest.mark.parametrize(("told", "complains"), [(0.0, False), (13.0, False), (14.0, True), (26.0, True)])
def test_a_supply_that_is_not_the_one_named(make_rig: MakeRig, told: float, complains: bool) -> None:
    """The board measures 12 V: 13 V are within a tenth of that, 14 V are not."""
    board = FirmwareConfig(edges_per_revolution=96, channels=2, supply_full_scale=20_000)
    rig = make_rig(config=Config(supply_voltage=told, single_channel=False), firmware=board)
    rig.emulator.chip.supply(3.0)  # of 5 V, for 20 V
    rig.plug()
    rig.until(lambda: len(rig.readings) > 100, 1500)
    was = status.tally(rig.driver, rig.now)
    rig.run(200)
    said = status.problem(rig.driver, was, rig.now)
    measured = "12.0 V" if told < 24.0 else "13.0 V or less"
    assert (f"The board measures a supply of {measured}, and supply_voltage is {told:g} V" in said) == complains
    assert ("See whether the divider at A0 is connected" in said) == (told > 24.0)
    assert complains or said == ""


def test_a_supply_that_falls_to_less_than_half_of_what_it_was(make_rig: MakeRig) -> None:
    board = FirmwareConfig(edges_per_revolution=96, channels=2, supply_full_scale=20_000)
    rig = make_rig(config=Config(single_channel=False), firmware=board)
    rig.emulator.chip.supply(3.0)  # of 5 V, for 20 V
    rig.plug()
    rig.until(lambda: len(rig.readings) > 400, 3000)
    rig.emulator.chip.supply(0.9)
    was = status.tally(rig.driver, rig.now)
    rig.run(100)
    said = status.problem(rig.driver, was, rig.now)
    assert (
        "supply of less than 5.9 V, and it was 11.8 V" in said and "See whether the divider at A0 is connected" in said
    )


@pytest.mark.parametrize(
    ("most", "told", "assumed", "risky"),
    [(3.0, 0.0, True, True), (24.0, 0.0, True, False), (12.0, 0.0, False, False), (3.0, 12.0, False, False)],
)
def test_who_sets_max_voltage_is_told_that_the_supply_is_only_assumed(
    make_rig: MakeRig, most: float, told: float, assumed: bool, risky: bool
) -> None:
    """3 V asked for under a limit of 3 V were 12 V on a supply of 12 V that nobody measured or said."""
    rig = make_rig(config=Config(max_voltage=most, supply_voltage=told))
    assert status.assumption(rig.driver) == ""  # nobody knows yet whether the board measures
    rig.plug()
    rig.until(lambda: len(rig.readings) > 0, 1500)
    said = f"Full duty is taken for the {most:g} V of max_voltage" if assumed else ""
    assert status.assumption(rig.driver).startswith(said) and bool(status.assumption(rig.driver)) == assumed
    assert status.risk(rig.driver) == (status.assumption(rig.driver) if risky else "")
    assert (
        f"set supply_voltage to the supply's voltage ({most:g} if that is it)" in status.assumption(rig.driver)
    ) == assumed
    values = status.values(rig.driver, status.tally(rig.driver, rig.now), rig.now)
    source = "supply_voltage" if told else "max_voltage, as nobody says or measures the supply"
    assert values["voltage at full duty from"] == source


@pytest.mark.parametrize(("told", "warned"), [(1.2, True), (5.9, True), (6.0, False), (24.0, False)])
def test_a_supply_that_is_said_to_be_low_and_not_measured_is_warned_of(
    make_rig: MakeRig, told: float, warned: bool
) -> None:
    """1.2 for 12: 1 V asked for was 10 V at the motor, and nobody said so."""
    rig = make_rig(config=Config(supply_voltage=told))
    rig.plug()
    rig.until(lambda: len(rig.readings) > 0, 1500)
    said = f"supply_voltage is {told:g} V, less than half of the 12 V of max_voltage, and the board measures no supply"
    assert status.assumption(rig.driver).startswith(said) is warned
    assert status.risk(rig.driver) == status.assumption(rig.driver) and bool(status.risk(rig.driver)) is warned


def test_a_supply_that_is_measured_is_not_assumed(make_rig: MakeRig) -> None:
    """Nor while it is off, and too low to be taken for one."""
    board = FirmwareConfig(edges_per_revolution=96, channels=2, supply_full_scale=20_000)
    rig = make_rig(config=Config(max_voltage=3.0, single_channel=False), firmware=board)
    rig.emulator.chip.supply(0.0)
    rig.plug()
    rig.until(lambda: len(rig.readings) > 10, 1500)
    assert status.assumption(rig.driver) == ""
    rig.emulator.chip.supply(3.0)  # of 5 V, for 20 V
    rig.until(lambda: len(rig.readings) > 100, 1500)
    assert status.assumption(rig.driver) == "" and rig.driver.supply == pytest.approx(12.0, rel=0.01)
    values = status.values(rig.driver, status.tally(rig.driver, rig.now), rig.now)
    assert values["voltage at full duty from"] == "the board's measurement"
