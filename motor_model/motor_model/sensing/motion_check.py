"""Check that the motor moves as its voltage wants: no edges, edges that stop, a direction that is the wrong one.

One channel cannot tell a motor that stands from an encoder that is not connected, but for two signs: a supply that is
measured and missing, and edges that end without having come later and later, as those of a shaft that is braked do. Nor
does it show direction.

A finding is a sentence for people. A stop is one that lasts for `stall_time` at a voltage from STRONG on, or LASTING
times as long from DRIVEN on (half of the voltage for ever is a quarter of a stall's heat): then the plant switches the
motor off by itself, whoever sends the voltage. Simulated and real motor share this. So does any voltage where the
supply is measured and off, and no edge comes: whoever switches it on again, on most benches by the switch that stops
the motor, does not expect it to go on by itself.

What a voltage that is never strong for long does to a motor that does not turn is in `heating.py`, how long it has been
driven is in `lasting.py`; what two channels
show of one that turns the wrong way without becoming slower, in `against_voltage.py`; and of one whose other channel
is lost, in `to_and_fro.py`.
"""

from dataclasses import dataclass

from motor_model.frozen_record import replace
from motor_model.sample import Sample
from motor_model.sensing.against_voltage import AgainstVoltage
from motor_model.sensing.heating import Heating
from motor_model.sensing.lasting import Lasting
from motor_model.sensing.supply import find_least_supply
from motor_model.sensing.to_and_fro import ToAndFro

DRIVEN = 0.25  # of the motor's voltage: turns any motor that is meant for it
STRONG = 0.5  # of the motor's voltage: twice what any motor needs to break away, so that no slow ramp comes that far
STILL_STRONG = 0.8  # of that it may fall to and count on: a loop's voltage trembles with the disc's slots
LASTING = 16.0  # stall times of driving without an edge: a slow ramp is strong before that
LONG = 500_000_000  # [ns] of driving one way without what should follow
ALL = 0.93  # of a measured supply, which a driver smooths by as much as 5 %: more there is not, however little it is
# Of the period before: a motor that is braked to a standstill has a last one of at least 1.3 of it, however hard it is
# braked (slots at the end of a constant deceleration); a disc with slots irregular by 5 % seldom has 1.2.
SLOWED = 1.2

NO_SUPPLY = "the motor does not turn: its supply is at {supply:.1f} V; switch it on, and join its ground to the board's"
NEVER = (
    "no edge ever, though driven with {voltage:.1f} V: the encoder is not connected (signal, supply, ground), or the "
    "motor does not turn (bridge, its supply, a blocked shaft)"
)
CUT_OFF = (
    "edges ended within one slot, without slowing down before, and {voltage:.1f} V brings none back: the encoder's "
    "cable is off, or the shaft has jammed"
)
STALLED = "no edges at {voltage:.1f} V: the motor is stalled, or the encoder's cable is off"
HEATED = (
    "no edges, and {voltage:.1f} V in the mean square for {time:.2g} s: the motor is stalled, or the encoder's cable "
    "is off"
)
AGAINST = "the motor turns against its voltage: swap the motor's two wires, or the encoder's two channels"

NOWHERE = (
    "edges are counted to and fro at {voltage:.1f} V, and lead nowhere: one of the encoder's two channels is off, or "
    "something holds the shaft"
)


