"""Would the tests notice? The code is made wrong in one place at a time, and a test must fail each time.

    python3 verification/mutate.py [--work DIR] [--output FILE.csv] [--resume FILE.csv] [--jobs 1|2] [NAME|ROOM...]
    python3 verification/mutate.py --check         only whether list and code fit together
    python3 verification/mutate.py --list

The mutations are listed in mutate_parts, each with the exact text that it replaces: where the code has changed so that
a text is not there exactly once, nothing is run. A copy of the project is built; in it each mutation is made and built
in turn, and the tests that tests/run.sh runs are asked one after another until one fails: the C++ tests for all
mutations, in an order that mixes the rooms; then for those left the tests that look at the mutation's room, and the
others, the shortest first. On the untouched copy all of them must pass. What the oracle finds is kept in the folder of
the copy, as it does not depend on the code that is changed.

Results, one row a mutation, go to --output as soon as they are there; --resume takes over those that were noticed.

Exit codes: 0 every mutation was noticed, or its survival is explained beside it; 1 one was not, or does not compile;
2 the check itself could not be made.
"""

import argparse
import contextlib
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from queue import SimpleQueue
from typing import Any

from mutate_parts import campaign
from mutate_parts.campaign import Verdict
from mutate_parts.listing import MUTATIONS
from mutate_parts.mutation import Mutation, faults
from mutate_parts.suite import Suite
from mutate_parts.workspace import ROOT, CannotCheck, Workspace

FOLDERS = ("cmake", "docs", "examples", "forms", "src", "tests", "verification", "scenes")
NOTICED, SURVIVED, BROKEN = 0, 1, 2


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME|ROOM", help="default: all")
    parser.add_argument("--work", type=Path, help="folder of the copy, kept; default: a temporary one")
    parser.add_argument("--output", type=Path, default=Path("mutations.csv"), metavar="FILE.csv")
    parser.add_argument("--resume", type=Path, metavar="FILE.csv", help="rows of an earlier run")
    parser.add_argument("--jobs", type=int, choices=(1, 2), default=1, help="copies that work at a time")
    parser.add_argument("--check", action="store_true", help="only compare the list with the code")
    parser.add_argument("--list", action="store_true", help="only print the list")
    return parser.parse_args(arguments)


def chosen(names: Sequence[str]) -> list[Mutation]:
    known = {name for mutation in MUTATIONS for name in (mutation.name, mutation.room)}
    if unknown := sorted(set(names) - known):
        raise CannotCheck(f"no mutation and no room: {', '.join(unknown)}")
    return [mutation for mutation in MUTATIONS if not names or {mutation.name, mutation.room} & set(names)]


class Run:
    """Verdicts in the order of the list, written and shown as they come."""

    def __init__(self, mutations: Sequence[Mutation], options: argparse.Namespace) -> None:
        self.output, self.lock = options.output, threading.Lock()
        earlier = campaign.read(options.resume) if options.resume else {}
        kept = {mutation.name: earlier.get((mutation.name, mutation.digest)) for mutation in mutations}
        self.verdicts = {name: verdict for name, verdict in kept.items() if verdict and verdict.noticed}
        self.mutations = mutations

    def left(self) -> list[Mutation]:
        """Those not judged yet, and those that only the C++ tests were asked about."""
        verdicts = [self.verdicts.get(mutation.name) for mutation in self.mutations]
        pairs = zip(self.mutations, verdicts)
        return [m for m, verdict in pairs if verdict is None or verdict.noticed_by == campaign.WAITS]

    def ordered(self) -> list[Verdict]:
        return [self.verdicts[m.name] for m in self.mutations if m.name in self.verdicts]

    def add(self, verdict: Verdict) -> None:
        with self.lock:
            if earlier := self.verdicts.get(verdict.mutation):
                verdict = replace(verdict, seconds=earlier.seconds + verdict.seconds)
            self.verdicts[verdict.mutation] = verdict
            campaign.write(self.output, self.ordered())
            print(campaign.line(verdict), flush=True)


def march(run: Run, work: Path, jobs: int) -> None:
    """The C++ tests for all mutations that are left, the other tests for those that are left then; dealt out to as
    many copies as there are jobs."""
    copies: SimpleQueue[tuple[Workspace, Suite]] = SimpleQueue()
    usual: dict[str, float] = {}

    def copy(job: int) -> Suite:
        workspace = Workspace(work / str(job + 1), FOLDERS, (), "all")
        suite = Suite(workspace.build, work / "oracle", usual)
        copies.put((workspace, suite))
        return suite

    def in_a_copy(task: Callable[[Any, Workspace, Suite], None]) -> Callable[[Any], None]:
        def one(item: Any) -> None:
            place = copies.get()
            try:
                task(item, *place)
            finally:
                copies.put(place)

        return one

    def asked(tests: campaign.Asked) -> Callable[[Any], None]:
        return in_a_copy(
            lambda mutation, workspace, suite: run.add(campaign.judge(tests, mutation, workspace, suite))
        )

    baseline = in_a_copy(lambda name, _, suite: suite.baseline(name))
    with ThreadPoolExecutor(max_workers=jobs) as pool:
        names = list(pool.map(copy, range(jobs)))[0].names
        baseline(campaign.CPP)
        list(pool.map(asked(campaign.by_cpp), campaign.mixed(run.left())))
        if run.left():
            list(pool.map(baseline, [name for name in names if name != campaign.CPP]))
            print(f"untouched code: {len(usual)} tests pass in {sum(usual.values()):.0f} s", flush=True)
        list(pool.map(asked(campaign.by_others), campaign.mixed(run.left())))


def tell(run: Run) -> int:
    """The tables, and what is wrong with them."""
    verdicts = run.ordered()
    failures = []
    for mutation in run.mutations:
        if problem := campaign.problem(run.verdicts[mutation.name], mutation):
            failures.append(f"FAILED {mutation.name} ({mutation.file}, {mutation.why}): {problem}")
    noticed = sum(verdict.noticed for verdict in verdicts)
    print(f"\n{campaign.by_room(verdicts)}\n")
    print("\n".join([*failures, f"{noticed} of {len(verdicts)} mutations noticed"]))
    return SURVIVED if failures else NOTICED


@contextlib.contextmanager
def folder(wanted: Path | None) -> Iterator[Path]:
    if wanted is None:
        with tempfile.TemporaryDirectory(prefix="mutate-") as work:
            yield Path(work).resolve()
    else:
        wanted.mkdir(parents=True, exist_ok=True)
        yield wanted.resolve()


def check(options: argparse.Namespace) -> int:
    mutations = chosen(options.names)
    if options.list:
        for mutation in mutations:
            print(
                f"{mutation.room:<9} {mutation.name:<32} {mutation.kind:<8} {mutation.file}: {mutation.why}"
            )
        return NOTICED
    if wrong := faults(mutations, ROOT):
        raise CannotCheck("list and code do not fit together:\n" + "\n".join(wrong))
    if options.check:
        print(f"{len(mutations)} mutations fit the code")
        return NOTICED
    run = Run(mutations, options)
    with folder(options.work) as work:
        if run.left():
            march(run, work, options.jobs)
    return tell(run)


def main(arguments: Sequence[str]) -> int:
    try:
        return check(parse(arguments))
    except (CannotCheck, OSError) as problem:
        print(f"mutate: {problem}", file=sys.stderr)
        return BROKEN


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
