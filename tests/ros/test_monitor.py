"""The monitor as a process: joint states and commands of a robot come in real time, health goes out."""

import time
from pathlib import Path

import foreign_bags
from bags_over_dds import Start
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from foreign_bags import KA, KS, KV
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from workbench import Bench, end

from motor_model.model_file import save
from motor_model.parameters import Parameters
from motor_msgs.msg import MotorHealth
from motor_ros import qos
from motor_ros.messages import time_message

PERIOD = 0.01  # [s] of the messages
MAPPING = "voltage: '{commands}:effort[wheel]'\nposition: '{states}:position[wheel]'\n"


class Robot:
    """Publishes a motor's motion by the clock, with the stamps that it should have had: a busy machine is only late."""

    def __init__(self, bench: Bench) -> None:
        self.bench, self.motion, self.blocked = bench, foreign_bags.move(60.0), False
        deep = QoSProfile(depth=5000)
        self._states = bench.publisher(JointState, "joint_states", deep)
        self._commands = bench.publisher(JointState, "commands", deep)
        self._begin, self._row, self._angle = time.time_ns(), 0, 0.0

    def publish(self) -> None:
        """Send what is due."""
        while self._row * PERIOD < (time.time_ns() - self._begin) * 1e-9:
            k = 2 * self._row  # of a motion at 200 Hz
            self._angle = self._angle if self.blocked else float(self.motion.angle[k])
            voltage = float(self.motion.voltage[k])
            for publisher, state in (
                (self._commands, JointState(name=["wheel"], effort=[voltage])),
                (self._states, JointState(name=["wheel"], position=[self._angle])),
            ):
                state.header.stamp = time_message(self._begin + round(self._row * PERIOD * 1e9))
                publisher.publish(state)
            self._row += 1


def test_a_robots_motor_is_watched_and_one_that_is_blocked_is_told(bench: Bench, start: Start, tmp_path: Path) -> None:
    names = {name: f"{bench.node.get_namespace().rstrip('/')}/{name}" for name in ("commands", "states")}
    names["states"] = names["states"].replace("states", "joint_states")
    (tmp_path / "mapping.yaml").write_text(MAPPING.format(**names))
    wheel = Parameters({"kv": KV, "ka": KA, "ks": KS}, ("coulomb_friction",), name="wheel")
    save(tmp_path / "model.yaml", wheel, {"kv": 0.01 * KV, "ka": 0.02 * KA, "ks": 0.05 * KS})
    told = bench.hear(MotorHealth, "motor/health", qos.HEALTH)
    diagnostics = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    given = {"model": tmp_path / "model.yaml", "mapping": tmp_path / "mapping.yaml", "window": 1.0}
    monitor = start(
        "motor_identification",
        "monitor",
        "--ros-args",
        *(word for one in given.items() for word in ("-p", ":=".join(map(str, one)))),
    )
    robot = Robot(bench)

    def becomes(state: str) -> MotorHealth:
        def there() -> bool:
            robot.publish()
            return bool(told) and told[-1].state == state

        bench.wait(there, state)
        return told[-1]

    health = becomes("fits")
    assert health.header.frame_id == "wheel" and 0.5 < health.innovation_ratio < 2.0, health.sentence
    assert 0.4 < health.window < 1.5 and health.sentence.startswith("The motor fits its model: residual ")
    robot.blocked = True
    health = becomes("broken")
    assert list(health.changed_names) == [] and health.since.sec > 0
    bench.wait(lambda: any(one.status[0].level == DiagnosticStatus.ERROR for one in diagnostics), "an error")
    assert diagnostics[-1].status[0].hardware_id == "wheel"
    senders = bench.node.get_publishers_info_by_topic(names["commands"])
    assert [one.node_name for one in senders] == ["bench"], "the monitor commands nothing"
    _, err = end(monitor)
    assert monitor.returncode == 0 and "Traceback" not in err, err


def test_a_clock_that_stands_holds_no_health_up(bench: Bench, start: Start, tmp_path: Path) -> None:
    """Nobody publishes /clock: it said nothing, and looked at nothing, for ever."""
    save(tmp_path / "model.yaml", Parameters({"kv": KV, "ka": KA}), {"kv": 0.01 * KV, "ka": 0.02 * KA})
    diagnostics = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    words = ("-p", f"model:={tmp_path / 'model.yaml'}", "-p", "use_sim_time:=true")
    start("motor_identification", "monitor", "--ros-args", *words)
    bench.wait(lambda: len(diagnostics) > 1, "diagnostics")
