"""Which of several ports to open: all of them are asked for their board's number, then the one that has it runs."""

from dataclasses import dataclass, field

from motor_driver.ports.port_error import NODE, PortError, Wording

BUSY_ROUNDS = 20  # times that ports in use are tried again (4 s): another driver that is asking has done so by then

MISSING = "None of {} has the board with that board_id: plug it in, or see which number it was flashed with{}."
DOUBLED = (
    "Several boards have that board_id ({}): nobody knows which one is meant. Flash one of them with another number "
    "(ros2 run motor_board flash --board-id){}."
)


def the_only(matches: list[str], found: list[str], wording: Wording = NODE) -> str:
    """Return the port of the board that has the number, of those that were found.

    Raises:
        PortError: none has it, or several have.
    """
    if not matches:
        raise PortError(MISSING.format(", ".join(found), wording.end))
    if len(matches) > 1:
        raise PortError(DOUBLED.format(", ".join(matches), wording.end))
    return matches[0]


@dataclass
class Search:
    """A round through all ports, and its result."""

    passed: set[str] = field(default_factory=set)  # asked in this round
    matches: list[str] = field(default_factory=list)
    busy: set[str] = field(default_factory=set)  # of those that were passed: in use by somebody
    rounds: int = 0  # that were begun again for those
    last: str = ""  # the port whose board ran before; it is tried first

    def next(self, found: list[str]) -> tuple[str, bool]:
        """The port to open, and whether its board is only to say its number; no port: look again soon.

        Raises:
            PortError: the round is over, and none or several have the number.
        """
        if self.last in found:
            port, self.last = self.last, ""
            return port, False
        left = [port for port in found if port not in self.passed]
        if left:
            self.passed.add(left[0])
            return left[0], len(found) > 1
        if self.busy and self.rounds < BUSY_ROUNDS:
            self.passed -= self.busy
            self.busy.clear()
            self.rounds += 1
            return "", False
        matches = [port for port in self.matches if port in found]
        self.begin_again()
        return the_only(matches, found), False

    def hear(self, port: str, match: bool) -> None:
        """The board on a port has said its number, or there is none."""
        if match:
            self.matches.append(port)

    def is_busy(self, port: str) -> None:
        """A port is in use."""
        self.busy.add(port)

    def is_lost(self, port: str) -> None:
        """The port of the board that ran is gone."""
        self.last = port

    def begin_again(self) -> None:
        """Forget the round."""
        self.passed.clear()
        self.matches.clear()
        self.busy.clear()
        self.rounds = 0
