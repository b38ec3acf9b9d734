"""The faults of `faults.py` on the simulated plant, as a table: what happens, how long it may last."""

from collections.abc import Callable
from dataclasses import dataclass
from math import tau

from faults_injected import (
    ask_in_turn,
    be_always_late,
    be_late,
    block,
    cable_off,
    die,
    end_first_sender,
    fall_silent,
    go_wrong,
    go_wrong_now_and_then,
    hum,
    loosen,
    lose_link,
    mains_rate,
    pick_up_mains,
    repeat,
    restart,
    second_plant,
    send_by_turns,
    send_nonsense,
    shake,
    stamp_by_another_clock,
    suspend,
    swap,
)
from faults_loop import Loop
from faults_motor import Motor

KNOWN, MOTION = 0.15, 0.5  # [s] from when it could be known, and where only motion can tell


@dataclass(frozen=True)
class Fault:
    """One fault; it comes after 1.5 s at a reference."""

    name: str
    most: float  # [s] that the motor may run on
    apply: Callable[[Loop], None]
    reference: float = 0.5  # of the top speed; 0: no controller, but plain motor/voltage
    two_channels: bool = False
    raw: float = 0.0  # of the motor's voltage
    supply: float = 0.0  # of the motor's voltage, measured; 0: not measured, and all of it
    at_start: bool = False  # it is there before the reference comes
    edges: int = 96  # a turn
    mains: float = 0.0  # of the edges that are wanted, that hum of the mains makes; the disc is one of which it does

    models: tuple[bool, ...] = (False, True)  # with which the controller runs

    @property
    def controlled(self) -> bool:
        """Whether the controller drives the motor."""
        return self.raw == 0.0

    def edges_for(self, motor: Motor) -> int:
        """Edges a turn, so that hum is that share of what is wanted at the reference."""
        if not self.mains:
            return self.edges
        return max(round(tau * mains_rate(motor) / (self.mains * self.reference * motor.top)), 2)

    def reference_for(self, motor: Motor) -> float:
        """[rad/s], by whole edges a turn."""
        if not self.mains:
            return self.reference * motor.top
        return mains_rate(motor) * tau / self.edges_for(motor) / self.mains


FAULTS = (
    Fault("encoder's cable off", MOTION, cable_off()),
    Fault("encoder's cable off at 3 % of the top speed", MOTION, cable_off(), reference=0.03),
    Fault("cable off, 2 stray edges a second", MOTION, cable_off(2.0)),
    Fault("cable off, 5 stray edges a second", MOTION, cable_off(5.0)),
    Fault("cable off, 50 stray edges a second", MOTION, cable_off(50.0)),
    Fault("cable off, 100 stray edges a second", MOTION, cable_off(100.0)),
    Fault("cable off at 3 % of the top speed, 5 stray edges a second", MOTION, cable_off(5.0), reference=0.03),
    Fault("cable off at 3 % of the top speed, 20 stray edges a second", MOTION, cable_off(20.0), reference=0.03),
    Fault("cable off at 3 % of the top speed, 50 stray edges a second", MOTION, cable_off(50.0), reference=0.03),
    Fault("no encoder from the start, supply measured as 0.4 of it", MOTION, cable_off(), supply=0.4, at_start=True),
    Fault("50 stray edges a second, speed and angle in turn", MOTION, ask_in_turn, two_channels=True),
    Fault("edges for 20 of every 100 ms: a loose contact", MOTION, loosen),
    Fault("hum at 5 % of the top speed, of 0.75 of the edges that are wanted", MOTION, hum(), reference=0.05),
    *(
        Fault(
            f"hum, of {share:g} of the edges that are wanted, {edges} a turn", MOTION, hum(share), edges=edges, **more
        )
        for edges, more in ((8, {"reference": 0.35}), (20, {"reference": 0.35}), (8, {}))
        for share in (0.55, 0.75, 0.9)
    ),
    *(
        Fault(
            f"hum of the mains, of {share:g} of the edges that are wanted{where}",
            MOTION,
            pick_up_mains,
            mains=share,
            **more,
        )
        for share in (0.55, 0.75, 0.9)
        for where, more in (("", {}), (", at 70 % of the top speed", {"reference": 0.7}))
    ),
    Fault("hum of the mains from the start", MOTION, pick_up_mains, mains=0.75, at_start=True),
    Fault("the driver repeats one sample, at 3 % of the top speed", MOTION, repeat, reference=0.03),
    Fault("edges are stamped by another clock than samples", MOTION, stamp_by_another_clock, models=(True,)),
    Fault("shaft blocked", MOTION, block),
    Fault("two channels exchanged", MOTION, swap, two_channels=True),
    Fault("two channels exchanged at 5 % of the top speed", MOTION, swap, reference=0.05, two_channels=True),
    Fault("two channels exchanged at 3 % of the top speed", MOTION, swap, reference=0.03, two_channels=True),
    Fault("two channels exchanged at 2 % of the top speed", MOTION, swap, reference=0.02, two_channels=True),
    Fault("samples 100 ms late", KNOWN, be_late),
    Fault("samples 60 ms late, from the start", MOTION, be_always_late, at_start=True),
    Fault("no samples reach the controller", KNOWN, fall_silent),
    Fault("controller killed", KNOWN, die),
    Fault("speed is not a number", KNOWN, go_wrong),
    Fault("speed is not a number in every other sample, cable off", KNOWN, go_wrong_now_and_then),
    Fault("voltage is not a number", KNOWN, send_nonsense),
    Fault("two senders of motor/voltage, the first ends", KNOWN, end_first_sender, raw=0.6),
    Fault("two senders of motor/voltage, each every 1.2 s, by turns", KNOWN, send_by_turns, raw=0.6),
    Fault("the link of a sender of motor/voltage was away for 2 s, and is back", KNOWN, lose_link, raw=0.6),
    Fault("the controller's computer was suspended, and wakes up", KNOWN, suspend),
    Fault("a second plant on the topic", KNOWN, second_plant),
    Fault("plant restarted under a held reference", KNOWN, restart),
    Fault("plain voltage, plant restarted", KNOWN, restart, raw=0.6),
    Fault("plain voltage, shaft blocked", MOTION, block, raw=0.6),
    Fault("plain voltage to and fro at every sample, shaft blocked", MOTION, shake, raw=1.0),
    Fault("plain voltage, encoder's cable off", MOTION, cable_off(), raw=0.6),
    Fault("plain voltage, two channels exchanged", MOTION, swap, two_channels=True, raw=0.6),
)
