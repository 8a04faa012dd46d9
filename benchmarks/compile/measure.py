#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Time and peak memory of compiling: the umbrella header alone, and each example."""
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

root = pathlib.Path(__file__).resolve().parents[2]

subjects = {
    "#include <sinew/sinew.hpp>": "#include <sinew/sinew.hpp>\n",
    "example string_on_rigid": (root / "examples/string_on_rigid/main.cpp"),
    "example one_tetrahedron": (root / "examples/one_tetrahedron/main.cpp"),
    "example liver": (root / "examples/liver/main.cpp"),
    "example vitrectomy": (root / "examples/vitrectomy/main.cpp"),
}


def compile_once(compiler, flags, source):
    """Seconds of processor and of wall time, and peak memory in MB, of one run of the compiler."""
    command = [compiler, "-std=c++20", *flags, f"-I{root}/include", f"-I{root}/examples", "-isystem", "/usr/include/eigen3",
               "-c", str(source), "-o", "/dev/null"]
    start = time.monotonic()
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"bench: {' '.join(command)} failed")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - start, usage.ru_maxrss / 1024


def table(rounds=3):
    rows = []
    print(f"\ncompiling at -O2 (median of {rounds}: processor seconds, wall seconds, peak memory)")
    with tempfile.TemporaryDirectory() as folder:
        for name, subject in subjects.items():
            source = subject
            if isinstance(subject, str):
                source = pathlib.Path(folder) / "subject.cpp"
                source.write_text(subject)
            for compiler in ("g++", "clang++"):
                if not shutil.which(compiler):
                    continue
                runs = [compile_once(compiler, ["-O2"], source) for _ in range(rounds)]
                cpu, wall, memory = (statistics.median(column) for column in zip(*runs))
                print(f"  {name:28} {compiler:8} {cpu:6.2f} s {wall:6.2f} s {memory:6.0f} MB")
                rows.append({"subject": name, "compiler": compiler, "cpu_s": cpu, "wall_s": wall, "memory_mb": memory})
    return rows


if __name__ == "__main__":
    table()
