"""Faults that come between programs, injected live: the simulated plant's shell, and others as processes over ROS 2.

One motor (174 rad/s, 12 V) at 200 Hz. Time is the wall clock's, as a listener hears it, so that what a busy machine is
late by is in it; speeds are those that the plants report.
"""

import re
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from faults_clock import HOUR, SetClock
from faults_held_up import BOTH, CONTROLLER, LONG, PLANT, SHORT, HeldUp, cut_supply
from faults_live_stage import MOTOR, Stage, stage
from faults_loop import Outcome, outcome
from faults_twice import end_first, end_second, launch_both, launch_twice
from geometry_msgs.msg import Twist
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Header
from std_srvs.srv import SetBool, Trigger
from workbench import program

from motor_msgs.msg import MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import time_message, voltage_message

# [s] from when it could be known; where what has been recorded is written every half a second; and watched
KNOWN, KNOWN_AT_WRITING, WATCHED = 0.15, 0.65, 3.0
WANTED, OVERSHOOT = 0.5, 0.1  # of the top speed, and of that: a loop that goes on may be so much faster for a moment
DAY = 86_400_000_000_000  # [ns]
LOGGED = re.compile(r"^\[\w+\] \[[\d.]+\] \[\w+\]: ")  # what begins a line of a log
HEAD = "| fault | may take | ms | speed | voltage | what was said |\n|---|---|---|---|---|---|"


def recorded(stage: Stage) -> Path:
    """A recording of the same motor under steps of 12 V."""
    bag = stage.folder / "bag"
    words = [program("motor_identification", "experiment"), "rich", "--model", stage.model, "--output", bag]
    subprocess.run(list(map(str, words)), check=True, capture_output=True)
    return bag


def play_bag(stage: Stage) -> None:
    """All topics of a recording are played onto a plant that stands."""
    bag = recorded(stage)
    stage.plant("live")
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    heard = stage.bench.hear(MotorVoltage, "motor/voltage")
    stage.run("motor_identification", "play", bag, "--rate", "1")
    stage.until(lambda: any(message.voltage for message in heard), "a voltage of the recording")


def republish(stage: Stage, kind: str, topic: str, renewed: bool) -> None:
    """A program of somebody's own reads a recording of yesterday and publishes what was asked for then.

    kind: what; renewed: with the stamps of now in place of those that were recorded.
    """
    stage.plant()
    stage.controller("", "-p", "joint_command_timeout:=0.5")
    stage.until(lambda: len(stage.moments) > 50 and bool(stage.said), "the loop")
    messages = {
        "voltage": (MotorVoltage, lambda now: voltage_message(6.0, time_message(now), "")),
        "joint": (JointState, lambda now: JointState(header=header_at(now), name=["motor"], velocity=[80.0])),
        "reference": (Float64, lambda now: Float64(data=80.0)),  # which has no stamp
    }
    message, make = messages[kind]
    publisher = stage.bench.publisher(message, topic, qos.COMMANDS)
    stage.bench.heard(publisher)
    stage.hear(11.0 if kind == "joint" else 0.5)  # who sends joint commands has been there for 10 s
    back = 0 if renewed else DAY
    stage.bench.node.create_timer(
        0.01, lambda: publisher.publish(make(stage.bench.node.get_clock().now().nanoseconds - back))
    )
    stage.hear(1.0)


def header_at(now: int) -> Header:
    """A header of that time [ns]."""
    return Header(stamp=time_message(now))


def start_second_plant(stage: Stage) -> None:
    """A second plant of the same names comes up beside one that is driven."""
    stage.plant()
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    stage.send(6.0)
    infos = stage.bench.hear(MotorSpeed, "motor/speed")
    stage.plant("second")
    stage.until(lambda: any(message.header.frame_id == "second" for message in infos), "the second plant")


def resume_experiment(stage: Stage) -> None:
    """An experiment is stopped by Ctrl-Z in mid-run, and goes on."""
    stage.plant()
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    one = stage.run("motor_identification", "experiment", "rich", "--output", stage.folder / "new")
    stage.until(lambda: abs(stage.moments[-1].voltage) > 1.0, "motion")
    stage.stand_still(one)


