"""The emulated chip's C library as Python calls it: structures, and the signature of every function."""

import ctypes
from ctypes import POINTER, Structure, c_char_p, c_int, c_size_t, c_uint8, c_uint16, c_uint32, c_uint64, c_void_p
from typing import Any

from motor_board.build import chip_library


class PinLevels(Structure):
    """As `struct chip_pins` of the library: mean levels of the bridge's pins, in 1/256."""

    _fields_ = [("enable", c_uint16), ("forward", c_uint16), ("reverse", c_uint16)]


class Load(Structure):
    """As `struct chip_load` of the library: what an interrupt has cost, in cycles."""

    _fields_ = [("calls", c_uint64), ("cycles", c_uint64), ("longest", c_uint64), ("waited", c_uint64)]


def load_library() -> Any:
    """Load the emulation's shared library with the signatures of its functions."""
    library = ctypes.CDLL(str(chip_library()))
    bytes_, cycles = POINTER(c_uint8), POINTER(c_uint64)
    signatures: dict[str, tuple[Any, list[Any]]] = {
        "open": (c_void_p, [c_char_p]),
        "close": (None, [c_void_p]),
        "name": (c_char_p, [c_void_p]),
        "cycle": (c_uint64, [c_void_p]),
        "run": (c_int, [c_void_p, c_uint64]),
        "pins": (PinLevels, [c_void_p]),
        "pull_ups": (c_int, [c_void_p]),
        "written": (c_uint64, [c_void_p]),
        "edges": (c_size_t, [c_void_p, c_uint64, c_void_p, c_void_p, c_size_t]),
        "feed": (c_size_t, [c_void_p, c_char_p, c_size_t]),
        "drain": (c_size_t, [c_void_p, bytes_, cycles, c_size_t]),
        "reset": (None, [c_void_p]),
        "power_up": (None, [c_void_p]),
        "resets": (c_uint32, [c_void_p]),
        "clock_zero": (c_uint64, [c_void_p]),
        "supply": (None, [c_void_p, c_uint32]),
        "sensing": (c_uint64, [c_void_p]),
        "sense": (None, [c_void_p, c_uint32]),
        "hang": (None, [c_void_p, c_int]),
        "load": (c_uint64, [c_void_p, POINTER(Load)]),
    }
    for name, (result, arguments) in signatures.items():
        function = getattr(library, f"chip_{name}")
        function.restype, function.argtypes = result, arguments
    return library
