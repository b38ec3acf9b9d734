"""Definitions are ROS 2's grammar, or refused before anybody makes code of them."""

from pathlib import Path

import pytest
from ament_index_python.packages import get_packages_with_prefixes

from motor_identification.bag.definition import installed
from motor_identification.bag.interface_grammar import LONGEST_ARRAY, Field, NotOfGrammar, parse

TYPE = "some_msgs/msg/Some"


def test_every_installed_message_is_of_the_grammar() -> None:
    known = 0
    for package, prefix in get_packages_with_prefixes().items():
        for path in Path(prefix, "share", package, "msg").glob("*.msg"):
            name = f"{package}/msg/{path.stem}"
            assert name in parse(installed(name).text, name)
            known += 1
    assert known > 100


def test_fields_constants_remarks_and_nested_types() -> None:
    text = f"""# a remark
std_msgs/Header header   # of it
Inner[3] inners
float64[] values
float64[<=4] few
string<=10 name "a # b"
int32 COUNT=3
string WORD = "x = 1"
uint8[{10**6}] picture
================================================================================
MSG: some_msgs/Inner
bool b
================================================================================
MSG: std_msgs/Header
string frame_id
"""
    types = parse(text, TYPE)
    assert types[TYPE] == (
        Field("header", "std_msgs/msg/Header"),
        Field("inners", "some_msgs/msg/Inner", 3),
        Field("values", "float64", 0),
        Field("few", "float64", 0),
        Field("name", "string"),
        Field("picture", "uint8", 10**6),
    )
    assert types["some_msgs/msg/Inner"] == (Field("b", "bool"),)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("float64 x\nimport os", "line 2 is no field|import is not defined|os"),
        ("float64 x; import os", "line 1 is no field"),
        ("float64 __import__('os').system('x')", "line 1 is no field"),
        ("float64 class", "line 1 is no field"),
        ("float64 x\u00e9", "line 1 is no field"),
        ("float64[ x", "line 1 is no field"),
        ("float64", "line 1 is no field"),
        ("Missing x", "some_msgs/msg/Missing is not defined"),
        (f"{TYPE} x", "nested deeper than 30, or in itself"),
        ("string[300000] x", "line 1 has an array of 300000, and 4096 is the most"),
        (f"string[{LONGEST_ARRAY + 1}] x", "and 4096 is the most"),
        ("string[4096] x\n" * 25, "more than 100000 values"),
        ("A[4096] x\n===\nMSG: some_msgs/A\nB[4096] x\n===\nMSG: some_msgs/B\nbool x", "more than 100000 values"),
        ("#" * (1 << 20) + "x", "longer than"),
        (
            "T0 x\n" + "".join(f"===\nMSG: some_msgs/T{k}\nT{k + 1} a\nT{k + 1} b\n" for k in range(40)),
            "nested deeper than 30",
        ),
    ],
)
def test_anything_else_is_refused(text: str, why: str) -> None:
    with pytest.raises(NotOfGrammar, match=why):
        parse(text, TYPE)


def test_the_longest_array_and_types_in_types_in_both_branches() -> None:
    parse(f"string[{LONGEST_ARRAY}] x", TYPE)
    deep = "".join(f"===\nMSG: some_msgs/T{k}\nT{k + 1} a\n" for k in range(28))
    parse("T0 x\n" + deep + "===\nMSG: some_msgs/T28\nbool x", TYPE)
