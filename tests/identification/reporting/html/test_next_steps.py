"""The commands that reports suggest: complete, with the files and options of the command that wrote the report."""

from dataclasses import replace

from motor_identification.bag import Source, Window
from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.reporting.html.next_steps import NO_FILES, Files, list_diagnosis_steps, list_fit_steps


def test_commands_are_for_this_diagnosis(variants: dict[Verdict, Diagnosis]) -> None:
    steps = list_diagnosis_steps(variants[Verdict.UNDECIDED], Files("out/found.yaml", Source((), "/left", Window(1.5))))
    run, read = "ros2 run motor_identification", "--topic-namespace /left --start 1.5"
    assert [step.command for step in steps] == [
        f"{run} experiment coast --output coast",
        f"{run} diagnose train.bag coast --validate held_out.bag {read} --report next",
        "ros2 run motor_sim motor_sim --ros-args -p model:=out/found.yaml",
        "ros2 run motor_control tune out/found.yaml --output out/gains.yaml",
        "ros2 run motor_control motor_control --ros-args --params-file out/gains.yaml",
        f"{run} identify train.bag --effects coulomb_friction {read} --report fit",
    ]
    bare = [step.command for step in list_diagnosis_steps(variants[Verdict.UNEXPLAINED], NO_FILES)]
    assert bare[0] == f"{run} diagnose train.bag --validate held_out.bag --output model.yaml"  # nobody wrote one yet
    assert bare[1].endswith("model:=model.yaml") and "--effects" not in "".join(bare)
    again = replace(variants[Verdict.UNDECIDED], bags=("runs/coast", "coast_2"))
    assert list_diagnosis_steps(again, Files("m.yaml"))[0].command.endswith("--output coast_3")  # none is overwritten


def test_commands_are_for_this_fit(found: Diagnosis) -> None:
    fit = replace(found.model, uris=("a bag",), suggested_experiment="ramps")
    run = "ros2 run motor_identification"
    assert [step.command for step in list_fit_steps(fit, Files("m.yaml"))][:3] == [
        f"{run} experiment ramps --output ramps",
        f"{run} identify 'a bag' ramps --effects coulomb_friction --report next",
        f"{run} diagnose 'a bag' --known-effects coulomb_friction --report diagnosis",
    ]
    plain = replace(found.baseline, uris=("bag",), suggested_experiment="")
    assert [step.command for step in list_fit_steps(plain, NO_FILES)][:2] == [
        f"{run} identify bag --output model.yaml",
        f"{run} diagnose bag --report diagnosis",
    ]
    minus = replace(plain, uris=("-100", "100"))
    assert list_fit_steps(minus, Files("m.yaml"))[0].command == f"{run} diagnose ./-100 100 --report diagnosis"
    assert NO_FILES.reading == () and Files("", Source((), "", Window(0.0, 2.0))).reading == ("--stop", "2")
