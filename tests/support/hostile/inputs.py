"""The kinds of hostile inputs: for each, how one is made, and which command reads it."""

import os
import shutil
import sqlite3
import struct
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from itertools import islice
from pathlib import Path
from random import Random
from typing import Any

import yaml
import zstandard
from hypothesis import strategies as st

from hostile import mcap_mutation
from hostile.sandbox import Main

ROOT = Path(__file__).resolve().parents[3]
if str(ROOT) not in sys.path:
    sys.path.append(str(ROOT))  # the stand-in is no installed package
NUMBERS = (
    "nan", "inf", "-inf", "1e300", "-1e300", "5e-324", "1e-300", "0", "-0", "-1", "2e10",
    "9223372036854775808", "1e999", "0x10", "1_000", "١٢", "1,5", "", " ", "NULL", "1e", "--1", "True",
    "2026-11-22", "1:30:00",
)  # fmt: skip
WORDS = (
    "../../../etc/passwd", "/dev/zero", "/dev/full", "/proc/self/mem", "-", "--", "--help=1", "\x1b[2J", "\udcff",
    "a\nb", "$HOME", "$(touch ran)", "`touch ran`", "%s%n", "x" * 5000, "", " ", ".", "..", "~", "évil",
    "<b>", "$\\frac{", "out", "input",
)  # fmt: skip
SCALARS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=20),
    st.sampled_from(NUMBERS),
    st.binary(max_size=9),
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4),
    max_leaves=12,
)
Draw = Callable[[Any], Any]


@dataclass(frozen=True)
class Kind:
    """A kind of input: `make` writes it into a folder and returns the words of a command line for `main`."""

    name: str
    share: int  # of a whole run, in inputs
    main: Callable[[str], Main]
    make: Callable[[Draw, Random, Path], list[str]]
    interrupt: float = 0.0  # [s] after which what runs for ever is told to end


def command(name: str) -> Main:
    """The main function of a command, such as `identify`."""
    from importlib import import_module

    packages = {"tune": "motor_control.cli.tune", "ros2": "ros2_stand_in.main"}
    main: Main = import_module(packages.get(name, f"motor_identification.cli.{name}")).main
    return main


def node(name: str) -> Main:
    from importlib import import_module

    package = "motor_identification.service" if name == "motor_identification" else name
    main: Main = import_module(f"{package}.node").main
    return main


@cache
def stored() -> list[tuple[str, str, int, bytes]]:
    """The first messages of a golden bag as they would be recorded now: motor/info has got fields since."""
    from rclpy.serialization import serialize_message

    from motor_identification.bag import messages, read_recording
    from motor_ros.messages import info_message, time_message

    info = read_recording(ROOT / "bags" / "step").info
    return [
        (topic, kind, time, serialize_message(info_message(info, time_message(time))) if "Info" in kind else data)
        for topic, kind, time, data in islice(messages(ROOT / "bags" / "step"), 300)
    ]


@cache
def base(name: str) -> bytes:
    """A golden bag's file, a part of it in several chunks, or the same as a database."""
    from motor_identification.bag import BagWriter, messages, topics

    if name == "golden":
        return next((ROOT / "bags" / "step").glob("*.mcap")).read_bytes()
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bag"
        if name == "chunks":
            with BagWriter(path) as writer:
                for number, (topic, kind, time, data) in enumerate(stored()):
                    writer.write(writer.topic(topic, kind), time, data)
                    if number % 60 == 59:
                        writer.flush()
            return next(path.glob("*.mcap")).read_bytes()
        from rosbags.rosbag2 import StoragePlugin, Writer
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore

        with Writer(path, version=9, storage_plugin=StoragePlugin.SQLITE3) as writer:
            connections = {}
            for topic in topics(ROOT / "bags" / "step"):
                store = get_typestore(Stores.EMPTY)
                store.register(get_types_from_msg(topic.definition, topic.type_name))
                connections[topic.name] = writer.add_connection(topic.name, topic.type_name, typestore=store)
            for topic_name, _, time, data in islice(messages(ROOT / "bags" / "step"), 300):  # by its own definitions
                writer.write(connections[topic_name], time, data)
        return next(path.glob("*.db3")).read_bytes()


