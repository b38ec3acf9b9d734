"""What decides who can reach the motors: the environment of a program, and that of a shell with env.sh."""

import os
import subprocess
import sys
import xml.etree.ElementTree as Tree
from pathlib import Path

import pytest
from domains import free_domain

from motor_ros.loopback import CLOSED, MIDDLEWARE, OPEN, OTHER, PROFILE, RANGE, SKIP, stay_on_this_machine

ROOT = Path(__file__).resolve().parents[2]
SUPPORT = ROOT / "tests" / "support"
OWN = str(SUPPORT / "quick_announcements.xml")
CASES = [
    ({}, "LOCALHOST", CLOSED.name),
    ({RANGE: "OFF"}, "OFF", CLOSED.name),
    ({RANGE: "SUBNET"}, "SUBNET", OPEN.name),
    ({RANGE: "SYSTEM_DEFAULT"}, "SYSTEM_DEFAULT", OPEN.name),
    ({RANGE: "LOCALHOST", PROFILE: f"/old/{OPEN.name}"}, "LOCALHOST", CLOSED.name),
    ({RANGE: "SUBNET", PROFILE: f"/old/{CLOSED.name}"}, "SUBNET", OPEN.name),
    ({PROFILE: OWN}, "LOCALHOST", Path(OWN).name),
    ({RANGE: "", PROFILE: "", SKIP: ""}, "LOCALHOST", CLOSED.name),
    ({PROFILE: "/moved/own.xml"}, "LOCALHOST", CLOSED.name),
    ({PROFILE: str(ROOT)}, "LOCALHOST", CLOSED.name),
    ({RANGE: "SUBNET", PROFILE: "/moved/own.xml"}, "SUBNET", OPEN.name),
]


@pytest.mark.parametrize(("environment", "wanted", "profile"), CASES)
def test_sockets_are_closed_unless_the_user_opens_them(environment: dict[str, str], wanted: str, profile: str) -> None:
    ours = dict(environment)
    said = stay_on_this_machine(ours)
    assert ("everybody on it hears the motors" in said) == (profile == OPEN.name)
    assert (ours[RANGE], Path(ours[PROFILE]).name, ours["SKIP_DEFAULT_XML_FILE"]) == (wanted, profile, "1")
    assert Path(ours[PROFILE]).is_file()
    assert ("cannot be read" in said) == (environment.get(PROFILE) in ("/moved/own.xml", str(ROOT)))


@pytest.mark.parametrize(("environment", "wanted", "profile"), CASES)
def test_env_sh_says_the_same(environment: dict[str, str], wanted: str, profile: str) -> None:
    bare = {name: os.environ[name] for name in ("PATH", "HOME") if name in os.environ}
    script = f'source env.sh && echo "${RANGE} ${PROFILE} $SKIP_DEFAULT_XML_FILE"'
    done = subprocess.run(
        ["bash", "-c", script], env=bare | environment, cwd=ROOT, capture_output=True, text=True, timeout=120.0
    )
    said = done.stdout.split()
    assert (said[0], Path(said[1]).name, said[2]) == (wanted, profile, "1")
    assert ("is your own" in done.stderr) == (profile == Path(OWN).name)
    assert ("cannot be read" in done.stderr) == (environment.get(PROFILE) in ("/moved/own.xml", str(ROOT)))
    assert ("everybody on it hears the motors" in done.stderr) == (profile == OPEN.name)


@pytest.mark.parametrize("name", ["ROS_STATIC_PEERS", "ROS_DISCOVERY_SERVER"])
@pytest.mark.parametrize(
    ("environment", "kept"),
    [({}, False), ({RANGE: "OFF"}, False), ({RANGE: "SUBNET"}, True), ({PROFILE: OWN}, True)],
)
def test_nobody_elsewhere_is_told_of_a_closed_node(name: str, environment: dict[str, str], kept: bool) -> None:
    """Left over from another project, they were: 27 packets to each of 32 ports of a peer in 7 s."""
    ours = environment | {name: "192.0.2.1"}
    said = stay_on_this_machine(ours)
    assert ours.get(name, "") == ("192.0.2.1" if kept else "")
    assert said.startswith(f"{name} is set and not used") != kept and ("SUBNET" in said) != kept
    bare = {one: os.environ[one] for one in ("PATH", "HOME") if one in os.environ}
    done = subprocess.run(
        ["bash", "-c", f'source env.sh && echo "${{{name}:-}}"'],
        env=bare | environment | {name: "192.0.2.1"},
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=120.0,
    )
    assert done.stdout.strip() == ours.get(name, "") and (said in done.stderr)


def test_a_profile_that_is_no_xml_is_not_used(tmp_path: Path) -> None:
    """Fast DDS goes on without it: UDP on 0.0.0.0."""
    broken = tmp_path / "own.xml"
    broken.write_text("<dds><profiles>")
    ours = {PROFILE: str(broken)}
    assert f"{broken}, which cannot be read" in stay_on_this_machine(ours) and ours[PROFILE] == str(CLOSED)


