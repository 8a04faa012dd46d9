#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""What packages have beside headers, packages.py ROOT SINEW: the man page and completion of the program SINEW name all its options, and
the recipes are of the version of the headers."""
import ast
import json
import pathlib
import re
import subprocess
import sys

root, program = pathlib.Path(sys.argv[1]), sys.argv[2]
sys.path.insert(0, str(root / "packaging"))
sys.dont_write_bytecode = True
import help_text  # noqa: E402

mistakes = []


def check(right, message):
    if not right:
        mistakes.append(message)


def output(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, check=True, **options).stdout


# lines as CLI11 writes them, with words that end before, at and behind the column of explanations
for line, entry in {
    "  -h,--help                   Print": help_text.Entry(["-h", "--help"], "", [], "Print"),
    '  --camera "X Y Z  X Y Z"     Where': help_text.Entry(["--camera"], '"X Y Z  X Y Z"', [], "Where"),
    "  --profile Excludes: --quiet Print": help_text.Entry(["--profile"], "", ["--quiet"], "Print"),
    "  --quiet Excludes: --profile --json": help_text.Entry(["--quiet"], "", ["--profile", "--json"], ""),
    "  --markdown FOLDER Excludes: component": help_text.Entry(["--markdown"], "FOLDER", ["component"], ""),
    "  --set PATH.ATTRIBUTE=VALUE ...": help_text.Entry(["--set"], "PATH.ATTRIBUTE=VALUE ...", [], ""),
    "  --set PATH.ATTRIBUTE=VALUES ...": help_text.Entry(["--set"], "PATH.ATTRIBUTE=VALUES ...", [], ""),
    "  scene FILE REQUIRED         Scene file": help_text.Entry(["scene"], "FILE", [], "Scene file"),
    "  --threads N": help_text.Entry(["--threads"], "N", [], ""),
}.items():
    check(help_text.entry(line) == entry, f"'{line}' is read as {help_text.entry(line)}")

# each name that the help has between "Options:" and the next empty line, found without help_text
page = output(sys.executable, root / "packaging/man_page.py", program).replace("\\-", "-")
completion = output(sys.executable, root / "packaging/completion.py", program)


def completed(*words):
    """What bash offers for the last of the words."""
    script = completion + 'COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _sinew; printf "%s\\n" "${COMPREPLY[@]}"'
    return output("bash", "-c", script, "bash", *words).split()


commands = re.findall(r"^  (\w+) ", output(program, "--help").partition("Subcommands:")[2], re.MULTILINE)
check(set(commands) >= {"run", "view", "serve", "check", "list", "bake", "compare", "sweep"}, f"the program has only the commands {commands}")
check(set(commands) <= set(completed(program, "")), f"bash completes {completed(program, '')} as commands, of {commands}")
for command in commands:
    section = page.partition(f"\n.SH SINEW {command.upper()}\n")[2].partition("\n.SH ")[0]
    check(section, f"the man page has no section of {command}")
    help = output(program, command, "--help")
    names = re.findall(r"(?:^  |,)(-[\w-]+)", help.partition("\nOptions:\n")[2].partition("\n\n")[0], re.MULTILINE)
    check("--help" in names, f"no options were found in the help of {command}")
    for name in names:
        check(f"\\fB{name}\\fR" in section, f"the man page has no {name} of {command}")
        check(name in completed(program, command, "-"), f"bash does not complete {name} of {command}")
    for line in section.splitlines():
        check("Excludes:" not in line and "REQUIRED" not in line, f"the man page has the line '{line}' in {command}")
check("MechanicalObject" in completed(program, "list", "Mech"), "bash does not complete components")

# one version
header = (root / "include/sinew/version.hpp").read_text(encoding="utf-8")
version = ".".join(re.findall(r"define SINEW_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))
check(re.fullmatch(r"\d+\.\d+\.\d+", version), f"include/sinew/version.hpp has the version '{version}'")
port = json.loads((root / "packaging/vcpkg/sinew/vcpkg.json").read_text(encoding="utf-8"))
check(port["version"] == version, f"packaging/vcpkg/sinew/vcpkg.json has the version {port['version']}, the headers {version}")
changes = (root / "packaging/debian/changelog").read_text(encoding="utf-8")
check(changes.startswith(f"sinew ({version}) "), f"packaging/debian/changelog begins with another version than {version}")
for recipe in (root / "packaging/conan").rglob("conanfile.py"):
    ast.parse(recipe.read_text(encoding="utf-8"), str(recipe))

print("\n".join(mistakes) or "the packages are as they should be")
sys.exit(bool(mistakes))
