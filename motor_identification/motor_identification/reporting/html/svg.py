"""Matplotlib figures as SVG that belongs to the page: its fonts, its colours by day and night, nothing from outside."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from io import StringIO
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TEXT, FAINT = "#010203", "#010204"  # stand for the page's own colours
MEASURED, BEFORE, AFTER, FLOOR = "#b4bdc8", "#e0672a", "#2f7fe0", "#9aa7b6"
WORST = ("#c026a8", "#111827", "#14b8a6")  # of different lightness: told apart without their hues, too
FONT = 9.0  # points


@contextmanager
def svg_style() -> Iterator[None]:
    """Within, figures are drawn for `to_svg`."""
    import matplotlib

    matplotlib.use("Agg")
    with matplotlib.rc_context(
        {
            "svg.fonttype": "none",
            "svg.hashsalt": "report",
            "font.size": FONT,
            "text.parse_math": False,  # a name may have $ in it
            "text.color": TEXT,
            "axes.labelcolor": TEXT,
            "axes.edgecolor": FAINT,
            "axes.titlesize": FONT,
            "axes.titleweight": "bold",
            "axes.titlelocation": "left",
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.grid": True,
            "grid.color": FAINT,
            "grid.linewidth": 0.5,
            "xtick.color": TEXT,
            "ytick.color": TEXT,
            "legend.frameon": False,
            "lines.linewidth": 1.3,
        }
    ):
        yield


def to_svg(figure: "Figure", title: str) -> str:
    """Return the figure, which has no layout yet, as an <svg> element; `title` is what a screen reader says."""
    from matplotlib import pyplot as plt

    _lay_out(figure)
    stream = StringIO()
    figure.savefig(stream, format="svg", transparent=True, dpi=160, metadata={"Date": None, "Creator": None})
    plt.close(figure)
    text = stream.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = text.replace(TEXT, "var(--text)").replace(FAINT, "var(--faint)")
    text = re.sub(r"font: ([\d.]+px)[^;\"]*", r"font: \1 var(--font)", text)
    text = re.sub(r"font-family: [^;\"]*", "font-family: var(--font)", text)  # as newer versions write it
    used = set(re.findall(r"#([\w.-]+)", text))
    text = re.sub(r' id="([\w.-]+)"', lambda found: found[0] if found[1] in used else "", text)
    text = re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1", text, count=1)
    text = re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", text, count=1)
    label = title.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")
    return text.replace("<svg", f'<svg role="img" aria-label="{label}"', 1).strip()


def _lay_out(figure: "Figure") -> None:
    """Make room for every text; a figure that had this engine for its own would be drawn twice for it."""
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    FigureCanvasSVG(figure)  # in which texts are as wide as they will be
    figure.dpi = 72.0  # as in SVG
    ConstrainedLayoutEngine().execute(figure)
