"""The parameter file is what the driver takes; the JSON holds all that was found."""

import json
from fractions import Fraction

import pytest
import yaml
from first_run_bench import SimulatedRun, motor

from motor_board.emulation.wiring import Wiring
from motor_driver.check.result import Chosen, as_json, parameter_text, refused_json
from motor_driver.check.settings import Settings
from motor_driver.frames.codes import Pwm
from motor_driver.parameters import ROWS, config_of

TOLD = Settings(max_voltage=9.0, supply_voltage=12.0, edges_per_revolution=96)


def test_the_file_has_parameters_of_the_driver_with_the_cures() -> None:
    wiring = Wiring(motor_swapped=True, channels_swapped=True)
    check = SimulatedRun(TOLD, channels=2, wiring=wiring).run()
    text = parameter_text(check, Chosen("/dev/ttyUSB0", "left: wheel", "coast"))
    values = yaml.safe_load(text)["/**/motor_driver"]["ros__parameters"]
    config = config_of({row.name: row.default for row in ROWS} | values)
    assert (config.name, config.max_voltage, config.supply_voltage) == ("left: wheel", 9.0, 12.0)
    assert config.reverse_motor and config.reverse_encoder and not config.single_channel
    assert values["port"] == "/dev/ttyUSB0" and values["decay"] == "coast"


def test_a_geared_encoder_that_is_counted_fourfold_is_written_as_it_was_said() -> None:
    said = Settings(edges_per_revolution=11, quadrature=4, gear=Fraction("34.014"), gear_said="34.014")
    check = SimulatedRun(said, motor(12.0, 12.0, 0.1), channels=2, edges=11, gear=34.014).run()
    assert check.record.codes == [] and check.record.measured.top_speed == pytest.approx(12.0, rel=0.04)
    text = parameter_text(check, Chosen("p", decay="coast", silent_pwm=True))
    values = yaml.safe_load(text)["/**/motor_driver"]["ros__parameters"]
    config = config_of({row.name: row.default for row in ROWS} | values)
    assert (config.edges_per_revolution, config.quadrature, config.gear) == (44, 4, Fraction("34.014"))
    assert values["gear_ratio"] == "34.014" and values["pulses_per_revolution"] == 11
    assert config.pwm is Pwm.SILENT and not config.single_channel


@pytest.mark.parametrize(("told", "written", "warned"), [(0.0, 0.0, True), (9.0, 9.0, False)])
def test_a_supply_that_nobody_measured_or_said_is_not_written_as_known(
    told: float, written: float, warned: bool
) -> None:
    """Else the driver would take it for said, and would not warn of a larger one."""
    check = SimulatedRun(Settings(max_voltage=9.0, supply_voltage=told, edges_per_revolution=96)).run()
    values = yaml.safe_load(parameter_text(check, Chosen("p")))["/**/motor_driver"]["ros__parameters"]
    assert values["supply_voltage"] == written
    lines = [str(line) for line in check.record.rows if "9 V are believed" in str(line)]
    assert len(lines) == 1 and ("say --supply-voltage" in lines[0]) == warned


def test_a_board_with_a_number_is_found_by_it_whatever_its_port() -> None:
    run = SimulatedRun(TOLD)
    run.run()
    object.__setattr__(run.check.board, "board_id", 7)
    values = yaml.safe_load(parameter_text(run.check, Chosen("/dev/ttyUSB0", "motor")))
    values = values["/**/motor_driver"]["ros__parameters"]
    assert values["board_id"] == "7" and "port" not in values
    assert config_of({row.name: row.default for row in ROWS} | values).board_id == 7


def test_the_json_has_no_parameters_where_something_is_wrong_and_null_where_there_is_no_number() -> None:
    right = json.loads(json.dumps(as_json(SimulatedRun(TOLD).run(), Chosen("p")), allow_nan=False))
    assert right["right"] and right["parameters"]["edges_per_revolution"] == 96
    assert right["measured"]["supply"] is None and 10.0 < right["measured"]["gain"] < 20.0
    wrong = as_json(SimulatedRun(TOLD, channels=2, wiring=Wiring(b_connected=False)).run(), Chosen("p"))
    assert not wrong["right"] and wrong["parameters"] is None
    assert [found["code"] for found in wrong["findings"]] == ["b_missing"]


def test_a_board_that_cannot_be_checked_has_its_sentence() -> None:
    refused = refused_json(Settings(board_id=9), "p", "wrong_board", "This is another board.")
    assert refused["findings"][0]["code"] == "wrong_board" and not refused["right"]