@dataclass(frozen=True)
class MotionCheck:
    """What was seen so far; every method returns the next state or reads it."""

    max_voltage: float  # [V] of the motor
    single_channel: bool
    stall_time: float = 0.4  # [s] 0: never stop the motor
    latest: Sample | None = None
    direction: int = 0  # of the voltage, 0 if it is small
    strong: int = 0  # likewise, 0 if it is not strong
    still: int = 0  # [ns] driven in this direction without an edge since
    along: int = 0  # [ns] driven in this direction while turning against it since
    strong_since: int = 0  # [ns] driven strongly in this direction since
    lasting: Lasting = Lasting()
    heating: Heating = Heating()
    against: AgainstVoltage = AgainstVoltage()
    to_and_fro: ToAndFro = ToAndFro()  # while it is driven strongly one way
    unsupplied: int = 0  # [ns] a voltage is wanted, without a supply and without an edge, since
    even: bool = False  # the latest edge came hardly later than the one before had

    def see(self, sample: Sample) -> "MotionCheck":
        """The next sample of the same board since its start."""
        share, now = sample.voltage / self.max_voltage, sample.sample_time
        direction, strong = _sign(share, DRIVEN), _sign(share, STRONG) or self._sign_of_all(sample)
        if strong == 0 and share * self.strong >= STILL_STRONG * STRONG:
            strong = self.strong
        fresh, anew = direction != self.direction, strong != self.strong
        before = self.latest
        edge = before is not None and sample.edge_count != before.edge_count
        moved = edge or before is None
        waits = self._is_off(sample) and share != 0.0 and not moved
        took = max(now - before.sample_time, 0) if before is not None else 0
        dt = took * 1e-9  # [s]
        return replace(
            self,
            latest=sample,
            direction=direction,
            strong=strong,
            still=now if fresh or moved else self.still,
            along=now if fresh or sample.speed * direction >= 0.0 else self.along,
            strong_since=now if anew else self.strong_since,
            lasting=self.lasting.see(direction, took, edge, self.stall_time),
            heating=self.heating.see(share, dt, edge, self.stall_time),
            against=self.against.see(sample, before, share, STRONG if strong else 0.0, 0 if anew else strong),
            to_and_fro=self.to_and_fro.see(sample, anew or strong == 0),
            unsupplied=self.unsupplied if waits else now,
            even=self._is_even(sample) if moved else self.even,
        )

    @property
    def finding(self) -> str:
        """What is wrong, as a sentence; empty if nothing is seen to be."""
        sample = self.latest
        if sample is None or self.direction == 0:
            return ""
        if not self.single_channel and sample.sample_time - self.along > LONG:
            return AGAINST
        return self._no_edges(sample) if sample.sample_time - self.still > LONG else ""

    @property
    def stop(self) -> str:
        """Why the motor has to be switched off, as a sentence; empty if it may go on."""
        sample, most = self.latest, self.stall_time * 1e9
        if sample is None or most == 0.0:
            return ""
        strong_since = self.strong_since if self.strong else None
        if not self.single_channel and self.against.lasts(sample, strong_since, self.stall_time):
            return AGAINST
        if sample.sample_time - self.unsupplied >= most:
            return NO_SUPPLY.format(supply=sample.supply_voltage)
        if excess := self.heating.excess(STRONG, self.stall_time):
            return HEATED.format(voltage=excess[0] * self.max_voltage, time=excess[1])
        if self.direction != 0 and self.lasting.time >= LASTING * most:
            return self._no_edges(sample)
        if strong_since is None:
            return ""
        if not self.single_channel and self.to_and_fro.lasts(sample.sample_time, self.stall_time):
            return NOWHERE.format(voltage=sample.voltage)
        stalled = sample.sample_time - max(self.still, strong_since) >= most
        return self._no_edges(sample) if stalled else ""

    def _sign_of_all(self, sample: Sample) -> int:
        """The direction of all the voltage that a measured supply gives; 0: it is less, off, or not measured."""
        supply = sample.supply_voltage
        return _sign(sample.voltage / supply, ALL) if supply >= find_least_supply(self.max_voltage) else 0

    def _is_off(self, sample: Sample) -> bool:
        """Whether the supply is measured and off."""
        return sample.supply_voltage < find_least_supply(self.max_voltage)  # False of nan

    def _is_even(self, sample: Sample) -> bool:
        """Whether the period of this edge is hardly longer than that of the one before."""
        return self.latest is not None and 0.0 < sample.edge_period <= SLOWED * self.latest.edge_period

    def _no_edges(self, sample: Sample) -> str:
        text = NEVER if sample.edge_count == 0 else CUT_OFF if self.even else STALLED
        believed = abs(sample.voltage) * ALL  # more than is measured, where a driver takes the supply for off
        if sample.supply_voltage < max(find_least_supply(self.max_voltage), believed):  # false if not measured
            text = NO_SUPPLY
        return text.format(voltage=sample.voltage, supply=sample.supply_voltage)


def _sign(share: float, least: float) -> int:
    return 0 if abs(share) < least else 1 if share > 0.0 else -1
