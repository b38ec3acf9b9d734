"""A source of recordings: which bags, which motor in them, and which part of each."""

from collections.abc import Callable
from dataclasses import dataclass

from motor_identification.bag.motor.recording import read_recording
from motor_identification.recording import Recording, check


@dataclass(frozen=True)
class Window:
    """Part of a recording, in seconds after its first sample; 0, 0 is all of it."""

    start: float = 0.0  # [s]
    stop: float = 0.0  # [s] 0 is the end


@dataclass(frozen=True)
class Source:
    """Bags of one motor, the namespace that its plant ran in, and the part of each that is used."""

    uris: tuple[str, ...]
    namespace: str = ""
    window: Window = Window()
    reader: Callable[[str], Recording] | None = None  # of bags of other robots; None: `motor/speed`

    def __post_init__(self) -> None:
        """Take the slash off that a shell puts behind a directory's name: sentences name a bag by its last part."""
        object.__setattr__(self, "uris", tuple(uri.rstrip("/") or uri for uri in self.uris))

    def read(self, uri: str) -> Recording:
        """Read and check one of the bags.

        Raises:
            RecordingError: the bag cannot be read, has no such motor, or the window is empty.
        """
        if self.reader is not None:
            return check(self.reader(uri).between(self.window.start, self.window.stop))
        return read_recording(uri, self.namespace, self.window.start, self.window.stop)
