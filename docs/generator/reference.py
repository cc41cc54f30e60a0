"""Manual, completions and reference from what the program declares of itself.

    reference.py DECLARATIONS.json DOCUMENTS OUTPUT     OUTPUT/man, OUTPUT/completions, OUTPUT/docs; DOCUMENTS is the
                                                        folder of the pages that are written by hand
"""

import sys
from pathlib import Path

import completion_bash
import completion_fish
import completion_zsh
import declared
import manual
import pages
import site_pages


def main() -> None:
    """Write all of it."""
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    declarations, sources, output = (Path(word) for word in sys.argv[1:])
    known = declared.read(declarations)
    texts = {
        "man/thermocontact.1": manual.program_page(known),
        "man/thermocontact-scene.5": manual.scene_page(known),
        "completions/thermocontact": completion_bash.completion(known),
        "completions/_thermocontact": completion_zsh.completion(known),
        "completions/thermocontact.fish": completion_fish.completion(known),
    }
    for name, text in texts.items():
        path = output / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    documents = site_pages.by_hand(sources) | {name: page(known) for name, page in pages.GENERATED.items()}
    site_pages.write(output / "docs", sources, documents | {"index.md": pages.index(documents)})


if __name__ == "__main__":
    main()
