"""Odd words, numbers and values, for the places where somebody expects an ordinary one."""

from hypothesis import strategies as st

NUMBERS = (
    "nan", "inf", "-inf", "1e300", "-1e300", "5e-324", "1e-300", "0", "-0", "-1", "2e10",
    "9223372036854775808", "1e999", "0x10", "1_000", "١٢", "1,5", "", " ", "NULL", "1e", "--1", "True",
    "2026-11-22", "1:30:00",
)  # fmt: skip
WORDS = (
    "../../../etc/passwd", "/dev/zero", "/dev/full", "/proc/self/mem", "-", "--", "--help=1", "\x1b[2J", "\udcff",
    "a\nb", "$HOME", "$(touch ran)", "`touch ran`", "%s%n", "x" * 5000, "", " ", ".", "..", "~", "évil",
    "<b>", "$\\frac{", "out", "input",
)  # fmt: skip
SCALARS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=20),
    st.sampled_from(NUMBERS),
    st.binary(max_size=9),
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4),
    max_leaves=12,
)
