"""What `ros2` says about itself, and what it does with words it does not know."""

import importlib
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE

from ros2_stand_in.verb_table import VERBS

LAUNCHED = Path(__file__).resolve().parents[2] / "ros2_stand_in" / "__main__.py"
ABOUT = "This is the motor workbench's stand-in for machines without the real ros2 command."


def test_help_says_what_this_is_and_lists_every_verb(ros2):
    for words in ((), ("--help",), ("-h",)):
        out = ros2(*words).out
        assert ABOUT in out
        listed = [line.strip() for line in out.splitlines() if line.startswith("  ")]
        assert [line.split("  ")[0] for line in listed] == [verb.words for verb in VERBS]


def test_a_closed_output_is_no_mistake():
    command = [sys.executable, str(LAUNCHED), "pkg", "list"]
    done = subprocess.run(["sh", "-c", f"{shlex.join(command)} >&-"], capture_output=True, text=True, timeout=PATIENCE)
    assert (done.returncode, done.stderr) == (0, "")


def test_help_of_a_group_lists_its_verbs_only(ros2):
    out = ros2("topic").out
    assert ABOUT in out
    listed = [line for line in out.splitlines() if line.startswith("  ")]
    assert [line.split()[:2] for line in listed] == [
        ["topic", verb] for verb in ("list", "info", "type", "echo", "hz", "pub")
    ]


def test_unknown_words_are_a_sentence_and_a_usage_error(ros2):
    assert ros2("lifecycle", "list", status=2).err == (
        "ros2 has no verb 'lifecycle' in the motor workbench's stand-in; "
        "it has: run, pkg, topic, service, action, interface, node, param, bag.\n"
    )
    assert ros2("topic", "bw", status=2).err == (
        "ros2 topic has no verb 'bw' in the motor workbench's stand-in; it has: list, info, type, echo, hz, pub.\n"
    )
    assert "unrecognized arguments: --nonsense" in ros2("pkg", "list", "--nonsense", status=2).err


@pytest.mark.parametrize("verb", VERBS, ids=lambda verb: verb.words.replace(" ", "_"))
def test_every_verb_has_a_function_and_help(verb, capsys):
    from ros2_stand_in.main import main

    module, _, function = verb.place.partition(":")
    assert callable(getattr(importlib.import_module(f"ros2_stand_in.verbs.{module}"), function))
    with pytest.raises(SystemExit) as ended:
        main([*verb.words.split(), "--help"])
    assert ended.value.code == 0
    out = capsys.readouterr().out
    assert out.startswith(f"usage: ros2 {verb.words} [-h]")
    assert verb.help in " ".join(out.split())


def test_without_the_workspace_it_says_to_source_it(ros2):
    assert ros2("pkg", "list", status=1, AMENT_PREFIX_PATH="").err == (
        "No packages are on the path: 'source env.sh' in the workbench's root, then try again.\n"
    )
    assert ros2("pkg", "list", status=1, PYTHONPATH="").err == (
        "motor_model is not on the path: 'source env.sh' in the workbench's root, then try again.\n"
    )
