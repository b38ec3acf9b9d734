"""The firmware's portable core, compiled for this computer: its functions and structures for the tests."""

import ctypes
from ctypes import (
    POINTER,
    Structure,
    c_bool,
    c_char_p,
    c_int,
    c_int16,
    c_uint8,
    c_uint16,
    c_uint32,
    c_void_p,
)
from functools import cache
from typing import Any

import pytest

from motor_board.build import core_library
from motor_board.errors import BoardError

LONGEST = 48
KEPT = 16  # edges


class EdgeTimer(Structure):
    _fields_ = [
        ("overflows", c_uint16),
        ("count", c_uint32),
        ("newest", c_uint8),
        ("known", c_uint8),
        ("way", c_uint8 * KEPT),
        ("inside", c_bool),
        ("entered_reverse", c_bool),
        ("fold", c_uint8),
        ("lines", c_uint8),
        ("errors", c_uint8),
        ("time", c_uint32 * KEPT),
    ]


class Edge(Structure):
    _fields_ = [
        ("count", c_uint32),
        ("time", c_uint32),
        ("period", c_uint32),
        ("valid", c_bool),
        ("reverse", c_bool),
    ]


class Frame(Structure):
    _fields_ = [
        ("version", c_uint8),
        ("type", c_uint8),
        ("size", c_uint8),
        ("seq", c_uint16),
        ("body", POINTER(c_uint8)),
    ]


class FrameReader(Structure):
    _fields_ = [("buffer", c_uint8 * LONGEST), ("length", c_uint8), ("listening", c_bool), ("bad", c_uint16)]


class Output(Structure):
    _fields_ = [
        ("on", c_bool),
        ("timed_out", c_bool),
        ("boot", c_uint8),
        ("latch", c_uint8),
        ("decay", c_uint8),
        ("pwm", c_uint8),
        ("top", c_int16),
        ("newest", c_int16),
        ("duty", c_int16),
        ("command", c_uint16),
        ("heard", c_uint32),
        ("timeout", c_uint32),
    ]


class WireEnable(Structure):
    _fields_ = [("on", c_uint8), ("boot", c_uint8), ("latch", c_uint8)]


class WireProtect(Structure):
    _fields_ = [("zero", c_uint16), ("most", c_uint16), ("rated", c_uint16), ("budget", c_uint32)]


class Guard(Structure):
    _fields_ = [
        ("limits", WireProtect),
        ("current", c_uint16),
        ("above", c_uint8),
        ("unknown", c_uint8),
        ("heat", c_uint32),
        ("tripped", c_uint8),
    ]


class GuardMemory(Structure):
    _fields_ = [("heat", c_uint32), ("check", c_uint32)]


class WireCommand(Structure):
    _fields_ = [("duty", c_int16)]


class DeviceConfig(Structure):
    _fields_ = [
        ("board", c_uint8),
        ("board_id", c_uint16),
        ("edges_per_revolution", c_uint16),
        ("channels", c_uint8),
        ("tick_ns", c_uint16),
        ("top", c_uint16),
        ("ticks_per_ms", c_uint32),
        ("shortest_period", c_uint32),
        ("first_period", c_uint32),
        ("lead", c_uint32),
        ("first_timeout", c_uint16),
        ("first_decay", c_uint8),
        ("senses_current", c_bool),
        ("silent_top", c_uint16 * 2),
    ]


class Device(Structure):
    _fields_ = [
        ("config", POINTER(DeviceConfig)),
        ("edges", EdgeTimer),
        ("output", Output),
        ("guard", Guard),
        ("reset_cause", c_uint8),
        ("period", c_uint32),
        ("compare", c_uint32),
        ("tick", c_uint32),
        ("latest", c_uint32),
        ("timeout", c_uint16),
        ("supply", c_uint16),
        ("current", c_uint16),
        ("rest", c_uint8 * 512),
    ]


class DeviceFrame(Structure):
    _fields_ = [("type", c_uint8), ("size", c_uint8), ("seq", c_uint16), ("data", c_uint8 * LONGEST)]


RESULTS: dict[str, Any] = {
    "crc_of": c_uint32,
    "cobs_stuff": c_uint8,
    "cobs_unstuff": c_uint8,
    "frame_read": c_bool,
    "frame_seal": c_uint8,
    "edge_timer_extend": c_uint32,
    "edge_timer_at": Edge,
    "quadrature_at": Edge,
    "guard_check": c_int,
    "device_latch": c_bool,
    "device_next": c_uint16,
    "device_is_behind": c_bool,
    "device_catch_up": c_uint16,
    "device_act": c_bool,
    "device_take": c_bool,
}
ARGUMENTS: dict[str, list[Any]] = {
    "crc_of": [c_char_p, c_uint8],
    "cobs_stuff": [c_char_p, c_uint8, c_void_p],
    "cobs_unstuff": [c_void_p, c_uint8],
    "frame_read": [c_void_p, c_uint8, c_void_p],
    "frame_seal": [c_void_p, c_uint8, c_uint16, c_uint8, c_void_p],
    "edge_timer_extend": [c_uint16, c_uint16, c_bool],
    "edge_timer_overflow": [c_void_p],
    "edge_timer_capture": [c_void_p, c_uint16, c_bool],
    "edge_timer_rise": [c_void_p, c_uint16, c_bool, c_bool],
    "edge_timer_fall": [c_void_p, c_uint16, c_bool, c_bool],
    "edge_timer_at": [c_void_p, c_uint32, c_bool],
    "edge_timer_forget": [c_void_p, c_uint32],
    "output_off": [c_void_p],
    "output_enable": [c_void_p, c_void_p, c_uint16, c_uint32],
    "output_command": [c_void_p, c_void_p, c_uint16, c_uint32],
    "output_check": [c_void_p, c_uint32],
    "output_latch": [c_void_p],
    "guard_set": [c_void_p, c_void_p],
    "guard_check": [c_void_p, c_uint16, c_uint32],
    "guard_keep": [c_void_p, c_void_p],
    "guard_recall": [c_void_p, c_void_p],
    "device_start": [c_void_p, c_void_p, c_uint16, c_uint8],
    "device_overflow": [c_void_p],
    "device_capture": [c_void_p, c_uint16, c_bool],
    "device_rise": [c_void_p, c_uint16, c_bool, c_bool],
    "device_latch": [c_void_p],
    "quadrature_start": [c_void_p, c_uint8, c_uint8],
    "quadrature_see_a": [c_void_p, c_uint16, c_bool, c_uint8],
    "quadrature_see_b": [c_void_p, c_uint16, c_bool, c_uint8, c_uint8],
    "quadrature_at": [c_void_p, c_uint32],
    "device_next": [c_void_p],
    "device_is_behind": [c_void_p, c_uint32],
    "device_catch_up": [c_void_p, c_uint32],
    "device_sample": [c_void_p, c_void_p],
    "device_act": [c_void_p, c_void_p, c_uint32],
    "device_take": [c_void_p, c_void_p, c_bool, c_uint32, c_uint16],
}


@cache
def load() -> Any:
    """The library; skips the test where there is no compiler."""
    try:
        library = ctypes.CDLL(str(core_library()))
    except BoardError as error:
        if "refuses" in str(error):
            raise
        pytest.skip(str(error))
    for name, arguments in ARGUMENTS.items():
        function = getattr(library, name)
        function.argtypes, function.restype = arguments, RESULTS.get(name)
    return library
