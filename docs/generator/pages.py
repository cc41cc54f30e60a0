"""The reference: scene keys, command line, exit codes, results, each a page in Markdown."""

from declared import Declared

PLACES = {
    "history": ("Columns of `history.csv`", "A row a step; the first line names the columns."),
    "steps": ("Columns of `steps.csv`", "A row an attempt, where steps are adapted (`time.tolerance`)."),
    "body": ("Fields of the body", "In `fields.pvd`, part 0, as far as `output.fields` asks for them."),
    "contact": (
        "Fields of the contact surfaces",
        "In `fields.pvd`, part 1; with `contact` among `output.fields`.",
    ),
    "summary": (
        "Entries of `summary.json`",
        "Dots stand between a table and its entries; NAME is that of a boundary in contact, BALANCE is `momentum` or"
        " `heat`.",
    ),
}


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _table(heads: list[str], rows: list[list[str]]) -> str:
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    lines += ["| " + " | ".join(_cell(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def results(declared: Declared) -> str:
    """Every column, field and entry."""
    text = (
        "# Results\n\nUnits are those of scenes in space, for SI; in the plane forces, energies, heat and areas are per"
        " metre of thickness, and norms have m in place of m^(3/2).\n"
    )
    for place, (title, introduction) in PLACES.items():
        fields = place in ("body", "contact")
        rows = []
        entries = declared.results[place] + (declared.results["summary_opened"] if place == "summary" else [])
        for entry in entries:
            row = [f"`{entry['name']}`", entry["unit"], entry["meaning"]]
            rows.append(row + ([str(entry["components"])] if fields else []))
        heads = ["name", "unit", "meaning"] + (["components"] if fields else [])
        text += f"\n## {title}\n\n{introduction}\n\n" + _table(heads, rows)
    return text + "\nWhat the balances are made of: [How to read the audits](audits.md).\n"


def exit_codes(declared: Declared) -> str:
    """Every exit code."""
    rows = [[str(code["code"]), code["meaning"], code["left"]] for code in declared.exit_codes]
    return (
        "# Exit codes\n\n"
        + _table(["code", "meaning", "what is left"], rows)
        + "\nUnder `mpirun` the codes are the same, but for signals, after which Open MPI itself ends with 1.\n"
    )


def command_line(declared: Declared) -> str:
    """Every command and option."""
    text = "# Command line\n\nWhat follows `--` are options of PETSc.\n"
    for command in (*declared.commands, declared.program):
        text += f"\n## `{' '.join(filter(None, ['thermocontact', command.name]))}`\n\n{command.help.rstrip('.')}.\n\n"
        rows = []
        for option in command.options:
            name = ", ".join(f"`{name}`" for name in option.names)
            rows.append([name, option.value, option.help + ("; repeatable" if option.repeatable else "")])
        text += _table(["option", "value", "meaning"], rows)
    return text + "\n[Exit codes](exit-codes.md), [scene keys](scene-keys.md), [results](results.md).\n"


def scene_keys(declared: Declared) -> str:
    """As `thermocontact schema --format markdown` has them."""
    return declared.scene_keys_markdown


def index(documents: dict[str, str]) -> str:
    """The pages by their titles: those that are written by hand, and the reference."""
    titles = {
        name: next(line[2:] for line in text.splitlines() if line.startswith("# "))
        for name, text in documents.items()
    }
    lines = ["# thermocontact", "", "Dynamic frictional contact of thermo-viscoelastic bodies.", ""]
    for heading, names in (
        ("Explained", [name for name in documents if name not in GENERATED]),
        ("Reference", list(GENERATED)),
    ):
        lines += [f"## {heading}", "", *(f"- [{titles[name]}]({name})" for name in names), ""]
    return "\n".join(lines)


GENERATED = {
    "scene-keys.md": scene_keys,
    "results.md": results,
    "exit-codes.md": exit_codes,
    "command-line.md": command_line,
}
