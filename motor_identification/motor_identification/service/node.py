"""The identification node: fits and diagnoses bags on request, in a process of its own, and latches the last model."""

import os
from concurrent.futures import Future as Answer
from dataclasses import replace
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from rclpy.task import Future

from motor_identification.bag import Source
from motor_identification.reporting.fit_model_file import save_model
from motor_identification.service import warm_up
from motor_identification.service.diagnose_action import DiagnoseAction
from motor_identification.service.job import DiagnosisJob, Job, run_job
from motor_identification.service.messages import diagnosis_job_of, fill_response, job_of, model_message
from motor_identification.service.parameters import PARAMETERS, PROGRAM
from motor_identification.service.worker import STOPPED, Call, Ended, Worker
from motor_identification.uncertainty.result import Fit
from motor_model.errors import MotorError
from motor_msgs.action import Diagnose
from motor_msgs.msg import MotorModel
from motor_msgs.srv import Identify
from motor_ros import qos
from motor_ros.parameters import declare
from motor_ros.run import run


class MotorIdentification(Node):
    """Service motor/identify, action motor/diagnose and the latched topic motor/model."""

    def __init__(self) -> None:
        super().__init__("motor_identification")
        declare(self, PARAMETERS)
        self._closed = False
        self._worker = Worker(warm_up.main)
        self._model = self.create_publisher(MotorModel, "motor/model", qos.MODEL)
        alone = MutuallyExclusiveCallbackGroup()  # a group is blocked while its fit is awaited; parameters must not be
        self.create_service(Identify, "motor/identify", self._on_identify, callback_group=alone)
        self._diagnose = DiagnoseAction(self, self._worker, self._diagnosis_job, self._awaited, self._keep)
        self.get_logger().info("ready: call motor/identify, or send motor/diagnose a goal, with bag_uris")

    async def _on_identify(self, request: Identify.Request, response: Identify.Response) -> Identify.Response:
        try:
            job = self._job(request)
            self.get_logger().info(f"identifying {', '.join(job.source.uris)}")
            fit = await self._awaited(self._worker.submit(run_job, job))
            fill_response(response, fit, self._keep(fit))
        except MotorError as error:
            self.get_logger().error(str(error))
            response.success, response.message = False, str(error)
            return response
        self.get_logger().info(response.message)
        return response

    def _keep(self, fit: Fit) -> MotorModel:
        """Write the model where that is wanted, and latch it as the message that this returns."""
        path = self._value("model_file")
        if path:
            save_model(path, fit, datetime.now(timezone.utc).isoformat(timespec="seconds"))
        message = model_message(fit, self.get_clock().now().to_msg())
        self._model.publish(message)
        return message

    def _job(self, request: Identify.Request) -> Job:
        job = job_of(request, *map(self._value, ("particles", "epochs", "seed", "workers")))
        return replace(job, source=self._resolved(job.source))

    def _diagnosis_job(self, goal: Diagnose.Goal) -> tuple[DiagnosisJob, str, str]:
        job = diagnosis_job_of(goal, self._value("workers"))
        source, validation = self._resolved(job.source), tuple(map(self._path, job.validation))
        first = Path(source.uris[0]).absolute()
        report = Path(self._value("report_directory") or first.parent).absolute() / f"{first.name}_diagnosis.html"
        return replace(job, source=source, validation=validation), str(report), str(self._value("model_file"))

    def _resolved(self, source: Source) -> Source:
        if not source.uris:
            raise MotorError("bag_uris is empty: name at least one bag.")
        return replace(source, uris=tuple(map(self._path, source.uris)))

    def _path(self, uri: str) -> str:
        return str(Path(self._value("bag_directory") or ".") / uri)

    def _value(self, name: str) -> Any:
        value = self.get_parameter(name).value
        return (value or os.cpu_count() or 1) if name == "workers" else value

    def _awaited(self, call: Call) -> Future:
        """A future that the executor waits for while it serves other callbacks."""
        future = Future()

        def hand_over(answer: "Answer[Any]") -> None:
            if self._closed:  # nobody waits any more
                return
            error = Ended(STOPPED) if answer.cancelled() else answer.exception()
            if error is None:
                future.set_result(answer.result())
            else:
                future.set_exception(error)

        call.answer.add_done_callback(hand_over)
        return future

    def close(self) -> None:
        """End a computation that is still going on."""
        self._closed = True
        self._worker.close()


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_identification motor_identification`."""
    return run(MotorIdentification, args, program=PROGRAM)
