"""A serial line that flips, loses and delays bytes as its faults say."""

from collections import deque

import numpy as np

from motor_board.emulation.faults import Faults


class SerialLine:
    """One direction of it; time in ns, from the caller."""

    def __init__(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)
        self._late: deque[tuple[int, bytes]] = deque()  # [ns] when due; nothing overtakes what is before it

    def send(self, data: bytes, faults: Faults, now: int) -> None:
        """Bytes go in at `now`."""
        if faults.bit_error_rate > 0.0 or faults.drop_rate > 0.0:
            data = self._damaged(data, faults)
        due = now
        if faults.delay > 0.0:
            due += int(self._random.uniform(0.0, faults.delay) * 1e9)
        if data:
            self._late.append((due, data))

    def receive(self, now: int) -> bytes:
        """What has come out by `now`."""
        out = b""
        while self._late and self._late[0][0] <= now:
            out += self._late.popleft()[1]
        return out

    def cut(self) -> None:
        """What is on its way is lost."""
        self._late.clear()

    def _damaged(self, data: bytes, faults: Faults) -> bytes:
        array = np.frombuffer(data, dtype=np.uint8)
        flips = self._random.random((len(array), 8)) < faults.bit_error_rate
        kept = self._random.random(len(array)) >= faults.drop_rate
        return bytes((array ^ np.packbits(flips, axis=1)[:, 0])[kept])
