"""The first run on a board: bytes and time in, bytes, prompts and findings out; driver and check joined."""

from motor_driver.check.check import Check
from motor_driver.check.look import OFF, Answer, Look, Prompt
from motor_driver.check.settings import AnyBoard, Settings
from motor_driver.driver import Driver, Reading
from motor_driver.frames.from_board import Hello
from motor_driver.handshake import PATIENCE

ANSWERS = {"": Answer.DONE, "y": Answer.YES, "n": Answer.NO}
HUNG_UP = "the terminal was closed"
SILENT = "no telemetry comes from {port} any more"


def code_of_refusal(config: AnyBoard, board: Hello | None) -> str:
    """Return the finding's code where a board was not accepted."""
    if board is None:
        return "no_board"
    if config.board_id not in (None, board.board_id):
        return "wrong_board"
    if config.known_edges and board.edges_per_revolution not in (0, config.edges_per_revolution):
        return "wrong_counts"
    return "wrong_firmware"


class FirstRun:
    """Lives as long as one port is open; times are the host's monotonic clock in ns."""

    def __init__(self, settings: Settings, config: AnyBoard, port: str, now: int, roll_call: bool = False) -> None:
        """`roll_call`: the board is only to say who it is."""
        self.settings, self._config, self.driver = settings, config, Driver(config)
        self.driver.opened(port, now, roll_call)
        self.check: Check | None = None  # once the board runs
        self._answer: Answer | None = None
        self._hung_up = False

    @property
    def board(self) -> Hello | None:
        """What the board has said of itself."""
        return self.driver.session.handshake.hello if self.driver.session else None

    @property
    def prompt(self) -> Prompt | None:
        """What a person is asked now."""
        return self.check.act.prompt if self.check else None

    @property
    def done(self) -> bool:
        """Whether the script has ended."""
        return self.check is not None and self.check.done

    @property
    def off(self) -> bool:
        """Whether the board has said that its output is off."""
        session = self.driver.session
        return session is None or session.latest is None or not session.latest.enabled

    def problem(self, now: int) -> str:
        """Why this board cannot be checked, as a sentence; empty if it can, or it is too early to say."""
        return self.driver.session.handshake.problem(now) if self.driver.session else self.driver.trouble

    @property
    def code(self) -> str:
        """The finding's code where the board cannot be checked."""
        return code_of_refusal(self._config, self.board)

    def answer(self, answer: Answer) -> None:
        """A person has said something."""
        self._answer = answer

    def hear(self, line: str) -> None:
        """A person has typed a line; one without even a newline is the terminal's end, and nobody answers any more."""
        answer = ANSWERS.get(line.strip().lower()[:1])
        if not line:
            self._hung_up = True
            self.abort(HUNG_UP)
        elif answer is not None:
            self.answer(answer)

    def abort(self, why: str) -> None:
        """Stop for good; `why` is a clause."""
        if self.check:
            self.check.abort(why)

    def received(self, data: bytes, now: int) -> None:
        """Bytes were read at `now`."""
        for reading in self.driver.received(data, now):
            if self.check is None and self.driver.board is not None:
                self.check = Check(self.settings, self.driver.board)
                if self._hung_up:  # before the board had answered
                    self.abort(HUNG_UP)
            if self.check is not None:
                self.check.see(self._look(reading))

    def _look(self, reading: Reading) -> Look:
        sample, session = reading.sample, self.driver.session
        answer, self._answer = self._answer, None
        return Look(
            time=sample.sample_time * 1e-9,
            count=sample.edge_count,
            edge_time=sample.edge_time * 1e-9,
            voltage=sample.voltage,
            on=session is not None and session.latest is not None and session.latest.enabled,
            supply=sample.supply_voltage,
            current=sample.current,
            answer=answer,
        )

    def step(self, now: int) -> bytes:
        """What to send at `now`."""
        act = self.check.act if self.check and not self.check.done else OFF
        order = self.driver.step(now, act.on, act.voltage)
        session = self.driver.session
        waits = session is not None and session.silent and not act.on  # nothing turns: samples may come again
        if order.stop and not waits:
            self.abort(order.stop)
        if waits and session is not None and now - session.heard > PATIENCE:
            self.abort(SILENT.format(port=session.port))
        return order.data
