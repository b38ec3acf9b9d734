"""Write one section of a page and keep the others: a page of several commands is whole after any of them."""

from pathlib import Path


def replace_section(text: str, section: str) -> str:
    """Replace the section of a page that has the same heading, its first line; what has none comes at the end.

    The part that begins with the title ("# ...") ends where the first section ("## ...") begins.
    """
    section = section.strip() + "\n"
    heading = section.split("\n", 1)[0]
    parts = ("\n" + text.strip()).split("\n## ") if text.strip() else []
    sections = [parts[0].strip() + "\n", *(f"## {part.strip()}\n" for part in parts[1:])] if parts else []
    if heading.startswith("# "):
        return "\n".join([section, *sections[1:]])
    found = [k for k, one in enumerate(sections) if one.split("\n", 1)[0] == heading]
    if found:
        sections[found[0]] = section
        return "\n".join(sections)
    return "\n".join([*sections, section])


def write_section(page: Path, lines: list[str]) -> None:
    """Write one section into a page, which need not exist yet."""
    page.parent.mkdir(exist_ok=True)
    text = page.read_text(encoding="utf-8") if page.exists() else ""
    page.write_text(replace_section(text, "\n".join(lines)), encoding="utf-8")
