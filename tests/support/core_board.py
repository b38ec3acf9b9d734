"""The firmware without its registers, compiled for this computer: the test is its timer and its line."""

from ctypes import byref, create_string_buffer

import firmware_core as core

from motor_driver.frames.table import Frame
from motor_driver.protocol import Arrival, Decoder, pack, unstuff

WRAP = 1 << 32
LEAD = 30  # [tick] that a sample is after its interrupt


class CoreBoard:
    """The firmware without its registers: the test is its timer."""

    CONFIG = core.DeviceConfig(1, 0, 96, 1, 500, 256, 2_000, 2_000, 10_000, LEAD, 100, 0)

    def __init__(self, config: core.DeviceConfig = CONFIG) -> None:
        self.lib, self.device, self.config = core.load(), core.Device(), config
        self.lib.device_start(byref(self.device), byref(config), 5, 1)
        self.now, self.overflows, self.seq = 0, 0, 0
        self.decoder = Decoder()
        self.compare = self.device.compare % 65536

    def step(self, late: int = 0) -> None:
        """The next compare interrupt, which is held up for so long [tick]."""
        self.now += ((self.compare - self.now) % 65536 or 65536) + late
        while self.overflows < self.now // 65536:
            self.overflows += 1
            self.lib.device_overflow(byref(self.device))
        ticks = self.lib.device_latch(byref(self.device))
        self.compare = self.lib.device_next(byref(self.device))
        if self.lib.device_is_behind(byref(self.device), self.now % WRAP):
            self.compare = self.lib.device_catch_up(byref(self.device), self.now % WRAP)
        if ticks:
            self.lib.device_sample(byref(self.device), byref(self.device.edges))

    def send(self, frame: Frame, version: int = 1) -> bool:
        """A frame comes in; whether it was one for a board."""
        plain = unstuff(pack(frame, self.seq)[:-1])
        assert plain is not None
        body = create_string_buffer(plain[4:-4])
        raw = core.Frame(version, frame.TYPE, len(plain) - 8, self.seq, core.POINTER(core.c_uint8)())
        raw.body = core.ctypes.cast(body, core.POINTER(core.c_uint8))
        self.seq += 1
        return bool(self.lib.device_act(byref(self.device), byref(raw), self.now % WRAP))

    def hear(self, quiet: bool = True) -> list[Frame]:
        """All that it has to say."""
        frames: list[Frame] = []
        out, wire = core.DeviceFrame(), create_string_buffer(48)
        while self.lib.device_take(byref(self.device), byref(out), quiet, self.now % WRAP, 0):
            length = self.lib.frame_seal(out.data, out.type, out.seq, out.size, wire)
            frames += [event.frame for event in self.decoder.receive(wire.raw[:length]) if isinstance(event, Arrival)]
        return frames