@pytest.mark.parametrize(
    ("text", "used"),
    [
        ('<CycloneDDS xmlns="https://cdds.io/config"><Domain id="any"/></CycloneDDS>', False),
        ("<launch/>", False),
        ('<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"/>', True),
        ("<dds><profiles/></dds>", True),
        ('<profiles\n    xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"/>', True),
        ('<dds\txmlns="http://www.eprosima.com"/>', True),
        ('<f:profiles xmlns:f="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"/>', False),
        ('<f:dds xmlns:f="http://www.eprosima.com"/>', False),
        ("<!-- <profiles> --><CycloneDDS/>", False),
        ("<CycloneDDS><![CDATA[ <profiles> ]]></CycloneDDS>", False),
        ("<!-- <CycloneDDS> --><dds/>", True),
        ('<!DOCTYPE dds [<!ENTITY all "<profiles/>">]><dds>&all;</dds>', False),
        ("<!DOCTYPE dds [<!ELEMENT dds ANY>]><dds/>", True),
        ('<?xml version="1.0" encoding="UTF-16"?><dds/>', False),
    ],
)
def test_a_file_of_another_program_is_no_profile(tmp_path: Path, text: str, used: bool) -> None:
    """Fast DDS goes on without Cyclone DDS's configuration as well, on 0.0.0.0; its own are left as they are.

    It knows its elements by their bare names alone; after those may be any white space. A comment names none.
    """
    named = tmp_path / "own.xml"
    named.write_text(text, "utf-16" if "UTF-16" in text else "utf-8")
    ours = {PROFILE: str(named)}
    assert (f"{named}, which cannot be read" not in stay_on_this_machine(ours)) is used
    assert ours[PROFILE] == str(named if used else CLOSED)
    words = ["bash", "-c", f'source env.sh && echo "${PROFILE}"']
    bare = {one: os.environ[one] for one in ("PATH", "HOME") if one in os.environ} | {PROFILE: str(named)}
    done = subprocess.run(words, env=bare, cwd=ROOT, capture_output=True, text=True, timeout=120.0)
    assert Path(done.stdout.strip()).name == (named if used else CLOSED).name


@pytest.mark.parametrize(
    ("environment", "said"),
    [
        ({MIDDLEWARE: "rmw_fastrtps_cpp"}, False),
        ({MIDDLEWARE: "rmw_fastrtps_dynamic_cpp"}, False),
        ({MIDDLEWARE: ""}, False),
        ({MIDDLEWARE: "rmw_cyclonedds_cpp"}, True),
        ({MIDDLEWARE: "rmw_cyclonedds_cpp", "CYCLONEDDS_URI": "own.xml"}, False),
        ({MIDDLEWARE: "rmw_zenoh_cpp"}, True),
    ],
)
def test_a_middleware_that_the_profile_is_not_for_is_said(environment: dict[str, str], said: bool) -> None:
    told = stay_on_this_machine(dict(environment))
    assert told == (OTHER.format(environment[MIDDLEWARE]) if said else "")


def transports(path: Path) -> tuple[list[str], list[str], str]:
    """Kinds of the transports, addresses of the white list, whether the built-in ones stay."""
    name = "{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}"
    tree = Tree.parse(path)
    texts = {tag: [node.text or "" for node in tree.iter(name + tag)] for tag in ("type", "address")}
    return (
        sorted(texts["type"]),
        texts["address"],
        "".join(node.text or "" for node in tree.iter(name + "useBuiltinTransports")),
    )


@pytest.mark.parametrize("path", [CLOSED, SUPPORT / "quick_announcements.xml"])
def test_the_profile_has_the_loopback_and_shared_memory_only(path: Path) -> None:
    assert transports(path) == (["SHM", "UDPv4"], ["127.0.0.1"], "false")
    assert transports(OPEN) == ([], [], "")


@pytest.mark.parametrize("path", [CLOSED, SUPPORT / "quick_announcements.xml"])
def test_as_many_processes_are_asked_as_the_highest_domain_has_ports_for(path: Path) -> None:
    """Fast DDS ends a process that would ask beyond 65,535 (119 in domain 232), and asks 32 unless it is told."""
    (asked,) = Tree.parse(path).iter("{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}maxInitialPeersRange")
    last = int(asked.text or "0") - 1
    assert last >= 60 and 7_400 + 250 * 232 + 10 + 2 * last <= 65_535


CROWD = """
import sys, rclpy
kept = []
for k in range(int(sys.argv[1])):
    context = rclpy.Context()
    rclpy.init(context=context)
    kept.append(rclpy.create_node(f"idle_{k}", context=context))
print("there", flush=True)
sys.stdin.read()
"""
ALONE = """
import sys, rclpy
from std_srvs.srv import SetBool
rclpy.init()
node = rclpy.create_node(sys.argv[1])
if sys.argv[1] == "called":
    node.create_service(SetBool, "motor/enable", lambda request, response: response)
    print("there", flush=True)
    rclpy.spin(node)
print(node.create_client(SetBool, "motor/enable").wait_for_service(timeout_sec=30.0), flush=True)
"""


def test_who_comes_after_33_others_finds_a_driver_that_came_after_them_too() -> None:
    """Both had ports at which nobody was asked, and a shell could not stop the motor."""
    environment = {**os.environ, "ROS_DOMAIN_ID": str(free_domain()), RANGE: "LOCALHOST", PROFILE: str(CLOSED)}

    def run(code: str, *words: str) -> subprocess.Popen[str]:
        pipe = subprocess.PIPE
        return subprocess.Popen(
            [sys.executable, "-c", code, *words], env=environment, stdin=pipe, stdout=pipe, text=True
        )

    started = []
    try:
        for code, words, said in ((CROWD, "33", "there"), (ALONE, "called", "there"), (ALONE, "caller", "True")):
            started.append(run(code, words))
            assert started[-1].stdout is not None and started[-1].stdout.readline().strip() == said
    finally:
        for one in started:
            one.kill()
            one.wait()
