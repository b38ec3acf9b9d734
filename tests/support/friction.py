"""Two recordings of a motor with friction, for whatever reads bags."""

from pathlib import Path

from motor_identification.cli.experiment import main as experiment
from motor_model.model_file import save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

KS = 0.5  # [V]


def record_friction(directory: Path) -> None:
    """`true.yaml`, the paper's motor with friction, and its bags `staircase` and `coast`."""
    save(directory / "true.yaml", Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": KS}, ("coulomb_friction",)))
    for profile in ("staircase", "coast"):
        offline = ["--model", str(directory / "true.yaml"), "--voltage", "10", "--output", str(directory / profile)]
        assert experiment([profile, *offline]) == 0