def fill_disk(stage: Stage) -> None:
    """No file of an experiment may grow any more in mid-run, as on a full disk."""
    stage.plant()
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    one = stage.run("motor_identification", "experiment", "rich", "--output", stage.folder / "new")
    stage.until(lambda: abs(stage.moments[-1].voltage) > 1.0, "motion")
    stage.hear(1.0)  # something has been written
    resource.prlimit(one.pid, resource.RLIMIT_FSIZE, (1000, 1000))


def refer_to_stopped_controller(stage: Stage) -> None:
    """A reference comes while the controller is stopped."""
    stage.plant()
    stage.controller()
    stage.until(lambda: len(stage.said) > 3 and len(stage.moments) > 50, "the loop")
    reference = stage.bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    stage.bench.heard(reference)
    stage.stand_still(stage.programs[-1], lambda: reference.publish(Float64(data=0.5 * MOTOR.top)))


def command_stopped_plant(stage: Stage) -> None:
    """A voltage comes while a plant is stopped."""
    stage.plant()
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    voltage = stage.bench.publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
    stage.bench.heard(voltage)
    stage.stand_still(stage.programs[0], lambda: voltage.publish(voltage_message(6.0, time_message(0), "user")))


def resume_plant(stage: Stage) -> None:
    """A plant that is driven is stopped, and the voltages keep coming."""
    stage.plant()
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    stage.send(6.0)
    stage.stand_still(stage.programs[0])


def drive_stopped_robot(stage: Stage) -> None:
    """A velocity comes while `diff_drive` is stopped."""
    for side in ("left", "right"):
        stage.plant(side, side)
        stage.controller(side)
    drive = stage.run("motor_examples", "diff_drive")
    command = stage.bench.publisher(Twist, "cmd_vel", qos.REFERENCE)
    stage.bench.heard(command)
    stage.until(lambda: any("/diff_drive" in one or "cmd_vel" in one for one in stage.said), "the drive")
    twist = Twist()
    twist.linear.x = 0.4
    stage.stand_still(drive, lambda: command.publish(twist))


def resume_play(stage: Stage) -> None:
    """Voltages of a recording are played, stopped by Ctrl-Z in mid-run, and go on."""
    bag = recorded(stage)
    stage.plant()
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    play = stage.run("motor_identification", "play", bag, "--topics", "motor/voltage")
    stage.until(lambda: abs(stage.moments[-1].voltage) > 1.0, "motion")
    stage.stand_still(play)


def drive_another_plant(stage: Stage) -> None:
    """A controller's voltages go to another plant than the one that it hears, and references keep coming."""
    stage.plant("heard", "left")
    stage.plant("driven", "right")
    stage.controller("left", "-r", "/left/motor/voltage:=/right/motor/voltage")
    _refer_often(stage, "left/motor/reference")
    stage.until(lambda: any("would be driven" in one for one in stage.said), "a sentence")


def drive_by_another_plant(stage: Stage) -> None:
    """A controller hears the samples of another plant than the one that its voltages go to."""
    stage.plant("driven", "left")
    stage.plant("heard", "right")
    stage.controller("left", "-r", "/left/motor/speed:=/right/motor/speed", "-r", "/left/motor/info:=/right/motor/info")
    _refer_often(stage, "left/motor/reference")
    stage.until(lambda: any("would be driven" in one for one in stage.said), "a sentence")


def start_in_another_namespace(stage: Stage) -> None:
    """Of two motors one has a controller that was started in no namespace."""
    for side in ("left", "right"):
        stage.plant(side, side)
    stage.controller("left")
    stage.controller("")
    stage.hear(2.0)
    _refer_often(stage, "right/motor/reference")


def remap_info(stage: Stage) -> None:
    """A controller hears no motor/info, for it has been renamed."""
    stage.plant()
    stage.controller("", "-r", "/motor/info:=/motor/inf")
    _refer_often(stage, "motor/reference")


