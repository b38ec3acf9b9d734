"""Find what was given to a node that drives a motor and does not reach it, by a slip of the pen or of the namespace."""

from collections.abc import Collection, Iterable, Sequence
from contextlib import suppress
from difflib import get_close_matches

from motor_model.errors import MotorError
from motor_model.given.sections import reaches, read_sections

# Two letters of ten. The closest names that are different parameters of one workbench, and may stand in one file for
# all its nodes, are command_timeout and joint_command_timeout, at 0.83.
CLOSE = 0.85

DIGITS = "0123456789_"
MISSPELT = "there is no parameter {}, and {} may be meant"
NAMESPACE = "{0} has parameters for '{1}', which is not {2}: write '/**/{3}', or '{2}'"
NAME = "{} has parameters for '{}', and {} may be meant"


def find_misspelt(given: Iterable[str], known: Sequence[str]) -> str:
    """Find a given parameter that is none, and nearly one that is not given, as a clause; "" if there is none."""
    names = set(given)
    missing = {_plain(name): name for name in known if name not in names}
    for name in sorted(names - set(known)):
        if close := get_close_matches(_plain(name), list(missing), 1, CLOSE):
            return MISSPELT.format(name, missing[close[0]])
    return ""


def find_unreached(path: str, node: str) -> str:
    """Find a section of a parameter file that was probably meant for a node of that full name, as a clause; "" if none.

    That is one of its name without a namespace, where the node has one, or of nearly its name; unless another section
    of its name is for it.

    Raises:
        MotorError: the file is no parameter file.
    """
    own = node.rpartition("/")[2]
    named = [name.strip("/") for name, _ in read_sections(path) if not name.endswith("*")]
    if any(reaches(name, node) for name in named):
        return ""
    for name in named:
        last = name.rpartition("/")[2]
        if name == own:
            return NAMESPACE.format(path, name, node, own)
        numbered = last != own and last.rstrip(DIGITS) == own.rstrip(DIGITS)  # motor_driver1 beside motor_driver2
        if last != own and not numbered and get_close_matches(_plain(last), [_plain(own)], 1, CLOSE):
            return NAME.format(path, name, own)
    return ""


def find_mistake(node: str, given: Collection[str], known: Sequence[str], words: Sequence[str]) -> str:
    """Find what does not reach a node of that full name, as a clause; words: of its command line; "" if all does."""
    for word, path in zip(words, words[1:], strict=False):
        if word == "--params-file":
            with suppress(MotorError):  # ROS has read it, which is stricter here and there, and laxer
                if said := find_unreached(path, node):
                    return said
    return find_misspelt(given, known)


def _plain(name: str) -> str:
    return name.lower().replace("-", "_")
