"""The identification node: fits and diagnoses bags on request, in a process of its own, and latches the last model."""

import os
from dataclasses import replace
from datetime import datetime, timezone
from functools import partial
from typing import Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger

from motor_identification.bag import Source
from motor_identification.mapping import make_reader
from motor_identification.reporting.fit_model_file import save_model
from motor_identification.service.call_waiter import CallWaiter
from motor_identification.service.diagnose_action import DiagnoseAction
from motor_identification.service.fit_queue import FitQueue
from motor_identification.service.job import DiagnosisJob, Job, prepare
from motor_identification.service.messages import diagnosis_job_of, fill_response, job_of, model_message
from motor_identification.service.parameters import PARAMETERS, PROGRAM
from motor_identification.service.places import Places
from motor_identification.service.worker import Worker
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
        self._waiter = CallWaiter()
        self._worker = Worker(prepare)
        self._model = self.create_publisher(MotorModel, "motor/model", qos.MODEL)
        self._places = Places(*map(self._value, ("bag_directory", "report_directory", "absolute_uris")))
        self._reader = make_reader(self._value("mapping"))
        self._fits = FitQueue(self._worker, self._waiter.wait)
        # Each request is taken at once: one that stayed in DDS while a fit is awaited would get no answer but silence.
        at_once = ReentrantCallbackGroup()
        options = {"callback_group": at_once, "qos_profile": qos.REQUESTS}
        self.create_service(Identify, "motor/identify", self._on_identify, **options)
        self.create_service(Trigger, "motor/cancel", self._on_cancel, callback_group=at_once)
        limit = partial(self._value, "time_limit")
        self._diagnose = DiagnoseAction(self, self._worker, self._diagnosis_job, limit, self._waiter.wait, self._keep)
        self.get_logger().info("ready: call motor/identify, or send motor/diagnose a goal, with bag_uris")

    async def _on_identify(self, request: Identify.Request, response: Identify.Response) -> Identify.Response:
        try:
            job = self._job(request)
            self.get_logger().info(f"identifying {', '.join(job.source.uris)}")
            fit = await self._fits.fit(job, *map(self._value, ("queue_length", "time_limit")))
            fill_response(response, fit, *self._keep(fit))
        except MotorError as error:
            self.get_logger().error(str(error))
            response.success, response.message = False, str(error)
            return response
        self.get_logger().info(response.message)
        return response

    def _on_cancel(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        ended = self._fits.cancel()
        response.success, response.message = bool(ended), f"{ended} requests of motor/identify were ended."
        return response

    def _keep(self, fit: Fit) -> tuple[MotorModel, str]:
        """Write the model where that is wanted, latch it as a message; returns that, and why it was not written."""
        path, trouble = self._value("model_file"), ""
        try:
            if path:
                save_model(path, fit, datetime.now(timezone.utc).isoformat(timespec="seconds"))
        except MotorError as error:  # the fit is worth more
            trouble = str(error)
            self.get_logger().error(trouble)
        message = model_message(fit, self.get_clock().now().to_msg())
        self._model.publish(message)
        return message, trouble

    def _job(self, request: Identify.Request) -> Job:
        job = job_of(request, *map(self._value, ("particles", "epochs", "seed", "workers")))
        return replace(job, source=self._resolved(job.source))

    def _diagnosis_job(self, goal: Diagnose.Goal) -> tuple[DiagnosisJob, str, str]:
        job = diagnosis_job_of(goal, self._value("workers"))
        source, validation = self._resolved(job.source), tuple(map(self._places.bag, job.validation))
        report = self._places.report(source.uris[0])
        return replace(job, source=source, validation=validation), str(report), str(self._value("model_file"))

    def _resolved(self, source: Source) -> Source:
        if not source.uris:
            raise MotorError("bag_uris is empty: name at least one bag.")
        return replace(source, uris=tuple(map(self._places.bag, source.uris)), reader=self._reader)

    def _value(self, name: str) -> Any:
        value = self.get_parameter(name).value
        return (value or os.cpu_count() or 1) if name == "workers" else value

    def close(self) -> None:
        """End a computation that is still going on."""
        self._waiter.close()
        self._worker.close()


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_identification motor_identification`."""
    return run(MotorIdentification, args, program=PROGRAM)
