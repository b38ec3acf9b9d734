"""Follow one wheel's motor: the angle by its counts, and whether it does what it is asked for."""

from dataclasses import dataclass, replace

from motor_model.gearing.gear import angle_of_count
from motor_model.sample import Info, Sample

SILENCE = 0.25  # [s] without a sample, or an answer of the controller: longer than any hiccup of a computer at work
UNAPPLIED = 0.1  # [s] of 0 V where the controller asks for a voltage: its first answers take a few samples to act
ASKED = 0.02  # of max_voltage: less may be rounded to no duty at all
OBEYED = 0.5  # [s] after which a controller that was given a reference runs
MOST_HELD = 2.0  # [s] for which a controller may go on alone: a robot at 0.5 m/s goes a metre
ANSWERS = 3.0  # [s] in which a controller says how long it would: one that is busy takes a second
RUNNING = "running"
FAILED = ("stopped", "no_samples")

NO_PLANT = "The {0} wheel has no motor: start its plant in the namespace {0}."
NO_SAMPLES = "No sample of the {} wheel for {:.1f} s: see whether its plant still runs."
NO_CONTROLLER = "The {0} wheel has no controller: start motor_control in the namespace {0}."
HOLDS = (
    "The controller of the {0} wheel would go on{1} if this drive died: set its reference_timeout, "
    "ros2 param set /{0}/motor_control reference_timeout 0.5."
)
UNSAID = (
    "The controller of the {0} wheel does not say how long it would go on if this drive died: it is another than "
    "before, does not answer, or has no reference_timeout; start motor_control anew in the namespace {0}."
)
RIVALS = "More than one node controls the {} wheel ({}): end the others; one that was killed is listed for a while."
NOT_RUNNING = "The {} wheel does not run: {}"
OUTPUT_OFF = "The output of the {0} wheel is off: see why in /diagnostics, then call {0}/motor/enable."


@dataclass(frozen=True, slots=True)
class Wheel:
    """What is known of one wheel; times are [s] on the clock of `now`."""

    name: str  # its namespace
    sign: float = 1.0  # -1: its motor turns backwards where the robot goes forwards
    info: Info | None = None
    sample: Sample | None = None
    heard: float = 0.0  # when the latest sample came
    edges: int = 0  # turned, signed
    direction: int = 1  # of a single channel, which counts up whichever way it turns
    state: str = ""  # of its controller
    reason: str = ""
    asked: float = 0.0  # [V] by its controller
    answered: float | None = None  # when its controller was last heard
    reference_timeout: float | None = None  # [s] of its controller; 0: it holds a reference for ever; None: not known
    unsaid_since: float | None = None  # since when its controller has not answered that; None: it has
    rivals: str = ""  # those who control it, where they are more than one
    off_since: float | None = None  # since when the plant applies nothing of what is asked for

    @property
    def angle(self) -> float:
        """[rad] that the output has turned, forwards, since the first sample; exact over any number of turns."""
        if self.info is None or not self.info.edges_per_revolution:
            return 0.0
        return self.sign * angle_of_count(self.edges, self.info.edges_per_revolution, self.info.gear)

    @property
    def speed(self) -> float:
        """[rad/s] forwards, as its plant reports it."""
        return self.sign * self.sample.speed if self.sample is not None else 0.0


def follow_sample(wheel: Wheel, sample: Sample, now: float) -> Wheel:
    """Take one more sample in; a plant that was started again goes on from where the wheel is."""
    before, direction = wheel.sample, wheel.direction
    if sample.speed != 0.0:
        direction = 1 if sample.speed > 0.0 else -1
    turned = 0
    recounts = before is not None and sample.edge_time == 0 < before.edge_time  # its board was reset
    if wheel.info is not None and before is not None and sample.sample_time > before.sample_time and not recounts:
        turned = sample.edge_count - before.edge_count
        if wheel.info.single_channel:
            turned *= direction
    limit = wheel.info.max_voltage if wheel.info is not None else 12.0
    off = sample.voltage == 0.0 and abs(wheel.asked) > ASKED * limit
    since = (now if wheel.off_since is None else wheel.off_since) if off else None
    return replace(wheel, sample=sample, heard=now, edges=wheel.edges + turned, direction=direction, off_since=since)


def follow_controller(wheel: Wheel, state: str, reason: str, asked: float, now: float) -> Wheel:
    """Take in what the controller says: its state and reason, and the voltage [V] that it asks for."""
    return replace(wheel, state=state, reason=reason, asked=asked, answered=now)


def find_trouble(wheel: Wheel, now: float, driven: float) -> str:
    """Find why a wheel cannot be relied on, as a sentence; "" if it can.

    driven: [s] for which it has been given references; 0: it is left alone.
    """
    if wheel.sample is None or wheel.info is None:
        return NO_PLANT.format(wheel.name)
    if now - wheel.heard > SILENCE:
        return NO_SAMPLES.format(wheel.name, now - wheel.heard)
    if wheel.answered is None or now - wheel.answered > SILENCE:
        return NO_CONTROLLER.format(wheel.name)
    if wheel.rivals:
        return RIVALS.format(wheel.name, wheel.rivals)
    silent = wheel.unsaid_since is not None and now - wheel.unsaid_since > ANSWERS
    if silent or (driven > 0.0 and wheel.reference_timeout is None):
        return UNSAID.format(wheel.name)
    if wheel.reference_timeout is not None and not 0.0 < wheel.reference_timeout <= MOST_HELD:
        return HOLDS.format(wheel.name, f" for {wheel.reference_timeout:g} s" if wheel.reference_timeout else "")
    if wheel.state in FAILED or (driven > OBEYED and wheel.state != RUNNING):
        return NOT_RUNNING.format(wheel.name, wheel.reason or wheel.state)
    if wheel.off_since is not None and now - wheel.off_since > UNAPPLIED:
        return OUTPUT_OFF.format(wheel.name)
    return ""


def awaits_answer(wheel: Wheel) -> bool:
    """Tell whether a wheel's controller is still to say for how long it would go on alone."""
    return wheel.reference_timeout is None
