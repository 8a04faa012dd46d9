# SPDX-License-Identifier: BSL-1.0
"""Applies the diffs of a Markdown file to a copy of the tree: apply.py CONTRIBUTING.md FOLDER.

A hunk is found by its lines, not by numbers: those that are there (' ', '-') must follow one another in the file, once."""
import pathlib
import re
import sys


def apply(lines, top):
    path, hunks = None, []
    for line in lines + ["+++ "]:
        if line.startswith("+++ "):
            if path:
                write(top / path, hunks)
            path, hunks = line[4:].strip(), []
        elif line.startswith("@@"):
            hunks.append([])
        elif not line.startswith("---"):
            hunks = hunks or [[]]
            hunks[-1].append(line or " ")


def write(path, hunks):
    old = path.read_text() if path.exists() else ""
    for hunk in hunks:
        before = "".join(line[1:] + "\n" for line in hunk if line[0] in " -")
        after = "".join(line[1:] + "\n" for line in hunk if line[0] in " +")
        if before and old.count(before) != 1:
            sys.exit(f"CONTRIBUTING.md: {path.name} has {old.count(before)} times what a diff changes:\n{before}")
        old = old.replace(before, after) if before else old + after
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(old)


text, top = pathlib.Path(sys.argv[1]).read_text(), pathlib.Path(sys.argv[2])
for diff in re.findall(r"^```diff\n(.*?)^```$", text, re.S | re.M):
    apply(diff.splitlines(), top)
