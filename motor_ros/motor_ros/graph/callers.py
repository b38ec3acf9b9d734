"""Answer requests that may move a motor once it is known who may have asked: no recording that is played does.

The middleware tells a server of a client first, then of its node's name, and then of what that serves, as it does of
publishers (see `acquaintances`); a request may come before all of that, and rclpy does not say whose it is. So it waits
until every client of the service is known, and is refused if one of them plays a recording. Nothing else of the node
waits meanwhile, and who asks is answered late, not asked to call again: whoever calls once, such as `ros2 service
call`, is always new.
"""

import time
from collections import deque
from collections.abc import Callable
from typing import Any, NamedTuple

from rclpy.node import Node
from rclpy.service import Service

from motor_ros.clocks.steady_timer import steady_timer
from motor_ros.graph.acquaintances import PATIENCE, Acquaintances, Verdict
from motor_ros.graph.players import CALLED, find_players_among
from motor_ros.graph.publishers import list_clients
from motor_ros.parameter_requests import parameter_setters, refuse_setting

LOOK_EVERY = 0.05  # [s]
UNKNOWN = "Nobody knows which node calls {}, or it has ended: call again."

Refuse = Callable[[Any, Any, str], Any]


class Waiting(NamedTuple):
    """A request that waits, what is to be filled in, whose it is to the middleware, and when [ns] it came."""

    request: Any
    response: Any
    header: Any
    at: int


class Callers:
    """Those who may call a node's services: to set its parameters, and what it has them look at beside."""

    def __init__(self, node: Node) -> None:
        """Let parameters of a node be set once it is known who may set them, and by no recording that is played."""
        self._node = node
        self._guarded = [Guarded(node, one, lambda _: True, refuse_setting) for one in parameter_setters(node)]
        steady_timer(node, LOOK_EVERY, self._on_look)  # one for all: rclpy warns of many

    def guard(self, service: Service, asks: Callable[[Any], bool], refuse: Refuse) -> "Guarded":
        """Stand between the requests of a service of the node and its callback.

        Args:
            service: its callback is called as before, for each request when that is let on.
            asks: whether a request asks for what may move a motor: all others are let on at once.
            refuse: fills in the response that is a refusal, of the request, a response, and a sentence.
        """
        self._guarded.append(Guarded(self._node, service, asks, refuse))
        return self._guarded[-1]

    def _on_look(self) -> None:
        for one in self._guarded:
            one.answer_known()


class Guarded:
    """One service, those who may call it, and their requests that wait."""

    def __init__(self, node: Node, service: Service, asks: Callable[[Any], bool], refuse: Refuse) -> None:
        self._node, self._service, self._asks, self._refuse = node, service, asks, refuse
        self._effect, self._respond = service.callback, service.send_response
        self._acquaintances, self._kept = Acquaintances(awaited=True), Waiting(None, None, None, 0)
        self._waiting: deque[Waiting] = deque()
        service.callback, service.send_response = self._on_request, self._on_response  # as every executor calls them

    def refuse_waiting(self, why: str) -> None:
        """Refuse all requests that wait, as a sentence says: they were made before what has happened now."""
        while self._waiting:
            one = self._waiting.popleft()
            self._respond(self._refuse(one.request, one.response, why), one.header)

    def answer_known(self) -> None:
        """Look who is there, and answer the requests of which it is known by now who may have sent them."""
        self._look()
        while self._waiting:
            one, now = self._waiting[0], time.monotonic_ns()
            verdict = self._judge(one.at, now)
            if verdict is Verdict.WAITS:
                return
            self._waiting.popleft()
            if verdict is Verdict.OBEYED:
                self._respond(self._effect(one.request, one.response), one.header)
            else:
                self._respond(self._refuse(one.request, one.response, self._say_why()), one.header)

    def _on_request(self, request: Any, response: Any) -> Any:
        if not self._asks(request):
            return self._effect(request, response)
        self._look()
        at = time.monotonic_ns()
        verdict = self._judge(at, at)
        if verdict is Verdict.OBEYED and not self._waiting:
            return self._effect(request, response)
        refused = self._refuse(request, response, self._say_why())  # an executor that answers by itself says this
        if verdict is not Verdict.REFUSED:
            self._kept = Waiting(request, response, None, at)
        return refused

    def _on_response(self, response: Any, header: Any) -> None:
        kept, self._kept = self._kept, Waiting(None, None, None, 0)
        if kept.response is not None and kept.response is response:
            self._waiting.append(kept._replace(header=header, response=type(response)()))
        else:
            self._respond(response, header)

    def _look(self) -> None:
        there, now = list_clients(self._node, self._service.service_name), time.monotonic_ns()
        met = self._acquaintances.look(there, set(), now)
        players = find_players_among(self._node, there) if met.watches(now) or self._acquaintances.players else set()
        self._acquaintances = self._acquaintances.look(there, players, now)

    def _judge(self, at: int, now: int) -> Verdict:
        if self._acquaintances.known or self._acquaintances.players:
            return self._acquaintances.judge(at, now)
        return Verdict.WAITS if now - at <= PATIENCE else Verdict.REFUSED  # who asks is not even listed yet

    def _say_why(self) -> str:
        name, players = self._service.service_name, self._acquaintances.players
        return CALLED.format(name, players) if players else UNKNOWN.format(name)
