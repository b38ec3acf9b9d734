"""What the samples say about motor, encoder and wiring: no edges, edges that stop, a direction that is the wrong one.

One channel cannot tell a motor that stands from an encoder that is not connected, but for two signs: a supply that is
measured and missing, and edges that end at a speed from which no shaft stops within a slot. Nor does it show direction.
"""

from dataclasses import dataclass, replace

from motor_model.sample import Sample

DRIVEN = 0.25  # of the full voltage: turns any motor that is meant for it
LONG = 500_000_000  # [ns] of driving one way without what should follow
LITTLE = 3.0  # [V] of supply: no bridge works with less
QUICK = 1.0 / 300.0  # [s] between edges; to stop within the next slot takes 3000 rad/s² with 96 of them

NO_SUPPLY = "the motor does not turn: the supply is at {supply:.1f} V; switch it on, and join its ground to the board's"
NEVER = (
    "no edge ever, though driven with {voltage:.1f} V: the encoder is not connected (signal, supply, ground), or the "
    "motor does not turn (bridge, its supply, a blocked shaft)"
)
CUT_OFF = (
    "edges ended within one slot at full motion, and {voltage:.1f} V brings none back: the encoder's cable is off, or "
    "the shaft has jammed"
)
STALLED = "no edges at {voltage:.1f} V: the motor is stalled, or the encoder's cable is off"
AGAINST = "the motor turns against its voltage: swap the motor's two wires, or the encoder's two channels"


@dataclass(frozen=True, slots=True)
class Wiring:
    """What was seen so far; every method returns the next state or reads it."""

    max_voltage: float
    single_channel: bool
    latest: Sample | None = None
    direction: int = 0  # of the voltage, 0 if it is small
    still: int = 0  # [ns] driven in this direction without an edge since
    along: int = 0  # [ns] driven in this direction while turning against it since
    quick: bool = False  # the latest edges came in quick succession

    def see(self, sample: Sample) -> "Wiring":
        """The next sample of the same board since its start."""
        strength = sample.voltage / self.max_voltage
        direction = 0 if abs(strength) < DRIVEN else 1 if strength > 0.0 else -1
        now, fresh = sample.sample_time, direction != self.direction
        moved = self.latest is None or sample.edge_count != self.latest.edge_count
        return replace(
            self,
            latest=sample,
            direction=direction,
            still=now if fresh or moved else self.still,
            along=now if fresh or sample.speed * direction >= 0.0 else self.along,
            quick=0.0 < sample.edge_period < QUICK if moved else self.quick,
        )

    @property
    def finding(self) -> str:
        """What is wrong, as a sentence; empty if nothing is seen to be."""
        sample = self.latest
        if sample is None or self.direction == 0:
            return ""
        if not self.single_channel and sample.sample_time - self.along > LONG:
            return AGAINST
        if sample.sample_time - self.still <= LONG:
            return ""
        text = NEVER if sample.edge_count == 0 else CUT_OFF if self.quick else STALLED
        if sample.supply_voltage < LITTLE:  # false if it is not measured
            text = NO_SUPPLY
        return text.format(voltage=sample.voltage, supply=sample.supply_voltage)
