"""The limits that hold whatever a step asks for: voltage, time, supply, rate of edges, gaps in the samples."""

from dataclasses import dataclass, replace

from motor_driver.check.look import OFF, Act, Look
from motor_driver.check.settings import DRIVE_TIME, HOLD_TIME, Settings

SAME = 0.01  # of the motor's voltage: less is the same voltage
MARGIN = 0.2  # [s] over the time that a step takes by itself
GAP = 0.1  # [s] between two samples while voltage is on
SAGS = 0.6  # of the expected supply: it is overloaded
TOO_HIGH = 1.15  # of the expected supply: a motor that is braked feeds it
MOST_EDGES = 18_000.0  # [1/s] with one channel, of the 20,000 that the board counts for certain

LONG = "{time:.1f} s with voltage on are enough"
LONG_SAME = "{time:.1f} s on {voltage:.3g} V are enough"
HELD_UP = "no sample came for {gap:.0f} ms"
SUPPLY = "the supply went from {expected:.3g} V to {supply:.1f} V"
FAST = "{rate:.0f} edges a second are more than the board counts for certain"


@dataclass(frozen=True)
class Guard:
    """Passes on what a step asks for within the limits; every method returns the next guard."""

    settings: Settings
    latest: Look | None = None
    driven_since: float | None = None  # [s]
    same_since: float | None = None  # [s]
    voltage: float = 0.0  # [V] since `same_since`
    supply: float = 0.0  # [V] before the motor was driven
    stop: str = ""  # why nothing is passed on any more, a clause

    def judge(self, act: Act, look: Look) -> tuple[Act, "Guard"]:
        """What may be done, and the next guard; after a stop nothing but 0 V."""
        if self.stop:
            return OFF, self
        drives = act.on and act.voltage != 0.0
        if not drives:
            supply = look.supply if look.supply > 0.0 else self.supply
            return act, replace(self, latest=look, driven_since=None, same_since=None, supply=supply)
        limit = self.settings.highest
        voltage = min(max(act.voltage, -limit), limit)
        same = self.same_since is not None and abs(voltage - self.voltage) <= SAME * self.settings.max_voltage
        after = replace(
            self,
            latest=look,
            driven_since=look.time if self.driven_since is None else self.driven_since,
            same_since=self.same_since if same else look.time,
            voltage=self.voltage if same else voltage,
            stop=self._why(look),
        )
        return (OFF if after.stop else replace(act, voltage=voltage)), after

    def _why(self, look: Look) -> str:
        """Why the motor, which is driven, has to be stopped; empty if it may go on."""
        before = self.latest
        gap = look.time - before.time if before else 0.0
        if gap > GAP:
            return HELD_UP.format(gap=1e3 * gap)
        if self.driven_since is not None and look.time - self.driven_since > DRIVE_TIME + MARGIN:
            return LONG.format(time=look.time - self.driven_since)
        if self.same_since is not None and look.time - self.same_since > HOLD_TIME + MARGIN:
            return LONG_SAME.format(time=look.time - self.same_since, voltage=self.voltage)
        if self.supply > 0.0 and not SAGS * self.supply < look.supply < TOO_HIGH * self.supply:
            return SUPPLY.format(expected=self.supply, supply=look.supply)
        rate = abs(look.count - before.count) / gap if before and gap > 0.0 else 0.0
        return FAST.format(rate=rate) if rate > MOST_EDGES else ""
