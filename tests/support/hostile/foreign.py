"""Hostile bags of other robots, and hostile mappings of sound ones."""

import tempfile
from functools import cache
from pathlib import Path
from random import Random

import yaml
from foreign_bags import move, write_driver_states, write_joint_states

from hostile import mcap_mutation
from hostile.bags import FIT
from hostile.kind import ROOT, Draw
from hostile.odd_values import NUMBERS, WORDS
from hostile.yaml_files import yaml_text

SOUND = {
    "driver": {
        "name": "right",
        "voltage": {"from": "/driver:wheels[1].duty", "scale": 12.0 / 255.0},
        "count": {"from": "/driver:wheels[1].ticks"},
        "edges_per_revolution": 1440,
    },
    "joints": {
        "voltage": {"from": "/wheels/commands:data[1]", "scale": 12.0},
        "speed": {"from": "/joint_states:velocity[right_wheel]", "unit": "rad/s"},
        "max_voltage": 12.0,
    },
}
ODD_FIELDS = (
    "/driver:wheels[99999999999].duty", "/driver:wheels[-1].duty", "/driver:", ":", "/driver:header.stamp.sec",
    "/driver:interface_names[0]", "/driver:wheels", "/joint_states:name[0]", "/joint_states:velocity[nobody]",
    "/joint_states:velocity[" + "[" * 2000, "/driver:wheels[1].__class__", "/driver:" + "a." * 3000 + "b", "/x:y@rpm*0",
    "/joint_states:velocity[right_wheel]@rpm*1e-9", "/joint_states:velocity[right_wheel]*nan", "/:a*1e999",
)  # fmt: skip


@cache
def base(name: str) -> bytes:
    """The MCAP file of a sound bag."""
    write = {"driver": write_driver_states, "joints": write_joint_states}[name]
    with tempfile.TemporaryDirectory() as folder:
        write(Path(folder) / "bag", move(2.0))
        return next((Path(folder) / "bag").glob("*.mcap")).read_bytes()


def _put(folder: Path, data: bytes) -> str:
    (folder / "out" / "input").mkdir()
    (folder / "out" / "input" / "input_0.mcap").write_bytes(data)
    return "out/input"


def mapping(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A mapping file, or options in its place, of a sound bag."""
    name = random.choice(list(SOUND))
    bag = _put(folder, base(name))
    odd = random.choice((*ODD_FIELDS, *WORDS, *NUMBERS))
    if random.random() < 0.3:
        options = ["--voltage-from", SOUND[name]["voltage"]["from"], "--speed-from", odd]  # type: ignore[index]
        return ["identify", bag, *random.choice((options, ["--voltage-from", odd])), *FIT]
    content = {key: dict(value) if isinstance(value, dict) else value for key, value in SOUND[name].items()}
    way = random.random()
    if way < 0.4:
        number = random.choice((1e300, 1e-300, -1.0, 0.0, 1e9, 1e-9, float("nan"), 0.02, 3.0, 2**31, 96))
        options = ("max_voltage", "speed_lag", "speed_window", "units_per_revolution", "edges_per_revolution")
        content[random.choice(options)] = number
        (folder / "mapping.yaml").write_text(yaml.safe_dump(content))
    elif way < 0.7:
        key = random.choice([key for key, value in content.items() if isinstance(value, dict)])
        content[key] = {**content[key], "from": odd}  # type: ignore[dict-item]
        (folder / "mapping.yaml").write_text(yaml.safe_dump(content), encoding="utf-8", errors="surrogatepass")
    else:
        (folder / "mapping.yaml").write_bytes(yaml_text(content, draw, random))
    return ["identify", bag, "--mapping", "mapping.yaml", *FIT]


def bag(draw: Draw, random: Random, folder: Path) -> list[str]:
    """Another robot's bag, its records and definitions changed, read by a sound mapping or looked through."""
    name = random.choice(list(SOUND))
    data = mcap_mutation.mutated(base(name), random) if random.random() < 0.9 else base(name)
    path = _put(folder, data)
    (folder / "mapping.yaml").write_text(yaml.safe_dump(SOUND[name]))
    inspect = ["inspect", path, *random.choice(([], ["--output", "out/mapping.yaml"]))]
    return random.choice((["identify", path, "--mapping", "mapping.yaml", *FIT], inspect))


def heard(draw: Draw, random: Random, folder: Path) -> list[str]:
    """Another robot's messages, changed, as a monitor hears them: by a mapping that is sound, mostly."""
    words = (mapping if random.random() < 0.3 else bag)(draw, random, folder)
    if not (folder / "mapping.yaml").exists():
        (folder / "mapping.yaml").write_text(yaml.safe_dump(random.choice(list(SOUND.values()))))
    window = random.choice(("10", "10", "1", "0.5", "600"))
    return [
        "watch",
        words[1],
        "mapping.yaml",
        str(ROOT / "bags" / random.choice(("paper", "rich", "closed_loop"))),
        window,
    ]


def watch(words: list[str]) -> int:
    """Do what a monitor does with messages, without a graph: keep them, and judge the motor now and then."""
    from motor_ros.command.shell import shell

    def work() -> int:
        from motor_identification.bag.storage import Bag
        from motor_identification.monitoring.evaluation import evaluate
        from motor_identification.monitoring.health import Health, Limits, update_health
        from motor_identification.monitoring.heard import Heard
        from motor_identification.monitoring.load_watch import load_watch

        uri, mapping, model, window = words
        watched = load_watch(f"{model}.yaml", mapping, "/", Limits(float(window)))
        kept, health = Heard(float(window)), Health()
        for number, (topic, at, data) in enumerate(Bag(uri).messages(set(watched.motor.topics))):
            kept.write(kept.topic(topic.name, topic.type_name), at, data)
            if number % 400 == 399:
                health = update_health(health, evaluate(watched, kept.copy(), at), at)
        print(health.verdict.state.value, health.verdict.sentence)
        return 0

    return shell(work)
