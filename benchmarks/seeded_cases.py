"""Run the cases of a benchmark, one for each seed, in processes of their own; print each, and write the page."""

import argparse
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import TypeVar

Outcome = TypeVar("Outcome")


def run_seeds(
    one: Callable[[int], Outcome],
    say: Callable[[Outcome], str],
    page: Callable[[list[Outcome], int], str],
    target: Path,
    about: str,
    cases: int,
) -> None:
    """Judge `one` case for every seed that the command line asks for, and write the page of all to `target`.

    say: a line for an outcome. page: of all outcomes and the first seed. about: what the benchmark is. cases: how many
    without a word.
    """
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--cases", type=int, default=cases, help=f"how many (default {cases})")
    parser.add_argument("--first", type=int, default=0, help="seed of the first")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    outcomes = []
    with ProcessPoolExecutor(options.workers) as pool:
        for outcome in pool.map(one, range(options.first, options.first + options.cases)):
            outcomes.append(outcome)
            print(say(outcome), flush=True)
    text = page(outcomes, options.first)
    target.write_text(text, encoding="utf-8")
    print(text)
