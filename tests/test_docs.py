"""The pages beside the README: their commands and code run as they stand there, their links lead somewhere."""

import ast
import io
import os
import re
import signal
import subprocess
import tokenize
from functools import cache
from pathlib import Path

import pytest
from bringup_tables import reference
from domains import free_domain
from patience import PATIENCE
from tiers import keep_fast

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted(
    path.relative_to(ROOT).as_posix()
    for pattern in ("*.md", "motor_*/README.md", "docs/*.md", "bags/*.md")
    for path in ROOT.glob(pattern)
)
BLOCK = re.compile(r"^( *)```(bash|python)\n(.*?)^ *```", re.DOTALL | re.MULTILINE)
NODE = re.compile(r"ros2 run (motor_\w+) (\1|board_emulator)\b")
# Commands that are not run here, and why.
ELSEWHERE = {
    r"\./test\.sh|ruff check": "the tests themselves, and tests/test_architecture.py",
    r"bags/make\.sh": "tests/test_golden_bags.py",
    r"ros2 run motor_board flash": "needs a board; tests/board/test_flash.py",
    r"ros2 run motor_board board_emulator|ros2 run motor_driver": "the same in README.md",
    r"ros2 topic pub --rate 20 motor/voltage": "needs a board",
}


def blocks(page: str, language: str) -> list[str]:
    text = (ROOT / page).read_text(encoding="utf-8")
    return [match[3] for match in BLOCK.finditer(text) if match[2] == language]


def commands(page: str) -> list[str]:
    lines = [line.split("  #")[0].strip() for block in blocks(page, "bash") for line in block.splitlines()]
    return [line for line in lines if line and not any(re.match(pattern, line) for pattern in ELSEWHERE)]


RUN = [page for page in PAGES if page != "README.md" and commands(page)]  # the README has a test of its own


def test_pages_are_found_and_every_exception_is_needed() -> None:
    assert len(PAGES) >= 14 and len(RUN) >= 3
    packages = {path.parent.name for path in ROOT.glob("motor_*/package.xml")}
    assert {f"{package}/README.md" for package in packages} <= set(PAGES)
    lines = [line.strip() for page in PAGES for block in blocks(page, "bash") for line in block.splitlines()]
    for pattern in ELSEWHERE:
        assert any(re.match(pattern, line) for line in lines), pattern