def _refer_often(stage: Stage, topic: str) -> None:
    """Send references, 20 a second."""
    reference = stage.bench.publisher(Float64, topic, qos.REFERENCE)
    stage.bench.node.create_timer(0.05, lambda: reference.publish(Float64(data=0.5 * MOTOR.top)))
    stage.until(lambda: len(stage.moments) > 50, "the plant")


def _drive_by_stream(stage: Stage) -> None:
    """Drive a plant by a controller to which references keep coming."""
    stage.plant()
    stage.controller()
    reference = stage.bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    stage.bench.heard(reference)
    stage.bench.node.create_timer(0.02, lambda: reference.publish(Float64(data=0.5 * MOTOR.top)))
    stage.until(lambda: any(moment.voltage for moment in stage.moments), "motion")


def restart_plant(stage: Stage) -> None:
    """A plant is killed and started again 5 s later, and references keep coming."""
    _drive_by_stream(stage)
    stage.programs[0].kill()
    stage.hear(5.0)
    count = len(stage.moments)
    stage.plant()
    stage.until(lambda: len(stage.moments) > count, "the plant again")


def release_second_stream(stage: Stage) -> None:
    """`motor/release`, while a second stream goes on that will pass the number at which the first one fell silent."""
    stage.plant()
    stage.controller("", "-p", "reference_timeout:=0.0")
    stage.until(lambda: bool(stage.said) and len(stage.moments) > 50, "the loop")
    for messages in (60, 30):  # one second later it is where the first one was
        reference = stage.bench.publisher(Float64, "motor/reference", qos.REFERENCE)
        stage.bench.heard(reference)
        timer = stage.bench.node.create_timer(0.05, partial(reference.publish, Float64(data=0.5 * MOTOR.top)))
        stage.hear(0.05 * messages)
        if messages == 60:
            timer.cancel()
            stage.bench.node.destroy_publisher(reference)
            stage.hear(1.0)
    client = stage.bench.node.create_client(Trigger, "motor/release")
    stage.until(client.service_is_ready, "motor/release")
    stage.until(client.call_async(Trigger.Request()).done, "the answer")


def restart_controller(stage: Stage) -> None:
    """A controller is killed and started again, as by systemd, and references keep coming."""
    _drive_by_stream(stage)
    stage.hear(3.0)
    stage.programs[-1].kill()
    stage.hear(2.0)
    count = len(stage.said)
    stage.controller()
    stage.until(lambda: any("They began" in one for one in stage.said[count:]), "the next one")


def stop_beside_calls(stage: Stage) -> None:
    """Somebody switches the output off while another node calls to switch it on, 100 times a second."""
    stage.plant()
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    stage.send(6.0)
    client = stage.bench.node.create_client(SetBool, "motor/enable")
    stage.until(client.service_is_ready, "motor/enable")
    stage.bench.node.create_timer(0.01, lambda: client.call_async(SetBool.Request(data=True)))
    stage.hear(1.0)
    off = client.call_async(SetBool.Request(data=False))
    stage.until(off.done, "the answer")


@dataclass(frozen=True)
class LiveFault:
    """One fault; what is heard after it is judged, and of what is said the sentence with these words."""

    name: str
    apply: Callable[[Stage], None]
    words: str
    most: float = KNOWN  # [s]
    goes_on: bool = False  # there is nothing to stop for: no motor turns faster than was asked for


