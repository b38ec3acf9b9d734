"""A recording beside its simulation: the recorded voltages drive a simulated motor while the recorded speed plays."""

from collections.abc import Mapping
from dataclasses import replace

from motor_bringup.argument import MODEL, PARAMETERS, Argument, checked
from motor_bringup.files import named
from motor_bringup.plant import model_of, with_files
from motor_bringup.program import Program, Session, Value
from motor_identification.bag import read_recording
from motor_model.sample import Info

SLOWEST, FASTEST = 10.0, 1000.0  # [Hz] at which motor_sim can sample
SIMULATED = "simulated"  # the namespace, in the recorded motor's, of the motor that is simulated beside it

ARGUMENTS = (
    Argument("bag", "", "the recording to play"),
    MODEL,
    Argument("topic_namespace", "", "of the recorded motor"),
    Argument("start", "", "leave out so many seconds of it; empty: none"),
    Argument("loop", "false", "true: begin again at the end, until Ctrl-C", ("true", "false")),
    PARAMETERS,
)


def session(told: Mapping[str, str]) -> Session:
    """Return what `replay.launch.py` starts: motor/speed is recorded, simulated/motor/speed what the model makes of it.

    Raises:
        MotorError: the bag, the model or the parameter file cannot be read.
    """
    values = checked(ARGUMENTS, told)
    bag, namespace = named(values["bag"], "bag"), values["topic_namespace"].strip("/")
    simulated = Program(
        "motor_sim",
        "motor_sim",
        namespace="/".join(filter(None, (namespace, SIMULATED))),
        remappings=(("motor/voltage", "/".join(("", *filter(None, (namespace, "motor/voltage"))))),),
    )
    own = {**_as_recorded(read_recording(bag, namespace).info), **model_of(values)}
    simulated = replace(simulated, parameters=with_files(simulated.full_name, "plant.yaml", values, own))
    later = ("--start-offset", values["start"]) if values["start"] else ()
    again = ("--loop",) if values["loop"] == "true" else ()
    play = Program("motor_identification", "play", (bag, *later, *again), node=False)
    return Session((simulated,), (play,), ready="Simulating")


def _as_recorded(info: Info) -> dict[str, Value]:
    """The encoder, the supply and the samples of the recorded motor, whatever the files say."""
    encoder: dict[str, Value] = {}
    if info.edges_per_revolution:  # imported speeds may come without
        encoder = {"edges_per_revolution": info.edges_per_revolution, "single_channel": info.single_channel}
    return {
        "name": f"{info.name}_{SIMULATED}",
        "sample_rate": min(max(1.0 / info.sample_period, SLOWEST), FASTEST),
        "max_voltage": info.max_voltage,
        **encoder,
    }