@pytest.mark.parametrize("page", keep_fast(RUN, "motor_sim/README.md"))
def test_every_command_works_as_written(page: str, tmp_path: Path) -> None:
    environment = {**os.environ, "ROS_DOMAIN_ID": str(free_domain()), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    (tmp_path / "bags").symlink_to(ROOT / "bags")
    nodes = []
    try:
        for command in commands(page):
            if NODE.match(command):
                nodes.append(subprocess.Popen(command.split(), cwd=tmp_path, env=environment))
                continue
            done = subprocess.run(
                ["bash", "-c", command], cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=120.0
            )
            assert done.returncode == 0 and "Traceback" not in done.stderr, f"{command}\n{done.stdout}\n{done.stderr}"
    finally:
        for node in nodes:
            node.send_signal(signal.SIGINT)
        ended = [node.wait(PATIENCE) for node in nodes]
    assert not any(ended)


@pytest.mark.parametrize("page", [page for page in PAGES if blocks(page, "python")])
def test_code_runs_as_written(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "bags").symlink_to(ROOT / "bags")
    monkeypatch.chdir(tmp_path)
    for block in blocks(page, "python"):
        exec(compile(block, page, "exec"), {"__name__": page})


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if target.startswith("http"):
            continue
        file, _, anchor = target.partition("#")
        linked = (ROOT / page).parent / file if file else ROOT / page
        assert linked.exists(), target
        if anchor:
            titles = re.findall(r"^#+ (.+)$", linked.read_text(encoding="utf-8"), re.MULTILINE)
            assert anchor in {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}, target


OURS = ("motor_*", "tests", "benchmarks", "demo", "docs", "bags", "ros2_stand_in")
FILES = [
    path.relative_to(ROOT) for folder in OURS for path in ROOT.glob(f"{folder}/**/*") if "__pycache__" not in path.parts
]
FILE = re.compile(r"(?<![\w/.-])(?:\.\./)*((?:[\w-]+/)*\w+\.(?:py|[ch]))\b")
FOLDER_ROW = re.compile(r"^\| `(\w+)/` \|.*?\| (.*) \|$", re.MULTILINE)
FOLDER = re.compile(r"`((?:[\w.-]+/)+)`")
MADE_BY_USERS = {"build/", "install/", "log/", "diagnosis/"}


def said_in(source: str) -> str:
    """Docstrings and comments of a module."""
    nodes = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    texts = [ast.get_docstring(node) or "" for node in ast.walk(ast.parse(source)) if isinstance(node, nodes)]
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    return "\n".join([*texts, *(token.string for token in tokens if token.type == tokenize.COMMENT)])


@cache
def paths_by_name() -> dict[str, list[tuple[str, ...]]]:
    """The parts of all paths, by the last one."""
    named: dict[str, list[tuple[str, ...]]] = {}
    for path in FILES:
        named.setdefault(path.name, []).append(path.parts)
    return named


def stands(mentioned: str, where: Path) -> bool:
    """Whether a file or folder is there: in the package of the page that mentions it, or by its path from the root."""
    ends = Path(mentioned).parts
    within = where.parts[0] if where.parts[0].startswith("motor_") and not ends[0].startswith("motor_") else ""
    there = paths_by_name().get(ends[-1], [])
    return (ROOT / mentioned).exists() or any(
        parts[-len(ends) :] == ends for parts in there if within in ("", parts[0])
    )


@pytest.mark.parametrize("page", [*PAGES, "benchmarks/README.md"])
def test_files_that_a_page_names_are_there(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    folders = {name for name in FOLDER.findall(text) if name not in MADE_BY_USERS}
    missing = {name for name in {*FILE.findall(text), *folders} if not stands(name, Path(page))}
    assert not missing


def test_files_that_a_docstring_or_comment_names_are_there() -> None:
    sources = {path: (ROOT / path).read_text(encoding="utf-8") for path in FILES if path.suffix == ".py"}
    missing = {
        f"{path}: {name}"
        for path, source in sources.items()
        if FILE.search(source)  # most name none, and are not taken apart
        for name in FILE.findall(said_in(source))
        if not stands(name, path)
    }
    assert not missing


def test_the_page_of_the_identification_names_every_module_in_its_folder() -> None:
    package = ROOT / "motor_identification" / "motor_identification"
    page = (package.parent / "README.md").read_text(encoding="utf-8")
    rows = {folder: set(re.findall(r"`(\w+\.py)`", files)) for folder, files in FOLDER_ROW.findall(page)}
    folders = {path.parent.name for path in package.glob("*/__init__.py")}
    assert rows == {
        name: {path.name for path in (package / name).glob("*.py") if path.name != "__init__.py"} for name in folders
    }
    for path in package.glob("*.py"):
        assert path.name == "__init__.py" or f"`{path.name}`" in page, path.name


def test_the_reference_is_as_it_would_be_written_now() -> None:
    page = (ROOT / "docs" / "interfaces.md").read_text(encoding="utf-8")
    assert page == reference("make_interfaces").page(), "run python docs/make_interfaces.py"
    files = [path for kind in ("msg", "srv", "action") for path in (ROOT / "motor_msgs" / kind).iterdir()]
    for path in files:
        assert f"## motor_msgs/{path.parent.name}/{path.stem}\n" in page
        fields = re.findall(r"^[\w/\[\]]+ +([a-z]\w*)(?: |$)", path.read_text(encoding="utf-8"), re.MULTILINE)
        assert len(fields) > 1 and all(f"| `{field}` |" in page for field in fields), path


@pytest.mark.parametrize("page", ["docs/troubleshooting.md", "motor_driver/README.md"])
def test_the_messages_of_the_troubleshooting_are_those_of_the_program(page: str) -> None:
    """Every quoted symptom is in the sources, … standing for what is filled in."""
    files = [
        *ROOT.glob("motor_*/motor_*/**/*.py"),
        *ROOT.glob("ros2_stand_in/**/*.py"),
        ROOT / "setup.sh",
        ROOT / "env.sh",
    ]
    source = "\n".join(path.read_text(encoding="utf-8") for path in files)
    source = re.sub(r"\{[^{}]*\}", "…", re.sub(r'"\s*\n\s*f?"', "", source))  # f-strings, as one line
    lines = (ROOT / page).read_text(encoding="utf-8").splitlines()
    symptoms = [row.split("|")[1] for row in lines if row.startswith("|")]
    quoted = [words for symptom in symptoms for words in re.findall(r'"([^"]+)"', symptom)]
    assert len(quoted) > 15
    for words in quoted:
        for part in words.split("…"):
            assert part.strip() in source, words
