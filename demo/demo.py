"""The main job, live: record a simulated motor, identify it, hold a speed with it; then a real motor's log.

Every command is shown before it runs; typed into a shell after `source env.sh` it does the same.
"""

import os
import shlex
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from contextlib import ExitStack
from pathlib import Path

from builtin_interfaces.msg import Time
from picture import draw_demo
from rclpy.serialization import deserialize_message

from motor_identification.bag import messages, read_recording
from motor_model.errors import MotorError
from motor_model.model_file import load, save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_msgs.msg import ControlState, MotorSpeed
from motor_ros.loopback import stay_on_this_machine

ROOT = Path(__file__).resolve().parents[1]
OUT = ROOT / "out" / "demo"
CLOSED_LOOP = OUT / "closed_loop"
REAL_MOTOR = ROOT / "tests" / "data" / "undc" / "prbs_2026-08-14.csv"
REFERENCE = 100.0  # [rad/s]
HELD_WITHIN = 2.0  # [rad/s] mean of the last second
LAST = 200  # samples of that second
FITTED_WITHIN = 0.01  # relative

# What the identification is not told: the paper's motor with Coulomb friction, on a disc with slots 1 % off.
HIDDEN = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.6}, ("coulomb_friction",), name="hidden")


def step(text: str) -> None:
    """Begin a step of the demo."""
    _styled(f"\n{text}", "1")


def shown(command: str) -> list[str]:
    """A command's words, after the user has seen it."""
    _styled(f"$ {command}", "2")
    return shlex.split(command)


def _styled(text: str, style: str) -> None:
    print(f"\033[{style}m{text}\033[0m" if sys.stdout.isatty() else text, flush=True)


def run(command: str) -> None:
    """Run a command to its end; its failure is the demo's."""
    status = subprocess.run(shown(command), cwd=OUT).returncode
    if status != 0:
        sys.exit(f"demo: that command failed with exit status {status}.")


def node(stack: ExitStack, command: str) -> None:
    """Start a node and end it with Ctrl-C when the stack unwinds."""
    process = subprocess.Popen(shown(command), cwd=OUT)

    def end() -> None:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(3.0)
        except subprocess.TimeoutExpired:
            process.kill()

    stack.callback(end)


def closed_loop() -> None:
    """Record while the reference is given, once controller and recorder both hear it."""
    command = shown("ros2 run motor_identification record closed_loop --duration 5")
    recorder = subprocess.Popen(command, cwd=OUT, stdout=subprocess.PIPE, text=True)
    assert recorder.stdout is not None
    print(recorder.stdout.readline(), end="", flush=True)  # it is listening now
    run(f'ros2 topic pub --once -w 2 --keep-alive 1 /motor/reference std_msgs/msg/Float64 "{{data: {REFERENCE}}}"')
    print(recorder.communicate(timeout=30.0)[0].strip())
    if recorder.returncode != 0:
        sys.exit("demo: the recorder failed.")


def live() -> None:
    """Experiment → bag → identify → model file → PI, as processes over DDS."""
    with ExitStack() as stack:
        step("1. A motor, simulated in real time; its friction is a secret of this script")
        node(stack, "ros2 run motor_sim motor_sim --ros-args -p model:=hidden.yaml -p slot_irregularity:=0.01")
        node(
            stack,
            "ros2 run motor_identification motor_identification --ros-args -p model_file:=model.yaml "
            f"-p bag_directory:={shlex.quote(str(OUT))}",
        )
        step("2. Drive it through a staircase of voltages and record a bag")
        run("ros2 run motor_identification experiment staircase --output staircase")
        step("3. Identify: particle swarm, then least squares")
        request = "{bag_uris: [staircase], effects: [coulomb_friction]}"
        run(f'ros2 service call /motor/identify motor_msgs/srv/Identify "{request}"')
        step(f"4. Hold {REFERENCE:g} rad/s with the PI controller")
        node(stack, "ros2 run motor_control motor_control")
        closed_loop()


def table() -> bool:
    """True against fitted parameters; whether all are close."""
    fitted = load(OUT / "model.yaml")
    print(f"  {'parameter':10}{'true':>14}{'fitted':>14}{'error':>12}")
    close = True
    for name, true in HIDDEN.values.items():
        value = fitted.value(name)
        close &= abs(value / true - 1.0) < FITTED_WITHIN
        print(f"  {name:10}{true:14.6g}{value:14.6g}{100 * (value / true - 1.0):+11.4f} %")
    return close


def held() -> bool:
    """Whether the speed was held over the last second."""
    recording = read_recording(str(CLOSED_LOOP))
    last = recording.speed[recording.time > recording.duration - 1.0]
    print(
        f"  reference {REFERENCE:g} rad/s; over the last second the encoder read "
        f"{last.mean():.2f} on average, {last.min():.2f} to {last.max():.2f} (slots 1 % off show ±3 %)"
    )
    return bool(abs(last.mean() - REFERENCE) < HELD_WITHIN)


def references() -> list[tuple[float, float]]:
    """When [s since the closed loop's first sample] the controller worked with which reference [rad/s]."""
    first = next(deserialize_message(row[3], MotorSpeed) for row in messages(str(CLOSED_LOOP), ["/motor/speed"]))
    return [(_seconds(state.header.stamp) - _seconds(first.header.stamp), state.reference) for state in states()]


def states() -> list[ControlState]:
    """What the controller said in the closed loop."""
    rows = messages(str(CLOSED_LOOP), ["/motor/control_state"])
    return [deserialize_message(row[3], ControlState) for row in rows]


def say_not_held(reasons: list[str]) -> str:
    """Say why the speed was not held, by what the controller said at the samples of the last second ("": nothing)."""
    said = Counter(" ".join(reason.split()) for reason in reasons if reason)
    if not said:
        return f"the speed was not held within {HELD_WITHIN:g} rad/s."
    share, (most, _) = said.total() / len(reasons), said.most_common(1)[0]
    return f"the speed was not held: at {share:.0%} of the last samples the controller says '{most}' Then run it again."


def _seconds(stamp: Time) -> float:
    return float(stamp.sec % 86400) + stamp.nanosec * 1e-9


def real_motor() -> None:
    """Import and identify a log of a real gearmotor, recorded by others (tests/data)."""
    step("5. A real motor's log: a 5 V gearmotor under a random telegraph voltage, recorded by others")
    csv = os.path.relpath(REAL_MOTOR, OUT)
    run(
        f"ros2 run motor_identification import_csv {shlex.quote(csv)} --output real --time t --voltage u --speed y "
        "--unit deg/s --speed-window 0.02 --edges-per-revolution 2800"
    )
    run("ros2 run motor_identification identify real --effects coulomb_friction,transport_delay --report real_report")


def main() -> int:
    """Run it all; 0 if the fit is right and the speed is held."""
    begun = time.monotonic()
    stay_on_this_machine()
    os.environ["ROS_DOMAIN_ID"] = str(215 + os.getpid() % 18)  # 215 to 232: nobody else's motor, nor a test's
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    save(OUT / "hidden.yaml", HIDDEN)
    live()
    real_motor()
    step("Result")
    fitted, holds = table(), held()
    picture = OUT / "demo.png"
    draw_demo(OUT, load(OUT / "model.yaml"), references(), picture)
    print(f"  picture: {picture.relative_to(ROOT)}")
    print(f"  took {time.monotonic() - begun:.0f} s")
    if not holds:
        raise MotorError(say_not_held([state.reason for state in states()[-LAST:]]))
    return 0 if fitted else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except MotorError as error:
        sys.exit(f"demo: {error}")
