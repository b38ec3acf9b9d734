"""End a reference that the plant or time has made an old one: restarted, away, switched off, held at 0 V, timed out.

Where somebody has just asked for a motion, he knows how the plant is; who goes on asking, as he did before, does not.
"""

from motor_control.controller.plant_watch import PlantWatch
from motor_control.controller.reference.demand import Source
from motor_control.controller.run import Config
from motor_control.controller.speed_law import IGNORED_TIME
from motor_control.controller.state import RESTARTED, State, drop, meet_other_plant
from motor_model.frozen_record import replace

AWAY = 1.0  # [s] of silence, or of 0 V in doubt, after which the motor is not driven on by an old reference
OFF = 0.5  # [s] for which a plant may ignore voltages before the reference is dropped: longer than any hiccup

RETURNED = "The plant was away for more than 1 s."
HELD = "{} The motor was held at 0 V for more than 1 s."
WAS_OFF = (
    "The plant applied nothing of what was asked for: see whether its output is off (motor/enable with data: true "
    "switches it on), and whether it is the plant that hears this motor/voltage."
)
SILENT_JOINT = "No command on motor/joint_command for joint_command_timeout ({:g} s)."
TIMED_OUT = "The last reference is older than reference_timeout ({:g} s)."


def drop_old_reference(config: Config, state: State, plant: PlantWatch, now: float) -> State:
    """Drop a reference that the plant or time has ended; of a plant that was restarted nothing is known any more."""
    if plant.restarted:
        return meet_other_plant(state, RESTARTED)
    if state.demand is None:
        return state
    fresh = now - state.begun <= AWAY
    if now - (state.since if state.arrival is None else state.arrival) > AWAY and not fresh:
        return drop(state, RETURNED)
    if _stood_still(state, plant):
        return drop(state, RETURNED)
    if state.held is not None and now - state.held > AWAY and not fresh:
        return drop(state, HELD.format(state.held_by))
    timed_out = _find_timeout(config, state, now)
    # what a slow stream asks for never lasts as long as OFF: it is no silence of the sender's that ended it
    if state.run is not None and state.run.ignored > (IGNORED_TIME if timed_out else OFF):
        return drop(state, WAS_OFF)
    if not timed_out:
        return state
    state = replace(state, references=state.references.forgive(), joints=state.joints.forgive())
    return drop(state, timed_out)


def _find_timeout(config: Config, state: State, now: float) -> str:
    """Find which time of its user's own a demand has outlived, as a sentence; "" if none."""
    joint = state.demand is not None and state.demand.source is Source.JOINT
    if joint and config.joint_timeout and now - state.referred > config.joint_timeout:
        return SILENT_JOINT.format(config.joint_timeout)
    if config.reference_timeout and now - state.referred > config.reference_timeout:
        return TIMED_OUT.format(config.reference_timeout)
    return ""


def _stood_still(state: State, plant: PlantWatch) -> bool:
    """Tell whether a reference from before a silence of which our own clock knows nothing is still in force.

    That is what a computer shows that was suspended while the plant, on another one, went on; it does not drive the
    motor on when somebody opens its lid.
    """
    if state.plant is None or state.arrival is None or state.begun > state.arrival:
        return False
    return plant.sample_time - state.plant.sample_time > AWAY * 1e9
