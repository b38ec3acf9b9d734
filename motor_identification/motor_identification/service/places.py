"""Where requests may point: bags inside the node's directory, reports there or where the node was told to put them."""

from dataclasses import dataclass
from pathlib import Path

from motor_model.errors import MotorError


@dataclass(frozen=True)
class Places:
    """A directory for bags and one for reports, named by whoever starts the node; no request leads out of them."""

    bags: str = ""  # empty: the working directory
    reports: str = ""  # empty: beside the first bag
    absolute_uris: bool = False  # requests may name any bag that the node can read

    def bag(self, uri: str) -> str:
        """The path of a bag that a request names.

        Raises:
            MotorError: it lies outside, also where a link leads out.
        """
        path = Path(self.bags or ".") / uri
        if not self.absolute_uris and not self._is_inside(path):
            raise MotorError(
                f"{uri} is outside of bag_directory ({self.bags or 'the working directory'}): name a bag in it, "
                "or start the node with absolute_uris:=true."
            )
        return str(path)

    def report(self, first_bag: str) -> Path:
        """The file for the report of a diagnosis, by its first bag."""
        bag = Path(first_bag).absolute()
        directory = Path(self.reports) if self.reports else bag.parent
        if not self.reports and not self.absolute_uris and not self._is_inside(directory):
            directory = Path(self.bags or ".")  # the directory itself is the bag
        return directory.absolute() / f"{bag.resolve().name}_diagnosis.html"

    def _is_inside(self, path: Path) -> bool:
        try:
            return path.resolve().is_relative_to(Path(self.bags or ".").resolve())
        except (OSError, RuntimeError, ValueError):  # a name too long, links in a circle, a zero byte
            return False
