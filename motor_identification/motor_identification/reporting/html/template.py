"""Fill the HTML templates that stand beside this file."""

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from motor_identification.reporting.html.tables import explain_rejection
from motor_identification.reporting.names import capitalize, effect_name, join_names

if TYPE_CHECKING:
    from jinja2 import Environment

HERE = Path(__file__).parent


@cache
def _environment() -> "Environment":
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(HERE), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {
        "effect_name": effect_name,
        "join_names": join_names,
        "capital": capitalize,
        "sentence": lambda text: f"{capitalize(text)}.",
        "explain_rejection": explain_rejection,
    }
    return environment


def fill_template(name: str, **values: Any) -> str:
    """Fill one of the templates; text in the values is escaped, but for SVG that the template marks as safe."""
    css = (HERE / "style.css").read_text(encoding="utf-8")
    return _environment().get_template(name).render(css=css, **values)
