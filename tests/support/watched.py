"""What was heard of a robot's wheel, and models of it: for tests of the monitor."""

from pathlib import Path

import foreign_bags
from foreign_bags import KA, KS, KV

from motor_identification.bag.storage import Bag
from motor_identification.logs.form import Kind
from motor_identification.mapping import Mapping, parse_origin
from motor_identification.monitoring.evaluation import Watch, evaluate
from motor_identification.monitoring.health import Verdict
from motor_identification.monitoring.heard import Heard
from motor_identification.monitoring.live_motor import LiveMotor
from motor_identification.monitoring.model_gap import Model
from motor_identification.reporting.model_comparison import Identified
from motor_model.parameters import Parameters

BAGS = Path(__file__).parents[2] / "bags"
COMMAND = parse_origin("/wheels/commands:data[1]*12")
ANGLE = Mapping(COMMAND, parse_origin("/joint_states:position[right_wheel]"), Kind.POSITION)
SPEED = Mapping(COMMAND, parse_origin("/joint_states:velocity[right_wheel]"), Kind.SPEED, speed_lag=0.0)
STANDS = Mapping(COMMAND, parse_origin("/joint_states:position[left_wheel]"), Kind.POSITION)
REVERSED = Mapping(parse_origin("/wheels/commands:data[1]*-12"), ANGLE.motion, Kind.POSITION)
IDLE = Mapping(parse_origin("/wheels/commands:data[0]*12"), STANDS.motion, Kind.POSITION)
ERRORS = {"kv": 0.001, "ka": 0.0005, "ks": 0.01}


def model(kv: float = KV, ka: float = KA, ks: float = KS) -> Model:
    """The wheel's model, or one that is off."""
    values = {"kv": kv, "ka": ka, "ks": ks}
    return Model(Identified("wheel", Parameters(values, ("coulomb_friction",)), ERRORS))


def hear(bag: Path, length: float = 10.0) -> tuple[Heard, int]:
    """A bag's end, as heard live."""
    kept, now = Heard(length), 0
    for topic, now, data in Bag(bag).messages():
        channel = kept.topic(topic.name, topic.type_name)
        kept.topics[topic.name] = topic  # with the definitions of the bag
        kept.write(channel, now, data)
    return kept, now


def hear_wheel(directory: Path) -> tuple[Heard, int]:
    """What the last 10 of 14 s leave, and when they ended [ns]."""
    foreign_bags.write_joint_states(directory / "robot", foreign_bags.move(14.0))
    return hear(directory / "robot")


def judged(wheel: tuple[Heard, int], mapping: Mapping, one: Model, late: float = 0.0) -> Verdict:
    """The verdict, `late` [s] after the last message."""
    heard, now = wheel
    return evaluate(Watch(LiveMotor(mapping, max_voltage=12.0), one), heard, now + round(late * 1e9))
