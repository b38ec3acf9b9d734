"""Fits that were asked for: one is computed, a few wait, and more are told so at once instead of never."""

from collections.abc import Awaitable, Callable
from typing import Any

from motor_identification.service.job import Job, run_job
from motor_identification.service.worker import Call, Worker
from motor_identification.uncertainty.result import Fit
from motor_model.errors import MotorError


class FitQueue:
    """Hands fits to a worker, in the order in which they come.

    Args:
        worker: where they are computed.
        awaited: turns a call into what a coroutine can wait for.
    """

    def __init__(self, worker: Worker, awaited: Callable[[Call], Awaitable[Any]]) -> None:
        self._worker, self._awaited = worker, awaited
        self._calls: list[Call] = []  # the one that is computed, and those that wait

    async def fit(self, job: Job, most: int, limit: float) -> Fit:
        """The fit, when its turn has come; `most` may wait beside the one that is computed, each takes `limit` s.

        Raises:
            MotorError: it cannot be done, or too many wait already.
        """
        if len(self._calls) > most:
            raise MotorError(
                f"busy: {most} requests wait already (queue_length): call again later, or end them with motor/cancel."
            )
        call = self._worker.submit(run_job, job, limit=limit)
        self._calls.append(call)
        try:
            fit: Fit = await self._awaited(call)
            return fit
        finally:
            self._calls.remove(call)

    def cancel(self) -> int:
        """End all of them; returns how many."""
        for call in self._calls:
            call.stop()
        return len(self._calls)
