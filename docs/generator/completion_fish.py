"""Completion for fish."""

from declared import Declared, Option


OFFERED = {
    "SCENE": "__fish_complete_suffix .toml",
    "CHECKPOINT": "__fish_complete_suffix .h5",
    "DIR": "__fish_complete_directories",
    "KEY=VALUE": "__thermocontact_settings",
}


def _quoted(text: str) -> str:
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def _option(option: Option) -> list[str]:
    words = []
    for name in option.names:
        words.append(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}")
    if option.choices:
        words.append(f"-x -a {_quoted(' '.join(option.choices))}")
    elif option.awaits == "FILE":
        words.append("-r -F")
    elif option.awaits:
        words.append(f"-x -a '({OFFERED[option.awaits]})'")
    elif option.value:
        words.append("-x")
    return [*words, f"-d {_quoted(option.help)}"]


def completion(declared: Declared) -> str:
    """The script."""
    names = " ".join(command.name for command in declared.commands)
    lines = ["# fish completion for thermocontact; generated", ""]
    lines += ["function __thermocontact_settings"]
    for key in declared.keys:
        values = declared.values.get(key["key"], [""])
        for value in values:
            lines.append(
                f"    printf '%s\\t%s\\n' {_quoted(key['key'] + '=' + value)} {_quoted(key['description'])}"
            )
    lines += ["end", "", "complete -c thermocontact -f"]
    none_yet = f"not __fish_seen_subcommand_from {names}"
    for option in declared.program.flags:
        lines.append(f"complete -c thermocontact -n {_quoted(none_yet)} " + " ".join(_option(option)))
    for command in declared.commands:
        lines.append(
            f"complete -c thermocontact -n {_quoted(none_yet)} -a {command.name} -d {_quoted(command.help)}"
        )
    for command in declared.commands:
        seen = _quoted(f"__fish_seen_subcommand_from {command.name}")
        if argument := command.argument:
            offered = (
                _quoted(" ".join(argument.choices)) if argument.choices else f"'({OFFERED[argument.awaits]})'"
            )
            lines.append(f"complete -c thermocontact -n {seen} -k -a {offered}")
        for option in command.flags:
            lines.append(f"complete -c thermocontact -n {seen} " + " ".join(_option(option)))
    return "\n".join(lines) + "\n"
