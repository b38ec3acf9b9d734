"""Python calls the emulated chip's library as C has it."""

import re
from ctypes import POINTER, c_char_p, c_int, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p
from pathlib import Path

import pytest
from emulated_board import need_emulator

from motor_board.emulation.library import Load, PinLevels, load_library

SOURCES = Path(__file__).resolve().parents[3] / "motor_board" / "emulator"
DEFINED = re.compile(r"^(?P<result>\w[\w ]*[ *])chip_(?P<name>\w+)\((?P<arguments>[^)]*)\)$", re.MULTILINE)
# What a type of C's is called here: pointers to arrays go as POINTER or as an address.
TYPES = {
    "void": {None},
    "int": {c_int},
    "uint32_t": {c_uint32},
    "uint64_t": {c_uint64},
    "size_t": {c_size_t},
    "struct chip_pins": {PinLevels},
    "struct chip *": {c_void_p},
    "char *": {c_char_p},
    "uint8_t *": {POINTER(c_uint8), c_char_p, c_void_p},
    "uint64_t *": {POINTER(c_uint64), c_void_p},
    "struct chip_load *": {POINTER(Load)},
}


def type_of(declaration: str) -> str:
    """The type in a declaration such as `const uint64_t *cycles`, without `const` and the name."""
    plain = re.sub(r"(\w+)\[\w+\]$", r"*\1", declaration.replace("const ", "").strip())
    return re.sub(r"\s*\*\s*\w*$", " *", plain) if "*" in plain else plain.rsplit(" ", 1)[0]


FUNCTIONS = {
    found["name"]: (found["result"].strip(), found["arguments"])
    for path in sorted(SOURCES.glob("*.c"))
    for found in DEFINED.finditer(path.read_text(encoding="utf-8"))
}


def test_all_functions_were_found() -> None:
    assert {"open", "run", "pins", "load", "edges"} < set(FUNCTIONS) and len(FUNCTIONS) == 20


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_has_the_signature_of_the_source(name: str) -> None:
    need_emulator()
    function, (result, arguments) = getattr(load_library(), f"chip_{name}"), FUNCTIONS[name]
    kind = result.replace("const ", "").strip()
    assert function.restype in TYPES[re.sub(r"\s*\*$", " *", kind)]
    assert len(function.argtypes) == len(arguments.split(","))
    for given, declared in zip(function.argtypes, arguments.split(","), strict=True):
        assert given in TYPES[type_of(declared)], declared
