"""The worker process: answers, progress, and an end to what is no longer wanted; its death is a sentence."""

import multiprocessing
import os
import queue
import signal
from collections.abc import Iterator
from concurrent.futures import CancelledError
from pathlib import Path

import pytest
import worker_calls as calls
from patience import PATIENCE

from motor_identification.service.worker import Call, Worker
from motor_model.errors import MotorError, RecordingError


@pytest.fixture(scope="module")
def worker() -> Iterator[Worker]:
    """One for all tests: it has to be fit for the next call after each."""
    worker = Worker(calls.nothing)
    yield worker
    worker.close()


def begun(worker: Worker, function: object) -> Call:
    """A call that is being computed."""
    heard: queue.Queue[str] = queue.Queue()
    call = worker.submit(function, heard=heard.put)  # type: ignore[arg-type]
    assert heard.get(timeout=PATIENCE) == "begun"
    return call


def still_works(worker: Worker) -> bool:
    return bool(worker.submit(calls.add, 2, 3).answer.result(PATIENCE) == 5)


def test_answers_and_tells_everything_in_between(worker: Worker) -> None:
    heard: list[tuple[str, int]] = []
    call = worker.submit(calls.count, 200, heard=lambda *told: heard.append(told))
    assert call.answer.result(PATIENCE) == 200
    assert sorted(heard) == [("counted", k) for k in range(200)]


def test_stays_the_same_process(worker: Worker) -> None:
    processes = {worker.submit(calls.process).answer.result(PATIENCE) for _ in range(3)}
    assert len(processes) == 1 and os.getpid() not in processes


def test_a_computation_that_obeys_ends_itself_and_its_process_lives(worker: Worker) -> None:
    before = worker.submit(calls.process).answer.result(PATIENCE)
    call = begun(worker, calls.obey)
    call.stop()
    with pytest.raises(RecordingError, match=r"^stopped by itself\.$"):
        call.answer.result(PATIENCE)
    assert worker.submit(calls.process).answer.result(PATIENCE) == before
    again = begun(worker, calls.obey)  # an old word to stop does not count
    assert not again.answer.done()
    again.stop()
    assert again.answer.exception(PATIENCE) is not None


def test_a_computation_that_does_not_obey_is_ended(worker: Worker) -> None:
    before = worker.submit(calls.process).answer.result(PATIENCE)
    call = begun(worker, calls.ignore)
    call.stop()
    with pytest.raises(MotorError, match=r"^the computation was stopped\.$"):
        call.answer.result(PATIENCE)
    assert worker.submit(calls.process).answer.result(PATIENCE) != before
    assert not Path(f"/proc/{before}").exists()


def test_a_computation_that_takes_too_long_is_ended(worker: Worker) -> None:
    call = worker.submit(calls.ignore, heard=lambda *told: None, limit=0.5)
    with pytest.raises(MotorError, match=r"^the computation took longer than 0\.5 s \(time_limit\) and was ended: "):
        call.answer.result(PATIENCE)
    assert worker.submit(calls.add, 2, 3, limit=PATIENCE).answer.result(PATIENCE) == 5


def test_what_has_not_begun_is_not_begun(worker: Worker) -> None:
    first = begun(worker, calls.obey)
    second = worker.submit(calls.vanish)
    second.stop()
    with pytest.raises(CancelledError):
        second.answer.result(0.0)
    first.stop()
    with pytest.raises(RecordingError):
        first.answer.result(PATIENCE)
    assert still_works(worker)


def test_a_killed_process_is_a_sentence_and_replaced(worker: Worker) -> None:
    process = worker.submit(calls.process).answer.result(PATIENCE)
    call = begun(worker, calls.ignore)
    os.kill(process, signal.SIGKILL)
    with pytest.raises(MotorError, match=r"the computing process was killed \(SIGKILL\).*try again"):
        call.answer.result(PATIENCE)
    assert still_works(worker)


def test_a_process_killed_between_two_calls_is_replaced(worker: Worker) -> None:
    process = worker.submit(calls.process).answer.result(PATIENCE)
    os.kill(process, signal.SIGKILL)
    while process in {child.pid for child in multiprocessing.active_children()}:  # its threads end one by one
        pass
    assert still_works(worker)


def test_a_listener_that_stumbles_is_a_sentence(worker: Worker) -> None:
    call = worker.submit(calls.obey, heard=lambda *told: [].pop())
    with pytest.raises(
        MotorError, match=r"^this is a mistake of the workbench, not yours \(IndexError: pop from empty list\); "
    ):
        call.answer.result(PATIENCE)
    assert still_works(worker)


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (calls.refuse, r"^the motor never moves\.$"),
        (
            calls.stumble,
            r"^this is a mistake of the workbench, not yours \(ZeroDivisionError: float division by zero\); ",
        ),
        (calls.vanish, r"^the computing process ended with status 3, "),
        (calls.unsendable, r"^this is a mistake of the workbench, not yours \(TypeError: cannot pickle"),
    ],
)
def test_a_failure_is_a_sentence(worker: Worker, function: object, words: str) -> None:
    with pytest.raises(MotorError, match=words):
        worker.submit(function).answer.result(PATIENCE)  # type: ignore[arg-type]
    assert still_works(worker)


def test_closing_ends_the_process_whatever_it_does() -> None:
    worker = Worker(calls.nothing)
    process = worker.submit(calls.process).answer.result(PATIENCE)
    call = begun(worker, calls.ignore)
    worker.close()
    assert not Path(f"/proc/{process}").exists()
    assert isinstance(call.answer.exception(PATIENCE), MotorError)
