"""How to go on: the commands that a diagnosis suggests, ready to be typed."""

import shlex

from motor_identification.diagnosis.result import Diagnosis


def commands(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    """What to type next, each with a sentence why."""
    rows = []
    profile = diagnosis.suggested_experiment
    bags = " ".join(shlex.quote(bag) for bag in diagnosis.bags)
    validation = "".join(f" {shlex.quote(bag)}" for bag in diagnosis.validation)
    judged = f" --validate{validation}" if validation else ""
    model = "--ros-args -p model:=model.yaml"
    run = "ros2 run motor_identification"
    if profile:
        rows.append((f"Record what is missing, with the plant running ({profile}):",
                     f"{run} experiment {profile} --output {profile}"))  # fmt: skip
        rows.append(("Diagnose both recordings together:", f"{run} diagnose {bags} {profile}{judged} --report next"))
    rows.append(("Run this motor with all of its effects:",
                 f"ros2 run motor_sim motor_sim {model}"))  # fmt: skip
    rows.append(("Control with it (feed-forward from the model):",
                 f"ros2 run motor_control motor_control {model} -p feedforward:=true"))  # fmt: skip
    effects = ",".join(diagnosis.model.parameters.effects)
    if effects:
        rows.append(("Fit the same effects to another recording:",
                     f"{run} identify BAG --effects {effects} --output model.yaml"))  # fmt: skip
    return rows
