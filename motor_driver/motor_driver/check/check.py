"""The first run as a state machine: a sample in, a voltage and a prompt out, and in the end what was found."""

from motor_driver.check.drive import OutputStaysOff
from motor_driver.check.guard import Guard
from motor_driver.check.look import OFF, Act, Look
from motor_driver.check.record import Record
from motor_driver.check.script import run_script
from motor_driver.check.settings import Settings
from motor_driver.frames.from_board import Hello

STAYS_OFF = "the board does not switch its output on"


class Check:
    """Passes samples to the script and what it wants through the guard; after the end, and after a stop, 0 V."""

    def __init__(self, settings: Settings, board: Hello) -> None:
        self.settings, self.board, self.record = settings, board, Record(board.board)
        self._steps = run_script(settings, board, self.record)
        self._guard = Guard(settings)
        self._started = self.done = False
        self.act = OFF

    def see(self, look: Look) -> Act:
        """Take a sample; what is to be done until the next."""
        if self.done:
            return OFF
        try:
            wanted = self._steps.send(look) if self._started else next(self._steps)
            self._started = True
        except StopIteration:
            self.done, self.act = True, OFF
            return OFF
        except OutputStaysOff:
            self.abort(STAYS_OFF)
            return OFF
        self.act, self._guard = self._guard.judge(wanted, look)
        if self._guard.stop:
            self.abort(self._guard.stop)
        return self.act

    def abort(self, why: str) -> None:
        """Stop for good; `why` is a clause."""
        if not self.done:
            self.done, self.act = True, OFF
            self._steps.close()
            self.record.find("stop", "stopped", why=why)

    @property
    def right(self) -> bool:
        """Whether it has come to its end, and all is right, or made up for by parameters."""
        return self.done and not self.record.wrong
