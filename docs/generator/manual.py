"""The manual pages: thermocontact(1), and thermocontact-scene(5) with every key of a scene."""

import textwrap

from declared import Command, Declared, Option


def roff(text: str) -> str:
    """Text as troff takes it: in lines that are not long, none of them a request, no dash a hyphen."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    lines = textwrap.wrap(text, 78, break_long_words=False, break_on_hyphens=False)
    return "\n".join("\\&" + line if line.startswith((".", "'")) else line for line in lines)


def bold(text: str) -> str:
    """Names as they are typed."""
    return f"\\fB{roff(text)}\\fR"


def italic(text: str) -> str:
    """Words that stand for others."""
    return f"\\fI{roff(text)}\\fR"


def _usage(option: Option) -> str:
    word = " ".join(filter(None, (bold(option.names[-1]), italic(option.value) if option.value else "")))
    return f"[{word}]" + ("..." if option.repeatable else "")


def _synopsis(command: Command) -> str:
    words = [bold("thermocontact"), bold(command.name)]
    words += [italic(option.name) for option in command.options if option.is_argument]
    words += [_usage(option) for option in command.flags if "--help" not in option.names]
    return " ".join(words)


def _option(option: Option) -> list[str]:
    names = ", ".join(bold(name) for name in option.names)
    return [".TP", names + (" " + italic(option.value) if option.value else ""), roff(option.help) + "."]


def _heading(name: str, section: int, version: str) -> list[str]:
    return [f'.TH {name.upper()} {section} "" "thermocontact {version}"']


def program_page(declared: Declared) -> str:
    """thermocontact(1)."""
    lines = _heading("thermocontact", 1, declared.version)
    lines += [".SH NAME", "thermocontact \\- dynamic contact of thermo\\-viscoelastic bodies"]
    lines += [".SH SYNOPSIS"]
    for command in declared.commands:
        lines += [_synopsis(command), ".br"]
    lines += [" ".join([bold("thermocontact"), *(_usage(option) for option in declared.program.flags)])]
    lines += [".SH DESCRIPTION"]
    lines += [
        roff(
            "A scene, a file in TOML, describes a body, its material, its loads and its contact with a rigid foundation;"
            " physics whose key is absent is not modelled. Its keys are those of"
        ),
        bold("thermocontact-scene") + "(5).",
        "\\fBmpirun \\-n\\fR \\fIP\\fR \\fBthermocontact run\\fR ... is the same run on",
        "\\fIP\\fR processes.",
        roff("What follows -- are options of PETSc."),
    ]
    lines += [".SH COMMANDS"]
    for command in declared.commands:
        lines += [f".SS {roff(command.name)}", roff(command.help) + "."]
        for option in command.flags:
            lines += _option(option)
    lines += [".SH OPTIONS"]
    for option in declared.program.flags:
        lines += _option(option)
    lines += [".SH EXIT STATUS"]
    for code in declared.exit_codes:
        lines += [".TP", bold(str(code["code"])), roff(f"{code['meaning']}. What is left: {code['left']}.")]
    lines += [".SH FILES", "The folder of results has"]
    for name, text in FILES.items():
        lines += [".TP", italic(name), roff(text)]
    lines += [".SH SEE ALSO", bold("thermocontact-scene") + "(5)"]
    return "\n".join(lines) + "\n"


FILES = {
    "fields.pvd": "the fields, a time series for ParaView",
    "history.csv": "a row a step: norms, and the terms of the balances of energy, force and heat",
    "steps.csv": "a row an attempt, where steps are adapted (time.tolerance)",
    "summary.json": "how the run ended, the scene as it was understood, final numbers, audits, times",
    "checkpoint.h5": "the whole state, to go on from with --restart",
}


def _key(key: dict) -> list[str]:
    said = [key["type"]] + ([key["unit"]] if key["unit"] else [])
    said += ["one of " + ", ".join(f'"{choice}"' for choice in key["choices"])] if key["choices"] else []
    said += ["required" if key["required"] else ""]
    said += [f"default {key['default']}"] if key["default"] is not None else []
    said += [f"unless {key['instead']} is given"] if key["instead"] else []
    said += [f"needs {', '.join(key['needs'])}"] if key["needs"] else []
    said += [f"excludes {', '.join(key['excludes'])}"] if key["excludes"] else []
    return [".TP", bold(key["key"]), roff(key["description"]), roff(f"({'; '.join(filter(None, said))})")]


def scene_page(declared: Declared) -> str:
    """thermocontact-scene(5)."""
    lines = _heading("thermocontact-scene", 5, declared.version)
    lines += [".SH NAME", "thermocontact\\-scene \\- the scenes of thermocontact"]
    lines += [".SH DESCRIPTION"]
    lines += [
        roff(
            "A scene is a file in TOML. Units are SI, or any other coherent set. Numbers that may vary in space or time are"
            " also taken as an expression in x, y, z and t in quotes. NAME stands for the name of a boundary or a region. A"
            " key that is not listed is an error."
        )
    ]
    lines += [".SH KEYS"]
    for key in declared.keys:
        lines += _key(key)
    lines += [".SH SEE ALSO", bold("thermocontact") + "(1)"]
    return "\n".join(lines) + "\n"
