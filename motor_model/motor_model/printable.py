"""Show text that strangers wrote, such as names in bags, without letting it steer a terminal."""

LONGEST = 200  # characters of a name: what is longer tells nobody more


def escape(text: str, longest: int = LONGEST) -> str:
    r"""Replace what is no visible character by its escape (`\x1b`, `\n`), bytes that are no UTF-8 by theirs (`\xff`).

    longest: characters that are kept; the rest becomes an ellipsis. 0: all are.
    """
    shown = "".join(character if character.isprintable() else _escaped(character) for character in text)
    return f"{shown[: longest - 1]}…" if 0 < longest < len(shown) else shown


def _escaped(character: str) -> str:
    if 0xDC80 <= ord(character) <= 0xDCFF:  # how Python keeps a byte that is no UTF-8 (PEP 383)
        return f"\\x{ord(character) - 0xDC00:02x}"
    return character.encode("unicode_escape").decode("ascii")
