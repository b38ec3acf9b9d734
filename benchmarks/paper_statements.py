"""Every statement of the paper with what becomes of it here, and why."""

from paper_loop import PAIRS, TOP_SPEED, Assumption
from paper_study import CALM, FIRST, NOTABLE, Causes, Table, larger_swings_more
from paper_words import markdown, pair, percent, signed

Verdict = tuple[str, str, str]  # statement, whether it holds, why


def statements_table(
    assumption: Assumption, simulated: Table, hardware: Table, causes: dict[float, Causes], calm: tuple[int, int]
) -> str:
    """The table; calm: on how many of how many discs all four pairs report less than 10 %."""
    slow = min(causes)
    rows = [
        _top_speed(),
        _calm("in simulation", simulated),
        _calm('in the experiment: "hardware", true shaft speed', hardware),
        _reads_calm(hardware, *calm),
        _quantisation(simulated, causes[assumption.reference]),
        _more(simulated, hardware),
        _friction(assumption.reference, slow, causes[assumption.reference], causes[slow]),
    ]
    return markdown(["statement", "here", "why"], "lll", [list(row) for row in rows])


def _top_speed() -> Verdict:
    why = "The model is built on it. With 0.4 V of friction and the same kv, 12 V reach (12 − 0.4)/kv = 168.3 rad/s."
    return f"the largest speed is {TOP_SPEED} rad/s at 12 V", "taken over", why


def _calm(where: str, rows: Table) -> Verdict:
    worst = max(PAIRS, key=lambda one: rows[one].oscillation)
    why = f"At most {percent(rows[worst].oscillation)} ({pair(worst)})"
    if rows[worst].creep > 0.8 * rows[worst].oscillation:
        why += ", and that is no oscillation but the integral still creeping up"
    return f"oscillation below 10 % {where}", _holds(rows[worst].oscillation < CALM), why + "."


def _reads_calm(rows: Table, calm: int, discs: int) -> Verdict:
    worst = max(PAIRS, key=lambda one: rows[one].reported)
    verdict = "borderline" if 0 < calm < discs else _holds(calm == discs)
    why = (
        f"At most {percent(rows[worst].reported)} ({pair(worst)}) in the median; all four pairs stay below 10 % on "
        f"{calm} of {discs} discs. A 1 % disc reads as 6 to 7 % at a perfectly constant speed, so this is about the "
        "disc more than about the motor."
    )
    return 'oscillation below 10 % in the experiment: "hardware", reported speed', verdict, why


def _quantisation(simulated: Table, causes: Causes) -> Verdict:
    real, disc, exact = (causes.rows[name] for name in ("hardware", "with a perfect disc", "with the exact speed"))
    holds = all(real[one].oscillation > simulated[one].oscillation for one in PAIRS)
    swings = [percent(rows[PAIRS[3]].oscillation) for rows in (real, disc, exact)]
    why = (
        f"All four oscillate more than in simulation. At {pair(PAIRS[3])} the shaft swings by {swings[0]}, with a "
        f"perfect disc by {swings[1]}, with the exact speed by {swings[2]}: it is the encoder, by its steps and its "
        "lag more than by its irregular slots; the 255 steps of voltage do nothing."
    )
    return "somewhat more oscillation in the experiment, because of quantisation", _holds(holds), why


def _more(simulated: Table, hardware: Table) -> Verdict:
    in_model, in_hardware = larger_swings_more(simulated), larger_swings_more(hardware)
    mixed = "holds on the hardware, does not in simulation"
    verdict = mixed if in_hardware and not in_model else _holds(in_model and in_hardware)
    small, large = simulated[10.0, 10.0], simulated[100.0, 10.0]
    creep, swing, swings = (
        hardware[10.0, 10.0].creep,
        hardware[10.0, 10.0].oscillation,
        hardware[100.0, 10.0].oscillation,
    )
    why = (
        f"With Ki = 10: {percent(swing)} at Kp = 10 (of which {percent(creep)} creep), {percent(swings)} at Kp = 100. "
        f"In simulation Kp = 100 has settled ({percent(large.oscillation)}), and Kp = 10 still creeps "
        f"({percent(small.oscillation)})."
    )
    return "Kp = 10 oscillates less than Kp = 100", verdict, why


def _friction(usual: float, slow: float, at_usual: Causes, at_slow: Causes) -> Verdict:
    at, there = at_usual.apart["hardware"][FIRST], at_slow.apart["hardware"][FIRST]
    verdict = _holds(abs(at) >= NOTABLE)
    if abs(at) < NOTABLE <= abs(there):
        verdict = "holds for slow references only"
    names = ("with the exact speed", "without friction", "with sliding friction only")
    exact, free, sliding = (signed(at_slow.apart[name][FIRST]) for name in names)
    why = (
        f"The mean ends {signed(at)} of the reference away from simulation at {usual:g} rad/s and {signed(there)} at "
        f"{slow:g} rad/s. There it is {exact} with the exact speed, {free} without friction and {sliding} with the "
        "0.4 V of sliding friction alone: friction accounts for it, quantisation does not, and nor do the 0.9 V to "
        "break away. The fit of a 10 V step hides most of the friction in kv, so that little is left near "
        f"{usual:g} rad/s. (Kp = 100 parts from simulation as much at {slow:g} rad/s, "
        f"{signed(at_slow.apart['hardware'][PAIRS[3]])}, by oscillating.)"
    )
    return "simulation and experiment differ notably at [10, 1], because of static friction", verdict, why


def _holds(holds: bool) -> str:
    return "holds" if holds else "does not hold"
