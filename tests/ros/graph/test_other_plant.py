"""A plant that is not alone on motor/speed gives its motor 0 V: a second plant, or a recording that is played."""

import re
import time
import warnings
from collections.abc import Callable
from subprocess import Popen

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from plant_rig import Rig
from plant_user import User
from std_srvs.srv import SetBool
from workbench import Bench

from motor_model.sample import Sample
from motor_msgs.msg import MotorSpeed
from motor_ros import qos
from motor_ros.graph import other_plant
from motor_ros.messages import speed_message, time_message

Start = Callable[..., "Popen[str]"]
DAY = 86_400_000_000_000  # [ns]
# Why a plant that is alone again is at 0 V; the second is said of one that a busy machine held up for a second.
STILL_SENT = re.compile("5 V (was already|went on) being sent")


@pytest.mark.parametrize("length", range(13))
def test_a_sample_that_is_cut_off_is_another_plants(length: int) -> None:
    """A stranger's four bytes on motor/speed ended the plant."""
    whole = bytes([0, 1, 0, 0, *(7).to_bytes(4, "little"), *(9).to_bytes(4, "little"), 0, 0])
    assert other_plant.read_stamp(whole) == (7, 9)
    assert other_plant.read_stamp(whole[:length]) == ((7, 9) if length == 12 else None)


def test_a_recording_that_is_played_is_no_command(bench: Bench) -> None:
    rig, recorded = Rig(bench), bench.publisher(MotorSpeed, "motor/speed")
    for _ in range(200):  # a publisher that says nothing, as one that has died
        assert rig.sample() == 6.0
    bench.wait(lambda: recorded.get_subscription_count() > 0, "the plant to listen")

    def play() -> float:
        recorded.publish(speed_message(Sample(rig.count, 0.0, 6.0), time_message(rig.stamp() - DAY), "motor"))
        rig.plant.gate = rig.plant.gate.take(6.0, time.monotonic_ns())
        return rig.sample()

    bench.wait(lambda: play() == 0.0, "0 V")  # it looks every 50 ms, in which any number of samples is taken here
    assert [play() for _ in range(90)] == [0.0] * 90
    refused = rig.plant._on_enable(SetBool.Request(data=True), SetBool.Response())
    assert not refused.success and "Another node publishes /motor/speed too (/bench, /bench)" in refused.message
    for _ in range(200):  # what waits in the queue
        rig.sample()
    now = rig.plant._other._heard or 0
    assert rig.plant._other.speaks(now) and not rig.plant._other.speaks(now + 2 * other_plant.SILENT)
    rig.plant._other._heard = time.monotonic_ns() - 2 * other_plant.SILENT  # it has ended
    rig.begin_again()
    bench.node.destroy_publisher(recorded)
    bench.wait(lambda: rig.plant._other._subscription is None, "the plant to listen no longer")


def test_a_publisher_that_comes_is_another_plant_before_it_says_anything(bench: Bench) -> None:
    """A recording began with references, and a controller obeyed them until its first sample."""
    rig = Rig(bench)
    bench.wait(lambda: rig.sample() == 6.0 and bool(rig.plant._other._ids), "a first look")
    bench.publisher(MotorSpeed, "motor/speed")
    bench.wait(lambda: rig.sample() == 0.0, "0 V")
    assert "(/bench, /bench)" in rig.plant._other.problem(time.monotonic_ns())
    rig.plant._other._unheard = frozenset()  # it has gone
    rig.begin_again()


class StandingRig(Rig):
    """The same, with ROS time that stands still, as `use_sim_time` without a /clock makes it."""

    def stamp(self) -> int:
        return 0


def test_another_plant_whose_clock_stands_as_ours_does_is_noticed(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All samples of both had the stamp 0, and each plant took the other's for its own."""
    monkeypatch.setattr(other_plant, "REMEMBERED", 300)
    rig, other = StandingRig(bench), bench.publisher(MotorSpeed, "motor/speed")
    bench.wait(lambda: rig.sample() == 6.0 and other.get_subscription_count() > 0, "the plant to listen")
    for _ in range(other_plant.REMEMBERED + 100):  # our own are heard once each, however many have one stamp
        assert rig.sample() == 6.0

    def play() -> float:
        other.publish(speed_message(Sample(rig.count, 0.0, 6.0), time_message(0), "motor"))
        return rig.sample()

    bench.wait(lambda: play() == 0.0, "0 V")
    assert rig.plant._other.speaks(time.monotonic_ns())


@pytest.mark.on_time
def test_two_plants_of_one_name_are_both_at_0_volt(bench: Bench, start: Start) -> None:
    """As processes; the second one would move with each voltage that the first one gets."""
    status = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    user = User(bench)
    start("motor_sim", "motor_sim")
    user.voltage = 5.0
    user.until(lambda sample: sample.voltage == 5.0, "motion")
    second = start("motor_sim", "motor_sim", "--ros-args", "-p", "seed:=1")
    bench.wait(
        lambda: bool(status) and "Another node publishes /motor/speed too" in status[-1].status[0].message, "the words"
    )
    heard = len(user.samples)
    bench.wait(lambda: {sample.voltage for sample in user.samples[-400:]} == {0.0}, "0 V of both for a second")
    assert sum(sample.voltage != 0.0 for sample in user.samples[heard:]) < 50  # each looks 20 times a second
    second.kill()  # its publisher is listed for a while
    alone = len(user.samples)
    bench.wait(lambda: bool(status) and STILL_SENT.search(status[-1].status[0].message), "the other words")
    if "went on" in status[-1].status[0].message:
        warnings.warn("the plant was held up for a second", stacklevel=1)
    assert {sample.voltage for sample in user.samples[alone:]} == {0.0}
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success
    user.until(lambda sample: sample.voltage == 5.0, "motion again")
