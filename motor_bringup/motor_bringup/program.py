"""One program to start, as `ros2 run` would: package, executable and what it is told."""

from collections.abc import Mapping
from dataclasses import dataclass, field

Value = bool | int | float | str


@dataclass(frozen=True)
class Program:
    """A node (`node`: takes ROS arguments) or a command of the workbench."""

    package: str
    executable: str
    arguments: tuple[str, ...] = ()
    node: bool = True
    namespace: str = ""
    parameters: Mapping[str, Value] = field(default_factory=dict)
    remappings: tuple[tuple[str, str], ...] = ()
    needed: bool = True  # when it ends, all end

    @property
    def full_name(self) -> str:
        """Of the node, if it is one: nodes are called like their executables."""
        return "/".join(("", *filter(None, (self.namespace, self.executable))))

    @property
    def command(self) -> list[str]:
        """The same as words for a shell, for machines without the launch system."""
        words = ["ros2", "run", self.package, self.executable, *self.arguments]
        ros = [*self._names(), *self._values()] if self.node else []
        return [*words, *(["--ros-args", *ros] if ros else [])]

    def _names(self) -> list[str]:
        pairs = [("__ns", f"/{self.namespace}")] if self.namespace else []
        return [word for old, new in (*pairs, *self.remappings) for word in ("-r", f"{old}:={new}")]

    def _values(self) -> list[str]:
        return [word for name, value in self.parameters.items() for word in ("-p", f"{name}:={_text(value)}")]


@dataclass(frozen=True)
class Session:
    """Programs that run side by side, and steps, each of which waits until the one before it has ended well."""

    programs: tuple[Program, ...]
    steps: tuple[Program, ...] = ()
    ready: str = ""  # the first step waits until the first program has written this


def _text(value: Value) -> str:
    """As YAML reads it: true and false, numbers, and text in quotes where it might be taken for one of those."""
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else repr(value)
