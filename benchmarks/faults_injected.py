"""What goes wrong with a loop of `faults.py`: line, shaft, samples, senders, plants."""

from collections.abc import Callable
from dataclasses import replace
from math import nan, tau

from faults_line import CableOff, Hum, LooseContact, NowAndThen, Stuck, Swapped, not_a_number
from faults_loop import Loop
from faults_motor import Motor

from motor_control.controller import controller
from motor_model.effects import INDEX

TREMBLE = 0.001  # of a period, 1 σ, of hum
SELDOM = 1.2  # [s] from a command of a sender to its next: one that has been silent for 0.5 s has ended
SECOND, ASLEEP = 0.6, 2.0  # of the voltage, that another sender sends; [s]


def mains_rate(motor: Motor) -> float:
    """[Hz] hum on the line of a motor."""
    return 100.0 if motor.top > 100.0 else 50.0


def pick_up_mains(loop: Loop) -> None:
    """The encoder's cable is off at its far end, and picks up the mains, whose crossings tremble a little."""
    loop.line = Hum(mains_rate(loop.motor), tau / loop.edges, TREMBLE)


def cable_off(stray: float = 0.0) -> Callable[[Loop], None]:
    """The encoder's cable is off."""

    def apply(loop: Loop) -> None:
        loop.line = CableOff(stray)

    return apply


def hum(share: float = 0.75) -> Callable[[Loop], None]:
    """The encoder's cable is off at its far end, and picks up edges at a share of the rate that is wanted."""

    def apply(loop: Loop) -> None:
        slot, wanted = tau / loop.edges, loop.state.demand
        if wanted is not None:  # a motor that is too slow for its disc is refused, or has been stopped
            loop.line = Hum(share * wanted.value / slot, slot)

    return apply


def loosen(loop: Loop) -> None:
    """A contact of the encoder's cable is loose."""
    loop.line = LooseContact()


def repeat(loop: Loop) -> None:
    """The driver repeats one sample."""
    loop.line = Stuck()


def go_wrong_now_and_then(loop: Loop) -> None:
    """The speed is not a number in every other sample, and no edge comes."""
    off, wrong = CableOff(), NowAndThen()
    loop.line = lambda sample: wrong(off(sample))


def stamp_by_another_clock(loop: Loop) -> None:
    """The driver stamps edges by another clock than samples."""
    loop.line = lambda sample: replace(sample, edge_time=sample.edge_time + 10**12)


def shake(loop: Loop) -> None:
    """Something holds the shaft, and the voltage turns to and fro."""
    block(loop)
    loop.to_and_fro = True


def block(loop: Loop) -> None:
    """Something holds the shaft: friction that no voltage overcomes."""
    for name in ("ks", "breakaway_voltage"):
        loop.board._p[INDEX[name]] = 10.0 * loop.motor.voltage


def swap(loop: Loop) -> None:
    """The encoder's two channels are exchanged."""
    loop.line = Swapped()


def be_late(loop: Loop) -> None:
    """Samples wait for 100 ms before they are answered."""
    loop.delay = 0.1


def be_always_late(loop: Loop) -> None:
    """Samples wait for 60 ms before they are answered, and have done so from the start: no clock shows it."""
    loop.delay, loop.state = 0.06, controller.State()


def ask_in_turn(loop: Loop) -> None:
    """Stray edges on a lost line, and two who ask for a speed and an angle in turn."""
    loop.line, loop.alternate = CableOff(50.0), True


def fall_silent(loop: Loop) -> None:
    """No sample reaches the controller any more."""
    loop.heard = False


def die(loop: Loop) -> None:
    """The controller is killed."""
    loop.alive = False


def go_wrong(loop: Loop) -> None:
    """The speed is not a number."""
    loop.line = not_a_number


def send_nonsense(loop: Loop) -> None:
    """A voltage is not a number."""
    loop.raw = nan


def end_first_sender(loop: Loop) -> None:
    """Another sender, which was left aside for a second, goes on where the first one ends."""
    loop.second = -SECOND * loop.motor.voltage
    loop.run(1.0)
    loop.raw, loop.alive = None, False


def send_by_turns(loop: Loop) -> None:
    """The sender comes every 1.2 s from now on, and another one, for the other way, halfway; each has come twice."""
    loop.second, loop.every = -SECOND * loop.motor.voltage, round(SELDOM * loop.rate)
    loop.run(2.0 * SELDOM)


def lose_link(loop: Loop) -> None:
    """The network between sender and plant is away for a while, and comes back; the sender has gone on."""
    loop.deaf = True
    loop.run(ASLEEP)
    loop.deaf = False


def suspend(loop: Loop) -> None:
    """The controller's computer is suspended for two seconds, and the plant, on another one, goes on."""
    loop.alive = False
    loop.run(ASLEEP)
    loop.asleep += ASLEEP - 1.0 / loop.rate
    loop.alive = True
    loop.drop_samples()


def second_plant(loop: Loop) -> None:
    """Another plant speaks on the same topic, of a motor that stands."""
    sample = loop.board.sample(loop.moments[-1].voltage)
    loop.rival = replace(sample, sample_time=sample.sample_time - round(0.6e9 / loop.rate), speed=0.0)


def restart(loop: Loop) -> None:
    """The plant is killed and started again."""
    loop.come_up()
