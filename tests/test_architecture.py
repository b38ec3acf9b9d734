"""The rules of the architecture: who may import what, and that the tree is formatted, linted and typed."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import TypeGuard

import pytest
import yaml

from motor_model.effects import EFFECT_BY_NAME, SPEC_BY_NAME

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = sorted(path.parent.name for path in ROOT.glob("motor_*/package.xml"))
# Arrows only point down: each package with those it may import.
BELOW = {
    "motor_model": set(),
    "motor_msgs": set(),
    "motor_ros": {"motor_model", "motor_msgs"},
    "motor_sim": {"motor_model", "motor_msgs", "motor_ros"},
    "motor_board": {"motor_model", "motor_ros"},
    "motor_driver": {"motor_model", "motor_ros"},
    "motor_control": {"motor_model", "motor_msgs", "motor_ros"},
    "motor_identification": {"motor_model", "motor_msgs", "motor_ros"},
    "motor_examples": {"motor_model", "motor_msgs", "motor_ros"},
    "motor_bringup": {"motor_model", "motor_identification"},
}
ROS = {"rclpy", "motor_msgs", "motor_ros", "std_msgs", "std_srvs", "sensor_msgs", "diagnostic_msgs", "rcl_interfaces"}
ROS |= {"builtin_interfaces", "geometry_msgs", "nav_msgs"}
# Where ROS may be imported: node files, command files, the modules that turn messages into plain values, and the one
# that looks up what is installed.
SHELLS = re.compile(
    r"(/node\.py|/messages\.py|/(answers|demands|neighbours|speakers)\.py|/diagnose_action\.py|/cli/(options/)?\w+\.py|/live/\w+\.py|motor_ros/motor_ros/((clocks|command|graph)/)?\w+\.py|motor_(board|control|driver|sim)/parameters\.py|/diff_drive/(motor|parameters)\.py|/service/(parameters|call_waiter)\.py|/bag/definition\.py)$"
)
# Effects are rows of a table, and nothing else knows one of them by name; but for:
SPECIAL = {
    "periodic/periodic_fit.py": "how each periodic effect is found: a line in a spectrum, or the first harmonic",
    "diagnosis/findings.py": "missed edges are counted in what a complete model leaves, not fitted",
    "live/speed_probe.py": "the model of the short ramp: as little as predicts a speed",
    "motor_control/parameters.py": "a parameter of the node with the same name",
    "motor_control/configuration.py": "the same parameter",
}
BAGS = re.compile(r"motor_identification/bag/((mcap|fields)/)?\w+\.py$")


# Inside a package too: its rooms (folders, or files beside them) from the ground up; each may import those before it.
ROOMS = {
    "motor_model": (
        "printable errors regular_file compiled frozen_record streams gearing program yaml_file given text_table "
        "effect effects sample parameters physical model_file excitation dynamics sensing simulate warm_up"
    ),
    "motor_control": (
        "checks filter controller announcements tuning configuration parameters warm_up preparation settings "
        "toggles messages answers speakers neighbours demands node cli programs"
    ),
    "motor_identification": (
        "recording progress experiment bag sensor measurement noise estimation timing periodic uncertainty physical "
        "validation discrepancy diagnosis identify diagnose reporting logs mapping monitoring service live cli programs"
    ),
}
MOST_MODULES = 15  # in one folder of a package


@cache
def list_modules() -> tuple[tuple[str, Path, set[str]], ...]:
    """List them; they are read where that is asked for, because every worker of the tests imports this file."""
    return tuple(sources())


def sources() -> Iterator[tuple[str, Path, set[str]]]:
    """Every module of our packages with the top-level packages it imports."""
    for package in PACKAGES:
        for path in sorted((ROOT / package / package).rglob("*.py")):
            names: set[str] = set()
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Import):
                    names |= {alias.name.split(".")[0] for alias in node.names}
                elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
                    names.add(node.module.split(".")[0])
            yield package, path, names


STAND_IN = {path.parent for path in (ROOT / "ros2_stand_in").rglob("*.py")}  # folders of the `ros2` command


def test_all_packages_are_known() -> None:
    assert set(PACKAGES) == set(BELOW)
    assert len(list_modules()) > 50


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_only_what_is_below(package: str) -> None:
    for owner, path, names in list_modules():
        if owner == package:
            ours = names & set(PACKAGES) - {package}
            assert ours <= BELOW[package], f"{path.relative_to(ROOT)} imports {ours - BELOW[package]}"


def imports_within(package: str) -> Iterator[tuple[Path, str, str]]:
    """Every import between rooms of a package: the file, its room, the room it needs."""
    root = ROOT / package / package
    for path in sorted(root.rglob("*.py")):
        here = path.relative_to(root).parts[0].removesuffix(".py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not (isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == package):
                continue
            inside = node.module.split(".")[1:]
            for there in [inside[0]] if inside else [alias.name for alias in node.names]:
                if there != here:
                    yield path, here, there


@pytest.mark.parametrize("package", sorted(ROOMS))
def test_rooms_import_only_what_is_below(package: str) -> None:
    rooms = ROOMS[package].split()
    root = ROOT / package / package
    there = {path.relative_to(root).parts[0].removesuffix(".py") for path in root.rglob("*.py")} - {"__init__"}
    assert there == set(rooms), "a room is new or gone: put it in its place in ROOMS"
    for path, here, needed in imports_within(package):
        assert rooms.index(needed) < rooms.index(here), f"{path.relative_to(ROOT)} ({here}) imports {needed}"


def test_no_folder_holds_more_than_fifteen_modules() -> None:
    for folder in {path.parent for _, path, _ in list_modules()} | STAND_IN:
        modules = [path for path in folder.glob("*.py") if path.name != "__init__.py"]
        assert len(modules) <= MOST_MODULES, f"{folder.relative_to(ROOT)} holds {len(modules)} modules: group them"


def test_every_folder_says_what_it_is_for() -> None:
    for folder in {path.parent for _, path, _ in list_modules()} | STAND_IN:
        said = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8")))
        assert said and len(said) > 40, f"{folder.relative_to(ROOT)}/__init__.py does not say what it is for"


def is_algorithmic(path: Path, imported: set[str]) -> bool:
    """Whether a module computes something: it has functions, and neither talks to ROS nor is a command."""
    shell = (
        imported & ROS
        or {"cli", "live"} & set(path.relative_to(ROOT).parts)
        or path.name in ("__init__.py", "warm_up.py", "programs.py")
    )
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return not shell and any(isinstance(node, ast.FunctionDef) for node in ast.walk(tree))


def test_every_algorithmic_module_has_a_test_file_of_its_own_name() -> None:
    """In the folder that mirrors its own. Those that have none yet are listed one by one; the list only shrinks."""
    without = set()
    for package, path, imported in list_modules():
        inside = path.relative_to(ROOT / package / package)
        mirrored = ROOT / "tests" / package.removeprefix("motor_") / inside.with_name(f"test_{inside.name}")
        if is_algorithmic(path, imported) and not mirrored.exists():
            without.add(f"{package}/{inside.with_suffix('')}")
    listed = set((ROOT / "tests" / "without_test_file.txt").read_text(encoding="utf-8").split())
    assert not without - listed, f"write a test file of its own name for {sorted(without - listed)}"
    assert not listed - without, f"take out of tests/without_test_file.txt: {sorted(listed - without)}"


def test_ros_stays_in_the_shells() -> None:
    for _, path, names in list_modules():
        if names & ROS:
            assert SHELLS.search(path.as_posix()), f"{path.relative_to(ROOT)} imports {names & ROS}"


def test_effects_are_known_by_name_in_their_table_only() -> None:
    """Whoever adds an effect edits its row and its term: nothing else asks what an effect is called."""
    special = set()
    for _, path, _ in list_modules():
        if path.parts[-2:] == ("motor_model", "effects.py"):
            continue
        texts = {node.value for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if _is_text(node)}
        if known := texts & set(EFFECT_BY_NAME) - set(SPEC_BY_NAME):  # terms do know parameters by name
            special.add("/".join(path.parts[-2:]))
            assert special <= set(SPECIAL), f"{path.relative_to(ROOT)} knows {known}: make it a column"
    assert special == set(SPECIAL), "an exception is needed no more"


def _is_text(node: ast.AST) -> TypeGuard[ast.Constant]:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def test_bags_are_known_in_one_place() -> None:
    for _, path, names in list_modules():
        if names & {"rosbags", "mcap", "apsw"}:
            assert BAGS.search(path.as_posix()), f"{path.relative_to(ROOT)} knows bags"


def test_serial_ports_are_opened_in_one_place() -> None:
    users = [path for _, path, names in list_modules() if names & {"serial", "termios"}]
    ports = [path for path in users if path.name == "link.py" and path.parent.name == "motor_driver"]
    pseudo = [path for path in users if path.name == "port.py" and path.parent.name == "emulation"]  # the other end
    assert len(ports) == 1 and users == pseudo + ports


@pytest.mark.parametrize("package", sorted(path.parent.name for path in ROOT.glob("motor_*/setup.py")))
def test_setup_py_says_of_a_package_what_its_package_xml_says(package: str) -> None:
    setup, manifest = ((ROOT / package / name).read_text(encoding="utf-8") for name in ("setup.py", "package.xml"))
    for tag in ("description", "version", "license"):
        said = re.search(rf"<{tag}>(.*)</{tag}>", manifest)
        assert said is not None and f'{tag}="{said[1]}"' in setup, tag


@pytest.mark.parametrize("package", [package for package in PACKAGES if package != "motor_msgs"])
def test_package_xml_names_what_is_imported(package: str) -> None:
    """Every imported package is a dependency by its rosdep key, or one of those that come from PyPI."""
    text = (ROOT / package / "package.xml").read_text(encoding="utf-8")
    declared = set(re.findall(r"<(?:exec_)?depend>([\w-]+)</", text))
    keys = {"numpy": "python3-numpy", "scipy": "python3-scipy", "yaml": "python3-yaml", "tqdm": "python3-tqdm"}
    keys |= {"jinja2": "python3-jinja2", "argcomplete": "python3-argcomplete"}
    keys |= {"matplotlib": "python3-matplotlib", "serial": "python3-serial"}
    rows = re.findall(r"from PyPI[^:]*: ([^>]*?) -->", text)
    from_pypi = {name.strip().split(".")[0] for row in rows for name in row.split(",")}
    for owner, path, names in list_modules():
        if owner != package:
            continue
        for name in names - set(sys.stdlib_module_names) - {package}:
            assert keys.get(name, name) in declared | from_pypi, f"{path.relative_to(ROOT)} imports {name}"


def run(*command: str) -> None:
    done = subprocess.run([sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_formatted() -> None:
    run("ruff", "format", "--check", ".")


def test_linted() -> None:
    run("ruff", "check", ".")


@pytest.mark.long
def test_all_modules_are_typed() -> None:
    run("mypy")


def test_what_compares_times_is_run() -> None:
    """`test.sh` looks for the mark on a line of its own: there is no other."""
    line = "^@pytest.mark.on_time$"
    run = f"""-m "on_time$tier" $(grep -rl --include='*.py' '{line}' tests)\n"""
    assert run in (ROOT / "test.sh").read_text("utf-8")
    texts = {path: path.read_text("utf-8") for path in (ROOT / "tests").rglob("*.py") if path != Path(__file__)}
    marked = {path: len(re.findall(re.escape(line[1:-1]) + "$", text, re.MULTILINE)) for path, text in texts.items()}
    assert sum(marked.values()) > 20
    assert all(text.count("mark.on_time") == marked[path] for path, text in texts.items())


def test_commit_hooks_and_continuous_integration_call_what_developers_call() -> None:
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text(encoding="utf-8"))["repos"]
    assert [repo["repo"] for repo in hooks] == ["local"]  # nothing is downloaded
    entries = [hook["entry"] for hook in hooks[0]["hooks"]]
    assert entries == ["./test.sh -q tests/test_architecture.py", "./test.sh"]
    jobs = yaml.safe_load((ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8"))["jobs"]
    steps = [step for job in jobs.values() for step in job["steps"]]
    assert [step["run"] for step in steps if "run" in step] == [".ci/run"]
    assert {step["uses"].split("@")[0] for step in steps if "uses" in step} == {
        "actions/checkout",
        "actions/setup-python",
    }
    assert (ROOT / ".ci" / "run").read_text(encoding="utf-8").rstrip().endswith("exec ./test.sh")


def test_nothing_outside_the_repository_is_needed() -> None:
    outside = re.compile("shared/" + "data|[.][.]/" + "shared")
    tracked = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True)
    if tracked.returncode:
        pytest.skip("not a checkout")
    for name in filter(None, tracked.stdout.split("\0")):
        if (ROOT / name).suffix in (".py", ".md", ".sh", ".yaml", ".yml", ".toml", ".json"):
            assert not outside.search((ROOT / name).read_text(encoding="utf-8")), name


@pytest.mark.parametrize("name", ["everything", "beside_ros"])
def test_every_pinned_package_has_its_hashes(name: str) -> None:
    text = (ROOT / "requirements" / f"{name}.lock").read_text(encoding="utf-8")
    pins = re.split(r"^(?=\S)", text, flags=re.MULTILINE)[1:]
    assert len(pins) > 30
    for pin in pins:
        assert re.match(r"[\w.-]+(\[\w]+\])?==\S+", pin) and "--hash=sha256:" in pin, pin.splitlines()[0]
    assert "://" not in text
    assert "--require-hashes -r $lock" in (ROOT / "setup.sh").read_text(encoding="utf-8")
