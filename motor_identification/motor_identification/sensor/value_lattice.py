"""Find the lattice that recorded values lie on: multiples of one step, as counts within a window are.

The phases x/h of levels x on a lattice of step h are whole numbers but for the rounding of printed decimals and a
window that jitters; on any other step they are anywhere. Beside a uniform density, phases with a scatter σ are likelier
by −ln(σ·√(2πe)) each, which is compared with the number of steps that could fit by chance.
"""

from functools import lru_cache
from math import ceil, e, log, sqrt, tau

import numpy as np

from motor_identification.recording import Floats

MOST_LEVELS = 120  # that are looked at: more say nothing new
FINEST = 1000.0  # steps up to the largest value; a finer lattice matters to nobody
# Of the finest step of values that are no larger than nearly all: 0 in all but the last digits, which are no lattice.
NOTHING, USUAL = 0.02, 0.99
SCAN = 0.05  # of a period at the largest value: distance of the steps that are tried, so that no peak is jumped
AT_ONCE = 2048  # steps, coarse ones first: most lattices are found among the first
PEAK = 0.6  # mean cosine of the phases, from which on a step is refined
MOST_SCATTER = 0.12  # of a step: beyond, noise hides the lattice (uniform phases have 0.29)
LEAST_SCATTER = 1e-3  # of a step: better than that is no more evidence
MOST_COARSE = 1.9  # times a step that was found: half of it fits as well
LEAST_PLACES = 4  # different multiples that must occur
SAME_LEVEL = 1e-3  # of the largest: sizes that differ by no more are one, in a last digit that a filter's undoing left
FEWEST_COUNTS = 2  # different sizes above 0, of rows that jitter: one is a motor that runs or stands
CHANGES_OF_ONE = 200  # changes where there is one size: fewer are a motor that runs or stands
CHANGES_OF_EACH = 20  # changes for each of so few sizes: a motor's speeds between some steps do not come again as often
# Counts of rows that jitter: how far the RMS of those up to 4 may be from whole ones, for each of it (a control loop's
# rows jitter by 1 to 5 %), and how many are there and back again within a row, for each size: no motor's speed does so.
FEW, MOST_BLUR, THERE_AND_BACK = 4, 0.06, 20
LOWEST = 0.02  # of the sizes above 0, and times that size, below which all are one count
ONE_COUNT = 1.5
SURE = 5.0  # standard errors that the mean of the sizes of so many counts may be off
CHANCE = 1e-4  # that values without a lattice are given one
WHOLE_PART = 0.01  # of a factor's own step that factors may be beside whole ones of it
PARTS = (1.0, 0.5, 0.25)  # of the largest value: a window that jitters blurs large values, not small ones


def are_whole_products(values: Floats, others: Floats, step: float) -> bool:
    """Decide whether products of values (K,) and others (K,) are multiples of a step since each factor is of its own.

    So are those of printed digits and rows of whole milliseconds, whatever was measured.
    """
    part = step / lattice if (lattice := find_lattice(values)) > 0.0 else 0.0
    return part > 0.0 and bool(np.all(np.abs(others / part - np.rint(others / part)) < WHOLE_PART))


def find_lattice(values: Floats, finest: float = FINEST) -> float:
    """Find the largest step whose multiples all values (K,) are, within their rounding; 0 where there is none.

    finest: how many steps there are up to the largest value, at most.
    """
    levels = np.unique(np.abs(values))
    usual = float(np.quantile(np.abs(values), USUAL)) if len(levels) else 0.0
    levels = levels[levels > max(NOTHING / finest * usual, 1e-12 * levels[-1])] if len(levels) else levels
    if len(levels) > MOST_LEVELS:  # at random: every so many of many levels lie on a lattice of their own
        levels = np.sort(np.random.default_rng(0).choice(levels, MOST_LEVELS, replace=False))
    for part in PARTS:
        some = levels[levels <= part * levels[-1]] if len(levels) else levels
        step = _find_step(some.tobytes(), finest) if len(some) >= LEAST_PLACES else 0.0
        if step > 0.0:
            return step
    return _find_small_counts(values, levels) or _find_blurred_counts(values)


def measure_blur(values: Floats, step: float) -> float:
    """Measure the RMS by which the values (K,) of a few counts are off from so many steps, for each of a count."""
    numbers = np.rint(np.abs(values) / step)
    few = (numbers >= 1.0) & (numbers <= FEW)
    return sqrt(float(np.mean((np.abs(values[few]) / (numbers[few] * step) - 1.0) ** 2))) if few.any() else 0.0


def _find_small_counts(values: Floats, levels: Floats) -> float:
    """Find the step of a few counts at most, 0, 1, 2 …, among which values (K,) change all the time; 0 without.

    levels: their sizes above 0, ascending. What has no lattice never comes to the same few values again and again.
    """
    same = SAME_LEVEL * levels[-1] if len(levels) else 0.0
    levels = levels[levels > same]
    sizes = levels[np.diff(levels, prepend=0.0) > same]  # the first of those that differ in their last digits
    if not 1 <= len(sizes) < LEAST_PLACES or not np.any(np.abs(values) <= same):
        return 0.0
    step = _refine(levels, float(sizes[0]))
    all_there = np.array_equal(np.rint(sizes / step), np.arange(1, len(sizes) + 1))
    changes = np.count_nonzero(np.abs(np.diff(values)) > same)
    often = changes >= (CHANGES_OF_ONE if len(sizes) == 1 else CHANGES_OF_EACH * len(sizes))
    return step if all_there and often and measure_scatter(levels, step) < LEAST_SCATTER else 0.0


