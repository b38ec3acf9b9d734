"""The action motor/diagnose of the node as a process: names what is missing, tells how far it is, stops, survives."""

import os
import signal
from collections.abc import Callable, Iterator
from pathlib import Path
from subprocess import Popen
from typing import Any

import pytest
import workbench
from action_msgs.msg import GoalStatus
from friction import KS
from rclpy.action import ActionClient
from rclpy.qos import QoSProfile
from workbench import Bench, end

from motor_model.model_file import load
from motor_model.parameters import PAPER_KA, PAPER_KV
from motor_msgs.action import Diagnose
from motor_msgs.msg import MotorModel
from motor_ros import qos

PATIENCE = 90.0  # [s]
ALL = QoSProfile(depth=1000)  # feedback: of the ten that are kept else, a test that is held up misses the first


@pytest.fixture(scope="module")
def models(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("models")


@pytest.fixture(scope="module")
def node(bags: Path, models: Path) -> Iterator["Popen[str]"]:
    """One node for all goals: it lives on after each."""
    rows = [f"bag_directory:={bags}", f"model_file:={models / 'model.yaml'}", f"report_directory:={models / 'reports'}"]
    arguments = [word for row in rows for word in ("-p", row)]
    process = workbench.start("motor_identification", "motor_identification", "--ros-args", *arguments)
    yield process
    assert process.poll() is None
    end(process)
    assert process.returncode == 0


class Asked:
    """A goal that was sent, and everything that is said about it."""

    def __init__(self, bench: Bench, client: ActionClient, **goal: list[str] | str) -> None:
        self.feedback: list[Diagnose.Feedback] = []
        self._bench = bench
        sent = client.send_goal_async(Diagnose.Goal(**goal), lambda message: self.feedback.append(message.feedback))
        bench.wait(sent.done, "the goal's acceptance")
        self.handle = sent.result()
        assert self.handle.accepted
        self._answer = self.handle.get_result_async()

    def begun(self) -> None:
        """Wait until the worker says something."""
        self._bench.wait(lambda: bool(self.feedback), "feedback", PATIENCE)
        assert not self._answer.done()

    def result(self) -> tuple[int, Diagnose.Result]:
        self._bench.wait(self._answer.done, "a result", PATIENCE)
        return self._answer.result().status, self._answer.result().result

    def cancelled(self) -> tuple[int, Diagnose.Result]:
        cancelling = self.handle.cancel_goal_async()
        self._bench.wait(cancelling.done, "an answer to the cancel")
        assert len(cancelling.result().goals_canceling) == 1
        return self.result()


@pytest.fixture
def ask(bench: Bench, node: "Popen[str]") -> Iterator[Callable[..., Asked]]:
    client = ActionClient(bench.node, Diagnose, "motor/diagnose", feedback_sub_qos_profile=ALL)
    bench.wait(client.server_is_ready, "motor/diagnose")
    bench.known_to("motor_identification")
    yield lambda **goal: Asked(bench, client, **goal)
    client.destroy()


def assert_refused(answer: tuple[int, Diagnose.Result], words: str, status: int = GoalStatus.STATUS_ABORTED) -> None:
    assert answer[0] == status
    result = answer[1]
    assert not result.success and words in result.message and "\n" not in result.message
    assert result.verdict == "" and result.model.parameter_names == [] and result.report_uri == ""


def test_names_the_missing_effect_and_latches_the_model(
    ask: Callable[..., Asked], bench: Bench, bags: Path, models: Path
) -> None:
    asked = ask(bag_uris=["staircase"], validation_uris=["coast"])
    status, result = asked.result()
    assert status == GoalStatus.STATUS_SUCCEEDED and result.success, result.message
    assert result.effects == ["coulomb_friction"] and result.verdict in ("explained", "undecided")
    assert "\n" not in result.message and len(result.message) > 20
    model = dict(zip(result.model.parameter_names, result.model.parameter_values, strict=True))
    for name, true in (("kv", PAPER_KV), ("ka", PAPER_KA), ("ks", KS)):
        assert model[name] == pytest.approx(true, rel=1e-3)
    assert result.gap_before > 10.0 * result.noise_floor
    assert 0.7 < result.gap_after / result.noise_floor < 1.3
    assert list(result.model.bag_uris) == [str(bags / "staircase")]

    stages = asked.feedback
    assert stages[0].stage == f"reading {bags / 'staircase'}" and stages[-1].stage == "report"
    shares = [stage.progress for stage in stages]
    assert shares == sorted(shares) and shares[0] == 0.0 and shares[-1] == 1.0 and len(set(shares)) > 5
    assert "coulomb_friction" in {stage.best_effect for stage in stages}
    assert stages[-1].gap == result.gap_after

    latched = bench.hear(MotorModel, "motor/model", qos.MODEL)  # later than the publication
    bench.wait(lambda: bool(latched), "the latched model")
    assert latched[0] == result.model
    assert load(models / "model.yaml").value("ks") == pytest.approx(KS, rel=1e-3)
    assert Path(result.report_uri) == models / "reports" / "staircase_diagnosis.html"
    assert "<html" in Path(result.report_uri).read_text(encoding="utf-8")


def test_a_cancel_stops_it_and_another_goal_meanwhile_is_refused(ask: Callable[..., Asked]) -> None:
    first = ask(bag_uris=["staircase"])
    first.begun()
    assert_refused(ask(bag_uris=["staircase"]).result(), "a diagnosis is going on already")
    assert_refused(first.cancelled(), "was stopped", GoalStatus.STATUS_CANCELED)
    assert_refused(ask(bag_uris=["nowhere"]).result(), "There is no bag")  # it is free again


def test_a_killed_worker_is_a_sentence_and_the_node_goes_on(ask: Callable[..., Asked], node: "Popen[str]") -> None:
    asked = ask(bag_uris=["staircase"])
    asked.begun()
    os.kill(worker_of(node), signal.SIGKILL)
    assert_refused(asked.result(), "the computing process was killed (SIGKILL)")
    assert_refused(ask(bag_uris=["nowhere"]).result(), "There is no bag")


def worker_of(node: "Popen[str]") -> int:
    """The process of its computations, the last of its children (the other belongs to multiprocessing)."""
    tasks = Path(f"/proc/{node.pid}/task").glob("*/children")
    children = [int(child) for task in tasks for child in task.read_text().split()]
    spawned = [pid for pid in children if b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes()]
    assert len(spawned) == 1
    return spawned[0]


BAD: list[tuple[dict[str, Any], str]] = [
    ({}, "bag_uris is empty"),
    ({"bag_uris": ["nowhere"]}, "There is no bag"),
    ({"bag_uris": ["staircase"], "validation_uris": ["nowhere"]}, "There is no bag"),
    ({"bag_uris": ["staircase"], "validation_uris": ["staircase/"]}, "is given for the fit and for validation"),
    ({"bag_uris": ["staircase"], "known_effects": ["magic"]}, "'magic' is not an effect"),
    ({"bag_uris": ["staircase"], "topic_namespace": "left"}, "/left/motor/speed"),
]


@pytest.mark.parametrize(("goal", "words"), BAD)
def test_a_bad_goal_is_one_sentence(ask: Callable[..., Asked], goal: dict[str, Any], words: str) -> None:
    assert_refused(ask(**goal).result(), words)


def test_ends_at_once_in_the_middle_of_a_goal(bench: Bench, start: Callable[..., "Popen[str]"], bags: Path) -> None:
    elsewhere = ["-r", "__ns:=/other", "-p", f"bag_directory:={bags}"]
    process = start("motor_identification", "motor_identification", "--ros-args", *elsewhere)
    client = ActionClient(bench.node, Diagnose, "other/motor/diagnose")
    bench.wait(client.server_is_ready, "other/motor/diagnose")
    bench.known_to("/other/motor_identification")
    Asked(bench, client, bag_uris=["staircase"]).begun()
    end(process)
    assert process.returncode == 0
