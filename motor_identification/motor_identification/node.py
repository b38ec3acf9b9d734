"""The identification node: fits models to bags on request, in a process of its own, and latches the last one."""

import os
from concurrent.futures import Future as WorkerResult
from dataclasses import replace
from datetime import datetime, timezone
from pathlib import Path

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from rclpy.task import Future

from motor_identification import warm_up
from motor_identification.findings import save_model
from motor_identification.fit import Fit
from motor_identification.job import Job, run_job
from motor_identification.messages import fill_response, job_of
from motor_identification.worker import Worker
from motor_model.errors import MotorError
from motor_msgs.msg import MotorModel
from motor_msgs.srv import Identify
from motor_ros import qos
from motor_ros.parameters import Row, declare
from motor_ros.run import run

PARAMETERS = (
    Row("bag_directory", "", "where relative bag_uris are looked for; empty: the working directory"),
    Row("model_file", "", "every identified model is also written here (YAML); empty: nowhere"),
    Row("particles", 50, "of the swarm", "", 2, 100_000),
    Row("epochs", 200, "of the swarm at most", "", 1, 1_000_000),
    Row("seed", 0, "of the swarm", "", 0, 2**31 - 1),
    Row("workers", 0, "threads that simulate; 0: all cores", "", 0, 1024),
)


class MotorIdentification(Node):
    """Service motor/identify and the latched topic motor/model."""

    def __init__(self) -> None:
        super().__init__("motor_identification")
        declare(self, PARAMETERS)
        self._closed = False
        self._worker = Worker(warm_up.main)
        self._model = self.create_publisher(MotorModel, "motor/model", qos.MODEL)
        alone = MutuallyExclusiveCallbackGroup()  # a group is blocked while its fit is awaited; parameters must not be
        self.create_service(Identify, "motor/identify", self._on_identify, callback_group=alone)
        self.get_logger().info("ready: call motor/identify with bag_uris")

    async def _on_identify(self, request: Identify.Request, response: Identify.Response) -> Identify.Response:
        try:
            job = self._job(request)
            self.get_logger().info(f"identifying {', '.join(job.uris) or 'nothing'}")
            fit = await self._in_worker(job)
            self._keep(fit)
        except MotorError as error:
            self.get_logger().error(str(error))
            response.success, response.message = False, str(error)
            return response
        fill_response(response, fit, self.get_clock().now().to_msg())
        self._model.publish(response.model)
        self.get_logger().info(response.message)
        return response

    def _keep(self, fit: Fit) -> None:
        path = self.get_parameter("model_file").value
        if path:
            save_model(path, fit, datetime.now(timezone.utc).isoformat(timespec="seconds"))

    def _job(self, request: Identify.Request) -> Job:
        if not request.bag_uris:
            raise MotorError("bag_uris is empty: name at least one bag.")
        value = {row.name: self.get_parameter(row.name).value for row in PARAMETERS}
        job = job_of(
            request, value["particles"], value["epochs"], value["seed"], value["workers"] or os.cpu_count() or 1
        )
        directory = Path(value["bag_directory"] or ".")
        return replace(job, uris=tuple(str(directory / uri) for uri in job.uris))

    def _in_worker(self, job: Job) -> Future:
        """A future that the executor waits for while it serves other callbacks."""
        answer = Future()

        def hand_over(result: "WorkerResult[Fit]") -> None:
            if self._closed:  # nobody waits any more
                return
            error = result.exception()
            if error is None:
                answer.set_result(result.result())
            elif isinstance(error, MotorError):
                answer.set_exception(error)
            else:
                answer.set_exception(MotorError(f"the computation broke: {type(error).__name__}: {error}"))

        self._worker.submit(run_job, job).add_done_callback(hand_over)
        return answer

    def close(self) -> None:
        """End a computation that is still going on."""
        self._closed = True
        self._worker.close()


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_identification motor_identification`."""
    return run(MotorIdentification, args)
