"""Have somebody turn the shaft by hand: which channels are alive, which way they count, how many edges a turn has."""

from dataclasses import dataclass
from fractions import Fraction

from motor_driver.check.findings import Finding, finding
from motor_driver.check.look import Act, Answer, Prompt, Steps

ALIVE = 4  # edges: more than a push on a shaft that stands on a flank makes
TO_AND_FRO = 2  # between which counts a dead channel B keeps the count
BY_HAND = 0.15  # of a turn: what a careful hand is off by, and a quarter of the least that a wrong number is off

GEAR = (
    "With {edges} edges in a turn of the encoder's shaft that is a gear of about {gear:.3g} to 1: say --gear-ratio, "
    "exactly, or another --pulses-per-revolution."
)


@dataclass(frozen=True)
class Turned:
    """What came while somebody turned the shaft."""

    said: Answer | None = None  # DONE; NO: it cannot be turned; None: nobody answered
    count: int = 0  # from the beginning to the end, signed with two channels
    span: int = 0  # from the lowest to the highest
    edges: int = 0  # samples with a new edge

    @property
    def alive(self) -> bool:
        """Whether the encoder has counted."""
        return self.edges >= ALIVE and self.span > TO_AND_FRO

    @property
    def to_and_fro(self) -> bool:
        """Whether edges came and the count got nowhere: channel B is dead."""
        return self.edges >= ALIVE and self.span <= TO_AND_FRO

    @property
    def way(self) -> int:
        """Of the count: +1, −1; 0 if it is not known."""
        return 0 if not self.alive or self.said is not Answer.DONE else 1 if self.count > 0 else -1


def turn_by_hand(most: float) -> Steps[Turned]:
    """Watch while somebody turns the shaft, until he says that it is done, or for `most` [s]."""
    look = yield Act(prompt=Prompt.TURN)
    first = low = high = look.count
    begun, edge, edges = look.time, look.edge_time, 0
    while look.answer not in (Answer.DONE, Answer.NO) and look.time - begun < most:
        look = yield Act(prompt=Prompt.TURN)
        edges += look.edge_time != edge
        edge = look.edge_time
        low, high = min(low, look.count), max(high, look.count)
    return Turned(look.answer, look.count - first, high - low, edges)


def judge_counts(turned: Turned, turns: int, edges: int | None, gear: float = 1.0) -> Finding | None:
    """Judge whether so many edges of the encoder's shaft, behind a gear, can be true; None if they can."""
    counted = abs(turned.count)
    words = "One turn" if turns == 1 else f"{turns} turns"
    if edges is None:
        return finding("unknown_counts", turns=words, counted=counted)
    expected = edges * gear * turns
    if abs(counted / expected - 1.0) <= BY_HAND / turns:
        return None
    hint = _hint(counted / turns, edges) if gear == 1.0 else GEAR.format(edges=edges, gear=counted / turns / edges)
    return finding("wrong_counts", turns=words, counted=counted, expected=expected, hint=hint)


def _hint(counted: float, told: int) -> str:
    """What the number means, if it is a likely one."""
    ratio = Fraction(counted / told).limit_denominator(4)
    about = f"Say --edges-per-revolution with the right number, near {counted:.0f}"
    if counted > 5.0 * told:
        return GEAR.format(edges=told, gear=counted / told)
    if ratio in (Fraction(1, 2), Fraction(1, 4)):
        return f"{about}: only edges of one polarity of one channel count, no flanks and no second channel."
    return f"{about}, and exactly, as the disc has it (10 turns tell more: --turns 10)."
