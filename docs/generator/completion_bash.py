"""Completion for bash."""

from declared import Command, Declared, Option

TEMPLATE = r"""# bash completion for thermocontact; generated
# Words are taken from the line itself, as bash has cut them at "=".
_thermocontact() {
    local current="${COMP_WORDS[COMP_CWORD]}" previous="" before="" command="" scene="" word i
    [ "$COMP_CWORD" -ge 1 ] && previous="${COMP_WORDS[COMP_CWORD-1]}"
    [ "$COMP_CWORD" -ge 3 ] && before="${COMP_WORDS[COMP_CWORD-3]}"
    for ((i = 1; i < COMP_CWORD; i++)); do
        word="${COMP_WORDS[i]}"
        [ -z "$command" ] && case "$word" in @commands_pattern@) command="$word" ;; esac
        case "$word" in *.toml) scene="$word" ;; esac
    done
    COMPREPLY=()
    compopt +o nospace 2>/dev/null
    if [ -z "$command" ]; then
        mapfile -t COMPREPLY < <(compgen -W "@first@" -- "$current")
        return
    fi

    # --set KEY=VALUE
    if [ "$previous" = --set ]; then
        compopt -o nospace 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -W "$(_thermocontact_keys "$scene")" -S = -- "$current")
        return
    fi
    local key=""
    [ "$current" = "=" ] && [ "${COMP_WORDS[COMP_CWORD-2]}" = --set ] && key="$previous" && current=""
    [ "$previous" = "=" ] && [ "$before" = --set ] && key="${COMP_WORDS[COMP_CWORD-2]}"
    if [ -n "$key" ]; then
        # quotes are part of a value, and what the user typed of it may begin with the shell's own
        local values typed="${current#[\'\"]}"
        values="$(_thermocontact_values "$(_thermocontact_pattern "$key")")"
        for word in $values; do
            case "${word#\"}" in "${typed#\"}"*) COMPREPLY+=("'$word'") ;; esac
        done
        return
    fi

    case "$command:$previous" in
@option_values@
    esac
    case "$current" in
    -*) case "$command" in
@options@
        esac ;;
    *) case "$command" in
@arguments@
        esac ;;
    esac
    case "${COMPREPLY[*]}" in */) compopt -o nospace 2>/dev/null ;; esac
}

# The keys of a scene, with the names of its own boundaries and regions where the file on the line has some.
_thermocontact_keys() {
    local key kind name
    for key in @keys@; do
        case "$key" in
        *.NAME.*)
            kind="${key%%.*}"
            for name in $(_thermocontact_names "$kind" "$1"); do
                printf '%s\n' "$kind.$name.${key#*.NAME.}"
            done ;;
        *) printf '%s\n' "$key" ;;
        esac
    done
}

# Names of the tables [KIND.NAME...] in a scene file, sides of a rectangle and a box where there is no file.
_thermocontact_names() {
    local names=""
    [ -r "$2" ] && names="$(sed -n "s/^[[:space:]]*\[*$1\.\([A-Za-z0-9_-]*\).*/\1/p" "$2" | sort -u)"
    [ -z "$names" ] && [ "$1" = boundary ] && names="left right bottom top front back"
    printf '%s\n' $names
}

# boundary.NAME.traction of boundary.left.traction
_thermocontact_pattern() {
    printf '%s\n' "$1" | sed 's/^\(boundary\|region\)\.[^.]*\./\1.NAME./'
}

_thermocontact_values() {
    case "$1" in
@values@
    esac
}

complete -F _thermocontact thermocontact
"""


FOLDERS = 'compgen -d -S / -- "$current"'
REPLIES = {
    "SCENE": f"compgen -f -X '!*.toml' -- \"$current\"; {FOLDERS}",
    "CHECKPOINT": f"compgen -f -X '!*.h5' -- \"$current\"; {FOLDERS}",
    "FILE": 'compgen -f -- "$current"',
    "DIR": 'compgen -d -- "$current"',
}


def _reply(option: Option) -> str:
    if option.choices:
        words = f'compgen -W "{" ".join(option.choices)}" -- "$current"'
    else:
        words = REPLIES.get(option.awaits, ":")
    return f"mapfile -t COMPREPLY < <({words})"


def _option_values(command: Command) -> list[str]:
    return [
        f"    {command.name}:{name}) {_reply(option)}; return ;;"
        for option in command.flags
        for name in (option.names if option.value and option.awaits != "KEY=VALUE" else [])
    ]


def _names(command: Command) -> str:
    return " ".join(name for option in command.flags for name in option.names)


def completion(declared: Declared) -> str:
    """The script."""
    commands = declared.commands
    words = {
        "commands_pattern": "|".join(command.name for command in commands),
        "first": " ".join([command.name for command in commands] + [_names(declared.program)]),
        "option_values": "\n".join(line for command in commands for line in _option_values(command)),
        "options": "\n".join(
            f'        {command.name}) mapfile -t COMPREPLY < <(compgen -W "{_names(command)}" -- "$current") ;;'
            for command in commands
        ),
        "arguments": "\n".join(
            f"        {command.name}) {_reply(command.argument)} ;;"
            for command in commands
            if command.argument
        ),
        "keys": " ".join(key["key"] for key in declared.keys),
        "values": "\n".join(
            f"    {key}) printf '%s\\n' {' '.join(chr(39) + value + chr(39) for value in values)} ;;"
            for key, values in declared.values.items()
        ),
    }
    text = TEMPLATE
    for name, value in words.items():
        text = text.replace(f"@{name}@", value)
    return text
