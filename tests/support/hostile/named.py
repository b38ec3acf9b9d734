"""Hostile inputs with a name: what once broke, hung, flooded or commanded the workbench, and how each has to end."""

from dataclasses import dataclass, replace
from pathlib import Path

from hostile import named_bags, named_files, sandbox
from hostile.bags import FIT
from hostile.inputs import main_of
from hostile.named_bags import BAG, START, VOLTAGE, Write, number, to_play, voltage
from hostile.named_files import COLUMNS, csv, link, model, text, workbook

DAMAGED = f"{BAG} is damaged: "
REPORT = ("--report", "out/report")
MADE = (*FIT[:4], "--output")
NODES = (
    *("motor_sim", "motor_control", "motor_driver", "motor_identification"),
    *("monitor", "board_emulator", "diff_drive"),
)
WRONG = {
    "a file of parameters that is not there": ["--params-file", "none.yaml"],
    "a broken file of parameters": ["--params-file", "input.yaml"],
    "a broken -p": ["-p", "broken"],
    "a bad namespace": ["-r", "__ns:=bad-name"],
    "a bad level of its log": ["--log-level", "nonsense"],
}
# What needs living nodes or another network namespace: the tests that have it, for the page.
LIVE = {
    "a stranger in another network namespace": "tests/system/test_stranger.py",
    "record: type names from the network": "tests/ros/test_interface_types.py",
    "param set model_file, then motor/identify": "tests/ros/test_identification_requests.py",
    "motor/identify: bags outside, and through links": "tests/identification/service/test_places.py",
    "motor/identify: a pipe as a bag": "tests/ros/test_identification_requests.py",
    "20 motor/identify at once, cancel, a limit of time": "tests/ros/test_identification_requests.py",
    "the model_file cannot be written": "tests/ros/test_identification_requests.py",
    "ROS_SECURITY_ENABLE without a keystore": "tests/ros/test_run.py",
    "--output x | true, > /dev/full, closed": "tests/identification/cli/test_identify_outputs.py",
    "the disk is full in the middle of a file": "tests/model/test_regular_file.py",
    "a bag that was only half imported": "tests/identification/cli/test_import_log.py",
    "motor/info of a live plant with a sample period of 1 ns": "tests/ros/test_messages.py",
}


@dataclass(frozen=True)
class Case:
    """A hostile input: what is written into a folder, the command that reads it, and how that has to end."""

    name: str
    write: Write
    words: list[str]
    status: int
    says: str  # stands in what it says, on either stream
    interrupt: float = 0.0  # [s]
    seconds: float = 20.0  # of a processor that it may take
    large: bool = False  # too much for a test

    def run(self, folder: Path) -> sandbox.Verdict:
        """Run it in the folder; another status, another sentence and too long a time are faults as well."""
        sandbox.prepare(folder)
        self.write(folder)
        verdict = sandbox.run(main_of(self.words[0]), self.words[1:], folder, self.interrupt)
        said = "".join((folder / name).read_text(encoding="utf-8", errors="replace") for name in ("err", "out.txt"))
        wrong = {
            f"status {verdict.status}": verdict.status != self.status,
            f"not said: {self.says}": self.says not in said,
            f"{verdict.busy:.0f} s": verdict.busy > self.seconds,
            "commands for the terminal": any(ord(c) < 32 and c not in "\n\t\r" for c in said),
        }
        return replace(verdict, faults=(*verdict.faults, *(fault for fault, is_so in wrong.items() if is_so)))


def fitted(name: str, write: Write, says: str = "kv", words: tuple[str, ...] = (), seconds: float = 20.0) -> Case:
    """A bag that is identified all the same."""
    return Case(name, write, ["identify", BAG, *FIT, *words], 0, says, seconds=seconds)


def unfit(name: str, write: Write, says: str, bag: str = BAG, command: str = "identify") -> Case:
    """A bag that is refused."""
    return Case(name, write, [command, bag, *(FIT if command == "identify" else ())], 1, says)


def diagnosed(name: str, write: Write, words: tuple[str, ...] = ()) -> Case:
    return Case(name, write, ["diagnose", BAG, *words], 0, "noise floor", seconds=60.0)


def simulated(name: str, write: Write, says: str, words: tuple[str, ...] = (), status: int = 1) -> Case:
    """A model file that is refused."""
    return Case(
        name, write, ["experiment", "step", "--model", "input.yaml", "--output", "out/bag", *words], status, says
    )


def played(name: str, status: int, says: str, *messages: tuple[str, str, int, bytes], interrupt: float = 0.0) -> Case:
    return Case(f"play: {name}", to_play(*messages), ["play", BAG, "--rate", "100"], status, says, interrupt)


