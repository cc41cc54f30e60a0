"""Pages in Markdown, written by hand or generated, as HTML that stands alone in one folder."""

import re
import shutil
from pathlib import Path

try:
    import markdown
except ImportError:  # the pages stay as they are
    markdown = None  # type: ignore[assignment]

LINK = re.compile(r"(!?)\[([^\]\n]*(?:\n[^\]\n]*)?)\]\(([^)\s]+)\)")

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>
body {{ max-width: 60rem; margin: 2rem auto; padding: 0 1rem; font: 1rem/1.5 sans-serif; }}
table {{ border-collapse: collapse; font-size: 0.9rem; }}
td, th {{ border: 1px solid #bbb; padding: 0.2rem 0.5rem; text-align: left; vertical-align: top; }}
pre {{ overflow-x: auto; background: #f4f4f4; padding: 0.6rem; }}
img {{ max-width: 100%; }}
</style>
</head>
<body>
<p><a href="index.html">thermocontact</a></p>
{body}
</body>
</html>
"""


def without_outside(text: str) -> str:
    """Links that leave the folder of documents, to the sources, as plain text: they lead nowhere from a package."""
    return LINK.sub(lambda link: link[2] if link[3].startswith("../") else link[0], text)


def to_html(text: str) -> str:
    """The page; links to other pages are those to their HTML."""
    linked = re.sub(r"\]\(([^):\s]+)\.md(#[^)]*)?\)", lambda link: f"]({link[1]}.html{link[2] or ''})", text)
    body = markdown.markdown(linked, extensions=["tables", "toc", "sane_lists"])
    title = next((line[2:] for line in text.splitlines() if line.startswith("# ")), "thermocontact")
    return PAGE.format(title=title, body=body)


def by_hand(sources: Path) -> dict[str, str]:
    """The pages of a folder, by their file's name."""
    return {path.name: without_outside(path.read_text()) for path in sorted(sources.glob("*.md"))}


def write(output: Path, sources: Path, pages: dict[str, str]) -> None:
    """All pages into the folder, and the images of `sources` that they show."""
    output.mkdir(parents=True, exist_ok=True)
    for name, text in pages.items():
        (output / name).write_text(text)
        if markdown is not None:
            (output / name).with_suffix(".html").write_text(to_html(text))
    used = {link[3] for text in pages.values() for link in LINK.finditer(text) if link[1]}
    for image in sorted(used):
        (output / image).parent.mkdir(exist_ok=True)
        shutil.copy(sources / image, output / image)
