"""However a live experiment ends, the motor gets 0 V at once: here the plant would go on for ten seconds by itself."""

import resource
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import workbench
from rclpy.duration import Duration
from rclpy.time import Time
from std_srvs.srv import SetBool
from workbench import DOMAIN, PATIENCE, Bench

from motor_identification.bag import BagWriter, contents, read_recording
from motor_identification.live import run_plan, speed_probe
from motor_identification.live.experiment_node import Driver
from motor_identification.live.recorder import Recorder
from motor_identification.live.run_plan import drive
from motor_model.errors import MotorError
from motor_model.excitation import profile
from motor_model.parameters import PAPER_KV
from motor_model.sample import Info
from motor_msgs.msg import MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import info_message, time_message
from motor_ros.parameter_requests import parameter_setters
from motor_ros.run import start_ros


class After:
    """An interrupt that comes as soon as something has happened."""

    def __init__(self, happened: Callable[[], bool]) -> None:
        self._happened = happened

    def __bool__(self) -> bool:
        return self._happened()


class Stand:
    """A plant that keeps the last voltage for ten seconds, and experiments on it in this process."""

    def __init__(self) -> None:
        self.plant = workbench.start("motor_sim", "motor_sim", "--ros-args", "-p", "command_timeout:=10.0")
        self.bench = Bench()
        self.bag = Path()
        self.samples = self.bench.hear(MotorSpeed, "motor/speed", qos.SPEED)
        self.bench.wait(lambda: bool(self.samples), "the plant")

    def close(self) -> None:
        self.bench.close()
        self.plant.kill()
        self.plant.communicate()

    def experiment(
        self,
        name: str,
        interrupt: Callable[[Driver], object] = lambda driver: False,
        limit: float | None = None,
        replace: bool = False,
    ) -> int:
        """Run one; `interrupt` is looked at all the time."""
        start_ros()
        driver = Driver(profile(name), 6.0, limit, "")
        return drive(driver, str(self.bag), After(lambda: bool(interrupt(driver))), replace)  # type: ignore[arg-type]

    def new(self, count: int) -> list[MotorSpeed]:
        """So many samples of what is now: without those that have waited in the queue."""
        now = self.bench.node.get_clock().now()
        self.samples.clear()

        def fresh() -> list[MotorSpeed]:
            return [sample for sample in self.samples if Time.from_msg(sample.header.stamp) > now]

        self.bench.wait(lambda: len(fresh()) >= count, "samples")
        return fresh()

    def assert_stopped(self) -> None:
        """No sample from now on has a voltage, and the plant would have gone on for long."""
        assert {sample.voltage for sample in self.new(20)} == {0.0}

    def put_aside(self) -> None:
        """The bag's name is free again; go on with what was recorded under another one."""
        assert not self.bag.exists()
        self.bag = self.bag.with_name(f"{self.bag.name}_incomplete")

    def recorded(self) -> float:
        """[s] in the bag; the plant had a voltage."""
        recording = read_recording(self.bag)
        assert recording.voltage.max() > 0.9
        return recording.duration


@pytest.fixture(scope="module")
def module_stand() -> Iterator[Stand]:
    stand = Stand()
    yield stand
    stand.close()


@pytest.fixture
def stand(module_stand: Stand, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Stand:
    monkeypatch.setenv("ROS_DOMAIN_ID", DOMAIN)
    module_stand.bag = tmp_path / "bag"
    return module_stand


def turning(driver: Driver) -> bool:
    return driver.elapsed > 0.3


def test_an_interrupt_and_what_the_bag_says_of_the_plan(stand: Stand, capsys: pytest.CaptureFixture[str]) -> None:
    assert stand.experiment("staircase", turning) == 130
    stand.assert_stopped()
    stand.put_aside()
    assert 0.2 < stand.recorded() < 3.0
    said = capsys.readouterr().out.splitlines()
    assert said[0] == (
        "Driving 'motor' through 'staircase' for 5.8 s: -6 to 6 V, both ways (of 12 V). "
        "The speed is not limited (--speed). Ctrl-C stops the motor."
    )
    assert said[1].startswith(f"{stand.bag}: interrupted, ")
    noted = contents(stand.bag).custom_data
    assert (noted["experiment.profile"], float(noted["experiment.voltage"])) == ("staircase", 6.0)
    assert (float(noted["experiment.duration"]), noted["experiment.source"]) == (5.85, "simulation")


def test_an_error_of_our_own(stand: Stand) -> None:
    def fail(driver: Driver) -> bool:
        assert not parameter_setters(driver)  # nor one that anybody can bring about there
        if turning(driver):
            raise ZeroDivisionError
        return False

    with pytest.raises(ZeroDivisionError):
        stand.experiment("staircase", fail)
    stand.assert_stopped()
    stand.put_aside()
    assert 0.2 < stand.recorded() < 3.0


def test_a_full_disk(stand: Stand) -> None:
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)

    def fill(driver: Driver) -> bool:
        if driver.elapsed > 0.8:  # something has been flushed
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))  # less than is written: any more is refused
        return False

    try:
        with pytest.raises(MotorError, match=r"cannot be written \(File too large\): make room") as refusal:
            stand.experiment("staircase", fill)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    stand.assert_stopped()
    stand.put_aside()
    assert str(refusal.value).endswith(f"are kept. The recording up to then is in {stand.bag}.")
    kept = contents(stand.bag)
    assert kept.cut and kept.message_count > 100
    assert f"the {kept.message_count} messages recorded until then are kept" in str(refusal.value)


