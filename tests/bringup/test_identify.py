"""From a motor to its model: the experiment, then the analysis of what it recorded."""

from motor_bringup.identify import session


def test_an_experiment_and_a_fit_of_what_it_recorded() -> None:
    experiment, analysis = session({"profile": "step", "voltage": "6", "effects": "coulomb_friction"}).steps
    assert (experiment.executable, analysis.executable) == ("experiment", "identify")
    assert experiment.arguments == ("step", "--output", "experiment", "--voltage", "6")
    assert analysis.arguments == ("experiment", "--effects", "coulomb_friction", "--output", "model.yaml")
    assert not experiment.node and not analysis.node


def test_a_diagnosis_finds_the_effects_by_itself() -> None:
    told = {"analysis": "diagnose", "effects": "coulomb_friction", "report": "out", "bag": "run"}
    experiment, analysis = session(told).steps
    assert analysis.executable == "diagnose" and "--effects" not in analysis.arguments
    assert analysis.arguments == ("run", "--output", "model.yaml", "--report", "out")
    assert experiment.arguments == ("rich", "--output", "run")


def test_the_namespace_is_that_of_the_plant() -> None:
    started = session({"namespace": "/left/"})
    assert [program.namespace for program in started.programs] == ["left"]
    assert all(step.arguments[-2:] == ("--topic-namespace", "left") for step in started.steps)
