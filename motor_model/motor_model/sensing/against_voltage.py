"""Tell a motor that turns against its voltage, and does not become slower, from one that is braked.

A loop that pushes the wrong way may do so in pulses, because it lets a fast motor coast, and may be held below a strong
voltage by a limit on plugging. More than PRESSING in the mean is more than a load of a quarter of the motor's voltage
asks a brake for, and slows that load down: of 73 random motors with such loads none was pressed so for the stall time.

A plant reports 0 rad/s where edges are further apart than SLOW; the count of two channels still says which way they
went. BACK of them against a strong voltage, none of them much later than the one before, are no motor that is being
braked: under half of the motor's voltage the periods of one whose time constant is 1 s and that comes to rest grow by
GROWTH and more.
"""

from dataclasses import dataclass

from motor_model.frozen_record import replace
from motor_model.sample import Sample

PRESSING = 0.27  # of the motor's voltage
PRESSED = 0.01  # [s] of the motor's voltage beyond that
# Of the speed at the beginning: a motor that is braked by half of its voltage keeps more only if its time constant is
# over 50 times the stall time: du/dt = -(0.5 + 1)·speed/time constant at least, from top speed down.
SLOWER = 0.98
SLOW, GROWTH, BACK = 0.1, 1.25, 3  # [s], of the period before, edges


@dataclass(frozen=True)
class AgainstVoltage:
    """How the motor has turned against its voltage, as two channels see it."""

    pushing: int = 0  # direction of the latest voltage beyond PRESSING, until one has the other direction
    begun: float = 0.0  # [rad/s] speed against that voltage when it began to press
    begun_at: int = 0  # [ns]
    pressed: float = 0.0  # [s] of the motor's voltage against that speed, beyond PRESSING
    back: int = 0  # slow edges against the strong voltage, since it began

    def see(self, sample: Sample, before: Sample | None, share: float, least: float, strong: int) -> "AgainstVoltage":
        """What it is after a voltage, as a share of the motor's; least: it presses by that at least.

        `strong` is the direction of a strong voltage that goes on, 0 if there is none or it has just begun.
        """
        pushing = (share >= PRESSING) - (share <= -PRESSING)
        pushing = pushing or (self.pushing if share * self.pushing >= 0.0 else 0)
        against = max(-sample.speed * pushing, 0.0)
        pressed = 0.0
        if pushing == self.pushing and before is not None and against > 0.0 and against >= SLOWER * self.begun:
            dt = max(sample.sample_time - before.sample_time, 0) * 1e-9
            pressed = max(self.pressed + (max(share * pushing, least) - PRESSING) * dt, 0.0)
        return replace(
            self,
            pushing=pushing,
            begun=self.begun if pressed else against,
            begun_at=self.begun_at if pressed else sample.sample_time,
            pressed=pressed,
            back=self._count_back(sample, before, strong) if strong else 0,
        )

    def lasts(self, sample: Sample, strong_since: int | None, stall_time: float) -> bool:
        """Whether it has gone on for the stall time [s]; strong_since [ns]: None where the voltage is not strong."""
        most = stall_time * 1e9
        pressed = self.pressed >= PRESSED and sample.sample_time - self.begun_at >= most
        if pressed and sample.speed * self.pushing < 0.0:
            return True
        return strong_since is not None and self.back >= BACK and sample.sample_time - strong_since >= most

    def _count_back(self, sample: Sample, before: Sample | None, strong: int) -> int:
        """Count slow edges against a strong voltage, none of them much later than the one before."""
        if before is None or sample.edge_count == before.edge_count:
            return self.back
        if (sample.edge_count - before.edge_count) * strong >= 0:
            return 0
        known = before.edge_period if before.edge_period > 0.0 else sample.edge_period
        return self.back + (SLOW <= sample.edge_period <= GROWTH * known)
