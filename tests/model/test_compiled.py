"""Machine code never outlives what it was made of, and a sentence that changes compiles nothing again."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from tiers import mark_slow

import motor_identification
import motor_model
from motor_model.compiled import _content, cache_of

PACKAGES = [Path(package.__file__ or "").resolve().parent for package in (motor_model, motor_identification)]
MODULES = {
    "motor": "motor_model.dynamics.motor",
    "bridge": "motor_model.dynamics.bridge",
    "roll_out": "motor_model.simulate",
    "residual": "motor_identification.estimation.residual",
    "viterbi": "motor_identification.noise.viterbi",
}

ALL_THAT_MOVES = set(MODULES) - {"viterbi"}

ASK = """
import sys
sys.path.insert(0, sys.argv[1])
from importlib import import_module
from motor_model.compiled import _content, cache_of
for name in sys.argv[2:]:
    module = import_module(name)
    assert module.__file__.startswith(sys.argv[1]), module.__file__
    print(cache_of(name))
"""


def copy_sources(root: Path) -> Path:
    """Copy the sources of the model and of what stands on it, without caches."""
    for folder in PACKAGES:
        shutil.copytree(folder, root / folder.name, ignore=shutil.ignore_patterns("__pycache__"))
    return root


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Sources to be edited."""
    return copy_sources(tmp_path)


@pytest.fixture(scope="module")
def before(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The caches of sources that nobody has edited: the same in every process."""
    root = copy_sources(tmp_path_factory.mktemp("unedited"))
    found = caches(root)
    assert caches(root) == found
    return found


def caches(root: Path) -> dict[str, str]:
    """Where, under root, a process that starts now would keep the machine code of each of MODULES."""
    command = [sys.executable, "-c", ASK, str(root), *MODULES.values()]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found = dict(zip(MODULES, done.stdout.split(), strict=True))
    assert Path(found["bridge"]).parent == root / "motor_model" / "dynamics" / "__pycache__"
    return {name: Path(cache).relative_to(root).as_posix() for name, cache in found.items()}


def edit(root: Path, module: str, old: str, new: str) -> None:
    path = root / Path(*module.split(".")).with_suffix(".py")
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


def changed(before: dict[str, str], after: dict[str, str]) -> set[str]:
    return {name for name in before if before[name] != after[name]}


@pytest.mark.parametrize(
    ("module", "old", "new", "recompiled"),
    [
        # a term of the equation: all that integrates it, however far up
        ("motor_model.dynamics.bridge", "return u - dead", "return u - 2.0 * dead", ALL_THAT_MOVES),
        # a constant that is imported by value
        mark_slow(
            "motor_model.dynamics.pieces",
            "\n@compiled",
            "\nLONGER = 2.0\n\n\n@compiled",
            {"motor", "roll_out", "residual"},
        ),
        # another place in the parameter vector
        mark_slow(
            "motor_model.effects",
            '"max_voltage", "coarseness"',
            '"coarseness", "max_voltage"',
            ALL_THAT_MOVES,
        ),
        ("motor_identification.noise.viterbi", "-price", "-2.0 * price", {"viterbi"}),
    ],
)
def test_an_edit_recompiles_all_that_depends_on_it(
    copy: Path, before: dict[str, str], module: str, old: str, new: str, recompiled: set[str]
) -> None:
    edit(copy, module, old, new)
    assert changed(before, caches(copy)) == recompiled


SENTENCES = [
    ("motor_model.effects", "Stribeck friction at low speed", "more friction at low speed"),  # what people read
    ("motor_model.effects", "starts=(0.03,)", "starts=(0.04,)"),  # what only a diagnosis reads
    ("motor_model.dynamics.bridge", "The H-bridge", "The bridge of transistors"),  # a docstring beside a kernel
    ("motor_identification.recording", "the motor never moves", "the motor never turns"),
    ("motor_identification.reporting.fit_text", "residual", "rest"),
]


def test_edited_sentences_recompile_nothing(copy: Path, before: dict[str, str]) -> None:
    for module, old, new in SENTENCES:
        edit(copy, module, old, new)
    assert changed(before, caches(copy)) == set()


@pytest.mark.slow
def test_what_was_read_of_a_source_is_kept_for_exactly_that_source(copy: Path, before: dict[str, str]) -> None:
    assert caches(copy) == before
    kept = copy / "motor_identification" / "noise" / "__pycache__" / "numba-viterbi.json"
    key, own, *_ = json.loads(kept.read_text())
    kept.write_text(kept.read_text().replace(own, "0" * 64))  # it is what is believed
    assert changed(before, caches(copy)) == {"viterbi"}
    kept.write_text(kept.read_text().replace(key, "0" * 64))  # of another source it is not
    assert caches(copy) == before
    edit(copy, "motor_identification.noise.viterbi", "-price", "-2.0 * price")
    assert changed(before, caches(copy)) == {"viterbi"}
    kept.write_text("[")
    assert changed(before, caches(copy)) == {"viterbi"}


def test_the_caches_in_use_are_those_of_the_present_sources() -> None:
    for name in MODULES.values():
        __import__(name)
    assert any(cache_of("motor_model.dynamics.motor").rglob("*.nbi"))


def test_a_module_that_is_built_into_the_interpreter_has_no_file() -> None:
    """`math` is a file of its own in some distributions, and part of the interpreter in others."""
    assert _content("sys") == sys.version.encode()
    assert _content("motor_model.compiled") == Path(motor_model.__file__).with_name("compiled.py").read_bytes()