def imported(name: str, write: Write, status: int, says: str, *words: str, large: bool = False) -> Case:
    command = ["import_csv", "input.csv", "--output", "out/bag", *COLUMNS, *words]
    return Case(f"import_csv: {name}", write, command, status, says, seconds=60.0 if large else 20.0, large=large)


def logged(name: str, write: Write, says: str, file: str = "input.xlsx", large: bool = False) -> Case:
    """A log that is refused."""
    return Case(name, write, ["import_log", file, "--dry-run"], 1, says, large=large)


def nothing(folder: Path) -> None:
    """The command line is all."""


FLOAT, ONE = "std_msgs/msg/Float64", number(1.0)
MOTOR, FIVE = "/motor/voltage", voltage(5.0)
SPEED, COUNT = ("--speed", "w", "--unit", "rad/s"), ("--count", "n", "--no-increments")
SAMPLES = ("-p", "sample_rate:=1e7")
CODE = (
    played("types named as programs of Python", 1, "no topic that", ("/t", "venv/__main__/X", START, ONE)),
    played("a package beside the bag, named as an installed one", 0, "", ("/t", FLOAT, START, ONE), interrupt=8.0),
    simulated("YAML that names a function", text("input.yaml", "a: !!python/name:os.system"), "not YAML"),
    unfit("a definition that is code", named_bags.defined(b"import os\n"), "cannot be decoded"),
)
STRANGE_MOTION = (
    fitted("a minute at 0 V, then motion", named_bags.long_standstill),
    diagnosed("a minute at 0 V, then motion, diagnosed", named_bags.long_standstill),
    unfit("both channels are exchanged", named_bags.wired_backwards, "swap the two channels"),
    unfit("both channels are exchanged, diagnosed", named_bags.wired_backwards, "swap the two", command="diagnose"),
)
ARGUMENTS = tuple(
    Case(f"{node}: {name}", text("input.yaml", "a: [\n"), [node, "--ros-args", *words], 2, said)
    for node in NODES
    for name, words in WRONG.items()
    for said in ["is no namespace" if "namespace" in name else "Couldn't parse"]
)
FILES = (
    unfit("a pipe as a bag", named_files.pipe("input.mcap"), "no regular file", "input.mcap"),
    unfit("a device as a bag", link("/dev/zero", "input.mcap"), "no regular file", "input.mcap"),
    unfit("links in a circle as a bag", link("input.mcap", "input.mcap"), "input.mcap", "input.mcap"),
    imported("a device as a log", link("/dev/zero", "input.csv"), 1, "not a regular file", *SPEED),
    simulated("a device as a model", link("/dev/zero", "input.yaml"), "no regular file"),
    Case("a full disk", named_bags.recording(), ["identify", BAG, *MADE, "/dev/full", "--force"], 1, "cannot write"),
)
NAMES = (
    diagnosed("a motor called $\\frac{, diagnosed, with a report", named_bags.recording("$\\frac{"), REPORT),
    fitted("a motor whose name clears the screen", named_bags.recording("$\\frac{\x1b[2J\x07"), words=REPORT),
    fitted("a motor whose name is not UTF-8", named_bags.not_utf_8, words=REPORT),
    unfit("a bag whose name clears the screen", nothing, "\\x1b[2J", "\x1b[2J"),
)
DAMAGE = (
    fitted("a flipped bit in the first chunk", named_bags.flipped(0), f"{DAMAGED}60 messages"),
    fitted("a flipped bit in the second chunk", named_bags.flipped(1), f"{DAMAGED}60 messages"),
    fitted("3,000 motor/info with other stamps", named_bags.info_says(3000), seconds=5.0),
)
PLAYED = (
    played(
        "a garbled last voltage", 0, "1 message is not", (MOTOR, VOLTAGE, START, FIVE), (MOTOR, VOLTAGE, START, b"x")
    ),
    played("the end of time", 1, "is damaged", (MOTOR, VOLTAGE, START, FIVE), (MOTOR, VOLTAGE, 2**64 - 1, FIVE)),
    played("a topic's name that clears the screen", 1, "\\x1b[2J", ("/\x1b[2J", FLOAT, START, ONE)),
    played("a type's name that is none", 1, "no topic that can be played here", ("/t", "Float64", START, ONE)),
)
TABLES = (
    imported("2·10¹⁰ edges a turn", csv(), 2, "edges-per-revolution", *COUNT, "--edges-per-revolution", "20000000000"),
    imported("counts of 10³⁰⁰", csv(n="1e300"), 1, "1e+300", *COUNT, "--edges-per-revolution", "96"),
    imported("one infinite voltage", csv(u="inf"), 0, "Left out: 1 row with a cell that is no number", *SPEED),
    imported("infinite voltages", csv(often=10, u="inf"), 1, "inf", *SPEED),
    imported("a lag that is no number", csv(), 2, "nan", *SPEED, "--speed-lag", "nan"),
    imported("milliseconds since 1970", csv(start=1.763e12, period=5.0), 0, "200 samples, 1.00 s", *SPEED),
    imported("--split over values that alternate", csv(100_000), 1, "has a single row", *SPEED, "--split", "z"),
    imported("a million rows", csv(1_000_000), 0, "1000000 samples", *SPEED, large=True),
)
EXPLORED = (Case("explore: --known-effects nope", nothing, ["explore", "out/x", "--known-effects", "nope"], 1, "nope"),)
BOMBS = (
    fitted("a zstd chunk of a gigabyte", named_bags.bomb("zstd"), DAMAGED),
    fitted("an lz4 chunk of a gigabyte", named_bags.bomb("lz4"), DAMAGED),
    unfit("a zstd file of a gigabyte", named_bags.packed_file, "unpacks to more than", "input.mcap.zstd"),
    unfit("string[300000] in a definition", named_bags.defined(b"string[300000] x\n"), "300000"),
    simulated("YAML: aliases of aliases", text("input.yaml", named_files.aliases()), "has an alias"),
    simulated("YAML: merges", text("input.yaml", "a: &a {x: 1}\nb: {<<: *a}\n"), "has an alias"),
    simulated("YAML: nested deep", text("input.yaml", "a: " + "[" * 100_000), "nested deeper than"),
    Case("metadata: aliases", named_files.metadata(named_files.aliases()), ["ros2", "bag", "info", BAG], 1, "metadata"),
    logged("JSON nested deep", text("input.json", '{"sysid": true, "x": ' + "[" * 200_000), "input.json", "input.json"),
)
WORKBOOKS = (  # the large ones: what is counted, on either side, is in tests/identification/logs/formats
    logged("a workbook of forty million empty rows", workbook("<row/>", 250_000_000), "1048576 rows", large=True),
    logged("a workbook whose rows are far apart", workbook('<row r="999999999"/>', 20_000_000), "1048576 rows"),
    logged("a workbook whose cells are far apart", workbook('<row><c r="IV1"/></row>', 10_000_000), "million cells"),
    logged(
        "a workbook of one row of elements",
        workbook("<c/>", 100_000_000, "<row>{}</row>"),
        "elements in a row",
        large=True,
    ),
    logged("a workbook with elements beside its rows", workbook("<x/>", 100_000_000), "elements in a row", large=True),
    logged(
        "a workbook of one long text", workbook('<row><c t="s"><v>0</v></c></row>', 10**7, text="x" * 10**6), "text"
    ),
    logged("a workbook of fifty million texts", workbook("<row/>", 6, texts=40_000_000), "million texts", large=True),
    logged("a workbook with entities of entities", workbook("", 0, head=named_files.ENTITIES), "entities"),
)
RIPPLE = model("torque_ripple", ripple_voltage=0.1, ripple_cycles=1e9, ripple_phase=0.0)
NUMBERS = (
    simulated("a model with kv of 10⁻³⁰⁰", model(kv=1e-300), "none that a motor has"),
    simulated("a model with a max_voltage of 10³⁰⁰", model(max_voltage=1e300), "max_voltage"),
    simulated("a model with a ripple of 10⁹ cycles", RIPPLE, "ripple_cycles"),
    simulated("a sample rate of 10⁷", model(), "sample-rate", ("--sample-rate", "1e7"), 2),
    Case("motor_sim: a sample rate of 10⁷", nothing, ["motor_sim", "--ros-args", *SAMPLES], 1, "sample_rate"),
    unfit("motor/info with a sample period of 1 ns", named_bags.info_says(sample_period=1e-9), "sample_period"),
)
CASES = (
    *(*CODE, *STRANGE_MOTION, *ARGUMENTS, *FILES, *NAMES, *DAMAGE, *PLAYED, *TABLES, *EXPLORED),
    *(*BOMBS, *WORKBOOKS, *NUMBERS),
)
# Half a second of a processor and more, and beside each another of its kind.
DEAR = frozenset(
    {
        "import_csv: --split over values that alternate",
        "a minute at 0 V, then motion, diagnosed",
        "a motor called $\\frac{, diagnosed, with a report",
        "a motor whose name is not UTF-8",
        "a workbook whose rows are far apart",
        "a workbook whose cells are far apart",
    }
)
