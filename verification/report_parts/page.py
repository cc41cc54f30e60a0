"""The page: the answer first, then each section with its verdict, its evidence and the commands that make it again."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

from report_parts.html import code, details, prose, table
from report_parts.kept import shown
from report_parts.section import Command, Findings, Kept, Section

STYLE = (Path(__file__).parent / "page.css").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Answer:
    """A section with its findings; none if its commands failed, and `problem` says how."""

    section: Section
    commands: Sequence[Command]
    kept: Sequence[Kept]  # none where results of another run stand in
    findings: Findings | None
    problem: str = ""

    @property
    def passes(self) -> bool:
        return self.findings is not None and self.findings.passes

    @property
    def verdict(self) -> str:
        return self.findings.worst if self.findings else f"no result: {self.problem}"


def page(answers: Sequence[Answer], machine: Sequence[Sequence[str]], how: str, when: str) -> str:
    passed = sum(answer.passes for answer in answers)
    versions = {kept.version for answer in answers for kept in answer.kept}
    kind = "ok" if passed == len(answers) else "bad"
    mixed = "<p><strong>Some results are kept from other versions of the driver.</strong></p>"
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>thermocontact: how do I know it is right?</title>
<style>
{STYLE}</style>
</head>
<body>
<header>
<p class="name">thermocontact</p>
<h1>How do I know it is right?</h1>
<p class="sum {kind}">{passed} of {len(answers)} questions answered as they should be</p>
<p>Made on {escape(when)} by</p>
{code(how)}
{mixed if len(versions) > 1 else ''}
</header>
<main>
<nav aria-label="Verdicts"><ol class="verdicts">
{''.join(map(entry, answers))}</ol></nav>
{''.join(map(article, answers))}<section id="machine">
<h2>Machine and versions</h2>
{table(['', ''], machine)}
</section>
</main>
</body>
</html>
"""


def mark(answer: Answer) -> str:
    return f'<span class="mark {"ok" if answer.passes else "bad"}">{"yes" if answer.passes else "NO"}</span>'


def entry(answer: Answer) -> str:
    section = answer.section
    return (
        f'<li>{mark(answer)}<div><a href="#{section.name}">{escape(section.title)}</a>'
        f"<span>{prose(answer.verdict)}</span></div></li>\n"
    )


def article(answer: Answer) -> str:
    section = answer.section
    typed = "\n".join(shown(section.name, command) for command in answer.commands)
    blocks = answer.findings.blocks if answer.findings else [printed(kept) for kept in answer.kept]
    return f"""<section id="{section.name}">
<h2>{escape(section.title)}</h2>
<p class="verdict">{mark(answer)}<span>{prose(answer.verdict)}</span></p>
<p>{prose(section.about)}</p>
{''.join(blocks)}
<h3>Again</h3>
{code(typed)}
<p class="made">{escape(made(answer))}</p>
</section>
"""


def made(answer: Answer) -> str:
    if not answer.kept:
        return "Read from results that were given."
    seconds, last = sum(kept.seconds for kept in answer.kept), max(kept.finished for kept in answer.kept)
    versions = " and ".join(sorted({kept.version for kept in answer.kept}))
    return f"{seconds:.0f} s, finished {last}, {versions}"


def printed(kept: Kept) -> str:
    """The end of what a command said."""
    tail = "\n".join(kept.printed.strip().splitlines()[-12:])
    return details(f"{kept.command.name}: exit code {kept.exit_code}", code(tail))
