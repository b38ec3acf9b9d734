"""Let a node's coroutines wait for calls of the worker while its executor serves other callbacks."""

from concurrent.futures import Future as Answer
from typing import Any

from rclpy.task import Future

from motor_identification.service.worker import STOPPED, Call, Ended


class CallWaiter:
    """Turns calls into futures of rclpy; after `close` nobody waits any more."""

    def __init__(self) -> None:
        self._closed = False

    def wait(self, call: Call) -> Future:
        """A future with the call's result, or with the error that ended it."""
        future = Future()

        def hand_over(answer: "Answer[Any]") -> None:
            if self._closed:
                return
            error = Ended(STOPPED) if answer.cancelled() else answer.exception()
            if error is None:
                future.set_result(answer.result())
            else:
                future.set_exception(error)

        call.answer.add_done_callback(hand_over)
        return future

    def close(self) -> None:
        """Leave those who wait without an answer: the node ends."""
        self._closed = True
