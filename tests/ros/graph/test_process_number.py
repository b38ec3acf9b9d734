"""A plant that not every shell of this machine would find does not start, and others say that they are that many."""

import os
import socket
import subprocess
import xml.etree.ElementTree as Tree
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from domains import free_domain
from patience import PATIENCE
from rclpy.node import Node
from workbench import ENVIRONMENT, Bench, program

from motor_model.errors import MotorError
from motor_model.sample import Info
from motor_ros import plant as plant_module
from motor_ros import qos
from motor_ros.gate import Gate
from motor_ros.graph import process_number
from motor_ros.graph.process_number import FOUND, MOST, find_number, refuse_crowd, tell_crowd
from motor_ros.loopback import CLOSED, MIDDLEWARE, PROFILE, RANGE
from motor_ros.plant import Plant

HEAD = "sl local_address rem_address st tx:rx tr:when retrnsmt uid timeout inode\n"
listed = pytest.mark.skipif(not os.path.exists("/proc/self/net/udp"), reason="the kernel does not list sockets")


def table(*sockets: tuple[int, str]) -> str:
    return HEAD + "".join(f"1: 0100007F:{port:04X} 0:0 07 0:0 0:0 0 0 0 {inode}\n" for port, inode in sockets)


def process(domain: int, number: int, inode: str = "1") -> list[tuple[int, str]]:
    """The sockets at which the so-many-th process of a domain listens, from 1 on."""
    first = 7400 + 250 * domain + 10 + 2 * (number - 1)
    return [(first, inode), (first + 1, inode)]


@contextmanager
def crowd(domain: int, count: int) -> Iterator[None]:
    """So many processes' sockets, held by this one."""
    with ExitStack() as kept:
        for number in range(1, count + 1):
            for port, _ in process(domain, number):
                kept.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)).bind(("127.0.0.1", port))
        yield


def test_as_many_are_found_as_the_profile_says() -> None:
    (asked,) = Tree.parse(CLOSED).iter("{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}maxInitialPeersRange")
    assert int(asked.text or "0") == FOUND


def test_the_number_is_that_of_the_ports() -> None:
    several = table(*process(3, 1), *process(3, 5, "2"), *process(3, MOST, "3"), (7400, "4"), (8401, "5"))
    assert find_number(3, [several]) == MOST and find_number(3, [several], ["2", "9"]) == 5
    assert find_number(3, ["", several], ["4", "5"]) == 0 and find_number(5, [several]) == 0
    half = table(process(3, 70)[0])  # one socket alone may be there to send, on any port
    assert find_number(3, [half]) == 0


@pytest.mark.parametrize(("number", "further"), [(FOUND, 1), (FOUND + 1, 1), (1, 2), (FOUND + 1, 5)])
def test_a_process_whose_port_for_messages_was_taken_has_the_number_of_the_other(number: int, further: int) -> None:
    """Beside a stranger's socket at port 125 of a domain the 63rd process's were 124 and 127: it started."""
    (discovery, _), *_ = process(3, number)
    (_, (messages, _)) = process(3, number + further)
    sockets = table((discovery, "7"), (messages, "7"), (45000, "7"), *process(3, number - 1 or 70))
    assert find_number(3, [sockets], ["7"]) == number
    assert find_number(3, [table((messages, "7"), (discovery - 250, "7"))], ["7"]) == 0


def test_the_next_domains_processes_are_none_of_this_one_but_a_process_may_have_run_into_their_ports() -> None:
    both = table(*process(4, 1, "1"), *process(3, MOST + 10, "2"))
    assert find_number(3, [both]) == 0 and find_number(3, [both], ["2"]) == MOST + 10


@pytest.mark.parametrize(("number", "refused"), [(FOUND, False), (FOUND + 1, True)])
def test_the_first_that_not_everybody_finds_is_refused(
    number: int, refused: bool, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    node = cast(Node, SimpleNamespace(context=SimpleNamespace(get_domain_id=lambda: 3)))
    monkeypatch.setattr(process_number, "TABLES", (tmp_path / "udp", tmp_path / "udp6"))
    monkeypatch.setattr(process_number, "own_sockets", lambda: {"7"})
    (tmp_path / "udp").write_text(table(*process(3, number, "7"), *process(3, FOUND, "1")))
    closed = {PROFILE: f"/elsewhere/{CLOSED.name}"}
    assert bool(tell_crowd(node, closed)) is refused
    for other in ({PROFILE: "/own.xml"}, {}, {**closed, MIDDLEWARE: "rmw_cyclonedds_cpp"}):
        refuse_crowd(node, other)
        assert tell_crowd(node, other) == ""
    if refused:
        with pytest.raises(MotorError, match="ROS process no. 63 of domain 3 on this machine"):
            refuse_crowd(node, closed)
    else:
        refuse_crowd(node, closed)


@listed
@pytest.mark.parametrize("name", ["motor_sim", "motor_driver"])
def test_no_plant_starts_that_not_every_shell_finds(name: str) -> None:
    """A sender from before turned its motor, and motor/enable from a new shell never reached it."""
    domain = free_domain()
    environment = ENVIRONMENT | {"ROS_DOMAIN_ID": str(domain), RANGE: "LOCALHOST", PROFILE: str(CLOSED)}
    with crowd(domain, FOUND):
        done = subprocess.run([program(name, name)], env=environment, capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert f"This is ROS process no. 63 of domain {domain} on this machine" in done.stderr
    assert "export another ROS_DOMAIN_ID" in done.stderr


@listed
def test_a_plant_that_runs_says_that_there_are_too_many(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(PROFILE, str(CLOSED))
    monkeypatch.setattr(plant_module, "LOOK_FOR_CROWD_EVERY", 0)
    heard = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    one = Plant(bench.node, Info(), Gate(True, 0.1))

    def told() -> bool:
        one.diagnose("", {})
        return bool(heard) and "ROS process no. 64 of domain" in heard[-1].status[0].message

    domain = bench.node.context.get_domain_id()
    with ExitStack() as kept:
        for port, _ in process(domain, FOUND + 2):
            kept.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)).bind(("127.0.0.1", port))
        bench.wait(told, "the warning")
    bench.wait(lambda: not told(), "its end")
