"""Check that the motor moves as its voltage wants: no edges, edges that stop, a direction that is the wrong one.

One channel cannot tell a motor that stands from an encoder that is not connected, but for two signs: a supply that is
measured and missing, and edges that end without having come later and later, as those of a shaft that is braked do. Nor
does it show direction.

A finding is a sentence for people. A stop is one that lasts for `stall_time` at a voltage from STRONG on: then the
plant switches the motor off by itself, whoever sends the voltage. Simulated and real motor share this.

A motor that has been heated without an edge is still warm after a stop: where this state lives on (the simulator's
does), a motor that is enabled again within a few stall times, and shows no edge, is stopped sooner than after
`stall_time`; an edge ends that.
"""

from dataclasses import dataclass
from math import exp, sqrt

from motor_model.frozen_record import replace
from motor_model.sample import Sample
from motor_model.sensing.supply import find_least_supply

DRIVEN = 0.25  # of the motor's voltage: turns any motor that is meant for it
STRONG = 0.5  # of the motor's voltage: twice what any motor needs to break away, so that no slow ramp comes that far
STILL_STRONG = 0.8  # of that it may fall to and count on: a loop's voltage trembles with the disc's slots
LONG = 500_000_000  # [ns] of driving one way without what should follow
ALL = 0.93  # of a measured supply, which a driver smooths by as much as 5 %: more there is not, however little it is
# Of the period before: a motor that is braked to a standstill has a last one of at least 1.3 of it, however hard it is
# braked (slots at the end of a constant deceleration); a disc with slots irregular by 5 % seldom has 1.2.
SLOWED = 1.2
SLOWER = 0.98  # of the speed at the beginning; a motor that is braked by STRONG keeps more only if its time constant
# is over 50 times the stall time: du/dt = -(0.5 + 1)·speed/time constant at least, from top speed down
# A loop that pushes the wrong way may do so in pulses, because it lets a fast motor coast, and may be held below STRONG
# by a limit on plugging. More than PRESSING in the mean is more than a load of a quarter of the motor's voltage asks a
# brake for, and slows that load down: of 73 random motors with such loads none was pressed so for the stall time.
PRESSING = 0.27
# A voltage that comes and goes, or turns to and fro, is never strong for long. In the mean square over so many stall
# times, without an edge, it is no more than STRONG: that is what heats a motor that does not turn.
HEATING = 4.0
# But a motor that turns to and fro within a slot shows no edge: a chirp on a coarse disc. Where a push one way is
# less than TURNED of what has brought an edge before (it may have to end a motion first), the mean is taken over a time
# so many times as long: a chirp over all the voltage, half of it in the mean square, has 11 stall times.
TURNED, PATIENT = 2.0, 4.0
PRESSED = 0.01  # [s] of the motor's voltage beyond that
# A plant reports 0 rad/s where edges are further apart than SLOW; the count of two channels still says which way they
# went. BACK of them against a strong voltage, none of them much later than the one before, are no motor that is being
# braked: under STRONG the periods of one whose time constant is 1 s and that comes to rest grow by GROWTH and more.
SLOW, GROWTH, BACK = 0.1, 1.25, 3

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
    pushing: int = 0  # direction of the latest voltage beyond PRESSING, until one has the other direction
    begun: float = 0.0  # [rad/s] speed against that voltage when it began to press
    begun_at: int = 0  # [ns]
    pressed: float = 0.0  # [s] of the motor's voltage against that speed, beyond PRESSING
    back: int = 0  # slow edges against the strong voltage since then
    heat: float = 0.0  # [s] mean square of the voltage's share, times the time that it is taken over
    warmth: float = 0.0  # [s] likewise, over PATIENT times that, whatever was pushed
    way: int = 0  # direction of the latest voltage that was not 0
    push: float = 0.0  # [s] of the motor's voltage that way, since it turned
    needed: float = 0.0  # [s] the same until an edge came, the first one after it had turned; 0: not known
    brought: bool = False  # an edge has come since it turned
    even: bool = False  # the latest edge came hardly later than the one before had

    def see(self, sample: Sample) -> "MotionCheck":
        """The next sample of the same board since its start."""
        share, now = sample.voltage / self.max_voltage, sample.sample_time
        direction, strong = _sign(share, DRIVEN), _sign(share, STRONG) or self._sign_of_all(sample)
        if strong == 0 and share * self.strong >= STILL_STRONG * STRONG:
            strong = self.strong
        fresh, anew = direction != self.direction, strong != self.strong
        pushing = _sign(share, PRESSING) or (self.pushing if share * self.pushing >= 0.0 else 0)
        moved = self.latest is None or sample.edge_count != self.latest.edge_count
        against = max(-sample.speed * pushing, 0.0)
        fell = pushing != self.pushing or against == 0.0 or against < SLOWER * self.begun
        pressed = 0.0 if fell else self._press(share * pushing, strong, now)
        way = _sign(share, 1e-9) or self.way
        push = (self.push if way == self.way else 0.0) + abs(share) * self._since(now)
        brought = self.brought and way == self.way
        needed = push if moved and self.latest is not None and not brought else self.needed
        small = push < TURNED * needed  # 0 where nothing is known: every push counts
        return replace(
            self,
            latest=sample,
            way=way,
            push=push,
            needed=needed,
            brought=brought or (moved and self.latest is not None),
            warmth=0.0 if moved else self._heat(self.warmth, share, PATIENT * self._heating, now),
            direction=direction,
            strong=strong,
            still=now if fresh or moved else self.still,
            along=now if fresh or sample.speed * direction >= 0.0 else self.along,
            strong_since=now if anew else self.strong_since,
            pushing=pushing,
            begun=self.begun if pressed else against,
            begun_at=self.begun_at if pressed else now,
            pressed=pressed,
            back=0 if anew else self._count_back(sample, strong),
            even=self._is_even(sample) if moved else self.even,
            heat=0.0 if moved else self._heat(self.heat, 0.0 if small else share, self._heating, now),
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
        lasts = not self.single_channel and sample.speed * self.pushing < 0.0
        lasts &= sample.sample_time - self.begun_at >= most
        if lasts and self.pressed >= PRESSED:
            return AGAINST
        for heat, time in ((self.heat, self._heating), (self.warmth, PATIENT * self._heating)):
            if heat >= STRONG**2 * time > 0.0:
                return HEATED.format(voltage=sqrt(heat / time) * self.max_voltage, time=time)
        if self.strong == 0:
            return ""
        if not self.single_channel and self.back >= BACK and sample.sample_time - self.strong_since >= most:
            return AGAINST
        stalled = sample.sample_time - max(self.still, self.strong_since) >= most
        return self._no_edges(sample) if stalled else ""

    def _sign_of_all(self, sample: Sample) -> int:
        """The direction of all the voltage that a measured supply gives; 0: it is less, off, or not measured."""
        supply = sample.supply_voltage
        return _sign(sample.voltage / supply, ALL) if supply >= find_least_supply(self.max_voltage) else 0

    def _is_even(self, sample: Sample) -> bool:
        """Whether the period of this edge is hardly longer than that of the one before."""
        return self.latest is not None and 0.0 < sample.edge_period <= SLOWED * self.latest.edge_period

    @property
    def _heating(self) -> float:
        """[s] over which the mean square is taken."""
        return HEATING * self.stall_time

    def _since(self, now: int) -> float:
        """Count the time [s] since the latest sample."""
        return max(now - self.latest.sample_time, 0) * 1e-9 if self.latest is not None else 0.0

    def _heat(self, heat: float, share: float, time: float, now: int) -> float:
        """Follow the mean square of a voltage, as a share of the motor's, over a time [s]."""
        if self.latest is None or self.stall_time == 0.0:
            return 0.0
        kept = exp(-self._since(now) / time)
        return heat * kept + share**2 * time * (1.0 - kept)

    def _press(self, share: float, strong: int, now: int) -> float:
        """Sum up a voltage, as a share of the motor's, that pushes against the motion."""
        dt = (now - self.latest.sample_time) * 1e-9 if self.latest is not None else 0.0
        return max(self.pressed + (max(share, STRONG if strong else 0.0) - PRESSING) * dt, 0.0)

    def _count_back(self, sample: Sample, strong: int) -> int:
        """Count slow edges against a strong voltage, none of them much later than the one before."""
        before = self.latest
        if before is None or sample.edge_count == before.edge_count:
            return self.back
        if (sample.edge_count - before.edge_count) * strong >= 0:
            return 0
        known = before.edge_period if before.edge_period > 0.0 else sample.edge_period
        return self.back + (SLOW <= sample.edge_period <= GROWTH * known)

    def _no_edges(self, sample: Sample) -> str:
        text = NEVER if sample.edge_count == 0 else CUT_OFF if self.even else STALLED
        believed = abs(sample.voltage) * ALL  # more than is measured, where a driver takes the supply for off
        if sample.supply_voltage < max(find_least_supply(self.max_voltage), believed):  # false if not measured
            text = NO_SUPPLY
        return text.format(voltage=sample.voltage, supply=sample.supply_voltage)


def _sign(share: float, least: float) -> int:
    return 0 if abs(share) < least else 1 if share > 0.0 else -1
