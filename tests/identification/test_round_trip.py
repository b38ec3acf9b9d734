"""Our motors exported as other people's logs come back, without hints: eleven of the cases of the benchmark."""

from pathlib import Path

import pytest
from exported_logs import draw_case, write_case
from tiers import keep_fast

from motor_identification.identify import Request, identify
from motor_identification.logs.columns.guess import guess_forms
from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.reader import read_table
from motor_identification.logs.form import Kind
from motor_identification.logs.imported import import_log
from motor_identification.recording import check, recording_of


@pytest.mark.parametrize("seed", keep_fast([*range(1000, 1008), *range(1009, 1012)], 1000, 1010))
def test_kv_and_ka_come_back(tmp_path: Path, seed: int) -> None:
    case, path = draw_case(seed), tmp_path / "log.csv"
    write_case(case, path)
    said = Said(edges_per_revolution=case.edges if case.kind is Kind.COUNT else None)
    (form,) = guess_forms(read_table(path), said).forms
    assert (form.kind, form.unit, form.time_unit) == (case.kind, case.unit, case.time_unit)
    (motor,) = import_log(path, said).motors
    runs = [check(recording_of(run.samples, motor.log.info, run.label)) for run in motor.log.runs]
    values = identify(runs, Request(("coulomb_friction",))).parameters.values
    assert values["kv"] == pytest.approx(case.truth.values["kv"], rel=0.01)
    assert values["ka"] == pytest.approx(case.truth.values["ka"], rel=0.05)
