"""A worker process for long computations: the node that asks stays alive, hears how far it is, and can end it."""

import multiprocessing
import os
import queue
import signal
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from typing import Any

from motor_model.errors import MotorError
from motor_model.program.internal_error import report

GRACE = 0.5  # [s] that a computation has to stop by itself; after that its process is ended
LOOK_EVERY = 0.1  # [s] how long it takes at most to notice that a computation is to stop
STOPPED = "the computation was stopped."
LATE = "the computation took longer than {:g} s (time_limit) and was ended: use a shorter part of the recording."


class Ended(MotorError):
    """A computation was stopped, or its process has died."""


@dataclass(frozen=True)
class Call:
    """A computation that was asked for: `answer` gets its result or its MotorError, from another thread."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    heard: Callable[..., None] | None  # of progress, also in another thread
    limit: float = float("inf")  # [s] that it may take
    answer: "Future[Any]" = field(default_factory=Future)
    unwanted: threading.Event = field(default_factory=threading.Event)

    def stop(self) -> None:
        """End it: at once where it has not begun, else within `GRACE`."""
        self.unwanted.set()
        self.answer.cancel()


class Worker:
    """One process, started at once so that its imports are done when the first call comes; a dead one is replaced."""

    def __init__(self, prepare: Callable[[], object]) -> None:
        self._context = multiprocessing.get_context("spawn")  # fork would copy DDS threads in an unknown state
        self._prepare = prepare
        self._calls: queue.SimpleQueue[Call | None] = queue.SimpleQueue()
        self._starting = threading.Lock()
        self._closed = False
        self._start()
        self._server = threading.Thread(target=self._serve, daemon=True)
        self._server.start()

    def submit(
        self,
        function: Callable[..., Any],
        *arguments: Any,
        heard: Callable[..., None] | None = None,
        limit: float = float("inf"),
    ) -> Call:
        """Queue a call that may take `limit` s. With `heard`, the function gets `progress` and `stopped` by names."""
        call = Call(function, arguments, heard, limit)
        self._calls.put(call)
        return call

    def close(self) -> None:
        """End the process, whatever it is doing."""
        with self._starting:
            self._closed = True
            self._process.terminate()
        self._calls.put(None)
        self._server.join()
        self._process.join()

    def _start(self) -> None:
        with self._starting:
            if self._closed:
                return
            self._connection, theirs = self._context.Pipe()
            self._process = self._context.Process(target=_work, args=(theirs, self._prepare), daemon=True)
            self._process.start()
            theirs.close()  # so that its end is seen here

    def _serve(self) -> None:
        while (call := self._calls.get()) is not None:
            if not call.answer.set_running_or_notify_cancel():
                continue
            if not self._process.is_alive():
                self._start()
            try:
                call.answer.set_result(self._computed(call))
            except MotorError as error:
                call.answer.set_exception(error)
            except Exception as error:  # of who heard the progress: the next call must not get this one's answer
                self._replace()
                call.answer.set_exception(report(error))

    def _replace(self) -> None:
        self._process.kill()
        self._process.join()
        self._start()

    def _computed(self, call: Call) -> Any:
        """What the process says in the end; while it computes, what it tells is handed on."""
        deadline, latest = float("inf"), time.monotonic() + call.limit
        try:
            self._connection.send((call.function, call.arguments, call.heard is not None))
            while True:
                if call.unwanted.is_set() and deadline == float("inf"):
                    self._connection.send(None)
                    deadline = time.monotonic() + GRACE
                if time.monotonic() > deadline:
                    self._replace()
                    raise Ended(STOPPED)
                if time.monotonic() > latest:
                    self._replace()
                    raise Ended(LATE.format(call.limit))
                if self._connection.poll(LOOK_EVERY):
                    kind, value = self._connection.recv()
                    if kind == "answer":
                        return value
                    if kind == "error":
                        raise value
                    if call.heard is not None:
                        call.heard(*value)
        except (EOFError, OSError):
            self._process.join()
            code = self._process.exitcode or 0
            self._start()
            raise Ended(_died(code)) from None


def _died(code: int) -> str:
    how = f"was killed ({signal.Signals(-code).name})" if code < 0 else f"ended with status {code}"
    return (
        f"the computing process {how}, possibly for lack of memory: try again, or with a shorter part of the recording."
    )


def _work(connection: Connection, prepare: Callable[[], object]) -> None:
    """The process: calls one after the other, each answered over the connection."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C in the terminal is for the node, which ends its worker itself
    calls: queue.SimpleQueue[tuple[Any, ...]] = queue.SimpleQueue()
    unwanted = threading.Event()
    threading.Thread(target=_listen, args=(connection, calls, unwanted), daemon=True).start()
    prepare()
    speaking = threading.Lock()  # progress comes from any thread

    def say(kind: str, value: Any) -> None:
        with speaking:
            connection.send((kind, value))

    while True:
        function, arguments, told = calls.get()
        hooks = {"progress": lambda *told: say("told", told), "stopped": unwanted.is_set} if told else {}
        try:
            say("answer", function(*arguments, **hooks))
        except MotorError as error:
            say("error", error)
        except Exception as error:
            say("error", report(error))


def _listen(connection: Connection, calls: "queue.SimpleQueue[tuple[Any, ...]]", unwanted: threading.Event) -> None:
    """Take calls, and the word to stop one; where the node has gone, go too."""
    try:
        while True:
            message = connection.recv()
            if message is None:
                unwanted.set()
            else:
                unwanted.clear()
                calls.put(message)
    except (EOFError, OSError):
        os._exit(1)
