"""What the paper states about its four gain pairs, asked of one set of assumptions, and of all of them."""

from dataclasses import dataclass, replace

from paper_loop import FREE, HARDWARE, PAIRS, SLIDING, Assumption, Bench, Row, judge, median_row, run, simulation

from motor_model.parameters import Parameters

CALM = 0.10  # the paper: oscillation below 10 %
NOTABLE = 0.02  # of the reference: what the eye sees in its figures
CAUSES = {  # the hardware without one thing at a time; the last two: two things, and three
    "hardware": Bench(HARDWARE),
    "without friction": Bench(FREE),
    "with sliding friction only": Bench(SLIDING),
    "with a perfect disc": Bench(HARDWARE, irregularity=0.0),
    "with the exact speed": Bench(HARDWARE, irregularity=0.0, ideal=True),
    "with the exact speed and any voltage": Bench(HARDWARE, irregularity=0.0, ideal=True, duty_steps=False),
}
FIRST = PAIRS[0]  # [10, 1]
Table = dict[tuple[float, float], Row]


@dataclass(frozen=True)
class Causes:
    """The four pairs on hardware that lacks one thing, by name; means less simulation, as shares of the reference."""

    rows: dict[str, Table]
    apart: dict[str, dict[tuple[float, float], float]]


def table(assumption: Assumption, bench: Bench, discs: int) -> Table:
    """All four pairs on one bench."""
    return {pair: median_row(pair, assumption, bench, discs) for pair in PAIRS}


def calm_discs(assumption: Assumption, bench: Bench, discs: int) -> int:
    """On how many discs all four pairs report an oscillation below 10 %."""
    return sum(
        all(judge(run(pair, assumption, bench, seed), assumption.reference).reported < CALM for pair in PAIRS)
        for seed in range(discs)
    )


@dataclass(frozen=True)
class Verdicts:
    """Which statements hold."""

    calm_simulation: bool  # oscillation below 10 % in simulation
    calm_shaft: bool  # in the experiment, of the true speed
    calm_reported: bool  # in the experiment, of the reported speed, which is what the paper saw
    more: bool  # in the experiment Kp = 100 oscillates more than Kp = 10, for either Ki
    friction: bool  # [10, 1] ends notably away from its simulation, and friction makes more than half of that

    def letters(self) -> str:
        """One letter for each that holds, a dot for each that does not."""
        held = (self.calm_simulation, self.calm_shaft, self.calm_reported, self.more, self.friction)
        return "".join(letter if holds else "·" for letter, holds in zip("SHRKF", held, strict=True))


def deviation(hardware: Table, simulated: Table, reference: float) -> dict[tuple[float, float], float]:
    """Mean speed of the last half second, hardware less simulation, as a share of the reference."""
    return {pair: (hardware[pair].mean - simulated[pair].mean) / reference for pair in PAIRS}


def verdicts(assumption: Assumption, fitted: Parameters, discs: int) -> Verdicts:
    """Ask the statements of one set of assumptions; `fitted` is the model that the paper would simulate."""
    simulated, hardware = table(assumption, simulation(fitted), 1), table(assumption, Bench(HARDWARE), discs)
    apart = abs(deviation(hardware, simulated, assumption.reference)[FIRST])
    smooth = median_row(FIRST, assumption, Bench(FREE), discs).mean
    without = abs(smooth - median_row(FIRST, assumption, simulation(FREE), 1).mean) / assumption.reference
    return Verdicts(
        calm_simulation=all(row.oscillation < CALM for row in simulated.values()),
        calm_shaft=all(row.oscillation < CALM for row in hardware.values()),
        calm_reported=all(row.reported < CALM for row in hardware.values()),
        more=larger_swings_more(hardware),
        friction=apart >= NOTABLE and without < 0.5 * apart,
    )


def larger_swings_more(rows: Table) -> bool:
    """Whether Kp = 100 oscillates more than Kp = 10, for either Ki."""
    return all(rows[100.0, ki].oscillation > rows[10.0, ki].oscillation for ki in (1.0, 10.0))


def varied(assumption: Assumption, **changes: object) -> Assumption:
    """The same but for some of it."""
    return replace(assumption, **changes)  # type: ignore[arg-type]
