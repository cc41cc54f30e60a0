"""How do I know it is right? One page that answers, with every number against its tolerance.

    python3 verification/report.py [--output DIR] [--reuse] [--small] [--section NAME ...] [--given NAME=DIR ...]
                                   [--driver build/thermocontact]

Runs the studies and writes DIR/report.html, which needs nothing else: pictures and style are inside. What each study
printed and wrote stays in DIR/NAME, and --reuse takes it from there instead of running again. --given takes the files
of a study that was run by hand (orders, error-curve). --small runs a small part of each, in a minute, to try the page.

Exit codes: 0 every question is answered as it should be, 1 one is not, 2 wrong usage or the page cannot be written.
"""

import argparse
import shlex
import sys
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from benchmarking.process import ROOT
from report_parts import machine, self_contained
from report_parts.kept import Workshop
from report_parts.page import Answer, page
from report_parts.section import Section, Unreadable, last_line
from report_parts.sections import SECTIONS


def given(text: str) -> tuple[str, Path]:
    name, separator, folder = text.partition("=")
    takes = [section.name for section in SECTIONS.values() if section.files]
    if not separator or name not in takes:
        raise argparse.ArgumentTypeError(f"must be NAME=DIR with NAME one of {', '.join(takes)}")
    if not Path(folder).is_dir():
        raise argparse.ArgumentTypeError(f"no folder {folder}")
    return name, Path(folder)


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "report", metavar="DIR")
    parser.add_argument("--reuse", action="store_true", help="take what an earlier run left in DIR")
    parser.add_argument("--small", action="store_true", help="a small part of each study")
    parser.add_argument("--section", choices=SECTIONS, nargs="+", default=list(SECTIONS))
    parser.add_argument("--given", type=given, action="append", default=[], metavar="NAME=DIR")
    parser.add_argument("--driver", type=Path, default=ROOT / "build" / "thermocontact")
    options = parser.parse_args(arguments)
    if not options.driver.is_file():
        parser.error(f"no driver at {options.driver}")
    return options


def answer(section: Section, options: argparse.Namespace, workshop: Workshop) -> Answer:
    commands = section.commands(options.small)
    folders = dict(options.given)
    kept = []
    if section.name not in folders:
        for command in commands:
            kept.append(workshop.kept(section.name, command, options.reuse))
    failed = [run for run in kept if run.exit_code not in run.command.judged]
    if failed:
        problem = f"{failed[0].command.name} ended with exit code {failed[0].exit_code}: {last_line(failed[0].printed)}"
        return Answer(section, commands, kept, None, problem)
    try:
        found = section.read(folders.get(section.name, workshop.of(section.name)), kept)
    except (Unreadable, OSError, ValueError, KeyError, IndexError) as missing:
        return Answer(section, commands, kept, None, f"{type(missing).__name__}: {missing}")
    return Answer(section, commands, kept, found)


def main(arguments: Sequence[str]) -> int:
    options = parse(arguments)
    driver = options.driver.resolve()
    workshop = Workshop(driver, options.output.resolve(), machine.version_of(driver))
    answers = []
    try:
        for name in options.section:
            found = answer(SECTIONS[name], options, workshop)
            answers.append(found)
            print(
                f"{'yes' if found.passes else 'NO ':<4} {found.section.title}\n     {found.verdict}",
                flush=True,
            )
        how = shlex.join(["python3", "verification/report.py", *arguments])
        when = datetime.now().isoformat(sep=" ", timespec="minutes")
        written = page(answers, machine.rows(workshop.version), how, when)
        if wrong := self_contained.problems(written):
            raise ValueError(f"the page does not stand alone: {'; '.join(wrong)}")
        options.output.mkdir(parents=True, exist_ok=True)
        path = options.output / "report.html"
        path.write_text(written, encoding="utf-8")
        print(f"\n{path}")
    except (OSError, ValueError) as problem:
        print(f"report: {problem}", file=sys.stderr)
        return 2
    return 0 if all(found.passes for found in answers) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
