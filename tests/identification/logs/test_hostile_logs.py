"""Damaged, forged and odd logs: each is read or refused in one sentence, and what is read can be a motor's."""

import json
import warnings
from pathlib import Path

import numpy as np
import pytest
from tiers import keep_fast

from motor_identification.logs.columns.said import Said
from motor_identification.logs.count_size import MOST_EDGES
from motor_identification.logs.imported import import_log
from motor_model.errors import MotorError
from motor_model.sample import check_info

DATA = Path(__file__).resolve().parents[2] / "data"
NAMES = (
    "undc/prbs_2026-08-14",
    "esp32/step_response",
    "ev3/steps_1s",
    "micromouse/testPid3",
    "undc/static_2026-08-17",
)
CELLS = [
    *("", "nan", "inf", "-inf", "1e308", "-1e308", "1e-320", "99999999999999999999", "0x10", "1,5", "1.5.2", "--", "'"),
    *('"', "a;b", "\t", "12:00:00", "2026-01-01T00:00:00", "é", "\x1b[31m", "=1+1", "-0", "1e", "NaN", "1_0", "٣", "²"),
    *("1 2", "1\r2", "9" * 400),
]
VALUES = [None, -1, "x", [], {}, [[]], [[1e308] * 9] * 9, True, "Meters", [[1, 2, 3, 4]] * 3, 0, [[0] * 9] * 50]
SAID = (
    Said(),
    Said(supply_voltage=7.4, unit="rpm"),
    Said(unit="deg", edges_per_revolution=48, supply_voltage=5.0),
    Said(unit="count", edges_per_revolution=MOST_EDGES, supply_voltage=1e-6),
    Said(steady=True, unit="deg/s", supply_voltage=5.0),
    Said(unit="rad", wrap=1e-9, supply_voltage=9.0),
    Said(unit="deg/s", count_quantum=1e-300, supply_voltage=3.0),
    Said(unit="deg", count_quantum=1e-200, supply_voltage=3.0),
    Said(unit="rpm", speed_window=1e-12, speed_lag=900.0, voltage_scale=1e9),
)


def bases() -> list[bytes]:
    """The names and the ends of public logs, and the beginning of a SysId log."""
    lines = [(DATA / f"{name}.csv").read_bytes().split(b"\n") for name in NAMES]
    heads = [b"\n".join([rows[0], *rows[-100:]]) for rows in lines]
    log = json.loads((DATA / "frc/drivetrain_sysid.json").read_text())
    short = {name: value[:50] if isinstance(value, list) else value for name, value in log.items()}
    return [*heads, json.dumps(short).encode()]


def mutate(data: bytes, random: np.random.Generator) -> bytes:
    """One of seven kinds of damage."""
    kind, is_json = int(random.integers(7)), data.startswith(b"{")
    changed = bytearray(data)
    if kind == 0:
        for _ in range(int(random.integers(1, 6))):
            changed[int(random.integers(len(changed)))] = int(random.integers(256))
        return bytes(changed)
    if kind == 1:
        return data[: int(random.integers(len(data)))]
    if kind == 2:
        place = int(random.integers(len(data)))
        return (
            data[:place] + data[place : place + int(random.integers(2000))] * int(random.integers(2, 20)) + data[place:]
        )
    if is_json:
        log = json.loads(data)
        log[list(log)[int(random.integers(len(log)))]] = VALUES[int(random.integers(len(VALUES)))]
        return json.dumps(log).encode()
    return mutate_cells(data, random, kind)


def mutate_cells(data: bytes, random: np.random.Generator, kind: int) -> bytes:
    rows = [line.split(",") for line in data.decode().split("\n")]
    column = int(random.integers(len(rows[0])))
    if kind == 3:
        scale = repr(10.0 ** random.uniform(-300, 300))
        rows[1:] = [[scale if k == column else cell for k, cell in enumerate(row)] for row in rows[1:]]
    for _ in range(int(random.integers(1, 4))):
        row = rows[int(random.integers(kind > 4, len(rows)))]
        row[int(random.integers(len(row)))] = CELLS[int(random.integers(len(CELLS)))]
    if kind == 6:
        first, second = (int(random.integers(len(rows))) for _ in range(2))
        rows[first], rows[second] = rows[second], rows[first]
    return "\n".join(",".join(row) for row in rows).encode("utf-8", "surrogatepass")


