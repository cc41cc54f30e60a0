"""What keeps a page from standing alone, and from answering."""

from html.parser import HTMLParser

LOADING = {"src", "srcset", "data", "poster", "action", "background", "ping"}
ACTIVE = {"script", "link", "iframe", "object", "embed", "base", "form"}


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.problems: list[str] = []
        self.ids: set[str] = set()
        self.targets: set[str] = set()
        self.sections = self.verdicts = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        self.ids.add(given.get("id", ""))
        if tag in ACTIVE:
            self.problems.append(f"<{tag}>")
        for name in LOADING & given.keys():
            if not given[name].startswith("data:"):
                self.problems.append(f"<{tag} {name}> of {given[name][:60]!r}")
        if tag == "img" and not given.get("alt"):
            self.problems.append("<img> without a description")
        if "href" in given:
            if given["href"].startswith("#"):
                self.targets.add(given["href"][1:])
            else:
                self.problems.append(f"reference to {given['href'][:60]!r}")
        self.sections += tag == "section" and given.get("id") != "machine"
        self.verdicts += tag == "p" and given.get("class") == "verdict"


def problems(page: str) -> list[str]:
    """Everything that is loaded from elsewhere, broken references, sections without a verdict."""
    reader = _Reader()
    reader.feed(page)
    found = reader.problems + [f"no {target!r} to refer to" for target in sorted(reader.targets - reader.ids)]
    style = page.partition("<style>")[2].partition("</style>")[0]
    found += [f"{word} in the style" for word in ("url(", "@import") if word in style]
    if reader.sections == 0 or reader.verdicts != reader.sections:
        found.append(f"{reader.verdicts} verdicts in {reader.sections} sections")
    return found
