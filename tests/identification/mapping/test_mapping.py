"""Mapping files and what stands in for them on a command line."""

from pathlib import Path

import pytest

from motor_identification.logs.form import Kind
from motor_identification.mapping.mapping import Mapping, load_mapping, mapping_text, parse_origin
from motor_model.errors import RecordingError

WHOLE = """\
name: left
voltage: {from: /left/command:data, scale: 12.0}
speed: {from: '/joint_states:velocity[left]', unit: rpm}
current: /power:current*0.001
edges_per_revolution: 1440
speed_lag: 0.0
max_voltage: 12
voltage_before: true
"""


def load(folder: Path, text: str) -> Mapping:
    (folder / "mapping.yaml").write_text(text)
    return load_mapping(folder / "mapping.yaml")


def test_a_file(tmp_path: Path) -> None:
    mapping = load(tmp_path, WHOLE)
    assert (mapping.name, mapping.kind, mapping.edges_per_revolution) == ("left", Kind.SPEED, 1440)
    assert (str(mapping.voltage), mapping.voltage.scale) == ("/left/command:data*12", 12.0)
    assert mapping.motion == parse_origin("/joint_states:velocity[left]@rpm", Kind.SPEED)
    assert mapping.current == parse_origin("/power:current*0.001")
    assert (mapping.speed_lag, mapping.speed_window, mapping.max_voltage, mapping.voltage_before) == (
        0.0,
        None,
        12.0,
        True,
    )


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    mapping = load(tmp_path, WHOLE.replace("name: left", 'name: "it\'s"').replace("voltage_before: true", ""))
    assert load(tmp_path, mapping_text(mapping)) == mapping
    plain = Mapping(parse_origin("/a:x"), parse_origin("/b:y"), Kind.POSITION)
    assert load(tmp_path, mapping_text(plain)) == plain


@pytest.mark.parametrize(
    ("text", "unit", "scale"),
    [("/a:x", "", 1.0), ("/a:x@rpm", "rpm", 1.0), ("/a:x*-0.5", "", -0.5), ("/a:x@deg/s*1e-3", "deg/s", 1e-3)],
)
def test_fields_with_units_and_factors(text: str, unit: str, scale: float) -> None:
    origin = parse_origin(text, Kind.SPEED)
    assert (origin.unit, origin.scale) == (unit, scale) and parse_origin(str(origin), Kind.SPEED) == origin


@pytest.mark.parametrize(
    ("text", "kind", "complaint"),
    [
        ("/a:x@rad", Kind.SPEED, "is in rad, which is no unit of it: take one of rad/s"),
        ("/a:x@V", None, "volts and amperes are made by a factor"),
        ("/a:x*0", None, "its factor has to be a number other than 0"),
        ("/a:x*1e99", None, "its factor has to be a number other than 0, up to 1e[+]09"),
        ("/a:x*1.2.3", None, "its factor has to be a number"),
        ("/a:x*", None, "is no TOPIC:FIELD"),
        ("", None, "is no TOPIC:FIELD"),
    ],
)
def test_what_is_no_field(text: str, kind: Kind | None, complaint: str) -> None:
    with pytest.raises(RecordingError, match=complaint):
        parse_origin(text, kind)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "needs voltage, and one of speed"),
        ("[1]", "needs voltage, and one of speed"),
        ("voltage: /a:x", "needs voltage, and one of speed"),
        ("{voltage: /a:x, speed: /b:y, count: /c:z}", "needs voltage, and one of speed"),
        ("{voltage: /a:x, speed: /a:x}", "cannot be both voltage and speed"),
        (
            "{voltage: /a:x, speed: /b:y, sped: 1}",
            "does not know sped: it may have count, current, edges_per_revolution",
        ),
        ("{voltage: 7, speed: /b:y}", "voltage is `{from: TOPIC:FIELD}`"),
        ("{voltage: {from: /a:x, size: 2}, speed: /b:y}", "voltage is `{from: TOPIC:FIELD}`"),
        ("{voltage: {from: /a:x, scale: [1]}, speed: /b:y}", "its factor has to be a number"),
        ("{voltage: {from: /a:x, scale: .nan}, speed: /b:y}", "its factor has to be a number"),
        ("{voltage: /a:x, speed: /b:y, edges_per_revolution: 20000000000}", "a whole number from 1 to 10000000"),
        ("{voltage: /a:x, speed: /b:y, edges_per_revolution: 1.5}", "a whole number from 1"),
        ("{voltage: /a:x, speed: /b:y, speed_window: -1}", "speed_window is a number above 0"),
        ("{voltage: /a:x, speed: /b:y, speed_lag: .inf}", "speed_lag is a number"),
        ("{voltage: /a:x, speed: /b:y, voltage_before: 3}", "voltage_before is true or false"),
        ("a: &a [1]\nb: *a", "has an alias"),
        ("{", "is not YAML"),
    ],
)
def test_what_is_no_mapping(tmp_path: Path, text: str, complaint: str) -> None:
    with pytest.raises(RecordingError, match=complaint) as caught:
        load(tmp_path, text)
    assert "mapping.yaml" in str(caught.value) and "\n" not in str(caught.value)


def test_no_file(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="There is no mapping .*: check the path, or let `inspect BAG` write one"):
        load_mapping(tmp_path / "none.yaml")
