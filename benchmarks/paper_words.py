"""The reproduction's tables in Markdown; the sentences around them stand in `paper_page.md`."""

from paper_fit import Fit, Floats
from paper_loop import PAIRS, REFERENCES, Assumption
from paper_study import Causes, Table

SAYS = {
    PAIRS[0]: "below 10 %; simulation and experiment differ notably",
    PAIRS[1]: "below 10 %",
    PAIRS[2]: "below 10 %, more than Kp = 10",
    PAIRS[3]: "below 10 %, more than Kp = 10",
}
LETTERS = "SHRKF"
BOARD = """### On the emulated board

The real firmware on an emulated ATmega328P, the same motor and disc on its pins, telemetry and commands over its serial
line; medians over three discs. At {rate:g} Hz its means are within {apart:.2g} rad/s of the simulated board's.

{table}

"""


def pair(one: tuple[float, float]) -> str:
    """As the paper writes it."""
    return f"[{one[0]:g}, {one[1]:g}]"


def percent(share: float) -> str:
    """With one decimal."""
    return f"{100 * share:.1f} %"


def signed(share: float) -> str:
    """A percentage with its sign; nothing is +0."""
    return f"{round(100 * share, 1) + 0.0:+.1f} %"


def markdown(head: list[str], aligned: str, rows: list[list[str]]) -> str:
    """A table; `aligned` has an l or r for each column."""
    rule = ["---" if side == "l" else "---:" for side in aligned]
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, rule, *rows])


def pairs_table(assumption: Assumption, simulated: Table, hardware: Table) -> str:
    """The four pairs in numbers, and what the paper says of them."""
    head = ["[Kp, Ki]", "oscillation: simulation", '"hardware"', "reported", "creep: simulation", '"hardware"']
    head += ["rise [ms]: simulation", '"hardware"', "offset [rad/s]: simulation", '"hardware"', "the paper"]
    rows = []
    for one in PAIRS:
        model, real = simulated[one], hardware[one]
        shares = (model.oscillation, real.oscillation, real.reported, model.creep, real.creep)
        rises = [f"{1e3 * row.rise:.0f}" for row in (model, real)]
        offsets = [f"{row.mean - assumption.reference:+.2f}" for row in (model, real)]
        rows.append([pair(one), *map(percent, shares), *rises, *offsets, SAYS[one]])
    return markdown(head, "lrrrrrrrrrl", rows)


def board_section(assumption: Assumption, hardware: Table, board: dict[float, Table]) -> str:
    """The emulated board's numbers; nothing where it did not run."""
    if not board:
        return ""
    rows = []
    for rate, table in board.items():
        for one, row in table.items():
            shares = [percent(row.oscillation), percent(row.reported)]
            rest = [f"{1e3 * row.rise:.0f}", f"{row.mean - assumption.reference:+.2f}"]
            rows.append([f"{rate:g} Hz", pair(one), *shares, *rest])
    apart = max(abs(board[assumption.rate][one].mean - hardware[one].mean) for one in PAIRS)
    head = ["rate", "[Kp, Ki]", "oscillation", "reported", "rise [ms]", "offset [rad/s]"]
    return BOARD.format(rate=assumption.rate, apart=apart, table=markdown(head, "rlrrrr", rows))


def causes_table(assumption: Assumption, causes: Causes) -> str:
    """The hardware without one thing at a time, at one reference."""
    head = ["hardware", *(f"{pair(one)} {what}" for one in PAIRS for what in ("mean", "oscillation"))]
    rows = []
    for name, table in causes.rows.items():
        cells = [(signed(causes.apart[name][one]), percent(table[one].oscillation)) for one in PAIRS]
        rows.append([name, *(cell for both in cells for cell in both)])
    return f"At {assumption.reference:g} rad/s:\n\n" + markdown(head, "l" + "rr" * len(PAIRS), rows)


def fitted_sentence(papers: Fit, ours: Fit) -> str:
    """The two coefficients that each fit finds."""
    return (
        f"kv = {papers.kv:.5f} and {ours.kv:.5f} V·s/rad, ka = {papers.ka:.6f} and {ours.ka:.6f} V·s²/rad; RMS of "
        f"simulated less sampled speed {papers.residual:.2f} and {ours.residual:.2f} rad/s"
    )


def errors_table(rows: dict[str, tuple[Floats, Floats]]) -> str:
    """How wrong each fit is."""
    head = ["motor", "kv: the paper's fit", "ours", "ka: the paper's fit", "ours"]
    cells = [[name, *(f"{e[i]:.1e}" for i in (0, 1) for e in both)] for name, both in rows.items()]
    return markdown(head, "lrrrr", cells)


def sweep_table(cells: dict[tuple[str, float], list[str]]) -> str:
    """Which statements hold where, and how often."""
    rows = [[unit, f"{rate:g} Hz", *(f"`{c}`" for c in letters)] for (unit, rate), letters in cells.items()]
    head = ["output in", "rate", *(f"{reference:g}" for reference in REFERENCES)]
    every = [letters for row in cells.values() for letters in row]
    quick = [letters for (_, rate), row in cells.items() for letters in row if rate == 1000.0]

    def counts(some: list[str]) -> str:
        return ", ".join(f"{letter} in {sum(letter in letters for letters in some)}" for letter in LETTERS)

    summary = f"Of {len(every)} combinations: {counts(every)}. Of the {len(quick)} at 1 kHz: {counts(quick)}."
    return markdown(head, "lr" + "l" * len(REFERENCES), rows) + f"\n\n{summary}"


def variants_table(assumption: Assumption, rows: dict[str, Table]) -> str:
    """The hardware under what else the paper leaves open."""
    head = ["choice", *(f"{pair(one)} {what}" for one in PAIRS for what in ("oscillation", "offset [rad/s]"))]
    lines = []
    for name, table in rows.items():
        cells = [(percent(table[p].oscillation), f"{table[p].mean - assumption.reference:+.2f}") for p in PAIRS]
        lines.append([name, *(cell for both in cells for cell in both)])
    return markdown(head, "l" + "rr" * len(PAIRS), lines)
