"""The shell that both plants share: what motor/enable answers, and joint states that are the angle."""

import time
from dataclasses import replace
from math import nan
from types import SimpleNamespace

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from std_srvs.srv import SetBool
from workbench import Bench

from motor_model.sample import Info, Sample
from motor_msgs.msg import MotorInfo, MotorVoltage
from motor_ros import qos
from motor_ros.clocks.hold_ups import STOOD_STILL, HoldUps
from motor_ros.gate import Gate
from motor_ros.graph.acquaintances import Verdict
from motor_ros.messages import info_message, time_message
from motor_ros.plant import STAYS, Plant


def asked(plant: Plant, on: bool) -> tuple[bool, str]:
    response = plant._on_enable(SetBool.Request(data=on), SetBool.Response())
    return response.success, response.message


def test_a_stop_that_is_due_comes_before_an_enable(bench: Bench) -> None:
    """The board has just said that it was reset, and nobody has looked yet: the output is not said to be on."""
    pending = ["the board was reset (watchdog)"]

    def work() -> None:
        if pending:
            plant.stop(pending.pop())

    plant = Plant(bench.node, Info(), Gate(True, 0.1), changed=work)
    assert asked(plant, True) == (
        False,
        "The output stays off. Just now, the board was reset (watchdog): look, then call again.",
    )
    assert not plant.gate.enabled
    assert asked(plant, True) == (True, "The output is on.") and plant.gate.enabled
    assert asked(plant, False) == (True, "The output is off: call motor/enable with data: true.")


@pytest.mark.parametrize(("timeout", "warned"), [(0.1, False), (0.5, False), (10.0, True)])
def test_a_plant_warns_of_a_voltage_that_outlives_its_sender(
    bench: Bench, capfd: pytest.CaptureFixture[str], timeout: float, warned: bool
) -> None:
    Plant(bench.node, Info(), Gate(True, timeout))
    assert ("command_timeout is 10 s: once who sends" in capfd.readouterr().err) is warned


def test_what_keeps_the_output_off_is_said(bench: Bench) -> None:
    plant = Plant(bench.node, Info(), Gate(True, 0.1), refusal=lambda: "There is no link to the board yet.")
    why = "There is no link to the board yet."
    assert asked(plant, True) == (False, f"The output is on, and the motor stays at 0 V. {why}")
    assert asked(plant, False)[0]
    assert asked(plant, True) == (False, f"The output stays off. {why}")


def test_what_was_called_while_the_plant_stood_still_switches_nothing_on(bench: Bench) -> None:
    """Its user had switched the motor off; 80 ms after the plant went on it ran, at a voltage that was still sent."""
    now = [100.0]
    plant = Plant(bench.node, Info(), Gate(True, 0.1))
    plant._hold_ups = HoldUps(bench.node, lambda: now[0])
    assert not plant._hold_ups.in_doubt() and asked(plant, True)[0]  # it runs
    assert asked(plant, False)[0]
    now[0] += 5.0
    assert asked(plant, True) == (False, f"The output stays off. {STOOD_STILL}") and not plant.gate.enabled
    assert asked(plant, False)[0]  # whenever that was
    for _ in range(4):
        assert not asked(plant, True)[0]
        now[0] += 0.9
        plant._hold_ups.in_doubt()  # it looks
    assert asked(plant, True)[0] and plant.gate.enabled


@pytest.mark.parametrize(("waited", "volts"), [(True, 0.0), (False, 6.0)])
def test_a_voltage_from_before_a_switch_does_not_act_after_it(
    bench: Bench, monkeypatch: pytest.MonkeyPatch, waited: bool, volts: float
) -> None:
    """It waits for its sender to be known, for up to 2 s, and is fresh where command_timeout is as long."""
    plant = Plant(bench.node, Info(), Gate(True, 10.0))
    verdict = [Verdict.WAITS]
    monkeypatch.setattr(plant._commanders, "judge", lambda at: verdict[0])
    stamps = {"received_timestamp": 0, "source_timestamp": 0}
    heard = MotorVoltage(voltage=6.0), {"publication_sequence_number": 1, **stamps}
    if waited:
        plant._input._on_message(*heard)
    assert asked(plant, False)[0] and asked(plant, True)[0]
    if not waited:
        plant._input._on_message(*heard)
    verdict[0] = Verdict.OBEYED
    assert plant.voltage() == volts


