"""Figures as SVG: the page's own colours and font, nothing from outside, a label for screen readers."""

from xml.etree import ElementTree

from motor_identification.reporting.html.svg import svg_style, to_svg


def drawn(title: str) -> str:
    from matplotlib import pyplot as plt  # here: who only collects this does not wait for it

    with svg_style():
        figure, axes = plt.subplots()
        axes.plot([0.0, 1.0], [1.0, 2.0], label="speed")
        axes.legend()
        return to_svg(figure, title)


def test_it_takes_the_page_s_colours_and_size() -> None:
    text = drawn("a < b & c")
    root = ElementTree.fromstring(text)
    assert root.get("role") == "img" and root.get("aria-label") == "a < b & c"
    assert root.get("width") is None and root.get("viewBox")
    assert "var(--text)" in text and "var(--faint)" in text and "#010203" not in text
    assert "var(--font)" in text and ">speed<" in text.replace("\n", "")  # text stays text


def test_it_is_the_same_every_time() -> None:
    assert drawn("x") == drawn("x") and "<metadata>" not in drawn("x") and "<!--" not in drawn("x")
