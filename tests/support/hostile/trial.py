"""Try inputs of a kind, each in a process of its own."""

import contextlib
import gc
import io
import os
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from random import Random
from typing import Any

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from hostile import sandbox
from hostile.bags import FIT
from hostile.inputs import main_of
from hostile.kind import ROOT, Kind

# What commands import once they have work to do, beside what fits and experiments need.
NEEDED = (
    "matplotlib.backends.backend_svg",
    "matplotlib.pyplot",
    "motor_control.configuration",
    "motor_control.controller.observer",
    "motor_control.tuning.gain_file",
    "motor_control.tuning.table",
    "motor_identification.live.monitor_node",
    "motor_identification.live.playback",
    "motor_identification.logs.formats.matlab",
    "motor_identification.logs.imported",
    "motor_identification.mapping.candidates",
    "motor_identification.reporting.fit_figure",
    "motor_identification.reporting.html.diagnosis_page",
    "motor_identification.reporting.html.fit_page",
    "ros2_stand_in.verbs.bag",
    "scipy.io",
)


@dataclass(frozen=True)
class Trial:
    """An input and how it ended."""

    number: int
    words: tuple[str, ...]
    verdict: sandbox.Verdict


def warm_up() -> None:
    """Import and compile in this process what every input needs: its processes are forked from it."""
    import rclpy  # noqa: F401

    from motor_identification.live import publishers

    for module in NEEDED:
        import_module(module)
    publishers._PATIENCE = 0.2  # nobody listens here
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder)
        sandbox.prepare(path / "warm")
        for words in (
            ["identify", str(ROOT / "bags" / "step"), "--effects", "coulomb_friction", *FIT],
            ["experiment", "step", "--model", str(ROOT / "bags" / "paper.yaml"), "--output", f"{folder}/bag"],
        ):
            before = os.getcwd()
            os.chdir(path / "warm")
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                assert main_of(words[0])(words[1:]) == 0, words
            os.chdir(before)
    gc.collect()
    gc.freeze()  # else every process copies all that its garbage collector looks at


def tried(kind: Kind, count: int, start: int) -> Iterator[Trial]:
    """So many inputs of a kind, the same for the same start."""
    for number in range(count):
        random = Random(f"{start} {kind.name} {number}")
        with tempfile.TemporaryDirectory() as outer:
            folder = Path(outer) / "place"
            sandbox.prepare(folder)
            words = kind.make(partial(drawn, random), random, folder)
            verdict = sandbox.run(kind.main(words[0]), words[1:], folder, kind.interrupt)
            yield Trial(number, tuple(words), verdict)


def drawn(random: Random, strategy: st.SearchStrategy[Any]) -> Any:
    """One value that hypothesis makes; its first ones are the simplest, so it is the last of a few."""
    found: list[Any] = []

    @settings(
        max_examples=4, database=None, deadline=None, phases=(Phase.generate,), suppress_health_check=list(HealthCheck)
    )
    @seed(random.getrandbits(64))
    @given(strategy)
    def take(value: Any) -> None:
        found.append(value)

    take()
    return found[-1]
