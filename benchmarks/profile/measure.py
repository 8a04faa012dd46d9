#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""What timers cost a runtime tree that is not profiled: instructions of a step, by callgrind, with the headers as they are
and with a copy of them from which the timers are deleted.

benchmarks/profile/measure.py [COMPILER ARGUMENT...]        (g++ -O3 -DNDEBUG if none is given)
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tests" / "guard"))
from guard import instructions

SCENES = {"matrix_free": 2, "assembled": 3, "nodes": 3}
# (file, what is there, what there is without timers); more than these in all files are the lines `span = ... span(Phase::...)`
DELETED = [
    (r"runtime/scope.hpp", r"\n *Profile\* profile = nullptr;", ""),
    (r"runtime/scope.hpp", r", Profile\* timer = nullptr\)", ")"),
    (r"runtime/scope.hpp", r", profile\(timer\)", ""),
    (r"runtime/scope.hpp", r", profile\(top\.profile\)", ""),
    (r"runtime/scope.hpp", r"\n *if constexpr \(S::profiled\) profile = &typed\.profile\(\);", ""),
    (r"runtime/scope.hpp", r", profile\)", ")"),
    (r"runtime/scope.hpp", r"\n *if \(profile\) \[\[unlikely\]\]\n *return [^;]*;", ""),
    (r"runtime/scope.hpp", r"\n *if \(profile\) \[\[unlikely\]\]\n *entry[^;]*; \}\);", ""),
    (r"runtime/scope.hpp", r"\n *const Span span = visit\(entry\);", ""),
    (r"runtime/scope.hpp", r"\n  Span span\(Phase phase\)(?s:.*?)\n  template", "\n  template"),
    (r"runtime/scope.hpp", r"(static constexpr bool profiled = )true", r"\1false"),
]


def without_timers(include):
    found = 0
    for header in include.rglob("*.hpp"):
        text, n = re.subn(r"\n[^\n]*span = [^\n]*span\(Phase::[^\n]*", "", header.read_text())
        found += n
        header.write_text(text)
    for name, there, instead in DELETED:
        header = include / "sinew" / name
        text, n = re.subn(there, instead, header.read_text())
        if n == 0:
            sys.exit(f"{header}: nothing looks like {there} any more; correct {__file__}")
        header.write_text(text)
    if found < 15:
        sys.exit(f"only {found} timers were found in {include}: do they look different now?")


def main():
    compiler = sys.argv[1:] or ["g++", "-O3", "-DNDEBUG"]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        shutil.copytree(root / "include", folder / "include")
        without_timers(folder / "include")
        programs = {}
        for way, include in {"with": root / "include", "without": folder / "include"}.items():
            programs[way] = folder / way
            done = subprocess.run([*compiler, "-std=c++20", f"-I{include}", "-isystem", "/usr/include/eigen3",
                                   root / "benchmarks/profile/off.cpp", "-o", programs[way], "-pthread"], capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(f"{way} timers it does not compile:\n{done.stderr[:2000]}")
        print("| 512 points | instructions a step without timers | with timers that are off | more |\n| --- | --- | --- | --- |")
        for scene, steps in SCENES.items():
            count = {way: (instructions(str(p), scene, 2 * steps) - instructions(str(p), scene, steps)) / steps for way, p in programs.items()}
            print(f"| {scene} | {count['without']:,.0f} | {count['with']:,.0f} | {100 * (count['with'] / count['without'] - 1):.3f} % |")


if __name__ == "__main__":
    main()
