"""What a message type is made of, as bags embed it: so that a bag can be read where the type is not installed."""

import json
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from motor_ros.interface_types import NotInstalled, definition_file

_SEPARATOR = "=" * 80
_FIELD = re.compile(r"^\s*([A-Za-z]\w*(?:/\w+)*)", re.MULTILINE)
_PRIMITIVES = {"bool", "byte", "char", "string", "wstring", "float32", "float64"} | {
    f"{kind}{bits}" for kind in ("int", "uint") for bits in (8, 16, 32, 64)
}


@dataclass(frozen=True, slots=True)
class Definition:
    """A message definition; both fields are empty for a type that is not installed from a .msg file."""

    text: str = ""  # the .msg file, then every nested one behind a separator (the MCAP schema encoding ros2msg)
    type_hash: str = ""  # REP 2016, such as RIHS01_d901…


@cache
def installed(type_name: str) -> Definition:
    """Return the definition of `package/msg/Name` from the installed share directories."""
    text = _source(type_name)
    if not text:
        return Definition()
    parts = [text, *(f"MSG: {name.replace('/msg/', '/')}\n{_source(name)}" for name in _nested(type_name, text))]
    return Definition(f"\n{_SEPARATOR}\n".join(part.rstrip("\n") for part in parts) + "\n", _type_hash(type_name))


def _file(type_name: str, suffix: str) -> Path | None:
    try:
        path = definition_file(type_name, suffix)
    except NotInstalled:
        return None
    return path if path.is_file() else None


def _source(type_name: str) -> str:
    path = _file(type_name, ".msg")
    return path.read_text(encoding="utf-8") if path else ""


def _type_hash(type_name: str) -> str:
    path = _file(type_name, ".json")
    hashes = json.loads(path.read_text(encoding="utf-8")).get("type_hashes", []) if path else []
    return next((str(row["hash_string"]) for row in hashes if row["type_name"] == type_name), "")


def _nested(type_name: str, text: str) -> list[str]:
    """Full names of all types inside the type, each once, in the order in which they are met."""
    found: dict[str, None] = {}
    waiting = [(type_name, text)]
    while waiting:
        owner, source = waiting.pop(0)
        for name in _FIELD.findall(source):
            if name in _PRIMITIVES:
                continue
            package, _, short = name.rpartition("/")
            full = f"{(package or owner).split('/')[0]}/msg/{short}"
            if full != type_name and full not in found:
                found[full] = None
                waiting.append((full, _source(full)))
    return list(found)
