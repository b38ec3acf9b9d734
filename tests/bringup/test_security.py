"""Who may say what: the policy follows from the nodes' own tables, and the script refuses what it cannot do."""

import os
import subprocess
import xml.etree.ElementTree as Tree
from pathlib import Path

import pytest
from bringup_tables import reference

from motor_ros.topics import SERVICES, TOPICS

ROOT = Path(__file__).resolve().parents[2]
SECURITY = ROOT / "motor_bringup" / "security"
POLICY = Tree.parse(SECURITY / "policy.xml").getroot()


def enclaves_that(kind: str, may: str, name: str) -> set[str]:
    return {
        str(enclave.get("path"))
        for enclave in POLICY.iter("enclave")
        for part in enclave.iter(kind)
        if part.get(may) == "ALLOW" and name in [one.text for one in part]
    }


def test_the_policy_is_what_the_tables_say() -> None:
    assert (SECURITY / "policy.xml").read_text() == reference("make_policy").page(), "run python docs/make_policy.py"


def test_who_may_drive_and_switch() -> None:
    assert enclaves_that("topics", "publish", "/motor/voltage") == {
        "/motor/control",
        "/motor/experiment",
        "/motor/play",
    }
    assert enclaves_that("services", "request", "/motor/enable") == {"/motor/operator"}
    assert enclaves_that("services", "reply", "/motor/enable") == {"/motor/plant"}
    assert enclaves_that("topics", "publish", "/motor/speed") == {"/motor/plant", "/motor/play"}
    assert enclaves_that("topics", "publish", "/motor/reference") == {"/motor/operator", "/motor/play"}


def test_every_topic_and_service_has_somebody_on_both_ends() -> None:
    for topic in TOPICS:
        name = topic.name if topic.name.startswith("/") else f"/{topic.name}"
        assert enclaves_that("topics", "publish", name) and enclaves_that("topics", "subscribe", name), name
    for service in SERVICES:
        kind, ask, answer = (
            ("actions", "call", "execute") if "/action/" in service.type_name else ("services", "request", "reply")
        )
        assert enclaves_that(kind, ask, f"/{service.name}") and enclaves_that(kind, answer, f"/{service.name}"), service


ASKS = '#!/bin/sh\n[ "$2" = --help ] && exit 0\necho "$@"; cat "$6"\n'


def make(folder: Path, *words: str, has_security: bool = True) -> "subprocess.CompletedProcess[str]":
    (folder / "ros2").write_text(ASKS if has_security else "#!/bin/sh\nexit 2\n")
    (folder / "ros2").chmod(0o755)
    environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
    command = [str(SECURITY / "make_keystore.sh"), *words]
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120.0, check=False
    )


def test_it_hands_the_policy_to_ros2_security_in_the_motors_namespace(tmp_path: Path) -> None:
    done = make(tmp_path, "keys")
    first, _, policy = done.stdout.partition("\n")
    assert done.returncode == 0 and first.startswith("security generate_artifacts -k keys -p ")
    assert "/motor/voltage</topic>" in policy and "ROS_SECURITY_STRATEGY=Enforce" in policy
    moved = make(tmp_path, "keys", "/left").stdout
    assert ">/left/motor/voltage</topic>" in moved and ">/motor/voltage<" not in moved and 'ns="/left"' in moved
    assert ">/left/motor_sim/set_parameters</service>" in moved and ">/left/joint_states<" in moved
    assert ">/diagnostics</topic>" in moved and 'path="/motor/plant"' in moved


@pytest.mark.parametrize(
    ("words", "has_security", "status", "said"),
    [
        ((), True, 2, "usage: "),
        (("keys", "bad name"), True, 1, "is no namespace"),
        (("keys", "$(touch ran)"), True, 1, "is no namespace"),
        (("there",), True, 1, "exists already and is left as it is"),
        (("keys",), False, 1, "there is no 'ros2 security' here"),
    ],
)
def test_what_it_cannot_do_is_one_sentence(
    tmp_path: Path, words: tuple[str, ...], has_security: bool, status: int, said: str
) -> None:
    (tmp_path / "there").mkdir()
    done = make(tmp_path, *words, has_security=has_security)
    assert (done.returncode, done.stdout) == (status, "") and said in done.stderr and done.stderr.count("\n") == 1
    assert not (tmp_path / "ran").exists() and not (tmp_path / "keys").exists()
