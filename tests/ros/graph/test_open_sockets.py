"""A node that can be reached from elsewhere, though nobody has opened the network, does not start."""

import os
import socket
import subprocess
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from patience import PATIENCE
from rclpy.node import Node
from rclpy.serialization import serialize_message
from std_msgs.msg import Float64
from tiers import keep_fast
from workbench import ENVIRONMENT, program

from motor_identification.bag import BagWriter
from motor_model.errors import MotorError
from motor_ros.graph import open_sockets
from motor_ros.graph.open_sockets import count_open, refuse_open_sockets
from motor_ros.loopback import CLOSED, MIDDLEWARE, PROFILE, RANGE

LAUNCHER = Path(__file__).parents[3] / "ros2_stand_in" / "ros2"

HEAD = "sl local_address rem_address st tx:rx tr:when retrnsmt uid timeout inode\n"
OURS = CLOSED.read_text()
WRONG = {
    "a tag that there is none of": OURS.replace("<rtps>", "<rtps><nonsense/>"),
    "opened by its owner": "<dds><profiles></profiles></dds>",
}


def table(*sockets: tuple[str, int, str]) -> str:
    rows = (f"1: {address}:{port:04X} 0:0 07 0:0 0:0 0 0 0 {inode}\n" for address, port, inode in sockets)
    return HEAD + "".join(rows)


def test_own_sockets_on_all_addresses_at_a_domains_ports_are_counted() -> None:
    anyone, here, six = "0" * 8, "0100007F", "0" * 32
    first = 7400 + 250 * 3
    found = [(anyone, first + 10, "1"), (anyone, first - 1, "1"), (anyone, first + 250, "1"), (anyone, first, "2")]
    tables = [table((here, first + 11, "1"), *found), table((six, first + 249, "1"))]
    assert count_open(3, tables, ["1"]) == 2
    assert count_open(3, tables, []) == 0 and count_open(5, tables, ["1", "2"]) == 0


@pytest.mark.skipif(not os.path.exists("/proc/self/fd"), reason="the kernel does not list sockets")
def test_one_table_is_enough(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A kernel without IPv6 has none of its sockets; the check then said nothing of the others either."""
    node = cast(Node, SimpleNamespace(context=SimpleNamespace(get_domain_id=lambda: 3)))
    monkeypatch.setattr(open_sockets, "TABLES", (tmp_path / "udp", tmp_path / "udp6"))
    refuse_open_sockets(node, {})
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        inode = str(os.fstat(one.fileno()).st_ino)
        (tmp_path / "udp").write_text(table(("0" * 8, 8150, inode), ("0" * 8, 8160, inode)))
        with pytest.raises(MotorError, match="listens to every network"):
            refuse_open_sockets(node, {})
        for opened in ({RANGE: "SUBNET"}, {MIDDLEWARE: "rmw_cyclonedds_cpp"}):
            refuse_open_sockets(node, opened)


def run(tmp_path: Path, wrong: str, package: str, command: str, *arguments: object) -> None:
    """Run one of our programs with a profile that leaves it open, and see it refuse."""
    launch(tmp_path, wrong, program(package, command), *arguments)


def launch(tmp_path: Path, wrong: str, *command: object) -> None:
    """Run a command so."""
    profile = tmp_path / "own.xml"
    profile.write_text(WRONG[wrong])
    done = subprocess.run(
        list(map(str, command)),
        env=ENVIRONMENT | {PROFILE: str(profile), RANGE: "LOCALHOST"},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )
    assert done.returncode == 1 and "listens to every network, not only on this machine: Fast DDS" in done.stderr
    assert str(profile) in done.stderr and "Traceback" not in done.stderr


listed = pytest.mark.skipif(not os.path.exists("/proc/self/net/udp"), reason="the kernel does not list sockets")


@listed
@pytest.mark.parametrize("wrong", keep_fast(list(WRONG), "a tag that there is none of"))
def test_no_plant_starts_with_a_profile_that_leaves_it_open(wrong: str, tmp_path: Path) -> None:
    """Fast DDS logged an error for the first, and went on with a motor that everybody on the network could drive."""
    run(tmp_path, wrong, "motor_sim", "motor_sim")


@listed
@pytest.mark.parametrize("command", keep_fast(["play", "record", "experiment"], "play"))
def test_no_command_that_makes_a_node_of_its_own_sends_to_every_network(command: str, tmp_path: Path) -> None:
    bag = tmp_path / "bag"
    with BagWriter(bag) as writer:
        writer.write(writer.topic("/x", "std_msgs/msg/Float64"), 1, serialize_message(Float64(data=1.0)))
    arguments = {
        "play": [bag],
        "record": [tmp_path / "new", "/x"],
        "experiment": ["step", "--output", tmp_path / "new"],
    }
    run(tmp_path, "a tag that there is none of", "motor_identification", command, *arguments[command])
    assert not (tmp_path / "new").exists()


@listed
def test_the_stand_in_of_ros2_does_not_send_to_every_network_either(tmp_path: Path) -> None:
    launch(tmp_path, "a tag that there is none of", LAUNCHER, "topic", "list")
