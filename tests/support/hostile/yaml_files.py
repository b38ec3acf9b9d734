"""Hostile YAML: a bag's metadata and model files, their values or their text changed."""

import shutil
from pathlib import Path
from random import Random
from typing import Any

import yaml

from hostile import mcap_mutation
from hostile.bags import FIT
from hostile.kind import ROOT, Draw
from hostile.odd_values import VALUES


def changed_yaml(content: Any, draw: Draw, random: Random) -> Any:
    """Values with one of their parts swapped for another."""
    if isinstance(content, dict) and content and random.random() < 0.85:
        key = random.choice(list(content))
        if random.random() < 0.1:
            return {k: v for k, v in content.items() if k != key}
        return {**content, key: changed_yaml(content[key], draw, random)}
    if isinstance(content, list) and content and random.random() < 0.8:
        at = random.randrange(len(content))
        return [*content[:at], changed_yaml(content[at], draw, random), *content[at + 1 :]]
    return draw(VALUES)


def yaml_text(content: Any, draw: Draw, random: Random) -> bytes:
    for _ in range(random.choice((1, 1, 2, 4))):
        content = changed_yaml(content, draw, random)
    text = yaml.safe_dump(content, sort_keys=False, allow_unicode=True).encode("utf-8", errors="surrogatepass")
    way = random.randrange(8)
    if way == 0:
        return mcap_mutation.changed_bytes(text, random)
    if way == 1:
        return b"x: &a [1,1,1,1]\n" + b"".join(b"y%d: &b%d [*a,*a]\n" % (k, k) for k in range(30)) + text
    if way == 2:
        return (
            text
            + b"\nz: "
            + random.choice(
                (b"[" * 4000, b"{a: " * 4000, b"1" * 100_000, b"1" + b":10" * 30_000, b"!!python/name:os.system")
            )
        )
    return text


def metadata(draw: Draw, random: Random, folder: Path) -> list[str]:
    shutil.copytree(ROOT / "bags" / "step", folder / "out" / "input")
    content = yaml.safe_load((ROOT / "bags" / "step" / "metadata.yaml").read_text())
    (folder / "out" / "input" / "metadata.yaml").write_bytes(yaml_text(content, draw, random))
    return random.choice((["identify", "out/input", *FIT], ["ros2", "bag", "info", "out/input"]))


def model(draw: Draw, random: Random, folder: Path) -> list[str]:
    content = yaml.safe_load((ROOT / "bags" / random.choice(("rich.yaml", "paper.yaml", "emulated.yaml"))).read_text())
    if random.random() < 0.6:
        for name in random.sample(list(content["parameters"]), random.choice((1, 1, 2))):
            odd = random.choice((1e300, 1e-300, 5e-324, -1.0, 1e9, 1e-9, 0.0, float("nan"), 1e-3, 0.1, 1.0, 30.0, 1e4))
            content["parameters"][name] = {"value": odd}
        if random.random() < 0.2:
            content["max_voltage"] = random.choice((1e300, 1e-9, 0.0, 1e5, 1e-3, -12.0))
        (folder / "input.yaml").write_text(yaml.safe_dump(content))
    else:
        (folder / "input.yaml").write_bytes(yaml_text(content, draw, random))
    if random.random() < 0.05:
        return ["tune", "input.yaml", "--output", "out/gains.yaml"]
    profile = random.choice(("step", "coast", "prbs"))
    return ["experiment", profile, "--model", "input.yaml", "--output", "out/bag"]
