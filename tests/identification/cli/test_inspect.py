"""`inspect` writes a mapping that `identify` and `diagnose` take."""

from pathlib import Path

import foreign_bags
import pytest

from motor_identification.bag import BagWriter
from motor_identification.cli.identify import main as identify
from motor_identification.cli.inspect import main
from motor_identification.mapping import load_mapping


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("foreign") / "bag"
    foreign_bags.write_joint_states(path, foreign_bags.move(8.0))
    return path


def test_from_a_bag_to_a_fit(bag: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mapping = tmp_path / "mapping.yaml"
    assert main([str(bag), "--output", str(mapping)]) == 0
    out = capsys.readouterr().out
    assert "/joint_states  sensor_msgs/msg/JointState  (1600 messages, 200 Hz, stamped)" in out
    assert "/wheels/commands:data[1] drives /joint_states:velocity[right_wheel], a speed (it explains " in out
    assert "without a mapping" not in out
    assert load_mapping(mapping).voltage.scale == 1.0
    mapping.write_text(mapping.read_text().replace("scale: 1.0", "scale: 12.0", 1))
    assert identify([str(bag), "--mapping", str(mapping), "--effects", "coulomb_friction"]) == 0
    assert "kv         0.35" in capsys.readouterr().out
    more = ["--position-from", "/joint_states:position[right_wheel]", "--effects", "coulomb_friction"]
    assert identify([str(bag), "--mapping", str(mapping), *more]) == 0
    assert "kv         0.350" in capsys.readouterr().out


def test_a_bag_of_ours_needs_no_mapping(capsys: pytest.CaptureFixture[str]) -> None:
    bag = str(Path(__file__).parents[3] / "bags" / "step")
    assert main([bag]) == 0
    out = capsys.readouterr().out
    assert "(1 message, stamped)" in out
    assert (
        f"\n{bag} was recorded from this workbench's topics: identify and diagnose read it without a mapping.\n" in out
    )


def test_a_mapping_that_is_there_stays(bag: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "mapping.yaml").write_text("mine")
    assert main([str(bag), "--output", str(tmp_path / "mapping.yaml")]) == 1
    assert "exists already" in capsys.readouterr().err and (tmp_path / "mapping.yaml").read_text() == "mine"
    assert main([str(bag)]) == 0 and "voltage: {from: '/wheels/commands:data[1]'" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (["--speed-from", "/joint_states:velocity[0]"], "needs --voltage-from and one of --speed-from"),
        (["--voltage-from", "/a:x"], "needs --voltage-from and one of --speed-from"),
        (["--voltage-from", "/a", "--speed-from", "/b:x"], "names no field of a message"),
        (["--voltage-from", "/a:x", "--speed-from", "/b:x@kg"], "is in kg, which is no unit of it"),
        (["--voltage-from", "/a:x", "--speed-from", "/b:x"], "it has the topics /joint_states, /wheels/commands"),
        (["--voltage-from", "/a:x", "--count-from", "/b:x", "--counts-per-turn", "0"], "a whole number from 1"),
        (
            ["--voltage-from", "/wheels/commands:data[1]", "--count-from", "/joint_states:position[1]"],
            "is unknown: give",
        ),
        (["--mapping", "/nowhere.yaml"], "There is no mapping /nowhere.yaml"),
        (["--mapping", ""], "There is no mapping "),
    ],
)
def test_what_cannot_be_read_is_a_sentence(
    bag: Path, capsys: pytest.CaptureFixture[str], options: list[str], complaint: str
) -> None:
    assert identify([str(bag), *options]) == 1
    err = capsys.readouterr().err
    assert complaint in err and err.count("\n") == 1


def test_topics_that_cannot_be_read_are_named_where_nothing_else_moves(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        topic = writer.topic("/wheel/state", "a_package_with_a_long_name_interfaces/msg/StateOfAWheelWithALongName")
        for k in range(5):
            writer.write(topic, 10**18 + k, b"\0\1\0\0" + bytes(8))
    assert main([str(tmp_path / "bag")]) == 1
    heard = capsys.readouterr()
    assert "it as MCAP, which embeds definitions, or source the package that has it.)" in heard.out
    assert "make /wheel/state readable first, as said above, or write the mapping by hand." in heard.err
