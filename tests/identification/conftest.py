"""Diagnoses that reports and words are tested on."""

from dataclasses import replace

import pytest
from diagnosed import diagnosis

from motor_identification.diagnosis.result import Diagnosis, Verdict


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pages without pictures, where only the text matters."""
    for name in ("pictures.draw_overlay", "diagnosis_page.draw_map", "diagnosis_page.draw_torque"):
        monkeypatch.setattr(f"motor_identification.reporting.html.{name}", lambda *how: "")


@pytest.fixture(scope="module")
def found() -> Diagnosis:
    """Coulomb friction of 0.4 V is found."""
    return diagnosis("coulomb_friction", ks=0.4)


@pytest.fixture(scope="module")
def variants(found: Diagnosis) -> dict[Verdict, Diagnosis]:
    """A diagnosis for every verdict."""
    ambiguous = replace(found.findings[0], ambiguous_with=("dead_zone", "load_bias"), suggested_experiment="coast")
    bare = replace(found, findings=(), model=found.baseline, after=found.before, gap_after=found.gap_before)
    fine = replace(found, findings=(), baseline=found.model, before=found.after, gap_before=found.gap_after)
    return {
        Verdict.EXPLAINED: found,
        Verdict.NOTHING_MISSING: replace(fine, verdict=Verdict.NOTHING_MISSING),
        Verdict.UNEXPLAINED: replace(bare, verdict=Verdict.UNEXPLAINED),
        Verdict.UNDECIDED: replace(
            found, verdict=Verdict.UNDECIDED, findings=(ambiguous,), suggested_experiment="coast"
        ),
    }
