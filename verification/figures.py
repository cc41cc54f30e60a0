"""The pictures of one results folder, or of two side by side with common scales.

    python3 verification/figures.py DIR [DIR] --output DIR [--small] [--only PICTURE]...

    deformed       deformed mesh over the undeformed outline       Figure 2 of the paper
    temperature    temperature                                     Figure 3
    von-mises      von Mises stress                                Figure 4
    contact-final  along each contact boundary at the final time: pressure, tangential traction, slip velocity,
                   penetration
    contact-maps   pressure and slip velocity along each contact boundary against time
    contact-history  forces, shares closed and slipping, largest slip velocity, largest penetration against time
    spring-history   forces on springs, and largest slip velocity, against time

All are drawn that the scenes' physics have; --only picks some. Each is written as PNG and PDF; --small writes small
PNGs only, for a README. All are at the last step in the folder, except those over time.

Exit codes: 0 drawn, 1 the output folder cannot be written, 2 something that a picture needs is missing (which and
where is said; pictures before it are drawn).
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from plotting.results import Results, Unusable
from plotting.style import Album, Case, Draw, cases, styled

from plotting import body, contact, history

MECHANICS = {"inertia", "elasticity", "viscosity"}
HEAT = {"heat_capacity", "conduction"}

PICTURES: dict[str, tuple[set[str], Draw]] = {
    "deformed": (MECHANICS, body.draw_deformed),
    "temperature": (HEAT, body.draw_temperature),
    "von-mises": (MECHANICS, body.draw_von_mises),
    "contact-final": ({"compliance"}, contact.draw_final),
    "contact-maps": ({"compliance"}, contact.draw_maps),
    "contact-history": ({"compliance"}, history.draw_history),
    "spring-history": ({"spring"}, history.draw_springs),
}


def modelled(needed: set[str], folders: Sequence[Case]) -> bool:
    """Whether each scene has one of these physics."""
    return all(needed & case.results.physics for case in folders)


def chosen(folders: Sequence[Case], only: Sequence[str]) -> list[str]:
    missing = [name for name, (needed, _) in PICTURES.items() if not modelled(needed, folders)]
    for name in missing:
        if name in only:
            needed = " or ".join(sorted(PICTURES[name][0]))
            raise Unusable(f"{name}: not every scene models {needed}")
    if missing and not only:
        print(f"figures: not modelled in every scene, so left out: {', '.join(missing)}")
    return [name for name in PICTURES if name not in missing and (not only or name in only)]


def draw(folders: Sequence[Case], album: Album, only: Sequence[str]) -> None:
    if len({tuple(case.results.contact_names) for case in folders}) > 1:
        raise Unusable("the two scenes have different contact boundaries")
    names = chosen(folders, only)
    if not names:
        raise Unusable("the scenes have nothing in common that could be drawn")
    with styled():
        for name in names:
            PICTURES[name][1](folders, album)


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(description="Draw one results folder, or two side by side.")
    parser.add_argument("folders", type=Path, nargs="+", metavar="DIR")
    parser.add_argument("--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--small", action="store_true", help="small PNGs only, for a README")
    parser.add_argument("--only", choices=list(PICTURES), action="append", default=[], metavar="PICTURE")
    options = parser.parse_args(arguments)
    if len(options.folders) > 2:
        parser.error("at most two results folders")
    album = Album(options.output, options.small)
    try:
        draw(cases([Results(folder) for folder in options.folders]), album, options.only)
    except Unusable as problem:
        print(f"figures: {problem}", file=sys.stderr)
        return 2
    except OSError as problem:
        print(f"figures: {problem}", file=sys.stderr)
        return 1
    for path in album.written:
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
