"""Completion for zsh."""

from declared import Command, Declared, Option


ACTIONS = {
    "SCENE": '_files -g "*.toml"',
    "CHECKPOINT": '_files -g "*.h5"',
    "FILE": "_files",
    "DIR": "_files -/",
    "KEY=VALUE": "_thermocontact_settings",
}


def _escaped(text: str) -> str:
    """Inside of '...[text]...'."""
    for character, by in (("\\", "\\\\"), ("'", "'\\''"), ("[", "\\["), ("]", "\\]"), (":", "\\:")):
        text = text.replace(character, by)
    return text


def _action(option: Option) -> str:
    if option.choices:
        return "(" + " ".join(option.choices) + ")"
    return ACTIONS.get(option.awaits, " ")


def _option(option: Option) -> str:
    start = "*" if option.repeatable else f"({' '.join(option.names)})"
    names = option.names[0] if len(option.names) == 1 else "{" + ",".join(option.names) + "}"
    value = f":{option.value}:{_action(option)}" if option.value else ""
    return f"'{start}'{names}'[{_escaped(option.help)}]{value}'"


def _command(command: Command) -> list[str]:
    words = [_option(option) for option in command.flags]
    if argument := command.argument:
        words.append(f"'1:{argument.name.lower()}:{_action(argument)}'")
    return [f"        {command.name})", "            _arguments -s \\"] + [
        f"                {word}" + (" \\" if i + 1 < len(words) else " ;;") for i, word in enumerate(words)
    ]


def completion(declared: Declared) -> str:
    """The script."""
    lines = ["#compdef thermocontact", "# zsh completion for thermocontact; generated", ""]
    lines += ["_thermocontact_settings() {", "    local -a keys values", "    if compset -P '*='; then"]
    lines += ["        case ${IPREFIX##*[[:space:]]} in"]
    for key, values in declared.values.items():
        pattern = key.replace("NAME", "*")
        listed = " ".join("'" + value + "'" for value in values)
        lines.append(f"            {pattern}=) values=({listed}); compadd -- $values ;;")
    lines += ["        esac", "        return", "    fi", "    keys=("]
    lines += [f"        '{key['key']}:{_escaped(key['description'])}'" for key in declared.keys]
    lines += ["    )", "    _describe 'scene key' keys -S =", "}", ""]
    lines += [
        "_thermocontact() {",
        "    local curcontext=$curcontext state line",
        "    local -a commands",
        "    commands=(",
    ]
    lines += [f"        '{command.name}:{_escaped(command.help)}'" for command in declared.commands]
    lines += ["    )", "    _arguments -C \\"]
    lines += [f"        {_option(option)} \\" for option in declared.program.flags]
    lines += ["        '1:command:->command' '*::argument:->argument'"]
    lines += ["    case $state in", "    command) _describe 'command' commands ;;", "    argument)"]
    lines += ["        case $line[1] in"]
    for command in declared.commands:
        lines += _command(command)
    lines += ["        esac ;;", "    esac", "}", "", '_thermocontact "$@"']
    return "\n".join(lines) + "\n"
