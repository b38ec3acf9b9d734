"""A worker process for long computations: the node that asks stays alive, and can end the work at any moment."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor
from typing import Any, TypeVar

T = TypeVar("T")


def _begin() -> None:
    """Ctrl-C in the terminal is for the node, which ends its worker itself; if it is killed, so is the worker."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_follow_the_parent, daemon=True).start()


def _follow_the_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


class Worker:
    """One process, started at once so that its imports are done when the first job comes."""

    def __init__(self, prepare: Callable[[], object]) -> None:
        context = multiprocessing.get_context("spawn")  # fork would copy DDS threads in an unknown state
        self._pool = ProcessPoolExecutor(1, mp_context=context, initializer=_begin)
        self._pool.submit(prepare)

    def submit(self, function: Callable[..., T], *arguments: Any) -> "Future[T]":
        """Queue a call; its result or exception arrives in the future, from another thread."""
        return self._pool.submit(function, *arguments)

    def close(self) -> None:
        """End the process, whatever it is doing."""
        for process in list((self._pool._processes or {}).values()):
            process.terminate()
        self._pool.shutdown(wait=True, cancel_futures=True)  # the pool has to see it, or it stumbles at exit
