"""Hostile command lines: odd words, odd tables, and pipes or devices in the places of files."""

import os
import shutil
from pathlib import Path
from random import Random

from hypothesis import strategies as st

from hostile import mcap_mutation
from hostile.bags import FIT
from hostile.kind import ROOT, Draw
from hostile.odd_values import NUMBERS, WORDS

OPTIONS = {
    name: [f"--{option}" for option in options.split()]
    for name, options in {
        "identify": "effects start stop particles epochs seed output json report topic-namespace",
        "diagnose": "validate known-effects start stop topic-namespace output json report",
        "experiment": "voltage speed model sample-rate edges-per-revolution edge-resolution seed slot-irregularity",
        "import_csv": "time voltage speed unit split edges-per-revolution speed-lag count-quantum",
        "play": "rate topics remap start-offset",
        "tune": "output nope",
        "compare": "nope",
        "explore": "profile rounds known-effects voltage speed seed",
        "import_log": "time voltage speed unit sheet motor sample-period constant-voltage time-unit",
        "inspect": "output",
        "record": "topic-namespace duration mapping",
        "check": "port max-voltage supply-voltage edges-per-revolution gear-ratio quadrature board-id baud",
        "flash": "port board bridge board-id",
    }.items()
}
FIRST = {
    "experiment": ["step", "--output", "out/bag", "--model", "input.yaml"],
    "tune": ["input.yaml"],
    "compare": ["input.yaml", "input.yaml"],
    "explore": ["out/all", "--model", "none.yaml"],
    "import_log": ["input.csv", "--dry-run"],
    "record": ["out/bag", "--mapping", "none.yaml"],
    "check": ["--port", "none", "--max-voltage", "12", "--edges-per-revolution", "96"],
    "flash": ["--port", "none"],
}
REFUSED = tuple(word for word in (*WORDS, *NUMBERS) if not word.startswith(("/dev", "/proc")))


def arguments(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A command with odd words in the places of its options, and outputs where nothing can be written."""
    name = random.choice(list(OPTIONS))
    shutil.copytree(ROOT / "bags" / "step", folder / "input")
    (folder / "input.yaml").write_text((ROOT / "bags" / "paper.yaml").read_text())
    (folder / "input.csv").write_text("t,u,w\n" + "".join(f"{0.01 * k:.2f},{6 * (k > 9)},{k % 7}\n" for k in range(50)))
    odd = (*WORDS, *NUMBERS, draw(st.text(max_size=12)).replace("\0", ""))
    first = list(FIRST.get(name, ["input"]))
    if name in ("identify",):
        first += FIT
    if name == "compare":
        first[random.randrange(2)] = random.choice((*odd, "input.yaml"))
    elif name in ("explore", "record", "check", "flash"):  # those would wait for a motor
        options = random.sample(OPTIONS[name], 1)
        return [name, *first, options[0], random.choice(REFUSED)]
    elif random.random() < 0.15 or name in ("play", "diagnose"):
        first[0] = random.choice(odd).replace("input", "none") or "none"
    words = [name, *first]
    for option in random.sample(OPTIONS[name], min(random.choice((1, 1, 2)), len(OPTIONS[name]))):
        value = random.choice(odd)
        if option in ("--output", "--json", "--report") and not value.startswith(("/dev/", "/proc", "out")):
            value = f"out/{value[:100].replace('/', '_').replace('..', 'dots')}"  # what the user names is theirs
        words += [option, value]
    return words


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


def serial(draw: Draw, random: Random, folder: Path) -> list[str]:
    """What an Arduino printed: names before or in cells, stamps that stray, units that nobody knows, a line cut off."""
    times = [k * 0.005 for k in range(200)]
    for _ in range(random.choice((0, 0, 1, 2, 50))):
        times[random.randrange(200)] += random.choice((0.006, -0.006, 1e9, float("nan"), -1.0))
    rows = [(f"{now:.3f}", f"{6.0 * (k > 20)}", f"{min(k, 60) * 1.5:.2f}") for k, now in enumerate(times)]
    names = ["t", "voltage", random.choice(("speed", "tacho", "Speed (steps/s)", "pitch_velocity", "Speed (/)"))]
    for _ in range(random.choice((0, 0, 1))):
        names[random.randrange(3)] = random.choice((*WORDS, "t", "a" * 50))
    form = random.choice(("{n},{v}", "{n},{v}", "{n}:{v}", "{n} {v}", "{n}={v}", "{v}"))
    between = "," if form == "{n},{v}" else random.choice((",", ";", " ", "\t"))
    lines = [between.join(form.format(n=n, v=v) for n, v in zip(names, row, strict=True)) for row in rows]
    for _ in range(random.choice((0, 1, 1, 5, 100))):
        place = random.randrange(len(lines))
        lines[place] = random.choice(
            (lines[place][: random.randrange(20)], random.choice(WORDS), random.choice(NUMBERS))
        )
    head = random.choice(("", "=~=~= PuTTY log =~=~=\n", ",".join(names) + "\n"))
    data = (head + "\n".join(lines)).encode("utf-8", errors="surrogatepass")
    (folder / "input.csv").write_bytes(mcap_mutation.changed_bytes(data, random) if random.random() < 0.2 else data)
    words = ["import_log", "input.csv", *random.choice((["--output", "out/bag"], ["--dry-run"])), "--unit", "rad/s"]
    return words + (["--edges-per-revolution", random.choice(NUMBERS)] if random.random() < 0.2 else [])


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
