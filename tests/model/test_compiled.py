"""Machine code never outlives the source it was made of: the cache is named after everything it depends on."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import motor_identification
import motor_model
from motor_model.compiled import CACHE

SOURCES = Path(motor_model.__file__).resolve().parent
IDENTIFICATION = Path(motor_identification.__file__).resolve().parent

ASK = """
import sys
sys.path.insert(0, sys.argv[1])
import motor_model.compiled as c, motor_model
from pathlib import Path
assert motor_model.__file__.startswith(sys.argv[1]), motor_model.__file__
print(c.CACHE)
print(c._cache_of(Path(sys.argv[1]) / "motor_identification"))
"""


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Sources of the model and of what stands on it, without caches."""
    for folder in (SOURCES, IDENTIFICATION):
        shutil.copytree(folder, tmp_path / folder.name, ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


def caches(root: Path) -> tuple[str, str]:
    """Where a process that starts now would keep the model's machine code, and that of identification."""
    done = subprocess.run([sys.executable, "-c", ASK, str(root)], capture_output=True, text=True, check=True)
    model, identification = done.stdout.split()
    assert Path(model).parent == root / "motor_model" / "__pycache__"
    return model, identification


def test_an_edit_of_any_source_is_another_cache(copy: Path) -> None:
    seen = {caches(copy)}
    assert caches(copy) in seen
    for name in ("forces.py", "bridge.py", "effects.py"):
        with (copy / "motor_model" / name).open("a", encoding="utf-8") as source:
            source.write("# edited\n")
        now = caches(copy)
        assert all(now[0] != model and now[1] != identification for model, identification in seen)
        seen.add(now)


def test_an_edit_of_what_calls_the_model_is_another_cache_for_that_only(copy: Path) -> None:
    """A compiled function may call one of a neighbouring file; Numba itself would look at its own file only."""
    model, identification = caches(copy)
    with (copy / "motor_identification" / "residual.py").open("a", encoding="utf-8") as source:
        source.write("# edited\n")
    model_then, identification_then = caches(copy)
    assert model_then == model and identification_then != identification


def test_the_cache_in_use_is_that_of_the_present_sources() -> None:
    assert CACHE.parent == SOURCES / "__pycache__"
    assert CACHE.is_dir() and any(CACHE.rglob("*.nbi"))
