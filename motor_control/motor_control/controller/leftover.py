"""Take back what an integral has left over where the motor shall stand, and nothing else would.

A motor with two channels is held at 0 rad/s by whatever voltage that takes. What the integral has from before, from
larger gains than it has now or from a motion below what its plant reports, would turn it instead:

    no gain     an integral whose `ki` has been set to 0 is forgotten, at any reference
    small gain  at a reference of 0 it is taken back as by kp/ki of `UNWIND` at least; gains that are next to nothing,
                `kp` included, do not stop the motor then either, and it is forgotten
    creeping    at a reference of 0 each edge that comes its way, although the motor is reported to stand, leaves
                `KEPT` of it; an edge the other way is of a load, which it may hold
"""

from dataclasses import replace
from math import exp, isfinite

from motor_control.controller import pi
from motor_control.controller.motion import Motion
from motor_control.controller.run import Config, Run
from motor_model.sample import Sample

FORGET = 0.2  # [s] time constant
UNWIND = 0.25  # [s] three times the default gains' own
RUN_ON = 1.0  # [s] the default gains take 1/38 of that, and a third of the error as a voltage at once
# Of the integral, an edge. To drop all of it drops a load that was caught one edge too high, again and again. Of 162
# loads of 10 to 24 % of the voltage (6, 30 and 174 rad/s, 12 to 48 edges a turn, 100 Hz to 1 kHz) 56 were held with 0,
# 154 with 0.5, 155 with 0.6 and 0.7, 146 with 0.8, 113 with 1; of those last ones 3, 4, 1 and 3 were not with 0.5 to
# 0.8. Of 108 motors without a load 15 crept or swung on with 0.7, 5 with 0.6, 23 with 0.8, 46 with 1.
KEPT = 0.7


def reduce_creeping(run: Run, sample: Sample, reference: float) -> Run:
    """Reduce the integral of a run that turns a motor which shall stand, too slowly for a speed to be reported."""
    moved = sample.edge_count - run.motion.edge_count
    creeps = reference == 0.0 == sample.speed and moved * run.law.integral > 0.0
    return replace(run, law=pi.State(run.law.integral * KEPT ** abs(moved))) if creeps else run


def runs_on(config: Config, motion: Motion, law: pi.State, reference: float, error: float) -> bool:
    """Tell whether an integral turns a motor that shall stand, at an error [rad/s], and no gain would stop it.

    That is where an error of the whole top speed makes less than the voltage limit in `RUN_ON`.
    """
    top = min(config.faults.fastest, motion.fastest(config.voltage_limit))
    weak = isfinite(top) and max(config.gains.kp, config.gains.ki * RUN_ON) * top < config.voltage_limit
    return weak and reference == 0.0 and error * law.integral < 0.0


def forget(gains: pi.Config, law: pi.State, dt: float, always: bool = False) -> pi.State:
    """Forget, over dt [s], an integral that has no gain any more; always: whatever the gain."""
    return pi.State(law.integral * exp(-dt / FORGET)) if always or gains.ki == 0.0 else law


def gains_to_rest(gains: pi.Config, law: pi.State, reference: float, error: float) -> pi.Config:
    """Find the gains at a reference and an error [rad/s]: quick enough to take back what turns the motor at 0 rad/s."""
    least = gains.kp / UNWIND
    takes_back = reference == 0.0 and error * law.integral < 0.0
    return replace(gains, ki=least) if takes_back and gains.ki < least else gains