FIT = ["--particles", "8", "--epochs", "4", "--output", "out/model.yaml", "--json", "out/fit.json", "--force"]


def bag_commands(random: Random, bag: str) -> list[str]:
    return random.choice(
        (
            ["identify", bag, *FIT],
            ["identify", bag, "--effects", "coulomb_friction", *FIT],
            ["identify", bag, "--start", "0.1", "--stop", "0.6", *FIT],
            ["ros2", "bag", "info", bag],
            ["ros2", "bag", "reindex", bag],
        )
    )


def mcap(draw: Draw, random: Random, folder: Path) -> list[str]:
    data = mcap_mutation.mutated(base(random.choice(("golden", "chunks", "chunks"))), random)
    if random.random() < 0.1:
        (folder / "input.mcap.zstd").write_bytes(mcap_mutation.changed_bytes(zstandard.compress(data), random))
        return ["identify", "input.mcap.zstd", *FIT]
    (folder / "out" / "input").mkdir()
    (folder / "out" / "input" / "input_0.mcap").write_bytes(data)
    return bag_commands(random, "out/input")


def changed_message(data: bytes, random: Random) -> bytes:
    """A serialised message with another number in one of its places of eight bytes, or garbled."""
    out = bytearray(data)
    if random.random() < 0.2:
        return mcap_mutation.changed_bytes(data, random)
    at = 4 + 8 * random.randrange(max((len(out) - 4) // 8, 1)) + random.choice((0, 0, 4))
    number = random.choice((float("nan"), float("inf"), -float("inf"), 1e308, -1e308, 5e-324, 1e-9, 1e9))
    what = random.choice((struct.pack("<d", number), struct.pack("<Q", random.choice(mcap_mutation.INTEGERS))))
    out[at : at + 8] = what
    return bytes(out[: len(data)])


def contents(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A whole bag whose messages say odd things."""
    from motor_identification.bag import BagWriter

    names = {"/motor/speed": "/motor/speed", "/motor/info": "/motor/info"}
    if random.random() < 0.1:
        names[random.choice(list(names))] = "/" + random.choice(
            ("left/motor/speed", "motor/info", "\x1b[2J", "a" * 300)
        )
    often = random.choice((0.0, 0.01, 0.3, 1.0))
    late = random.choice((0, 0, 0, 10**9, -(10**9), 10**18))
    with BagWriter(folder / "out" / "input") as writer:
        for topic, kind, time, data in stored()[:251]:
            if random.random() < often or (topic == "/motor/info" and random.random() < 0.5):
                data = changed_message(data, random)
            channel = writer.topic(
                names.get(topic, topic), random.choice((kind,) * 50 + ("evil/msg/X", "venv/__main__/X"))
            )
            writer.write(channel, max(time + (late if random.random() < 0.01 else 0), 0), data)
    return bag_commands(random, "out/input")


def database(draw: Draw, random: Random, folder: Path) -> list[str]:
    path = folder / "out" / "input.db3"
    path.write_bytes(base("database"))
    if random.random() < 0.5:
        data = path.read_bytes()
        path.write_bytes(
            data[: random.randrange(len(data))] if random.random() < 0.2 else mcap_mutation.changed_bytes(data, random)
        )
        return ["identify", "out/input.db3", *FIT]
    connection = sqlite3.connect(path)
    value = random.choice(("NULL", "-1", "9223372036854775807", "x'00'", "'text'", "zeroblob(1000000)", "1e300", "''"))
    table = random.choice(("topics", "messages", "metadata", "schema"))
    columns = [row[1] for row in connection.execute(f"PRAGMA table_info({table})")] or ["id"]
    statements = (
        f"UPDATE {table} SET {random.choice(columns)} = {value} WHERE rowid % {random.choice((1, 1, 7))} = 0",
        f"DELETE FROM {table}",
        f"DROP TABLE {table}",
        "ALTER TABLE messages RENAME TO m; CREATE VIEW messages AS SELECT * FROM m",
        "INSERT INTO messages SELECT NULL, topic_id, timestamp, zeroblob(1000000) FROM messages",
        "UPDATE topics SET offered_qos_profiles = 'a: &a [1]\nb: [*a, *a]'",
    )
    with suppress(sqlite3.Error):
        connection.executescript(random.choice(statements))
    connection.close()
    return ["identify", "out/input.db3", *FIT]


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


def csv(draw: Draw, random: Random, folder: Path) -> list[str]:
    rows = [
        [f"{0.005 * k:.3f}", f"{6.0 if k > 20 else 0.0}", f"{min(k, 60) * 1.5:.2f}", str(3 * k)] for k in range(200)
    ]
    texts = draw(st.lists(st.text(max_size=6), min_size=1, max_size=9))
    for _ in range(random.choice((0, 1, 1, 5, 300))):
        row = random.choice(rows)
        if row:
            row[random.randrange(len(row))] = random.choice((*NUMBERS, *texts))
    if random.random() < 0.2:
        del random.choice(rows)[:]
    separator = random.choice((",", ",", ",", ";", "\t", "|"))
    text = "\n".join(separator.join(row) for row in [["t", "u", "w", "n"], *rows])
    data = text.encode("utf-8", errors="surrogatepass")
    if random.random() < 0.3:
        data = mcap_mutation.changed_bytes(data, random)
    (folder / "input.csv").write_bytes(data)
    words = ["import_csv", "input.csv", "--output", "out/bag", "--time", "t", "--voltage", "u"]
    words += random.choice(
        (
            ["--speed", "w", "--unit", "rad/s"],
            ["--count", "n", "--edges-per-revolution", "96"],
            ["--position", "w", "--unit", "rad"],
        )
    )
    extra = (
        ["--edges-per-revolution", "20000000000"],
        ["--speed-lag", "nan"],
        ["--speed-window", "1e300"],
        ["--split", "u"],
        ["--voltage-scale", "1e300"],
    )
    return words + (random.choice(extra) if random.random() < 0.2 else [])


OPTIONS = {
    name: [f"--{option}" for option in options.split()]
    for name, options in {
        "identify": "effects start stop particles epochs seed output json report topic-namespace",
        "diagnose": "validate known-effects start stop topic-namespace output json report",
        "experiment": "voltage speed model sample-rate edges-per-revolution edge-resolution seed slot-irregularity",
        "import_csv": "time voltage speed unit split edges-per-revolution speed-lag count-quantum",
        "play": "rate topics remap start-offset",
        "tune": "output nope",
    }.items()
}


def arguments(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A command with odd words in the places of its options, and outputs where nothing can be written."""
    name = random.choice(list(OPTIONS))
    shutil.copytree(ROOT / "bags" / "step", folder / "input")
    (folder / "input.yaml").write_text((ROOT / "bags" / "paper.yaml").read_text())
    odd = (*WORDS, *NUMBERS, draw(st.text(max_size=12)).replace("\0", ""))
    first = {"experiment": ["step", "--output", "out/bag", "--model", "input.yaml"], "tune": ["input.yaml"]}.get(
        name, ["input"]
    )
    if name in ("identify",):
        first += FIT
    if random.random() < 0.15 or name in ("play", "diagnose"):
        first[0] = random.choice(odd).replace("input", "none") or "none"
    words = [name, *first]
    for option in random.sample(OPTIONS[name], random.choice((1, 1, 2))):
        value = random.choice(odd)
        if option in ("--output", "--json", "--report") and not value.startswith(("/dev/", "/proc", "out")):
            value = f"out/{value[:100].replace('/', '_').replace('..', 'dots')}"  # what the user names is theirs
        words += [option, value]
    return words


def pipes(draw: Draw, random: Random, folder: Path) -> list[str]:
    """Pipes, devices, loops and folders in the places of files."""
    bad = folder / ("input" + random.choice(("", ".mcap", ".db3", ".yaml", ".csv", ".mcap.zstd")))
    way = random.randrange(6)
    if way == 0:
        os.mkfifo(bad)
    elif way == 1:
        bad.symlink_to(bad.name)
    elif way == 2:
        bad.mkdir()
        os.mkfifo(bad / random.choice(("metadata.yaml", "a.mcap", "a.db3")))
    else:
        bad.symlink_to(random.choice(("/dev/zero", "/dev/random", "/dev/full", "/proc/self/mem", "/dev/stdin", "/")))
    name = bad.name
    return random.choice(
        (
            ["identify", name, *FIT], ["diagnose", name],
            ["ros2", "bag", "info", name], ["ros2", "bag", "reindex", name],
            ["experiment", "step", "--model", name, "--output", "out/bag"], ["tune", name], ["play", name],
            ["import_csv", name, "--output", "out/bag", "--time", "t", "--voltage", "u", "--speed", "w"],
        )
    )  # fmt: skip


def parameters(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A node with odd parameters, on the command line or in a file."""
    name = random.choice(("motor_sim", "motor_sim", "motor_control", "motor_driver"))
    rows = {
        "motor_sim": "name sample_rate edges_per_revolution max_voltage model edge_resolution seed gear_ratio",
        "motor_control": "kp ki voltage_limit model speed_source sample_timeout reference_rate_limit",
        "motor_driver": "port baud name sample_rate edges_per_revolution max_voltage",
    }[name].split()
    odd = (*NUMBERS, *WORDS)
    if random.random() < 0.5:
        words = [
            word
            for _ in range(random.choice((1, 2)))
            for word in ("-p", f"{random.choice(rows)}:={random.choice(odd)}")
        ]
    else:
        content = {"/**": {"ros__parameters": {random.choice(rows): draw(VALUES)}}}
        (folder / "input.yaml").write_bytes(yaml_text(content, draw, random))
        words = ["--params-file", "input.yaml"]
    if random.random() < 0.2:
        words += random.choice(
            (["-r", "__ns:=bad-name"], ["--log-level", "x"], ["-r", "x"], ["--enclave", "x"], ["--nope"])
        )
    return [name, "--ros-args", *(word.replace("\0", "") for word in words)]


def values(draw: Draw, random: Random, folder: Path) -> list[str]:
    """What is typed behind `ros2 topic pub` and `ros2 service call`."""
    text = draw(st.one_of(st.text(max_size=40), VALUES.map(lambda value: yaml.safe_dump(value, allow_unicode=True))))
    fields = {
        "std_msgs/msg/Float64": ("data",),
        "motor_msgs/msg/MotorModel": ("name", "parameter_values", "effects", "header", "on_bound"),
        "motor_msgs/srv/Identify": ("bag_uris", "start", "particles", "seed"),
        **dict.fromkeys(("venv/__main__/X", "evil/msg/X", "../x", ""), ("data",)),
    }
    kind = random.choice([*fields] + 4 * [*fields][:3])
    whole = f"{random.choice(fields[kind])}:\n  " + text.replace("\n", "\n  ")
    return ["values", kind, text if random.random() < 0.2 else whole]


def fill_values(words: list[str]) -> int:
    """What the stand-in does with a type and a text, without a graph."""
    from motor_ros.command import shell
    from ros2_stand_in.interfaces import interface_type
    from ros2_stand_in.interfaces import values as typed

    def work() -> int:
        kind = "srv" if "/srv/" in words[0] else "msg"
        found = interface_type.load(words[0], kind)
        typed.fill(found.Request() if kind == "srv" else found(), typed.parse(words[1]))
        return 0

    return shell(work)


def playing(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A bag to play whose types, topics, times or messages are odd."""
    contents(draw, random, folder)
    return ["play", "out/input", "--rate", "100"]


def main_of(name: str) -> Main:
    if name in ("motor_sim", "motor_control", "motor_driver"):
        return node(name)
    return fill_values if name == "values" else command(name)


KINDS = (
    Kind("MCAP file, by its records", 1100, main_of, mcap),
    Kind("bag with odd messages", 600, main_of, contents),
    Kind("database (.db3)", 250, main_of, database),
    Kind("metadata.yaml", 200, main_of, metadata),
    Kind("model file", 300, main_of, model),
    Kind("CSV", 250, main_of, csv),
    Kind("arguments", 250, main_of, arguments),
    Kind("pipes, devices, links", 100, main_of, pipes),
    Kind("values on the command line", 200, main_of, values),
    Kind("parameters of nodes", 80, main_of, parameters, interrupt=1.0),
    Kind("bag to play", 40, main_of, playing, interrupt=8.0),
)
