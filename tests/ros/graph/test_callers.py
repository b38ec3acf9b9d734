"""A request that might move a motor is answered once it is known whose it is: a node is known after its clients."""

import time

import pytest
from std_srvs.srv import SetBool
from workbench import Bench

from motor_ros.graph import callers
from motor_ros.graph.callers import KNOWN_AFTER, count_callers, serve_known


class Served:
    """A service, what it answered, and a client of it."""

    def __init__(self, bench: Bench) -> None:
        self.bench, self.answered = bench, 0
        serve_known(bench.node, SetBool, "x", lambda request: bool(request.data), self.answer, self.refuse)
        self.client = bench.node.create_client(SetBool, "x")
        bench.wait(lambda: self.client.service_is_ready() and count_callers(bench.node, "x") == (1, 1), "the client")

    def answer(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        self.answered, response.success = self.answered + 1, True
        return response

    @staticmethod
    def refuse(response: SetBool.Response, refusal: str) -> SetBool.Response:
        response.message = refusal
        return response

    def call(self, on: bool) -> tuple[SetBool.Response, float]:
        """The response, and how long [s] it took."""
        begun, future = time.monotonic(), self.client.call_async(SetBool.Request(data=on))
        self.bench.wait(future.done, "an answer")
        return future.result(), time.monotonic() - begun


@pytest.mark.parametrize(
    ("counts", "on", "answers", "waits"),
    [
        ([(1, 1)], True, True, False),
        ([(1, 0), (1, 0)], True, False, True),
        ([(1, 0), (1, 1)], True, True, True),  # known by then
        ([(2, 1), (2, 1)], True, True, True),  # of a node that has two
        ([(1, 0)], False, True, False),  # whoever asks for no motion
    ],
)
def test_who_is_not_known_yet_is_waited_for_and_refused_if_nobody_is(
    bench: Bench, monkeypatch: pytest.MonkeyPatch, counts: list[tuple[int, int]], on: bool, answers: bool, waits: bool
) -> None:
    served, left = Served(bench), list(counts)
    monkeypatch.setattr(callers, "count_callers", lambda *_: left.pop(0))
    response, took = served.call(on)
    assert response.success is answers and served.answered == int(answers)
    assert (took >= 0.99 * KNOWN_AFTER) is waits
    assert answers or response.message == "Nobody knows yet which node calls /x: call again."


def test_the_node_goes_on_while_a_request_waits(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    served, ticks = Served(bench), []
    bench.node.create_timer(0.01, lambda: ticks.append(time.monotonic()))
    bench.wait(lambda: len(ticks) > 2, "the timer")
    monkeypatch.setattr(callers, "count_callers", lambda *_: (1, 0))
    before = len(ticks)
    served.call(True)
    assert len(ticks) - before > 5


def test_a_client_without_a_node_is_counted(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    served = Served(bench)
    assert count_callers(bench.node, "x") == (1, 1)
    monkeypatch.setattr(bench.node, "get_node_names_and_namespaces", lambda: [("gone", "/")])
    assert count_callers(bench.node, "x") == (1, 0)
    assert served.answered == 0
