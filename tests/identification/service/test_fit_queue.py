"""Fits that wait: in order, not too many, and all of them can be ended."""

import asyncio
from concurrent.futures import Future
from typing import Any

import pytest

from motor_identification.bag import Source
from motor_identification.service.fit_queue import FitQueue
from motor_identification.service.job import Job
from motor_identification.service.worker import Call
from motor_model.errors import MotorError

JOB = Job(Source(("bag",)))


class Bench:
    """A worker that computes when the test says so."""

    def __init__(self) -> None:
        self.calls: list[Call] = []

    def submit(self, function: Any, *arguments: Any, limit: float) -> Call:
        self.calls.append(Call(function, arguments, None, limit, Future()))
        return self.calls[-1]


def test_one_is_computed_two_wait_and_the_next_is_told_so() -> None:
    async def ask() -> None:
        bench = Bench()
        queue = FitQueue(bench, lambda call: asyncio.wrap_future(call.answer))  # type: ignore[arg-type]
        asked = [asyncio.create_task(queue.fit(JOB, 2, 7.0)) for _ in range(3)]
        await asyncio.sleep(0)
        with pytest.raises(MotorError, match=r"^busy: 2 requests wait already \(queue_length\): call again later"):
            await queue.fit(JOB, 2, 7.0)
        assert len(bench.calls) == 3 and {call.limit for call in bench.calls} == {7.0}
        bench.calls[0].answer.set_result("a fit")
        assert await asked[0] == "a fit"
        again = asyncio.create_task(queue.fit(JOB, 2, 7.0))  # there is room now
        await asyncio.sleep(0)
        assert queue.cancel() == 3 and len(bench.calls) == 4
        for task in (*asked[1:], again):
            with pytest.raises(asyncio.CancelledError):
                await task
        assert queue.cancel() == 0

    asyncio.run(ask())
