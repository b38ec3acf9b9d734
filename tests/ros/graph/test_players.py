"""What is played from a recording moves no motor, whatever its player is called, nor before anybody knows that."""

import time
from collections.abc import Callable
from subprocess import Popen

import pytest
import rclpy
from bag_player import play
from plant_rig import Rig
from rcl_interfaces.srv import SetParameters
from std_srvs.srv import SetBool, Trigger
from workbench import Bench

from motor_msgs.msg import ControlState, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.graph.players import find_players_among, is_player
from motor_ros.graph.publishers import UNKNOWN, Publisher, list_clients
from motor_ros.messages import time_message, voltage_message

Start = Callable[..., "Popen[str]"]
DAY = 86_400_000_000_000  # [ns]


@pytest.mark.parametrize(
    "name",
    ["bag_player", "rosbag_player", "RosbagReplayer", "simple_bag_play_node", "playback_node", "PlaybackNode"]
    + ["playback_node_1", "play_bag", "replay_bag", "play_rosbag", "rosbag_playback", "bag_player2"],
)
def test_players_of_other_programs_are_known_by_their_names(name: str) -> None:
    """A speed that one of them sent last was held for ever, as a hand's is."""
    assert is_player(name)


@pytest.mark.parametrize(
    "name",
    ["play", "experiment", "rqt_gui_py_node_123", "teleop", "airbag", "player", "rosbag2_recorder"]
    + ["garbage_display", "baggage_display_node", "rosbag_display", "bag_file_display", "playground_bagger"],
)
def test_what_may_be_a_hand_or_a_program_is_no_player(name: str) -> None:
    assert not is_player(name)


def ready(bench: Bench) -> Rig:
    rig = Rig(bench)
    bench.wait(lambda: rig.sample() == 6.0 and bool(rig.plant._other._ids), "a first look")
    return rig


def test_voltages_of_a_recording_alone_are_no_command(bench: Bench) -> None:
    """Nobody else had samples, so that the motor ran as it had run then."""
    rig = ready(bench)
    player = rclpy.create_node("rosbag2_player", context=bench._context)
    player.create_publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
    bench.wait(lambda: rig.sample() == 0.0, "0 V")
    assert "A recording of /motor/voltage is played (/rosbag2_player)" in rig.plant._find_others(0)
    refused = rig.plant._on_enable(SetBool.Request(data=True), SetBool.Response())
    assert not refused.success and "play BAG --topics motor/voltage" in refused.message
    player.destroy_node()
    bench.wait(lambda: rig.sample() == 0.0 and not rig.plant._find_others(time.monotonic_ns()), "its end")
    rig.begin_again()


@pytest.mark.parametrize(
    ("name", "calls", "refused"),
    [("rosbag2_player", True, True), ("rosbag2_player", False, False), ("hand", True, False)],
)
def test_a_request_of_a_recording_switches_nothing_on(bench: Bench, name: str, calls: bool, refused: bool) -> None:
    """`ros2 bag play --publish-service-requests`; of who plays something else, such as a camera's, nothing is known."""
    rig = ready(bench)
    player = rclpy.create_node(name, context=bench._context)
    if calls:
        player.create_client(SetBool, "motor/enable")
    listed = [f"/{name}"] if calls else []
    bench.wait(lambda: [one.node for one in list_clients(bench.node, "/motor/enable")] == listed, "the client")
    bench.wait(lambda: name in bench.node.get_node_names(), "the node")
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=False)).success  # whoever asks for that
    answer = bench.call(SetBool, "motor/enable", SetBool.Request(data=True))
    assert answer.success is not refused and ("The output is on" in answer.message) is not refused
    said = "The output stays off. /motor/enable would be called by what plays a recording (/rosbag2_player), which may"
    assert answer.message.startswith(said) is refused
    player.destroy_node()
    bench.wait(lambda: not list_clients(bench.node, "/motor/enable"), "its end")
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success and rig.plant.gate.enabled


def test_a_request_of_a_recording_resets_no_controller_and_sets_no_limit(bench: Bench, start: Start) -> None:
    start("motor_sim", "motor_sim")
    start("motor_control", "motor_control", "--ros-args", "-p", "voltage_limt:=5.0")
    states = bench.hear(ControlState, "motor/control_state", qos.CONTROL_STATE)
    bench.wait(lambda: bool(states) and states[-1].state == "stopped", "a stop")
    player = rclpy.create_node("rosbag2_player", context=bench._context)
    player.create_client(Trigger, "motor/reset")
    player.create_client(SetParameters, "motor_control/set_parameters")
    answer = bench.call(Trigger, "motor/reset", Trigger.Request())
    assert not answer.success and "/motor/reset would be called by what plays" in answer.message
    obeyed, why = bench.set("motor_control", "voltage_limit", 11.0)
    assert not obeyed and "/motor_control/set_parameters would be called by what plays" in why
    player.destroy_node()
    bench.wait(lambda: "rosbag2_player" not in bench.node.get_node_names(), "its end")
    assert bench.set("motor_control", "voltage_limit", 11.0)[0]
    assert bench.call(Trigger, "motor/reset", Trigger.Request()).success


