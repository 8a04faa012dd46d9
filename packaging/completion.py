#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Completion of the program sinew for bash, made of what it says of itself: completion.py SINEW."""
import sys

import help_text


def names(entries):
    return " ".join(name for entry in entries for name in entry.names)


def main(program):
    top = help_text.read(program)
    commands = [entry.names[0] for entry in top.sections["Subcommands"]]
    cases = [f'    {c}) options="{names(help_text.read(program, c).sections["Options"])}" ;;' for c in commands]
    print("\n".join([
        "# bash completion of sinew", "_sinew() {", "  local word=${COMP_WORDS[COMP_CWORD]} options", "  if [ \"$COMP_CWORD\" = 1 ]; then",
        f'    COMPREPLY=($(compgen -W "{" ".join(commands)} {names(top.sections["Options"])}" -- "$word"))', "    return", "  fi",
        "  case ${COMP_WORDS[1]} in", *cases, "  esac",
        '  if [ "${COMP_WORDS[1]}" = list ] && [[ $word != -* ]]; then',
        "    COMPREPLY=($(compgen -W \"$(\"${COMP_WORDS[0]}\" list 2>/dev/null | grep -oE '\\b[A-Z][A-Za-z0-9]+')\" -- \"$word\"))",
        '  elif [[ $word == -* ]]; then', '    COMPREPLY=($(compgen -W "$options" -- "$word"))', "  else",
        '    COMPREPLY=($(compgen -f -- "$word"))', "  fi", "}", "complete -o filenames -F _sinew sinew"]))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("completion.py: give it the program sinew")
    main(sys.argv[1])