def test_a_speed_is_kept_without_a_model(stand: Stand, capsys: pytest.CaptureFixture[str]) -> None:
    assert stand.experiment("step", limit=40.0) == 0
    stand.assert_stopped()
    recording = read_recording(stand.bag)
    volts = float(contents(stand.bag).custom_data["experiment.voltage"])
    assert recording.voltage.max() == volts == pytest.approx(0.95 * 40.0 * PAPER_KV, rel=2e-3)
    assert recording.speed[0] == 0.0 and 37.0 < recording.speed.max() < 40.0  # the ramp before it is not in the bag
    assert f"A short ramp says: {volts:g} V at most keep the motor below 40 rad/s." in capsys.readouterr().out


def test_a_motor_that_runs_faster_than_allowed(stand: Stand, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(speed_probe, "slowed", lambda plan, parameters, limit: plan)  # as if the ramp had misled us
    with pytest.raises(MotorError, match=r"at 6 V, above --speed 40, and was stopped: give less --voltage\. The rec"):
        stand.experiment("step", limit=40.0)
    stand.assert_stopped()
    stand.put_aside()
    speeds = read_recording(stand.bag).speed
    assert 40.0 < speeds.max() < 0.97 * 6.0 / PAPER_KV  # never got where the voltage would have taken it


def test_an_interrupt_of_the_ramp_leaves_no_bag(stand: Stand) -> None:
    assert stand.experiment("step", turning, limit=40.0) == 130
    stand.assert_stopped()
    assert not stand.bag.exists()


@pytest.fixture(params=[3600.0, -3600.0])
def another_clock(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """The experiment's clock is by so many seconds not the plant's."""
    true, off = Driver.get_clock, Duration(nanoseconds=round(request.param * 1e9))

    class Off:
        def __init__(self, driver: Driver) -> None:
            self._clock = true(driver)

        def now(self) -> Time:
            return self._clock.now() + off

        def __getattr__(self, name: str) -> object:
            return getattr(self._clock, name)

    monkeypatch.setattr(Driver, "get_clock", lambda driver: Off(driver))


@pytest.mark.usefixtures("another_clock")
def test_a_clock_that_is_not_the_plants_holds_nothing_up(stand: Stand) -> None:
    """With a plant under use_sim_time, or after the clock was set back, it waited for ever, and said nothing."""
    end = stand.bench.node.get_clock().now() + Duration(seconds=PATIENCE)
    assert stand.experiment("step", lambda driver: stand.bench.node.get_clock().now() > end) == 0
    stand.assert_stopped()
    # The step is 1.1 s; half a second of samples from before may stand before it, and more where the machine is busy.
    assert 1.0 < stand.recorded() < 5.0  # who goes by the wrong clock ends at once, or is interrupted above


@pytest.mark.usefixtures("another_clock")
def test_samples_that_waited_while_the_recorder_was_made_are_no_part_of_the_plan(
    stand: Stand, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a busy machine a step began with them, so that its first half second was neither driven nor in the bag."""
    monkeypatch.setattr(run_plan, "announce", lambda *_: time.sleep(0.6) or "as many samples as are kept have come")
    assert stand.experiment("step") == 0
    stand.assert_stopped()
    driven = int((read_recording(stand.bag).voltage > 0.0).sum())
    assert 150 < driven < 250  # samples: the step takes a second


def test_a_recorder_that_is_made_slowly_is_no_silence_of_the_plant(
    stand: Stand, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a busy machine "the samples stopped after 0.00 s", which nobody had looked at for a second."""

    def record(*arguments: Any) -> Recorder:
        time.sleep(1.1)
        return Recorder(*arguments)

    monkeypatch.setattr(run_plan, "Recorder", record)
    assert stand.experiment("step") == 0
    stand.assert_stopped()


def test_another_plant_and_another_voltage(stand: Stand) -> None:
    other = stand.bench.publisher(MotorInfo, "motor/info", qos.INFO)

    def announce(driver: Driver) -> bool:
        if turning(driver) and driver.info is not None:
            other.publish(info_message(Info(max_voltage=24.0), time_message(0)))
        return False

    with pytest.raises(MotorError, match="motor/info has changed"):
        stand.experiment("staircase", announce)
    stand.assert_stopped()
    stand.bench.node.destroy_publisher(other)
    stand.bag = stand.bag.with_name("two")
    voltage = stand.bench.publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)

    def meddle(driver: Driver) -> bool:
        if turning(driver):
            voltage.publish(MotorVoltage(voltage=1.0))
        return False

    with pytest.raises(
        MotorError,
        match=r"^Another node publishes motor/voltage: /bench\. End it, and start anew\. The rec.* in \S+two_inc",
    ):
        stand.experiment("staircase", meddle)
    second = stand.bench.publisher(MotorSpeed, "motor/speed", qos.SPEED)
    stand.bag = stand.bag.with_name("three")
    try:
        with pytest.raises(MotorError, match=r"2 nodes publish motor/speed: stop all but the plant"):
            stand.experiment("rich")  # long enough to hear of the other one
    finally:
        stand.bench.node.destroy_publisher(second)


def test_plants_elsewhere_are_named(
    stand: Stand, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(run_plan, "PATIENCE", 2.0)
    left = stand.bench.publisher(MotorInfo, "/left/motor/info", qos.INFO)
    start_ros()
    driver = Driver(profile("step"), 6.0, None, "nowhere")
    said = r"^Nothing on /nowhere/motor/info: there are plants in / and /left: say --topic-namespace / or --topic-nam"
    with pytest.raises(MotorError, match=said):
        drive(driver, str(stand.bag), After(lambda: False))  # type: ignore[arg-type]
    stand.bench.node.destroy_publisher(left)
    assert not stand.bag.exists()
    assert "Waiting for a plant on /nowhere/motor/info, 2 s at most.\n" in capsys.readouterr().err


def test_a_bag_that_exists_moves_nothing(stand: Stand) -> None:
    BagWriter(stand.bag).close()
    with pytest.raises(MotorError, match="exists already"):
        stand.experiment("step")
    stand.assert_stopped()
    assert stand.experiment("step", replace=True) == 0
    assert stand.recorded() > 1.0


def test_an_attempt_that_failed_leaves_its_name_to_the_next(stand: Stand) -> None:
    names = []
    for _attempt in range(2):
        assert stand.experiment("step", turning) == 130
        names += [path.name for path in stand.bag.parent.iterdir() if path.name not in names]
    assert names == ["bag_incomplete", "bag_incomplete_2"]
    assert stand.experiment("step") == 0 and stand.recorded() > 1.0


def test_an_experiment_that_stood_still_itself_does_not_blame_the_plant(stand: Stand) -> None:
    def stand_still(driver: Driver) -> bool:
        if turning(driver):
            time.sleep(1.5)
            driver.failed()  # the first thing that it does when it goes on
        return False

    with pytest.raises(MotorError, match=r"^No sample was answered for 1\.\d s after 0\.\d+ s, in which the motor got"):
        stand.experiment("step", stand_still)
    stand.assert_stopped()


def test_a_plant_that_is_switched_off_and_then_lost(stand: Stand) -> None:
    assert stand.bench.call(SetBool, "motor/enable", SetBool.Request(data=False)).success
    with pytest.raises(
        MotorError, match=r"^The (?:plant's )?output is off: call motor/enable with data: true\. The rec"
    ):
        stand.experiment("step")
    assert stand.bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success
    stand.bag = stand.bag.with_name("lost")

    def lose(driver: Driver) -> bool:
        if turning(driver):
            stand.plant.kill()
        return False

    with pytest.raises(MotorError, match=r"^The samples stopped after 0\.\d+ s: is the plant still running\? The rec"):
        stand.experiment("step", lose)
    stand.put_aside()
    assert 0.2 < stand.recorded() < 1.1
