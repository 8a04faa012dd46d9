#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""What a class more costs sinew::standard: its sources are compiled with the registry as it is, and with copies of a force
field of its own law (FastTriangularBendingSprings over Vec3d, 130 lines) under other names. Prints processor seconds of each
source, and their difference for one class. Each source is compiled twice, without precompiled headers."""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
sources = sorted((root / "examples/sinew/standard").glob("*.cpp"))
once = {"init", "init_components", "init_states", "pattern", "read", "table", "change", "bake", "components"}  # CMake: at -O1


def with_copies(folder, count):
    """A folder whose <sinew/registry.hpp> has `count` classes more."""
    include = pathlib.Path(folder) / "sinew"
    include.mkdir()
    force = (root / "include/sinew/force/fast_triangular_bending_springs.hpp").read_text()
    registry = (root / "include/sinew/registry.hpp").read_text()
    includes, classes = "", ""
    for i in range(count):
        copy = force.replace("LinearBending", f"LinearBending{i}").replace("FastTriangularBendingSprings", f"ExtraForce{i}")
        (include / f"extra{i}.hpp").write_text(copy)
        includes += f"#include <sinew/extra{i}.hpp>\n"
        classes += f"ExtraForce{i}<Vec3d>, "
    registry = registry.replace("#include <sinew/sinew.hpp>\n", f"#include <sinew/sinew.hpp>\n{includes}")
    registry, found = re.subn(r"(struct Standard\s*: Registry<)", rf"\g<1>{classes}", registry)
    if found != 1:
        sys.exit("class_cost: the list Standard does not begin as this script expects it")
    (include / "registry.hpp").write_text(registry)
    return pathlib.Path(folder)


def seconds(include, source, compiler, flags):
    level = "-O1" if source.stem in once else "-O3"
    command = [compiler, "-std=c++20", level, "-DSINEW_COMPILED", *flags, f"-I{include}", f"-I{root}/include", "-isystem",
               "/usr/include/eigen3", "-c", str(source), "-o", "/dev/null"]
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"class_cost: {' '.join(command)} failed")
    return usage.ru_utime


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--classes", type=int, default=4, help="how many copies")
    parser.add_argument("--compiler", default="g++")
    parser.add_argument("--flags", nargs="*", default=["-march=native"])
    arguments = parser.parse_args()
    total = 0
    with tempfile.TemporaryDirectory() as plain, tempfile.TemporaryDirectory() as more:
        as_it_is, longer = with_copies(plain, 0), with_copies(more, arguments.classes)
        print(f"{'source':<20}{'as it is':>10}{'a class more':>14}  [s]", flush=True)
        for source in sources:
            # in turn, so that what else the machine does meets both
            without = seconds(as_it_is, source, arguments.compiler, arguments.flags)
            one = (seconds(longer, source, arguments.compiler, arguments.flags) - without) / arguments.classes
            total += one
            print(f"{source.stem:<20}{without:>10.1f}{one:>14.2f}", flush=True)
    print(f"{'a class':<30}{total:>14.2f}")


if __name__ == "__main__":
    main()
