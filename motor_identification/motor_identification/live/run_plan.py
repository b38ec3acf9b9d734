"""Drives the live plant through a plan and records it; leaves the motor at 0 V however it ends."""

import sys
import time

import rclpy
from tqdm import tqdm

from motor_identification.bag import BagWriter
from motor_identification.live.experiment_node import Driver
from motor_identification.live.recorder import Recorder
from motor_model.errors import MotorError
from motor_ros.run import Interrupt, spin

PATIENCE = 10.0  # [s] for a plant to appear
RECORDED = ("motor/speed", "motor/info", "motor/voltage", "motor/model")


def drive(node: Driver, output: str, interrupt: Interrupt) -> int:
    """Run the plan on the live plant; returns the exit status.

    Raises:
        MotorError: no plant, one that falls silent, restarts, is switched off or too fast, another driver, or a bag
            that cannot be written.
    """
    try:
        _wait_for_plant(node, interrupt)
        if interrupt:
            return 130
        with BagWriter(output) as writer:
            if node.limit is not None and not _scaled(node, writer, interrupt):
                return 130
            writer.note("experiment", _words(node))
            recorder = Recorder(node, writer, [node.resolve_topic_name(topic) for topic in RECORDED])
            try:
                _follow(node, interrupt, recorder)
            finally:
                node.stop()
                recorder.close()
        if recorder.refusal:
            raise recorder.refusal
        if node.problem:
            raise MotorError(f"{node.problem} What was recorded until then is in {output}.")
        count = recorder.counts[node.resolve_topic_name("motor/speed")]
        how = "interrupted, " if interrupt else ""
        print(f"{output}: {how}{count} samples, {node.elapsed:.2f} s of '{node.profile.name}'{_peak(node)}")
        return 130 if interrupt else 0
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _wait_for_plant(node: Driver, interrupt: Interrupt) -> None:
    deadline = time.monotonic() + PATIENCE
    spin(
        node,
        lambda: bool((node.plan and node.heard) or node.failed() or interrupt) or time.monotonic() > deadline,
    )
    if node.problem:
        raise MotorError(node.problem)
    if (node.plan is None or node.heard is None) and not interrupt:
        topic = node.resolve_topic_name("motor/info" if node.plan is None else "motor/speed")
        raise MotorError(f"nothing on {topic}: start motor_sim or motor_driver, or simulate offline with --model.")


def _scaled(node: Driver, writer: BagWriter, interrupt: Interrupt) -> bool:
    """Find the voltage for a speed; however that ends, the motor gets 0 V, and without success there is no bag."""
    from motor_identification.live.speed_probe import scale  # compiled code, which no other experiment has to wait for

    done = False
    try:
        scale(node, interrupt)
        done = not interrupt
    finally:
        node.stop()
        if not done:
            writer.discard()
    return done


def _words(node: Driver) -> dict[str, str]:
    """What is going to be done, for the bag."""
    words = node.plan.words() if node.plan else {}
    if node.info:
        words |= {"motor": node.info.name, "source": node.info.source}
    return words | ({"speed_limit": repr(node.limit)} if node.limit else {})


def _peak(node: Driver) -> str:
    return f", peak {node.plan.voltage:g} V" if node.plan else ""


def _follow(node: Driver, interrupt: Interrupt, recorder: Recorder) -> None:
    """Start once the recorder hears the samples, and show progress until the plan is done."""
    speed = node.resolve_topic_name("motor/speed")

    def failed() -> bool:
        return bool(interrupt or recorder.refusal) or node.failed()

    spin(node, lambda: recorder.counts[speed] > 0 or failed())
    if node.plan is None or failed():
        return
    node.follow(node.plan)
    total = node.plan.duration
    columns = "{desc} {bar} {n:.1f}/{total:.1f} s"
    with tqdm(total=total, desc=node.profile.name, disable=None, file=sys.stderr, bar_format=columns) as bar:

        def over() -> bool:
            bar.update(min(node.elapsed, total) - bar.n)
            return node.done or failed()

        spin(node, over)


if __name__ == "__main__":
    sys.exit("run 'experiment' instead")
