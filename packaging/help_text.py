# SPDX-License-Identifier: BSL-1.0
"""What the program sinew says of itself by --help, taken apart."""
import dataclasses
import re
import subprocess


COLUMN = 30  # where explanations begin; longer words have theirs on the next line


@dataclasses.dataclass
class Entry:
    names: list  # of an option ["-h", "--help"], otherwise one word
    value: str  # what follows the name: "SECONDS"
    excludes: list  # names that cannot stand beside it
    explanation: str


def entry(line):
    """One line of a section: names, value, what it excludes, and, from the column on, the explanation."""
    words, explanation = line[:COLUMN], line[COLUMN:]
    if not words.endswith(" ") or words.endswith(" Excludes: ") or explanation.startswith(("--", "...")):
        words, explanation = line, ""
    words, _, excludes = words.strip().partition(" Excludes: ")
    names, _, value = words.removesuffix(" REQUIRED").partition(" ")
    return Entry(names.split(","), value, excludes.split(), explanation.strip())


@dataclasses.dataclass
class Help:
    head: list  # lines above the usage
    usage: str
    sections: dict  # of each section ("Options", "Positionals", "Subcommands"), its entries
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
            if line.startswith("   "):  # goes on
                section[-1].explanation = f"{section[-1].explanation} {line.strip()}".strip()
            else:
                section.append(entry(line))
        elif not line.strip():
            section = None
        else:
            (help.head if not help.usage else help.foot).append(line)
    return help
