"""The viewers' layouts have the form that the viewers read, and every series in them is a field of ours."""

import importlib
import json
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

LAYOUTS = Path(__file__).resolve().parents[2] / "motor_bringup" / "layouts"
TYPES = {"motor/speed": "MotorSpeed", "motor/control_state": "ControlState"}
STATUS = re.compile(r"/diagnostics(/motor)?//(motor_control|motor_sim|motor_driver): motor/level$")
SHOWN = {  # what each layout has to show, by file
    "motor": {"speed", "reference", "voltage", "proportional", "integral", "feedforward", "edge_period"},
    "replay": {"speed", "voltage", "edge_period"},
}


def field_of(topic: str, field: str) -> str:
    """The field, which the topic's type has."""
    kind = TYPES[topic.strip("/").removeprefix("simulated/")]
    assert field in getattr(importlib.import_module("motor_msgs.msg"), kind).get_fields_and_field_types(), (
        topic,
        field,
    )
    return field


def children(element: ElementTree.Element) -> list[str]:
    return [child.tag for child in element]


@pytest.mark.parametrize("name", SHOWN)
def test_plotjuggler(name: str) -> None:
    root = ElementTree.parse(LAYOUTS / f"plotjuggler_{name}.xml").getroot()
    assert root.tag == "root" and "previouslyLoaded_Datafiles" not in children(root)  # nobody's files
    (tabs,) = root.findall("tabbed_widget")
    assert tabs.get("parent") == "main_window" and children(tabs)[-1] == "currentTabIndex"
    for splitter in root.iter("DockSplitter"):
        sizes = [float(size) for size in splitter.get("sizes", "").split(";")]
        assert len(sizes) == len(splitter) == int(splitter.get("count", 0)) and splitter.get("orientation") in (
            "-",
            "|",
        )
        assert sum(sizes) == pytest.approx(1.0, abs=1e-4)
    shown = set()
    for plot in root.iter("plot"):
        assert plot.get("mode") == "TimeSeries" and plot.get("style") in ("Lines", "Steps", "Dots")
        for curve in plot.findall("curve"):
            topic, _, field = curve.get("name", "").rpartition("/")
            assert re.fullmatch("#[0-9a-f]{6}", curve.get("color", ""))
            if not STATUS.match(f"{topic}/{field}"):
                shown.add(field_of(topic, field))
    assert SHOWN[name] <= shown
    assert any(STATUS.match(curve.get("name", "")) for curve in root.iter("curve")) == (name == "motor")


def panels(layout: Any) -> Iterator[str]:
    """Every panel of a tree of rows and columns."""
    if isinstance(layout, str):
        yield layout
        return
    assert layout["direction"] in ("row", "column") and 0.0 < layout["splitPercentage"] < 100.0
    yield from panels(layout["first"])
    yield from panels(layout["second"])


@pytest.mark.parametrize("name", SHOWN)
def test_foxglove(name: str) -> None:
    content = json.loads((LAYOUTS / f"foxglove_{name}.json").read_text(encoding="utf-8"))
    assert set(content) == {"configById", "globalVariables", "userNodes", "playbackConfig", "layout"}
    assert sorted(panels(content["layout"])) == sorted(content["configById"])
    kinds, shown = set(), set()
    for panel, config in content["configById"].items():
        kind, _, identity = panel.partition("!")
        kinds.add(kind)
        assert identity
        for path in config.get("paths", []):
            topic, _, field = path["value"].partition(".")
            assert path["timestampMethod"] == "headerStamp"
            shown.add(field_of(topic, field))
    assert SHOWN[name] <= shown
    assert kinds == ({"Plot", "StateTransitions", "DiagnosticSummary"} if name == "motor" else {"Plot"})
