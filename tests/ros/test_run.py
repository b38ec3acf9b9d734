"""A node that cannot start says why in one sentence."""

import signal
import subprocess
from pathlib import Path

import pytest
import workbench
from forked import Forked

from motor_model.errors import MotorError
from motor_ros import run
from motor_ros.run import check_security

BAD = [
    (("--params-file", "{0}/none.yaml"), {}, "Couldn't parse params file"),
    (("--params-file", "{0}/broken.yaml"), {}, "Couldn't parse params file"),
    (("--params-file", "/dev/zero"), {}, "Couldn't parse params file"),
    (("-p", "broken"), {}, "Couldn't parse parameter override rule"),
    (("-r", "__ns:=bad-name"), {}, "'bad-name' is no namespace: write -r __ns:=/left, which is a slash before each"),
    (("-r", "__ns:=/left/"), {}, "'/left/' is no namespace: write"),  # ROS: "must not start with a number"
    (("--remap", "motor_driver:__ns:=/1st"), {}, "'/1st' is no namespace: write"),
    (("-r", "__node:=a b"), {}, "Couldn't parse remap rule"),
    (("--log-level", "nonsense"), {}, "Couldn't parse log level"),
    (("--log-config-file", "/none"), {}, "ROS 2 cannot start: failed to initialize logging"),
    (("--enclave", "none"), {}, "ROS 2 cannot start: Enclave name is not valid"),
    (("--unknown",), {}, "unknown ROS arguments: '--unknown'"),
    ((), {"ROS_DOMAIN_ID": "x"}, "ROS 2 cannot start: ROS_DOMAIN_ID is not an integral number"),
    ((), {"ROS_SECURITY_ENABLE": "true"}, "ROS_SECURITY_ENABLE is true and there is no keystore"),
    ((), {"ROS_SECURITY_ENABLE": "true", "ROS_SECURITY_STRATEGY": "Enforce"}, "there is no keystore"),
]


@pytest.mark.parametrize(("words", "environment", "said"), BAD)
def test_a_wrong_argument_is_one_sentence(
    tmp_path: Path, words: tuple[str, ...], environment: dict[str, str], said: str
) -> None:
    (tmp_path / "broken.yaml").write_text("a: [\n")
    arguments = ["--ros-args", *(word.format(tmp_path) for word in words)] if words else []
    command = [workbench.program("motor_driver", "motor_driver"), *arguments]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    process = Forked(command, env=workbench.ENVIRONMENT | environment, **pipes)  # type: ignore[call-overload]
    _, err = process.communicate(timeout=120.0)
    ours = [line for line in err.splitlines() if not line.startswith(("[ERROR] [", "[WARN] ["))]
    assert process.returncode in (1, 2) and len(ours) == 1 and said in ours[0], err


class Stubborn:
    """A node whose closing fails, such as by what kept it from going on."""

    port = "open"

    def close(self) -> None:
        raise ValueError("the same again")

    def destroy_node(self) -> None:
        self.port = "closed"


def test_a_node_that_cannot_close_lets_go_of_its_port(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(run.rclpy, "ok", lambda: True)
    node = Stubborn()
    assert run._end(node) == 1 and node.port == "closed"  # type: ignore[arg-type]
    assert "ValueError: the same again" in capsys.readouterr().err


def test_security_needs_its_keystore(tmp_path: Path) -> None:
    check_security({})
    check_security({"ROS_SECURITY_ENABLE": "false"})
    check_security({"ROS_SECURITY_ENABLE": "true", "ROS_SECURITY_KEYSTORE": str(tmp_path)})
    with pytest.raises(MotorError, match="there is no keystore .*none"):
        check_security({"ROS_SECURITY_ENABLE": "true", "ROS_SECURITY_KEYSTORE": str(tmp_path / "none")})


def test_ctrl_c_is_heard_although_whoever_started_us_holds_it_back() -> None:
    """As `ros2 run` does for a program that is built anew; an older one ran on, and moved its motor."""
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    before = {number: signal.getsignal(number) for number in numbers}
    signal.pthread_sigmask(signal.SIG_BLOCK, numbers)
    try:
        interrupt = run.Interrupt()
        assert not interrupt
        signal.raise_signal(signal.SIGINT)
        assert interrupt and interrupt.cause == "Ctrl-C"
    finally:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, numbers)
        for number, handler in before.items():
            signal.signal(number, handler)