LIVE_FAULTS = (
    LiveFault("a whole recording is played onto a plant", play_bag, "Another node publishes"),
    LiveFault("a second plant in one namespace, plain voltage", start_second_plant, "Another node publishes"),
    *(
        LiveFault(
            f"a program of one's own publishes a recording's {topic}, with its stamps",
            partial(republish, kind=kind, topic=topic, renewed=False),
            "stamp",
        )
        for kind, topic in (("voltage", "motor/voltage"), ("joint", "motor/joint_command"))
    ),
    LiveFault("`experiment` stopped for 1.5 s (Ctrl-Z), and goes on", resume_experiment, "No sample was answered for"),
    LiveFault("`experiment`, whose disk is full in mid-run", fill_disk, "cannot be written", KNOWN_AT_WRITING),
    LiveFault("a controller stopped for 1.5 s, a reference meanwhile", refer_to_stopped_controller, "stood still"),
    LiveFault("a plant stopped for 1.5 s, a voltage meanwhile", command_stopped_plant, "held up"),
    LiveFault("a plant stopped for 1.5 s, 200 voltages a second keep coming", resume_plant, "went on being sent"),
    LiveFault("`diff_drive` stopped for 1.5 s, a velocity meanwhile", drive_stopped_robot, "stood still"),
    LiveFault("voltages go to another plant, references keep coming", drive_another_plant, "would be driven"),
    LiveFault("samples are another plant's, references keep coming", drive_by_another_plant, "would be driven"),
    LiveFault("one of two controllers in another namespace, references", start_in_another_namespace, "nobody hears"),
    LiveFault("a controller that hears no motor/info, references", remap_info, "Nobody publishes"),
    LiveFault("`motor/release`, the second of two streams of references goes on", release_second_stream, "begin again"),
    LiveFault("supply off for 2 s, the controller held up for 45 ms each 0.3 s", cut_supply, "Call motor/reset"),
    LiveFault("a plant is started again, 50 references a second keep coming", restart_plant, "begin again"),
    LiveFault(
        "a controller is killed and started again, 50 references a second keep coming", restart_controller, "They began"
    ),
    LiveFault(
        "`motor/enable` with data: false, 100 calls a second with data: true go on",
        stop_beside_calls,
        "The output is off",
    ),
    LiveFault("`play` of voltages stopped for 1.5 s, and goes on", resume_play, "Playing stood still"),
    *(
        LiveFault(
            f"{who} stopped for {seconds:g} s, {how}", HeldUp(which, seconds, stream), words, goes_on=seconds == SHORT
        )
        for which, who, words in (
            (CONTROLLER, "a controller", "stood still"),
            (PLANT, "a plant", "held up"),
            (BOTH, "both", "held up"),
        )
        for seconds in (SHORT, LONG)
        for stream, how in ((False, "one reference before"), (True, "references keep coming"))
    ),
    *(
        LiveFault(
            f"the clock of {whose} is set by an hour, {way}",
            SetClock(plant * hour, controller * hour),
            "stamp",
            goes_on=True,
        )
        for whose, plant, controller in (("both", 1, 1), ("the plant's computer", 1, 0), ("the controller's", 0, 1))
        for way, hour in (("ahead", HOUR), ("back", -HOUR))
    ),
    LiveFault("a launch file started once more, references keep coming", launch_twice, "publish motor/speed"),
    LiveFault("the second of two launches is ended, references keep coming", end_second, "publish motor/speed"),
    LiveFault("the first of two launches is ended, references keep coming", end_first, "publish motor/speed"),
    LiveFault("a launch file started twice at once, references then", launch_both, "publish motor/speed"),
)


def run_live(fault: LiveFault) -> Outcome:
    """What a fault does to the motors of running programs."""
    with stage() as one:
        fault.apply(one)
        begin = time.monotonic()
        one.hear(WATCHED)
    found = outcome(one.moments, begin)
    said = next((text for text in one.said if fault.words in text), "").replace(f"{one.folder}/", "")
    return Outcome(found.after, found.speed, found.voltage, LOGGED.sub("", said))


def live() -> list[tuple[str, bool]]:
    """The rows, and whether each is met."""
    rows = []
    for fault in LIVE_FAULTS:
        one = run_live(fault)
        speed, voltage = one.speed / MOTOR.top, one.voltage / MOTOR.voltage
        met = one.after is not None and (one.voltage == 0.0 or one.after <= fault.most)
        after = 0.0 if one.voltage == 0.0 else one.after  # and not when it was heard first
        took = "never" if after is None else f"{1e3 * after:.0f}"
        if fault.goes_on:
            met, took = speed <= WANTED * (1.0 + OVERSHOOT), "goes on" if after is None else took
        mark = "" if met else " **no**"
        rows.append(
            (
                f"| {fault.name} | {1e3 * fault.most:.0f}{mark} | {took} | {speed:.0%} | {voltage:.0%} | {one.said} |",
                met,
            )
        )
        print(rows[-1][0], file=sys.stderr)
    return rows


if __name__ == "__main__":
    live()
