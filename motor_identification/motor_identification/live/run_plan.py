"""Drives the live plant through a plan and records it; leaves the motor at 0 V however it ends."""

import sys
import time
from functools import partial
from pathlib import Path

import rclpy
from tqdm import tqdm

from motor_identification.bag import BagWriter, check_new_bag
from motor_identification.experiment import announce
from motor_identification.live.experiment_node import Driver
from motor_identification.live.plant_watch import OUTPUT_OFF
from motor_identification.live.recorder import Recorder
from motor_model.errors import MotorError
from motor_ros.graph.open_sockets import refuse_open_sockets
from motor_ros.run import Interrupt, spin

PATIENCE = 10.0  # [s] for a plant to appear
SILENT = 1.0  # [s] of that, before somebody who looks is told what is waited for
DIAGNOSTICS = 1.5  # [s] in which a plant, which says how it is once a second, has said so
SWITCH = "motor/enable"  # in what a plant's diagnostics say of an output that is off
RECORDED = ("motor/speed", "motor/info", "motor/voltage", "motor/model")


def drive(node: Driver, output: str, interrupt: Interrupt, replace: bool = False) -> int:
    """Run the plan on the live plant; returns the exit status. `replace` lets the bag replace one that is there.

    A bag that is not complete gets another name, so that the next attempt can have this one.

    Raises:
        MotorError: the node is open to the network, no plant, one that falls silent, restarts, is switched off or too
            fast, another driver, or a bag that cannot be written.
    """
    try:
        refuse_open_sockets(node)
        check_new_bag(Path(output), replace)
        _wait_for_plant(node, interrupt)
        return 130 if interrupt else _record(node, BagWriter(output, replace), interrupt)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _record(node: Driver, writer: BagWriter, interrupt: Interrupt) -> int:
    if node.limit is not None and not _scaled(node, writer, interrupt):
        return 130
    writer.note("experiment", _words(node))
    recorder = Recorder(node, writer, [node.resolve_topic_name(topic) for topic in RECORDED])
    done = False
    try:
        _follow(node, interrupt, recorder)
        done = not (interrupt or node.problem or recorder.refusal)
    finally:
        node.stop()
        recorder.close()
        bag = _closed(writer, done)
    if node.problem.startswith(OUTPUT_OFF):
        _ask_plant(node, interrupt)
    _raise_problem(recorder.refusal, node, bag)
    count = recorder.counts[node.resolve_topic_name("motor/speed")]
    how = "interrupted, " if interrupt else ""
    print(f"{bag or writer.path}: {how}{count} samples, {node.elapsed:.2f} s of '{node.profile.name}'{_peak(node)}")
    return 130 if interrupt else 0


def _closed(writer: BagWriter, done: bool) -> Path | None:
    """Where the bag is: under its own name only if it is complete."""
    if not done:
        return writer.set_aside()
    writer.close()
    return writer.path


def _ask_plant(node: Driver, interrupt: Interrupt) -> None:
    """Wait for what the plant's diagnostics, which come once a second, say of an output that is off."""
    deadline = time.monotonic() + DIAGNOSTICS
    spin(node, lambda: bool(node.plant_says or interrupt) or time.monotonic() > deadline)


def _raise_problem(refusal: MotorError | None, node: Driver, bag: Path | None) -> None:
    """Raise what ended the experiment, if something did, with the place of what was recorded."""
    kept = f" The recording up to then is in {bag}." if bag else ""
    if refusal:
        raise MotorError(f"{refusal}{kept}") from refusal
    if node.problem:  # the plant knows best why its output is off
        raise MotorError(f"{node.plant_says if SWITCH in node.plant_says else node.problem}{kept}")


def _is_found(node: Driver, interrupt: Interrupt, until: float) -> bool:
    """Whether a plant answers, waiting has ended, or something is wrong."""
    return bool((node.plan and node.heard) or node.failed() or interrupt) or time.monotonic() > until


def _wait_for_plant(node: Driver, interrupt: Interrupt) -> None:
    deadline = time.monotonic() + PATIENCE
    for until in (deadline - PATIENCE + SILENT, deadline):
        spin(node, partial(_is_found, node, interrupt, until))
        if node.problem:
            raise MotorError(node.problem)
        if (node.plan is not None and node.heard is not None) or interrupt:
            return
        topic = node.resolve_topic_name("motor/info" if node.plan is None else "motor/speed")
        if until < deadline:
            print(f"Waiting for a plant on {topic}, {PATIENCE:g} s at most.", file=sys.stderr, flush=True)
    raise MotorError(f"Nothing on {topic}: {_elsewhere(node)}")


def _elsewhere(node: Driver) -> str:
    """Where there are plants, or how to get one."""
    suffix = "/motor/info"
    names = [name for name, _types in node.get_topic_names_and_types() if name.endswith(suffix)]
    found = sorted(name[: -len(suffix)] or "/" for name in names if node.count_publishers(name))
    if len(found) == 1:
        return f"there is a plant in {found[0]}: say --topic-namespace {found[0]}."
    if not found:
        return "start motor_sim or motor_driver, or simulate offline with --model."
    options = " or ".join(f"--topic-namespace {namespace}" for namespace in found)
    return f"there are plants in {' and '.join(found)}: say {options}."


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

    node.heard = time.monotonic()  # nobody has listened while the recorder was made
    spin(node, lambda: recorder.counts[speed] > 0 or failed())
    if node.plan is None or failed():
        return
    if node.info:
        print(announce(node.plan, node.info.name, node.info.max_voltage, node.limit), flush=True)
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
