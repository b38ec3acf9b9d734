"""Writes the motors of an imported log: a bag for every run of each, or none at all."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from tqdm import tqdm

from motor_identification.bag import BagWriter
from motor_identification.bag.metadata import CAUTION_KEY, IMPORT
from motor_identification.live.qos_profiles import offered
from motor_identification.logs.serialised import speed_messages, voltage_messages
from motor_model.errors import RecordingError
from motor_ros import qos

if TYPE_CHECKING:
    from motor_identification.logs import Run
    from motor_identification.logs.imported import Imported
    from motor_model.sample import Info

CAUTION = "Caution: "  # what a finding begins with that stays true of the recording, whoever reads it
_SINCE_1970 = 10**18  # [ns] the year 2001: a log whose times are later counts from 1970
_LAST = 2**31 * 10**9  # [ns] the year 2038, which a message's stamp ends with
_CHUNK = 50_000  # samples serialised at a time


def run_import(file: Path, imported: "Imported", output: Path | None, force: bool) -> int:
    """Write the bags where an output was given, and say what was found."""
    said = [*imported.findings]
    bags: dict[Path, tuple[Run, Info]] = {}
    cautions: dict[Path, list[str]] = {}
    for motor in imported.motors:
        if motor.label:
            said.append(f"\nMotor {motor.label}:")
        said += motor.log.findings
        for run in motor.log.runs:
            parts = [part for part in (motor.label, run.label) if part]
            if output is not None:
                bag = output.with_name("_".join([output.name, *parts]))
                bags[bag] = (run, motor.log.info)
                cautions[bag] = find_cautions((*imported.findings, *motor.log.findings))
    try:  # bags first: who reads what is said may go at any line
        if bags:
            write_bags(bags, _offset(file, next(iter(bags.values()))[0]), force, cautions)
            said += [f"{path}: {len(run.samples)} samples, {run.duration:.2f} s" for path, (run, _) in bags.items()]
        else:
            said.append("Nothing is written (--dry-run).")
    finally:
        print(*said, sep="\n")
    return 0


def find_cautions(findings: Iterable[str]) -> list[str]:
    """The findings that a result has to be read with, too, long after the import: without their first word."""
    return [line.removeprefix(CAUTION) for line in findings if line.startswith(CAUTION)]


def write_bags(
    bags: "dict[Path, tuple[Run, Info]]",
    offset: int,
    force: bool = False,
    cautions: Mapping[Path, Sequence[str]] = MappingProxyType({}),
) -> None:
    """One bag a run, or none at all: whatever comes in between, what was begun is removed.

    Args:
        bags: the run and its motor, by the bag's path.
        offset: [ns] from the log's clock to ROS time.
        force: replace what exists.
        cautions: what the bags keep for those who read them, by the bag's path.

    Raises:
        RecordingError: a path exists already, or cannot be written; times are beyond what a message can say.
    """
    for run, _ in bags.values():
        if not 0 <= offset + run.samples[0].sample_time <= offset + run.samples[-1].sample_time < _LAST:
            raise RecordingError(
                "The log's times lie before 1970 or after 2038 as ROS counts: check --time and --time-unit."
            )
    writers: list[BagWriter] = []
    try:
        writers.extend(BagWriter(path, force, part=False) for path in bags)
        total = sum(len(run.samples) for run, _ in bags.values())
        with tqdm(total=total, desc="writing", unit="row", delay=2.0, disable=None) as bar:
            for writer, (path, (run, info)) in zip(writers, bags.items(), strict=True):
                if told := cautions.get(path):
                    writer.note(IMPORT, {f"{CAUTION_KEY}{number}": text for number, text in enumerate(told, 1)})
                _write(writer, run, info, offset, bar.update)
                writer.close()
    except BaseException:
        for writer in writers:
            writer.discard()
        raise


def _offset(file: Path, first: "Run") -> int:
    """[ns] from the log's clock to ROS time: the file's date, where the log itself does not count from 1970."""
    return 0 if first.samples[0].sample_time > _SINCE_1970 else file.stat().st_mtime_ns


def _write(writer: "BagWriter", run: "Run", info: "Info", offset: int, done: Callable[[int], object]) -> None:
    from rclpy.serialization import serialize_message

    from motor_ros.messages import info_message, time_message

    latched = writer.topic("/motor/info", "motor_msgs/msg/MotorInfo", offered(qos.INFO))
    speed = writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed", offered(qos.SPEED))
    voltage = writer.topic("/motor/voltage", "motor_msgs/msg/MotorVoltage", offered(qos.VOLTAGE))
    start = offset + run.samples[0].sample_time
    writer.write(latched, start, serialize_message(info_message(info, time_message(start))))
    for begin in range(0, len(run.samples), _CHUNK):
        samples = run.samples[begin : begin + _CHUNK]
        stamps = np.array([sample.sample_time for sample in samples], np.int64) + offset
        rows = zip(
            stamps.tolist(),
            voltage_messages(samples, stamps, info.name),
            speed_messages(samples, stamps, info.name),
            strict=True,
        )
        for now, volts, moved in rows:
            writer.write(voltage, now, volts)
            writer.write(speed, now, moved)
        done(len(samples))
