"""What a request names stays inside the directory that the node was given."""

from pathlib import Path

import pytest

from motor_identification.service.places import Places
from motor_model.errors import MotorError


@pytest.fixture
def bags(tmp_path: Path) -> Path:
    bags = tmp_path / "bags"
    for folder in (bags / "step", tmp_path / "secret"):
        folder.mkdir(parents=True)
    (bags / "out").symlink_to(tmp_path / "secret")
    (bags / "in").symlink_to("step")
    (bags / "loop").symlink_to("loop")
    (tmp_path / "name of it").symlink_to("bags")
    return bags


@pytest.mark.parametrize("uri", ["step", "./step/../step", "in", ".", "nowhere"])
def test_what_lies_inside_is_taken(bags: Path, uri: str) -> None:
    for root in (bags, bags.parent / "name of it"):
        assert Places(str(root)).bag(uri) == str(root / uri)
        assert Places(str(root)).bag(str(bags / "step")) == str(bags / "step")  # named whole, and inside


@pytest.mark.parametrize("uri", ["..", "../secret", "/etc", "out", "out/x", "step/../../secret", "loop", "a\0b", "/"])
def test_what_lies_outside_is_refused_also_behind_a_link(bags: Path, uri: str) -> None:
    with pytest.raises(MotorError, match="is outside of bag_directory .*: name a bag in it, or start the node"):
        Places(str(bags)).bag(uri)
    assert Places(str(bags), absolute_uris=True).bag(uri) == str(bags / uri)


def test_reports_stay_inside_too(bags: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    inside = Places(str(bags))
    assert inside.report(str(bags / "step")) == bags / "step_diagnosis.html"
    assert inside.report(str(bags)) == bags / "bags_diagnosis.html"  # the directory itself is the bag
    assert Places(str(bags), str(tmp_path / "reports")).report(str(bags / "step")).parent == tmp_path / "reports"
    assert Places(str(bags), absolute_uris=True).report("/x/step") == Path("/x/step_diagnosis.html")
    monkeypatch.chdir(bags)
    assert Places().report("step") == bags / "step_diagnosis.html"
    with pytest.raises(MotorError, match=r"\(the working directory\)"):
        Places().bag("../secret")
