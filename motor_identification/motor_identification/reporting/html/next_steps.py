"""The commands that a diagnosis or a fit suggests next, ready to be typed where its own command was."""

import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePath

from motor_identification.bag import Source
from motor_identification.diagnosis.result import Diagnosis
from motor_identification.uncertainty.result import Fit

RUN = "ros2 run motor_identification"
DEFAULT_MODEL = "model.yaml"


@dataclass(frozen=True)
class Files:
    """What a command was told of files."""

    model: str = ""  # where its model is, as the user would type it; empty: it was not written
    source: Source | None = None  # the recordings, and the part of them that was read; None: all of the named bags

    @property
    def reading(self) -> tuple[str, ...]:
        """The options that read the same part of a bag again."""
        if self.source is None:
            return ()
        window = self.source.window
        rows = (
            ("--topic-namespace", self.source.namespace),
            ("--start", window.start and f"{window.start:g}"),
            ("--stop", window.stop and f"{window.stop:g}"),
        )
        return tuple(word for option, value in rows if value for word in (option, value))


NO_FILES = Files()


@dataclass(frozen=True)
class NextStep:
    """A command with the reason for it."""

    why: str
    command: str


def list_diagnosis_steps(diagnosis: Diagnosis, files: Files) -> list[NextStep]:
    """List what to type after a diagnosis."""
    bags, reading = _bags(diagnosis.bags), _quote(*files.reading)
    validation = _join("--validate", _bags(diagnosis.validation)) if diagnosis.validation else ""
    steps = []
    if not files.model:
        again = _join(RUN, "diagnose", bags, validation, reading, "--output", DEFAULT_MODEL)
        steps.append(NextStep("Write the model to a file:", again))
    if diagnosis.suggested_experiment:
        more = _new_bag(diagnosis.suggested_experiment, (*diagnosis.bags, *diagnosis.validation))
        together = _join(RUN, "diagnose", bags, more, validation, reading, "--report", "next")
        steps += [
            _record(diagnosis.suggested_experiment, more),
            NextStep("Diagnose the recordings together:", together),
        ]
    steps += _use_model(files)
    if diagnosis.model.parameters.effects:
        fit = _join(RUN, "identify", bags, *_effects("--effects", diagnosis.model), reading, "--report", "fit")
        steps.append(NextStep("Fit these effects to all of the recorded motion:", fit))
    return steps


def list_fit_steps(fit: Fit, files: Files) -> list[NextStep]:
    """List what to type after a fit."""
    bags, reading, effects = _bags(fit.uris), _quote(*files.reading), _effects("--effects", fit)
    steps = []
    if not files.model:
        again = _join(RUN, "identify", bags, *effects, reading, "--output", DEFAULT_MODEL)
        steps.append(NextStep("Write the model to a file:", again))
    if fit.suggested_experiment:
        more = _new_bag(fit.suggested_experiment, fit.uris)
        together = _join(RUN, "identify", bags, more, *effects, reading, "--report", "next")
        steps.append(_record(fit.suggested_experiment, more))
        steps.append(NextStep("Fit the recordings together:", together))
    diagnose = _join(RUN, "diagnose", bags, *_effects("--known-effects", fit), reading, "--report", "diagnosis")
    steps.append(NextStep("Find the effects that this model lacks:", diagnose))
    return steps + _use_model(files)


def _effects(option: str, fit: Fit) -> tuple[str, ...]:
    effects = fit.parameters.effects
    return (option, ",".join(effects)) if effects else ()


def _new_bag(profile: str, taken: Sequence[str]) -> str:
    """A name for a recording of a profile; bags are never overwritten."""
    names = {PurePath(bag).name for bag in taken}
    return next(name for name in (profile, *(f"{profile}_{n}" for n in range(2, 99))) if name not in names)


def _record(profile: str, bag: str) -> NextStep:
    return NextStep(
        f"Record the profile '{profile}' with the plant running:", f"{RUN} experiment {profile} --output {bag}"
    )


def _use_model(files: Files) -> list[NextStep]:
    model = shlex.quote(files.model or DEFAULT_MODEL)
    option = f"--ros-args -p model:={model}"
    gains = shlex.quote(str(PurePath(files.model or DEFAULT_MODEL).with_name("gains.yaml")))
    return [
        NextStep("Simulate this motor:", f"ros2 run motor_sim motor_sim {option}"),
        NextStep("Design a speed controller for it:", f"ros2 run motor_control tune {model} --output {gains}"),
        NextStep("Control it with those gains:",
                 f"ros2 run motor_control motor_control --ros-args --params-file {gains}"),
    ]  # fmt: skip


def _quote(*words: str) -> str:
    return " ".join(map(shlex.quote, words))


def _bags(uris: Sequence[str]) -> str:
    """Bags as arguments; none may look like an option."""
    return _quote(*(f"./{uri}" if uri.startswith("-") else uri for uri in uris))


def _join(*parts: str) -> str:
    return " ".join(part for part in parts if part)
