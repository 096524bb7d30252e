# SPDX-License-Identifier: Apache-2.0
"""Prints what makes a shell complete commands, flags and their values.

  source <(patina completion bash)                        in ~/.bashrc
  source <(patina completion zsh)                         in ~/.zshrc, after compinit
  patina completion zsh > ~/.zfunc/_patina                in a folder of $fpath
"""
import argparse
import shlex

from patina.cli import main

SHELLS = ("bash", "zsh")


def add_arguments(parser):
    parser.add_argument("shell", choices=SHELLS, metavar="|".join(SHELLS), help="the shell")


def run(arguments):
    print({"bash": _bash, "zsh": _zsh}[arguments.shell](table()))


def table():
    """:returns: command -> dict of flag -> (choices, text of --help), from the parsers that --help is made of; what stands
    first is listed under the command's own name"""
    found = {}
    for name in main.COMMANDS:
        parser = argparse.ArgumentParser(prog=f"patina {name}")
        main.module_of(name).add_arguments(parser)
        found[name] = {}
        for action in parser._actions:
            for flag in action.option_strings or [name]:
                found[name].setdefault(flag, (tuple(map(str, action.choices or ())),
                                              " ".join((action.help or "").replace("%%", "%").split())))
    return found


def _values(commands, line):
    return "\n".join(line.format(case=shlex.quote(f"{name} {flag}"), choices=" ".join(choices))
                     for name, flags in commands.items() for flag, (choices, _) in flags.items() if choices)


def _flags(found):
    return [(flag, text) for flag, (_, text) in found.items() if flag.startswith("-")]


def _bash(commands):
    flags = "\n".join(f"        {name}) words={shlex.quote(' '.join(flag for flag, _ in _flags(found)))} ;;"
                      for name, found in commands.items())
    return f"""_patina() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} words=
    if [ "$COMP_CWORD" -eq 1 ]; then
        words={shlex.quote(" ".join(commands))}
    else
        case "${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD-1]}}" in
{_values(commands, "        {case}) words='{choices}' ;;")}
        esac
        if [ -z "$words" ] && [ "${{current:0:1}}" = - ]; then case "${{COMP_WORDS[1]}}" in
{flags}
        esac; fi
    fi
    COMPREPLY=()
    [ -z "$words" ] || COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o bashdefault -o default -F _patina patina"""


def _zsh(commands):
    def listed(pairs):
        return " ".join(shlex.quote(f"{name}:{text}") for name, text in pairs)

    flags = "\n".join(f"        {name}) found=({listed(_flags(found))}) ;;" for name, found in commands.items())
    return f"""#compdef patina
_patina() {{
    local -a found
    if (( CURRENT == 2 )); then
        found=({listed(main.COMMANDS.items())})
        _describe command found
        return
    fi
    case "$words[2] $words[CURRENT-1]" in
{_values(commands, "        {case}) compadd {choices}; return ;;")}
    esac
    if [[ $words[CURRENT] == -* ]]; then
        case $words[2] in
{flags}
        esac
        _describe flag found
        return
    fi
    _files
}}
if [ "$funcstack[1]" = _patina ]; then _patina "$@"; else compdef _patina patina; fi"""
