"""Pieces of the page: tables, pictures, folded parts."""

import base64
import re
from collections.abc import Sequence
from html import escape
from pathlib import Path

NUMBER = re.compile(r"[-+–]?(\d|inf|nan)[\d.,e+-]*%?")


def cell(text: str, kind: str = "td") -> str:
    """Numbers to the right, ranges in one piece; a verdict in its colour."""
    stripped = text.strip().replace(" – ", "\u00a0–\u00a0")
    names = ["n"] if NUMBER.fullmatch(stripped) else []
    if stripped == "FAILED" or stripped.startswith("FAILED "):
        names.append("bad")
    attribute = f' class="{" ".join(names)}"' if names else ""
    return f"<{kind}{attribute}>{escape(stripped)}</{kind}>"


def prose(text: str) -> str:
    """Numbers with an exponent stay in one piece."""
    return re.sub(r"\d[\d.]*e[-+]\d+", r'<span class="whole">\g<0></span>', escape(text))


def table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    numeric = [bool(NUMBER.fullmatch(text.strip())) for text in rows[0]] if rows else []
    kinds = [' class="n"' if is_number else "" for is_number in numeric] or [""] * len(header)
    head = "".join(f'<th scope="col"{kind}>{escape(name)}</th>' for name, kind in zip(header, kinds))
    body = "".join(f"<tr>{''.join(map(cell, row))}</tr>\n" for row in rows)
    return f'<div class="wide" tabindex="0"><table><thead><tr>{head}</tr></thead><tbody>\n{body}</tbody></table></div>'


def picture(path: Path, description: str) -> str:
    """Inline. Raises OSError."""
    data = base64.b64encode(path.read_bytes()).decode("ascii")
    return (
        f'<figure><img alt="{escape(description)}" src="data:image/png;base64,{data}">'
        f"<figcaption>{escape(description)}</figcaption></figure>"
    )


def details(summary: str, *blocks: str) -> str:
    return f"<details><summary>{escape(summary)}</summary>{''.join(blocks)}</details>"


def code(text: str) -> str:
    return f'<pre tabindex="0"><code>{escape(text)}</code></pre>'


def markdown_rows(text: str) -> list[list[str]]:
    """Of a table in Markdown, the header first, without the line of dashes."""
    rows = [re.split(r"(?<!\\)\|", line.strip()[1:-1]) for line in text.splitlines() if line.startswith("|")]
    return [
        [part.strip().replace("\\|", "|") for part in row]
        for row in rows
        if not all(set(part.strip()) <= {"-", ":"} and part.strip() for part in row)
    ]