def _find_blurred_counts(values: Floats) -> float:
    """Find the step of a few counts a row whose rows jitter, which values (K,) go to and fro between; 0 without."""
    sizes = np.abs(values)
    same = SAME_LEVEL * float(sizes.max(initial=0.0))
    moving = np.sort(sizes[sizes > same])
    if len(moving) in (0, len(sizes)):
        return 0.0
    lowest = moving[int(LOWEST * len(moving))]
    numbers = np.rint(sizes / np.median(moving[moving < ONE_COUNT * lowest]))
    few = [sizes[numbers == number] for number in range(1, FEW + 1) if np.any(numbers == number)]
    if len(few) < min(float(numbers.max()), FEW) or len(few) < FEWEST_COUNTS or not _are_multiples(few):
        return 0.0
    before, inside, after = numbers[:-2], numbers[1:-1], numbers[2:]
    excursions = np.count_nonzero((before == after) & (inside != before) & (np.maximum(before, inside) <= FEW))
    return _refine_few(few) if excursions >= THERE_AND_BACK * len(few) else 0.0


def _refine_few(few: list[Floats]) -> float:
    """Least squares of the sizes of 1, 2, 3 … counts = number × step."""
    numbers = np.repeat(np.arange(1.0, len(few) + 1.0), [len(some) for some in few])
    return float(numbers @ np.concatenate(few) / (numbers @ numbers))


def _are_multiples(few: list[Floats]) -> bool:
    """Whether sizes of 1, 2, 3 … counts are so many steps, but for what they scatter by."""
    step = _refine_few(few)
    for number, some in enumerate(few, 1):
        beside = some / (number * step) - 1.0
        blur = sqrt(float(np.mean(beside**2)))
        if blur > MOST_BLUR or abs(float(np.mean(beside))) > SAME_LEVEL + SURE * blur / sqrt(len(some)):
            return False
    return True


@lru_cache(maxsize=64)  # a recording's intervals are made, and its sensor is looked at, again and again
def _find_step(values: bytes, finest: float) -> float:
    """Find the largest step whose lattice is no chance, for ascending levels above 0 (float64)."""
    levels = np.frombuffer(values)
    top = float(levels[-1])
    tried = np.asarray(np.arange(LEAST_PLACES - 1.0, finest, SCAN) / top, dtype=np.float64)  # 1/step
    score = _mean_cosine(levels, tried[:AT_ONCE])
    for begin in range(0, len(tried), AT_ONCE):
        if begin == AT_ONCE:  # all others together, which takes a third of the cosines
            score = np.concatenate([score, _mean_cosine(levels, tried[AT_ONCE:])])
        part = slice(begin, begin + AT_ONCE)
        step = _best_step(levels, tried[part], score[part], len(tried))
        if step > 0.0:
            # Levels far from 0 lie nearly on a coarser lattice too, with every number one less.
            finer = tried[(tried >= 1.0 / step) & (tried < MOST_COARSE / step)]
            return _best_step(levels, finer, _mean_cosine(levels, finer), len(tried))
    return 0.0


def _best_step(levels: Floats, tried: Floats, score: Floats, count: int) -> float:
    """The step with the least scatter among those near 1/tried whose lattice is no chance; 0 without."""
    steps = dict.fromkeys(_refine(levels, 1.0 / float(one)) for one in tried[score > PEAK])  # neighbours end in one
    lattices = [step for step in steps if _is_lattice(levels, step, count)]
    # Of equals the first.
    return min(lattices, key=lambda step: max(measure_scatter(levels, step), LEAST_SCATTER), default=0.0)


def _mean_cosine(levels: Floats, tried: Floats) -> Floats:
    """Average the cosines of the phases of levels (L,) on lattices of 1/tried (N,), which are evenly spaced: (N,).

    By the cosine of a sum: each is one of √N coarse steps and one of √N fine ones. In single precision, which is
    several times as fast: phases are off by 1e-3 at most.
    """
    size = max(ceil(sqrt(len(tried))), 1)
    coarse, fine = tried[::size], tried[:size] - tried[:1]
    (cos, cos_fine), (sin, sin_fine) = (
        [function((tau * some[:, None] * levels).astype(np.float32)) for some in (coarse, fine)]
        for function in (np.cos, np.sin)
    )
    return np.asarray((cos @ cos_fine.T - sin @ sin_fine.T).ravel()[: len(tried)] / len(levels))


def _refine(levels: Floats, step: float) -> float:
    """Least squares of levels = number × step; numbers again until they stay."""
    for _ in range(5):
        numbers = np.rint(levels / step)
        squares = numbers @ numbers
        if squares == 0.0:
            return step
        before, step = step, float(numbers @ levels / squares)
        if step == before:
            break
    return step


def _is_lattice(levels: Floats, step: float, tried: int) -> bool:
    """Whether so many levels lie so near to multiples that no chance makes it, for so many steps tried."""
    places = len(np.unique(np.rint(levels / step)))
    scatter = max(measure_scatter(levels, step), LEAST_SCATTER)
    if scatter > MOST_SCATTER or places < LEAST_PLACES:
        return False
    return -log(scatter * sqrt(tau * e)) * places > log(tried / CHANCE)  # levels of one place share their rounding


def measure_scatter(levels: Floats, step: float) -> float:
    """Measure the RMS distance of levels from multiples of a step, in steps."""
    phases = levels / step
    return sqrt(float(np.mean((phases - np.rint(phases)) ** 2)))
