"""What comes in as data stays data: every place where a string becomes an import, a command or a socket is listed."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("motor_*/motor_*", "ros2_stand_in", "demo", "docs", "benchmarks")
FILES = sorted({path for folder in FOLDERS for place in ROOT.glob(folder) for path in place.rglob("*.py")})

# Where each of these may stand, and why that is no content's choice. A new place is a decision: write its reason here.
IMPORTS = {
    "motor_ros/motor_ros/interface_types.py": "installed interfaces, by form, ament index and place",
    "ros2_stand_in/main.py": "a row of the table of verbs",
    "benchmarks/peers.py": "names that stand in the same file",
}
COMMANDS = {
    "motor_board/motor_board/build.py": "compilers with their arguments, as a list",
    "motor_board/motor_board/programmer.py": "avrdude with its arguments, as a list",
    "ros2_stand_in/verbs/run.py": "an executable of an installed package, as the user has typed",
    "demo/demo.py": "the commands that it shows",
}
SOCKETS = {
    "motor_board/motor_board/emulation/port.py": "a name without a file that is bound and never listened on: a lock"
}
PROCESSES = {"motor_identification/motor_identification/service/worker.py": "a pipe to its own child; see its test"}
LIBRARIES = {
    "motor_board/motor_board/emulation/library.py": "the emulator that it has built itself",
}
KINDS = (ast.Import, ast.ImportFrom, ast.Call)
NEVER = {"pickle", "cPickle", "dill", "cloudpickle", "joblib", "shelve", "marshal", "runpy", "code", "codeop", "imp"}
NEVER_CALLED = {"eval", "exec", "compile", "__import__", "execfile", "input"}
NETWORK = {"socket", "socketserver", "http", "xmlrpc", "asyncio", "ssl", "ftplib", "smtplib", "urllib", "requests"}


def name_of(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@cache
def nodes(kind: type) -> list[tuple[str, ast.AST]]:
    return [(name, node) for name, node in all_nodes() if isinstance(node, kind)]


@cache
def all_nodes() -> list[tuple[str, ast.AST]]:
    """Files with their imports and calls: all other nodes would keep the garbage collector busy."""
    trees = ((name_of(path), ast.parse(path.read_text(encoding="utf-8"))) for path in FILES)
    return [(name, node) for name, tree in trees for node in ast.walk(tree) if isinstance(node, KINDS)]


def imported() -> Iterator[tuple[str, str]]:
    """Files and the modules that they import, whole names."""
    for name, node in nodes(ast.Import):
        yield from ((name, alias.name) for alias in node.names)
    for name, node in nodes(ast.ImportFrom):
        yield name, node.module or ""


@cache
def called() -> list[tuple[str, str, ast.Call]]:
    """Files and what they call, as it is written: `subprocess.run`, `eval`."""
    calls = [(name, node) for name, node in nodes(ast.Call) if isinstance(node.func, (ast.Name, ast.Attribute))]
    return [(name, written(node.func), node) for name, node in calls]


def written(function: ast.expr) -> str:
    """What is called, as it is written; names with dots are quicker put together than unparsed."""
    if isinstance(function, ast.Name):
        return function.id
    if isinstance(function, ast.Attribute):
        return f"{written(function.value)}.{function.attr}"
    return ast.unparse(function)


def users(*modules: str) -> set[str]:
    """Files, benchmarks apart, that import one of the modules."""
    return {name for name, module in imported() if module.split(".")[0] in modules and not _is_benchmark(name)}


def _is_benchmark(name: str) -> bool:
    return name.startswith("benchmarks/")


def test_there_are_files() -> None:
    assert len(FILES) > 250


def test_nothing_is_unpickled_and_no_text_is_run() -> None:
    assert [(name, module) for name, module in imported() if module.split(".")[0] in NEVER] == []
    assert [(name, what) for name, what, _ in called() if what in NEVER_CALLED] == []
    assert [name for name, _, call in called() if any(word.arg == "allow_pickle" for word in call.keywords)] == []


def test_names_become_imports_in_these_places_only() -> None:
    ways = ("import_module", "spec_from_file_location", "SourceFileLoader", "entry_points")
    assert {name for name, what, _ in called() if what.rpartition(".")[2] in ways} == set(IMPORTS)


def test_commands_are_started_in_these_places_only_and_never_by_a_shell() -> None:
    ways = ("system", "popen", "execv", "execve", "execvp", "execvpe", "execl", "spawnv", "spawnlp", "posix_spawn")
    by_os = {name for name, what, _ in called() if what.split(".")[0] == "os" and what.rpartition(".")[2] in ways}
    assert users("subprocess") | by_os == set(COMMANDS)
    shells = [name for name, _, call in called() if any(word.arg == "shell" for word in call.keywords)]
    assert shells == []


def test_no_port_is_opened_beyond_dds() -> None:
    assert users(*NETWORK) == set(SOCKETS)
    listening = [name for name, what, _ in called() if what.rpartition(".")[2] in ("listen", "accept", "create_server")]
    assert listening == []
    assert users("multiprocessing") == set(PROCESSES)
    # Its Pipe is a pair of sockets that only the two processes have; Listener, Client and Manager would have addresses.
    parts = {module for name, module in imported() if module.startswith("multiprocessing.")}
    names = {alias.name for _, node in nodes(ast.ImportFrom) if node.module in parts for alias in node.names}
    assert names == {"Connection"}


def test_libraries_are_loaded_in_these_places_only() -> None:
    ways = ("CDLL", "PyDLL", "LoadLibrary", "dlopen")
    assert {name for name, what, _ in called() if what.rpartition(".")[2] in ways} == set(LIBRARIES)


@pytest.mark.parametrize("table", [IMPORTS, COMMANDS, SOCKETS, PROCESSES, LIBRARIES])
def test_every_place_has_its_reason(table: dict[str, str]) -> None:
    assert all((ROOT / name).is_file() and len(reason) > 10 for name, reason in table.items())


def yaml_places() -> set[tuple[str, str]]:
    return {(name, what) for name, what, _ in called() if what.startswith("yaml.") and "dump" not in what}


def test_yaml_is_read_in_one_place() -> None:
    assert yaml_places() == {("motor_model/motor_model/yaml_file.py", call) for call in ("yaml.load", "yaml.parse")}
    text = (ROOT / "motor_model/motor_model/yaml_file.py").read_text(encoding="utf-8")
    assert 'getattr(yaml, "CSafeLoader", yaml.SafeLoader)' in text and text.count("Loader=_Loader") == 2


def test_files_are_written_whole_or_not_at_all() -> None:
    """But for bags, which are written while they are recorded, and the sketch that the firmware is copied into."""
    ways = ("write_text", "write_bytes")
    here = {name for name, what, _ in called() if what.rpartition(".")[2] in ways and what not in ways}
    here = {name for name in here if not _is_benchmark(name) and not name.startswith("docs/")}
    assert here == {"motor_board/motor_board/sketch.py", "motor_board/motor_board/wire_header.py"}