@pytest.mark.parametrize("seeds", keep_fast([range(15), range(15, 60)], range(15)), ids=["a few", "the others"])
@pytest.mark.parametrize("part", range(6))
def test_no_damage_breaks_it(tmp_path: Path, part: int, seeds: range) -> None:
    base, read = bases()[part], 0
    for seed in seeds:
        random = np.random.default_rng([part, seed])
        path = tmp_path / "log"
        path.write_bytes(mutate(base, random))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                imported = import_log(path, SAID[int(random.integers(len(SAID)))])
        except MotorError as error:
            assert "\n" not in str(error) and len(str(error)) < 700, (seed, error)
            continue
        read += 1
        for motor in imported.motors:
            info = motor.log.info
            check_info(info)
            assert np.isfinite([info.max_voltage, info.speed_window, info.speed_lag, info.sample_period]).all(), seed
            for run in motor.log.runs:
                numbers = np.array([(one.speed, one.voltage, one.edge_count) for one in run.samples], dtype=np.float64)
                assert np.isfinite(numbers).all() and np.abs(numbers[:, 2]).max() < 2**60, seed
                assert np.all(np.diff([one.sample_time for one in run.samples]) > 0), seed
    assert read >= len(seeds) // 15


def test_the_largest_numbers_warn_of_nothing(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    path.write_text("t,voltage,position\n" + "".join(f"{k},{(-1) ** k * 1.7e308},{k}\n" for k in range(20)))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(MotorError, match="V, which no such motor has"):
            import_log(path, Said(unit="deg", voltage_scale=1.0))


@pytest.mark.parametrize("size", [1e-299, 1e-160, 1e160, 1e299])
@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("names", ["time,u,speed (deg/s),pos", "time,u,a,b"])
def test_a_speed_of_no_size_beside_counts_is_a_sentence(tmp_path: Path, size: float, names: str) -> None:
    steps = np.random.default_rng(3).integers(1, 9, 200)
    rows = [
        f"{0.1 * k:.1f},{5 * (k > 20)},{float(step * size)!r},{sum(steps[: k + 1])}" for k, step in enumerate(steps)
    ]
    (tmp_path / "log.csv").write_text("\n".join([names, *rows]))
    with pytest.raises(MotorError):
        import_log(tmp_path / "log.csv", Said())


@pytest.mark.parametrize("delimiter", keep_fast([" ", "\t", ";", "x"], ";", "x"))
def test_a_line_longer_than_any_cell_may_be_is_a_sentence(tmp_path: Path, delimiter: str) -> None:
    path = tmp_path / "log.csv"
    path.write_text(f"time,u,speed\ndata = [{delimiter.join(['0.125'] * 40_000)}]\n0,1,2\n")
    with pytest.raises(MotorError) as refused:
        import_log(path, Said())
    assert "\n" not in str(refused.value) and len(str(refused.value)) < 700


def test_a_motion_that_is_told_before_its_voltage_only_leaves_no_rows(tmp_path: Path) -> None:
    rows = [f"{k * 0.01:.2f},,{k % 7}" for k in range(100)] + [f"{1 + k * 0.01:.2f},{k % 3}," for k in range(100)]
    (tmp_path / "log.csv").write_text("\n".join(["t,u,rpm", *rows]))
    with pytest.raises(MotorError, match="rpm has no value in any row from the first of u on"):
        import_log(tmp_path / "log.csv", Said())


@pytest.mark.filterwarnings("error")
def test_the_largest_numbers_of_a_file_of_arrays_are_none(tmp_path: Path) -> None:
    table = np.column_stack([np.arange(100) * 0.01, np.arange(100) // 10 % 3, np.arange(100) % 7])
    table[20, 2], table[40, 2] = 1e308, -1.7e308
    table[60:, 2] = 1.7e308
    np.save(tmp_path / "log.npy", table)
    (run,) = import_log(tmp_path / "log.npy", Said(unit="rpm")).motors[0].log.runs
    assert len(run.samples) < 60 and max(abs(sample.speed) for sample in run.samples) < 1.0
