"""Take a column's name apart into its words, and tell among them the side that it belongs to."""

import re

from motor_identification.logs.columns.vocabulary import (
    FILTERED,
    MEASURED,
    MOVES,
    SIDES,
    TAILS,
    WORDS,
    Quantity,
)

_PARTS = re.compile(r"[^\W\d_]+|\d+|%|°")
_CAMEL = re.compile(r"(?<=[^\W\d_A-ZÀ-Þ])(?=[A-ZÀ-Þ])|(?<=[A-Z])(?=[A-Z][a-z])")
_MILLI = re.compile(r"(?<![^\W\d_])m([AVS])(?![^\W_])")  # units of one word, whatever their capitals
_KNOWN = frozenset().union(*WORDS.values(), MEASURED, FILTERED)
_MOTIONS = frozenset(word for kind in MOVES for word in WORDS[kind] if len(word) > 2)
_COUNTED = WORDS[Quantity.COUNT] - {"enc", "encoder", "qei"}  # of which denc is the fourth beside aenc
_WRITTEN_TOGETHER = re.compile(  # the longer ones first
    "|".join(sorted((word for word in _KNOWN if "\u2e80" < word[0] < "\ua4d0"), key=len, reverse=True))
)


def split_words(text: str) -> tuple[str, ...]:
    """The words of a name, in lower case."""
    whole = _MILLI.sub(lambda match: f" m{match[1].lower()} ", text)
    apart = _CAMEL.sub(" ", whole.replace("ω", " ω ").replace("θ", " θ "))
    return tuple(part for word in _PARTS.findall(apart) for part in _taken_apart(word.lower()))


def _taken_apart(word: str) -> tuple[str, ...]:
    """The known words in one that are written together, as in Chinese and in German; else the word itself."""
    if word in _KNOWN:
        return (word,)
    if word[0] in "lr" and word[1:] in _MOTIONS:  # Lspeed beside Rspeed; RPWM and LPWM may be one motor's two ways
        return (word[0], word[1:])
    if word[0] == "d" and word[1:] in _COUNTED:  # dticks: how many since the row before
        return (word[0], word[1:])
    if word.endswith("dot") and word[:-3] in WORDS[Quantity.POSITION]:  # thetadot
        return (word[:-3], "dot")
    if found := tuple(_WRITTEN_TOGETHER.findall(word)):
        return found
    tail = next((one for one in TAILS if word.endswith(one)), "")
    return (word.removesuffix(tail), tail) if tail else (word,)


def find_side(words: tuple[str, ...]) -> str:
    """The side that a name's words tell: left, right or a number, else empty."""
    for word in words:
        if word in SIDES:
            return SIDES[word]
    if "r" in words and len(words) > 1:
        return "right"
    numbers = [
        words[k + 1] for k in range(len(words) - 1) if words[k] in ("m", "motor", "wheel") and words[k + 1].isdigit()
    ]
    return numbers[0] if numbers else ""


def find_device(words: tuple[str, ...]) -> str:
    """The number of a VESC, `DutyCycle_V1` beside `DutyCycle_V2`; empty where a `v` is the only word that is known."""
    numbered = len(words) > 2 and words[-2] == "v" and words[-1].isdigit()
    return words[-1] if numbered and any(len(word) > 1 and word in _KNOWN for word in words[:-2]) else ""
