#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""The man page of the program sinew, made of what it says of itself: man_page.py SINEW."""
import subprocess
import sys

import help_text


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def paragraph(lines):
    """Lines that stay lines."""
    yield "\n.br\n".join(map(escaped, lines))


def options(entries):
    for entry in entries:
        names = ", ".join(f"\\fB{escaped(name)}\\fR" for name in entry.names)
        yield ".TP\n" + names + (f" \\fI{escaped(entry.value)}\\fR" if entry.value else "")
        without = f" Not together with {', '.join(entry.excludes)}." if entry.excludes else ""
        end = "" if not entry.explanation or entry.explanation.endswith(".") else "."
        yield escaped(entry.explanation + end + without) or "\\&"


def main(program):
    top = help_text.read(program)
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
    lines = [f'.TH SINEW 1 "" "sinew {version}" "User Commands"', ".SH NAME", "sinew \\- simulate soft tissue, springs and rigid bodies",
             ".SH SYNOPSIS", ".B sinew\n.I COMMAND\n[options]", ".SH DESCRIPTION", *paragraph(top.head)]
    lines += [".SH COMMANDS", *options(top.sections["Subcommands"])]
    for command in (entry.names[0] for entry in top.sections["Subcommands"]):
        page = help_text.read(program, command)
        lines += [f".SH SINEW {command.upper()}", *paragraph(page.head), ".PP\n.B " + escaped(page.usage)]
        for section, entries in page.sections.items():
            if entries:
                lines += [".SS " + section.upper(), *options(entries)]
        if page.foot:
            lines += [".PP", *paragraph(page.foot)]
    lines += [".SH EXIT STATUS", *map(escaped, top.foot), ".SH SEE ALSO",
              "\\fBsinew list\\fR says what scenes may have. The package libsinew\\-dev has the library."]
    print("\n".join(lines))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("man_page.py: give it the program sinew")
    main(sys.argv[1])
