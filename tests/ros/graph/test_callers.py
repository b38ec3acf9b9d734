"""A request that may move a motor is answered once it is known who may have asked: its node is known after it comes."""

import time
from collections.abc import Callable
from subprocess import Popen

import pytest
from bag_player import call_at_once
from plant_rig import Rig
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.experimental import EventsExecutor
from std_srvs.srv import SetBool
from workbench import Bench

from motor_ros.graph import acquaintances, callers
from motor_ros.graph.callers import Callers
from motor_ros.graph.publishers import Publisher

Start = Callable[..., "Popen[str]"]
NOBODY, HAND = Publisher((1,), ""), Publisher((1,), "/hand")
OTHER, PLAYER = Publisher((2,), "/hand"), Publisher((2,), "/rosbag2_player")
SETTLED = acquaintances.SETTLED * 1e-9


class Served:
    """A service with its callers, and a client of it."""

    def __init__(self, bench: Bench) -> None:
        self.bench, self.answered = bench, 0
        self.service = bench.node.create_service(SetBool, "x", self.answer)
        self.callers = Callers(bench.node).guard(self.service, lambda request: bool(request.data), self.refuse)
        self.client = bench.node.create_client(SetBool, "x")
        bench.wait(lambda: self.client.service_is_ready() and bool(self.callers._acquaintances.known), "the client")

    def answer(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        self.answered, response.success = self.answered + 1, True
        return response

    @staticmethod
    def refuse(_: SetBool.Request, response: SetBool.Response, why: str) -> SetBool.Response:
        response.success, response.message = False, why
        return response

    def call(self, on: bool) -> tuple[SetBool.Response, float]:
        """The response, and how long [s] it took."""
        begun, future = time.monotonic(), self.client.call_async(SetBool.Request(data=on))
        self.bench.wait(future.done, "an answer")
        return future.result(), time.monotonic() - begun


def listed(monkeypatch: pytest.MonkeyPatch, served: Served, first: list[Publisher], later: list[Publisher]) -> None:
    """Have the middleware list these clients at the first look that comes, and those from then on."""
    nobody = acquaintances.Acquaintances(awaited=served.callers._acquaintances.awaited)
    served.callers._acquaintances, left = nobody, [first]
    monkeypatch.setattr(callers, "list_clients", lambda *_: left.pop() if left else later)


@pytest.mark.parametrize("executor", [EventsExecutor, SingleThreadedExecutor])
@pytest.mark.parametrize(
    ("first", "later", "on", "obeyed"),
    [
        ([HAND], [HAND], True, True),
        ([NOBODY], [HAND], True, True),
        ([NOBODY], [HAND, OTHER], True, True),  # a node with two
        ([], [HAND], True, True),
        ([HAND], [HAND, PLAYER], True, False),  # which of them?
        ([NOBODY], [NOBODY], True, False),
        ([NOBODY], [HAND, Publisher((2,), "")], True, False),  # the second is of nobody, whoever has the first
        ([], [], True, False),  # it has ended
        ([NOBODY], [], True, False),
        ([HAND, OTHER], [HAND], True, False),  # the second's, perhaps, before anybody knew what it serves
        ([NOBODY], [NOBODY], False, True),  # whoever asks for no motion
    ],
)
def test_a_request_waits_until_all_are_known_who_may_have_sent_it(
    bench: Bench,
    monkeypatch: pytest.MonkeyPatch,
    executor: Callable[..., Executor],
    first: list[Publisher],
    later: list[Publisher],
    on: bool,
    obeyed: bool,
) -> None:
    monkeypatch.setattr(callers, "PATIENCE", 500_000_000)
    monkeypatch.setattr(acquaintances, "PATIENCE", 500_000_000)
    bench.executor.remove_node(bench.node)
    bench.executor = executor(context=bench._context)
    bench.executor.add_node(bench.node)
    served = Served(bench)
    listed(monkeypatch, served, first, later)
    response, took = served.call(on)
    assert response.success is obeyed and served.answered == int(obeyed)
    assert (took >= 0.99 * SETTLED) is (obeyed and on) or not obeyed
    words = callers.UNKNOWN.format("/x") if PLAYER not in later else "/x would be called by what plays a recording"
    assert obeyed or response.message.startswith(words)


def test_who_is_known_is_answered_at_once_and_nothing_waits_for_others(bench: Bench) -> None:
    served, ticks = Served(bench), []
    bench.node.create_timer(0.01, lambda: ticks.append(time.monotonic()))
    waited = served.call(True)[1]
    assert waited > 0.5 * SETTLED and len(ticks) > 5
    assert min(served.call(True)[1] for _ in range(5)) < 0.2 * SETTLED


def test_a_later_stop_ends_a_request_that_waits(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else it would switch on what its sender has not seen to be switched off."""
    rig = Rig(bench)
    client = bench.node.create_client(SetBool, "motor/enable")
    bench.wait(client.service_is_ready, "the plant")
    now = [[NOBODY]]
    monkeypatch.setattr(callers, "list_clients", lambda *_: now[0])

    def wait_on() -> object:
        asked = client.call_async(SetBool.Request(data=True))
        bench.wait(lambda: len(rig.plant._enabling._waiting) == 1, "the request")
        return asked

    rig.plant.stop("a fault")
    for why, stop in (
        ("it was switched off by motor/enable", lambda: client.call_async(SetBool.Request(data=False))),
        ("another fault", lambda: rig.plant.stop("another fault")),
    ):
        asked = wait_on()
        stop()
        bench.wait(asked.done, "an answer")
        assert asked.result().message == f"The output stays off. Just now, {why}: look, then call again."
    asked = wait_on()
    rig.plant.stop("another fault")  # which is said to be still there
    now[0] = [HAND]
    bench.wait(asked.done, "an answer")
    assert asked.result().success and rig.plant.gate.enabled


@pytest.mark.parametrize(("name", "obeyed"), [("rosbag2_player", False), ("hand", True)])
def test_who_calls_as_soon_as_it_can_is_known_first(bench: Bench, start: Start, name: str, obeyed: bool) -> None:
    """A player was obeyed each of 20 times; a hand that calls once is a new node each time, and is not sent away."""
    start("motor_sim", "motor_sim")
    for _ in range(4):
        assert bench.call(SetBool, "motor/enable", SetBool.Request(data=False)).success
        answer = call_at_once(name, "motor/enable")
        assert (answer == "The output is on.") is obeyed
        assert obeyed or "called by what plays a recording" in answer or "Nobody knows which node" in answer