def test_of_a_node_without_a_name_yet_nothing_is_asked(bench: Bench) -> None:
    """The middleware refuses to be asked of it, and the plant would end."""
    there = [Publisher((1,), ""), Publisher((2,), "/rosbag2_player"), Publisher((3,), "/gone")]
    assert find_players_among(bench.node, there) == {"/rosbag2_player"}


@pytest.mark.parametrize(("name", "plays"), [("/plotjuggler", True), ("/bench/plotjuggler", True), ("/plotter", False)])
def test_a_viewer_that_publishes_a_loaded_bag_again_plays_it(bench: Bench, name: str, plays: bool) -> None:
    """PlotJuggler's re-publisher sends what is under its cursor, references too: one that is moved drove the motor."""
    assert find_players_among(bench.node, [Publisher((1,), name)]) == ({name} if plays else set())


@pytest.mark.parametrize("renamed", [False, True])
def test_a_player_of_another_name_is_known_by_what_it_serves(
    bench: Bench, monkeypatch: pytest.MonkeyPatch, renamed: bool
) -> None:
    """Its services may be renamed, too (`ros2 bag play --remap`), and it may have the name of another node."""
    rig = ready(bench)
    asked, served = rig.plant._commanders._node, [("/y/z" if renamed else "/x/pause", ["rosbag2_interfaces/srv/Pause"])]
    monkeypatch.setattr(asked, "get_service_names_and_types", lambda: served)
    of_node = served if renamed else []  # else of another x
    monkeypatch.setattr(asked, "get_service_names_and_types_by_node", lambda name, _: of_node if name == "x" else [])
    player = rclpy.create_node("x", context=bench._context)
    player.create_publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
    bench.wait(lambda: rig.sample() == 0.0, "0 V")
    assert "is played (/x)" in rig.plant._find_others(0)
    player.destroy_node()
    bench.wait(lambda: rig.sample() == 0.0 and not rig.plant._find_others(time.monotonic_ns()), "its end")
    rig.begin_again()


@pytest.mark.parametrize(
    ("age", "obeyed"), [(DAY, False), (10_500_000_000, False), (9_000_000_000, True), (-DAY, False)]
)
def test_a_voltage_of_another_time_is_not_obeyed(bench: Bench, age: int, obeyed: bool) -> None:
    rig = Rig(bench)
    rig.plant.gate = rig.plant.gate.come_up(0)
    sender = bench.publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)

    def send(volts: float, stamp: int) -> float:
        sender.publish(voltage_message(volts, time_message(stamp), "recorded"))
        return rig.sample()

    bench.wait(lambda: send(0.0, 0) == 0.0 and rig.plant.gate.begun, "the sender")
    applied: list[float] = []

    def drive() -> bool:
        applied.append(send(5.0, rig.stamp() - age))
        return applied[-1] == 5.0 if obeyed else len(applied) == 100

    bench.wait(drive, "its voltages")
    assert set(applied) <= ({0.0, 5.0} if obeyed else {0.0})
    assert obeyed == (rig.plant._old == "")
    assert obeyed or "is stamped" in rig.plant._old and ("ahead" if age < 0 else "ago") in rig.plant._old


def test_nobody_is_obeyed_whose_node_is_not_known(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """Messages come before the middleware has told whose they are: 0.14 s of a recording drove the motor."""
    rig = Rig(bench)
    rig.plant.gate = rig.plant.gate.come_up(time.monotonic_ns())
    sender = bench.publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
    node, names = rig.plant._commanders._node, []
    listed = node.get_publishers_info_by_topic

    def nameless(topic: str) -> list[object]:
        found = listed(topic)
        for one in found if topic.endswith("motor/voltage") and not names else []:
            one._node_name = UNKNOWN
        return found

    monkeypatch.setattr(node, "get_publishers_info_by_topic", nameless)

    def send(volts: float) -> float:
        sender.publish(voltage_message(volts, time_message(0), "us"))
        return rig.sample()

    end = time.monotonic() + 1.0
    while time.monotonic() < end:
        assert send(5.0) == 0.0
    assert rig.plant.gate.sender is not None and rig.plant.gate.sender.name == ""  # the rig's own
    names.append("known")
    bench.wait(lambda: send(0.0) == 0.0 and rig.plant.gate.begun, "the known one")
    bench.wait(lambda: send(5.0) == 5.0, "its voltage")


@pytest.mark.parametrize(
    ("name", "clock"), [("rosbag2_player", False), ("rosbag2_player", True), ("plotjuggler", True), ("x", False)]
)
def test_voltages_of_a_player_never_reach_the_pins(bench: Bench, start: Start, name: str, clock: bool) -> None:
    """Nor those whose stamps are of now by the `/clock` of the same recording (`ros2 bag play --clock`)."""
    samples = bench.hear(MotorSpeed, "motor/speed")
    played = bench.hear(MotorVoltage, "motor/voltage", qos.VOLTAGE)
    start("motor_sim", "motor_sim", *(("--ros-args", "-p", "use_sim_time:=true") if clock else ()))
    bench.wait(lambda: len(samples) > 50, "samples")
    with play(name, "motor/voltage", recorded=True, clock=clock):
        bench.wait(lambda: len(played) > 300, "what is played")
    assert {sample.voltage for sample in samples} == {0.0}
    assert clock is (samples[-1].header.stamp.sec < time.time() - 1000.0)  # its clock is in force