@pytest.mark.parametrize(("sent", "volts"), [("before", 0.0), ("between", 0.0), ("after", 6.0)])
def test_a_voltage_that_was_on_its_way_when_the_motor_was_switched_does_not_act(
    bench: Bench, sent: str, volts: float
) -> None:
    """Switched off and on at once, a motor ran on at the voltage that came after that: in 29 of 31 tries."""
    plant = Plant(bench.node, Info(), Gate(True, 10.0))
    plant._input._commanders = None  # it is known who sends
    stamps = {"before": time.time_ns()}
    assert asked(plant, False)[0]
    stamps["between"] = time.time_ns()
    assert asked(plant, True)[0]
    stamps["after"] = time.time_ns()
    about = {"received_timestamp": time.time_ns(), "source_timestamp": stamps[sent], "publication_sequence_number": 7}
    plant._input._on_message(MotorVoltage(voltage=6.0), about)
    now = time.monotonic_ns()
    assert plant.gate.voltage(now) == volts
    about |= {"source_timestamp": time.time_ns(), "publication_sequence_number": 8}
    plant._input._on_message(MotorVoltage(voltage=5.0), about)
    assert plant.gate.voltage(now) == 5.0  # its sender goes on, and is the same


def test_nobody_switches_on_while_two_senders_cannot_be_told_apart(bench: Bench) -> None:
    """The answer was "The output is on", and the motor got 0 V."""
    plant = Plant(bench.node, Info(), Gate(True, 0.1))
    now = time.monotonic_ns()
    for number in (1, 1, 2):  # of two under one frame_id
        plant.gate = plant.gate.take(6.0, now, "one", number)
    success, said = asked(plant, True)
    assert not success and said.startswith(f"{STAYS[True]} More than one node sends motor/voltage")
    assert asked(plant, False)[0]
    plant.gate = replace(plant.gate, rival_until=now)
    assert asked(plant, True)[0]


def test_a_motor_that_stops_again_and_again_is_switched_on_later_and_later(bench: Bench) -> None:
    """A supervisor that answered every stop got the motor each time."""
    plant = Plant(bench.node, Info(), Gate(True, 0.1))
    plant.stop("no edges at 12.0 V", motor=True)
    plant.stop("no edges at 12.0 V", motor=True)  # said until the board is off: one stop
    assert asked(plant, True)[0]
    plant.stop("no edges at 12.0 V", motor=True)
    for on in (True, False, True):  # to switch it off first is no way round
        success, said = asked(plant, on)
        assert success is not on and not plant.gate.enabled
    assert said == (
        "The output stays off. It has stopped 2 times, each within a minute of the one before: see to the cause, and "
        "wait 1 s."
    )
    plant.gate = replace(plant.gate, faults=replace(plant.gate.faults, latest=plant.gate.faults.latest - 1.01))
    assert asked(plant, True) == (True, "The output is on.")


def test_a_link_that_comes_and_goes_heats_no_motor(bench: Bench) -> None:
    plant = Plant(bench.node, Info(), Gate(True, 0.1))
    for _ in range(5):
        plant.stop("the link to the board was lost")
        assert asked(plant, True) == (True, "The output is on.")


@pytest.mark.parametrize(("later", "volts"), [(100_000_000, 6.0), (100_000_001, 0.0)])
def test_a_plant_that_catches_up_holds_a_voltage_for_no_longer_than_its_timeout(
    bench: Bench, later: int, volts: float
) -> None:
    """Held up for 0.4 s, a simulation gave its motor the voltage from before for all that time, at once."""
    plant, now = Plant(bench.node, Info(), Gate(True, 0.1)), time.monotonic_ns()
    plant.gate = plant.gate.take(0.0, now).take(6.0, now)
    assert plant.voltage(now + later) == volts


@pytest.mark.parametrize(("single", "angle"), [(False, 1.0), (True, 5.0)])
def test_joint_states_are_the_angle_that_was_counted(bench: Bench, single: bool, angle: float) -> None:
    """Three slots on, two back: two channels count down, and one knows the direction by the speed's sign alone."""
    plant = Plant(bench.node, Info(single_channel=single, edges_per_revolution=4), Gate(True, 0.1))
    joints: list[JointState] = []
    plant._joint = SimpleNamespace(publish=joints.append, get_subscription_count=lambda: 1)
    down = -1 if not single else 1
    for count, speed in ((3, 5.0), (3 + 2 * down, 5.0)):
        plant.publish(Sample(0, speed, 0.0, edge_count=count), time_message(0))
    assert joints[-1].position[0] == pytest.approx(angle * 6.283185307 / 4)


