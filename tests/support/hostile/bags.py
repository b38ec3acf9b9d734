"""Hostile bags: their bytes, their tables and their messages changed, to be read or played."""

import sqlite3
import struct
from contextlib import suppress
from functools import cache
from itertools import islice
from pathlib import Path
from random import Random

import zstandard

from hostile import mcap_mutation
from hostile.kind import ROOT, Draw

FIT = ["--particles", "8", "--epochs", "4", "--output", "out/model.yaml", "--json", "out/fit.json", "--force"]


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


def playing(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A bag to play whose types, topics, times or messages are odd."""
    contents(draw, random, folder)
    return ["play", "out/input", "--rate", "100"]
