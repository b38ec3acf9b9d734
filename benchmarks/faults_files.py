"""Parameter files of another motor: a section of `faults.py`, on the simulated plant at 200 Hz.

Files are a driver's (edges, gear, voltage), a controller's (gains, limit) and a model, all of one motor, while another
one is connected. Somebody asks for half of the top speed of the motor that the files are of.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from faults_injected import swap
from faults_loop import DEFAULTS, Loop, outcome
from faults_motor import MOTORS, Motor

from motor_control.configuration import config_of
from motor_model.sample import Sample
from motor_model.sensing.motion_check import MotionCheck

RATE, WATCHED = 200.0, 3.0  # [Hz], [s]
TOLD = MOTORS[2]  # whose the files are
HEAD = "| connected, and what the files say | 0 V after [ms] | speed | of the wanted one | what was said |"


@dataclass(frozen=True)
class Swap:
    """A motor that is connected, and files that are of another one."""

    name: str
    motor: Motor  # that is connected
    told: Motor = TOLD
    edges: int = 96  # a turn, of its encoder, gear and all
    told_edges: int = 96
    exchanged: bool = False  # its direction


SWAPS = (
    *(
        Swap(f"a motor of {factor:g} × the top speed", replace(TOLD, top=factor * TOLD.top))
        for factor in (0.2, 0.5, 2.0, 5.0)
    ),
    *(Swap(f"an encoder, or a gear, of {edges / 96:g} × the edges", TOLD, edges=edges) for edges in (24, 48, 192, 384)),
    Swap("both: 5 × the top speed, a quarter of the edges", replace(TOLD, top=5.0 * TOLD.top), edges=24),
    Swap("the other direction, two channels", TOLD, exchanged=True),
    Swap("a motor and a supply of 12 V, `max_voltage` of 3", TOLD, replace(TOLD, voltage=3.0)),
    Swap("a motor and a supply of 12 V, `max_voltage` of 48", TOLD, replace(TOLD, voltage=48.0)),
)


def loop_of(one: Swap, model: bool) -> Loop:
    """The loop of one motor with the files of another."""
    loop = Loop(one.motor, RATE, model, single_channel=not one.exchanged, edges=one.edges)
    if one.exchanged:
        swap(loop)
    line, scale = loop.line, one.edges / one.told_edges

    def read(sample: Sample) -> Sample:
        seen = line(sample)
        return replace(seen, speed=scale * seen.speed)

    loop.line, loop.limit = read, min(one.told.voltage, one.motor.voltage)
    info = loop._board_config.info(one.told.parameters())
    info = replace(info, max_voltage=loop.limit, edges_per_revolution=one.told_edges)
    settings = {**DEFAULTS, **one.told.settings(info, model)}
    loop.config = config_of(settings, info, one.told.parameters() if model else None)  # type: ignore[arg-type]
    loop.check = MotionCheck(loop.limit, loop.single_channel)
    return loop


def files() -> Iterable[str]:
    """The rows, without a model / with one."""
    yield HEAD
    yield "|---|---|---|---|---|"
    for one in SWAPS:
        wanted, found = 0.5 * one.told.top, []
        for model in (False, True):
            loop = loop_of(one, model)
            loop.run(0.2)
            loop.reference, begin = wanted, loop.time
            loop.run(WATCHED)
            found.append(outcome(loop.moments, begin))
        after = " / ".join("never" if it.after is None else f"{1e3 * it.after:.0f}" for it in found)
        top = " / ".join(f"{it.speed / one.motor.top:.0%}" for it in found)
        share = " / ".join(f"{it.speed / wanted:.0%}" for it in found)
        said = next((it.said for it in found if it.said), "")
        yield f"| {one.name} | {after} | {top} | {share} | {said} |"


if __name__ == "__main__":
    print("\n".join(files()))
