#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""The man page of the program sinew, made of what it says of itself: man_page.py SINEW."""
import subprocess
import sys

import help_text


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def options(entries):
    for words, explanation in entries:
        yield ".TP\n.B " + escaped(words)
        yield escaped(explanation) if explanation else "\\&"


def main(program):
    top = help_text.read(program)
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
    lines = [f'.TH SINEW 1 "" "sinew {version}" "User Commands"', ".SH NAME", "sinew \\- simulate soft tissue, springs and rigid bodies",
             ".SH SYNOPSIS", ".B sinew\n.I COMMAND\n[options]", ".SH DESCRIPTION", *map(escaped, top.head)]
    lines += [".SH COMMANDS", *options(top.sections["Subcommands"])]
    for command, _ in top.sections["Subcommands"]:
        page = help_text.read(program, command)
        lines += [f".SH SINEW {command.upper()}", *map(escaped, page.head), ".PP\n.B " + escaped(page.usage)]
        for section, entries in page.sections.items():
            if entries:
                lines += [".SS " + section.upper(), *options(entries)]
        if page.foot:
            lines += [".PP", *map(escaped, page.foot)]
    lines += [".SH EXIT STATUS", *map(escaped, top.foot), ".SH SEE ALSO",
              "The package libsinew\\-dev has the library; its documentation says what scenes may have."]
    print("\n".join(lines))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("man_page.py: give it the program sinew")
    main(sys.argv[1])
