"""The action motor/diagnose: one diagnosis at a time, in the node's worker, with feedback and cancel."""

from collections.abc import Awaitable, Callable
from typing import Any

from rclpy.action import ActionServer, CancelResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node

from motor_identification.progress import Stage
from motor_identification.service.job import DiagnosisJob, Reported, run_reported
from motor_identification.service.messages import feedback_message, result_message
from motor_identification.service.worker import Call, Worker
from motor_identification.uncertainty.result import Fit
from motor_model.errors import MotorError
from motor_msgs.action import Diagnose
from motor_msgs.msg import MotorModel

BUSY = "a diagnosis is going on already: wait for its result, or cancel it."


class DiagnoseAction:
    """Serves goals on a node; a second goal beside a running one is aborted with a sentence.

    Args:
        node: whose action it is.
        worker: where the computing is done.
        job_of: what to compute for a goal, and the files for its report and its model ("": none); may raise a
            MotorError.
        limit: [s] that a diagnosis may take, now.
        awaited: turns a call into what a coroutine of the node can wait for.
        keep: does with the model of each success what the node does with its models, and returns it as a message,
            with a sentence about what could not be done (empty: nothing).
    """

    def __init__(
        self,
        node: Node,
        worker: Worker,
        job_of: Callable[[Diagnose.Goal], tuple[DiagnosisJob, str, str]],
        limit: Callable[[], float],
        awaited: Callable[[Call], Awaitable[Any]],
        keep: Callable[[Fit], tuple[MotorModel, str]],
    ) -> None:
        self._node, self._worker, self._job_of, self._awaited, self._keep = node, worker, job_of, awaited, keep
        self._limit = limit
        self._running: Call | None = None
        self._goal: ServerGoalHandle | None = None
        self._progress = 0.0  # of it; its parts are done in any order, and nobody wants to see it fall
        self._server = ActionServer(node, Diagnose, "motor/diagnose", self._on_goal, cancel_callback=self._on_cancel)

    async def _on_goal(self, goal: ServerGoalHandle) -> Diagnose.Result:
        if self._goal is not None:
            return self._refused(goal, MotorError(BUSY))
        self._goal, self._progress = goal, 0.0
        try:
            return await self._diagnosed(goal)
        except MotorError as error:
            return self._refused(goal, error)
        finally:
            self._goal = self._running = None

    async def _diagnosed(self, goal: ServerGoalHandle) -> Diagnose.Result:
        job, report, model = self._job_of(goal.request)
        self._node.get_logger().info(f"diagnosing {', '.join(job.source.uris)}")
        self._running = self._worker.submit(run_reported, job, report, model, heard=self._hear, limit=self._limit())
        if goal.is_cancel_requested:  # before there was anything to stop
            self._running.stop()
        reported: Reported = await self._awaited(self._running)
        result = result_message(reported, *self._keep(reported.diagnosis.model))
        goal.succeed()
        self._node.get_logger().info(result.message)
        return result

    def _refused(self, goal: ServerGoalHandle, error: MotorError) -> Diagnose.Result:
        if goal.is_cancel_requested:
            goal.canceled()
            self._node.get_logger().info(str(error))
        else:
            goal.abort()
            self._node.get_logger().error(str(error))
        return Diagnose.Result(success=False, message=str(error))

    def _on_cancel(self, goal: ServerGoalHandle) -> CancelResponse:
        if self._running is not None and goal is self._goal:
            self._running.stop()
        return CancelResponse.ACCEPT

    def _hear(self, stage: Stage) -> None:
        """From the worker's thread to the node's, which alone speaks to ROS."""
        executor, goal = self._node.executor, self._goal
        if executor is not None and goal is not None:
            executor.create_task(self._tell, goal, stage)

    def _tell(self, goal: ServerGoalHandle, stage: Stage) -> None:
        if goal.is_active:
            self._progress = max(self._progress, stage.share)
            goal.publish_feedback(feedback_message(stage, self._progress))