def test_a_plant_says_again_what_it_is_while_another_says_it_too(bench: Bench) -> None:
    """A recording that is played with its motor/info: a controller would go on with another motor's disc and limits."""
    plant, heard = Plant(bench.node, Info(), Gate(True, 0.1)), bench.hear(MotorInfo, "motor/info", qos.INFO)
    bench.wait(lambda: len(heard) == 1, "what it says at its start")
    for _ in range(3):
        plant.diagnose("", {})
    bench.executor.spin_once(timeout_sec=0.2)
    assert len(heard) == 1
    stranger = bench.publisher(MotorInfo, "motor/info", qos.INFO)
    stranger.publish(info_message(Info(edges_per_revolution=12, max_voltage=48.0), time_message(0)))
    bench.wait(lambda: heard[-1].edges_per_revolution == 12, "the other one")

    def said_again() -> bool:
        plant.diagnose("", {})
        return bool(heard[-1].edges_per_revolution == 96)

    bench.wait(said_again, "what it says after the other one")
    assert heard[-1].max_voltage == 12.0


def test_a_voltage_is_acted_on_when_it_comes_and_not_with_the_next_sample(bench: Bench) -> None:
    """The board takes it with its next tick: told of it at the next sample, it would be late by one."""
    applied: list[float] = []
    plant = Plant(bench.node, Info(), Gate(True, 10.0), changed=lambda: applied.append(plant.voltage()))
    sender = bench.publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)

    def sent(volt: float) -> bool:
        sender.publish(MotorVoltage(voltage=volt))
        bench.executor.spin_once(timeout_sec=0.02)
        return applied[-1:] == [volt]

    bench.wait(lambda: sent(0.0), "0 V")
    bench.wait(lambda: sent(3.0), "3 V")
    assert plant.gate.begun


def test_references_that_nobody_hears_are_said(bench: Bench) -> None:
    """A controller that was started in another namespace hears none, and says nothing of them."""
    plant, told = Plant(bench.node, Info(), Gate(True, 0.1)), bench.hear(DiagnosticArray, "/diagnostics")
    said = "References are published on /motor/reference and nobody hears them: start motor_control in this namespace."

    def says(wanted: bool) -> bool:
        plant.diagnose("", {})
        return bool(told) and (said in told[-1].status[0].message) == wanted

    bench.wait(lambda: says(False), "a diagnostic")
    bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    bench.wait(lambda: says(True), "the sentence")
    bench.hear(Float64, "motor/reference", qos.REFERENCE)
    bench.wait(lambda: says(False), "its end")


def test_a_voltage_that_is_not_a_number_is_a_warning_that_names_its_sender(bench: Bench) -> None:
    plant, told = Plant(bench.node, Info(), Gate(True, 0.1)), bench.hear(DiagnosticArray, "/diagnostics")
    hand = bench.publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
    message = MotorVoltage(voltage=nan)
    message.header.frame_id = "hand"

    def says() -> bool:
        hand.publish(message)
        assert plant.voltage() == 0.0
        plant.diagnose("", {})
        return bool(told) and told[-1].status[0].level == DiagnosticStatus.WARN

    bench.wait(says, "a warning")
    node = bench.node.get_fully_qualified_name()
    said = f"nan on motor/voltage is not a number (frame_id 'hand'; {node}): the motor gets 0 V until the next number"
    assert told[-1].status[0].message.startswith(said)


def test_a_stranger_s_frame_id_neither_steers_a_terminal_nor_forges_a_line(bench: Bench) -> None:
    """It was in the log and in /diagnostics as it came."""
    plant, told = Plant(bench.node, Info(), Gate(True, 0.1)), bench.hear(DiagnosticArray, "/diagnostics")
    stranger = bench.publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
    message = MotorVoltage(voltage=nan)
    message.header.frame_id = "\x1b[2J\n[INFO] all is well" + 100 * "x"

    def says() -> str:
        stranger.publish(message)
        assert plant.voltage() == 0.0
        plant.diagnose("", {})
        return told[-1].status[0].message if told else ""

    bench.wait(lambda: "is not a number" in says(), "a warning")
    shown = "\\x1b[2J\\n[INFO] all is well" + 100 * "x"
    assert f"(frame_id '{shown[:79]}…';" in says() and says().isprintable()


def test_a_best_effort_publisher_of_voltages_is_a_warning(bench: Bench) -> None:
    plant, told = Plant(bench.node, Info(), Gate(True, 0.1)), bench.hear(DiagnosticArray, "/diagnostics")
    bench.publisher(MotorVoltage, "motor/voltage", qos_profile_sensor_data)

    def says() -> bool:
        plant.diagnose("", {})
        return bool(told) and told[-1].status[0].level == DiagnosticStatus.WARN

    bench.wait(says, "a warning")
    assert "sends on /motor/voltage is not heard, nor would a 0 be" in told[-1].status[0].message
