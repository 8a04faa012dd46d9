# SPDX-License-Identifier: BSL-1.0
"""What the program sinew says of itself by --help, taken apart."""
import dataclasses
import re
import subprocess


@dataclasses.dataclass
class Help:
    head: list  # lines above the usage
    usage: str
    sections: dict  # of each section ("Options", "Positionals", "Subcommands"): [(words, explanation)]
    foot: list  # lines below


def read(program, *command):
    """The help of the program, or of one of its commands."""
    text = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True).stdout
    help = Help([], "", {}, [])
    section = None
    for line in text.splitlines():
        if line.startswith("Usage: "):
            help.usage = line.removeprefix("Usage: ")
        elif re.fullmatch(r"(Options|Positionals|Subcommands):", line):
            section = help.sections.setdefault(line[:-1], [])
        elif section is not None and line.startswith("  "):
            words, _, explanation = line.strip().partition("  ")
            if line.startswith("   "):  # goes on
                before = section.pop()
                section.append((before[0], f"{before[1]} {line.strip()}".strip()))
            else:
                section.append((words, explanation.strip()))
        elif line.strip():
            (help.head if not help.usage else help.foot).append(line)
    return help
