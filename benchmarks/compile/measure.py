#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""What compiling costs: processor seconds and peak memory of the umbrella header, of each layer of headers, of scenes
that grow in nodes and in components, and of the examples; and the longest files of the last build of the tests."""
import argparse
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
layers = ["core", "topology", "linalg", "state", "context", "force", "mass", "constraint", "mapping", "collision", "solver",
          "lagrangian", "io", "engine", "control", "visual", "scene", "runtime"]
COMPILED = "#define SINEW_COMPILED\n"
optional = {"cholmod_solver.hpp", "convex.hpp", "contact_manifold.hpp", "hull_contacts.hpp", "hull_impact.hpp",
            "hull_ray.hpp", "moved_primitive.hpp", "convex_collision_model.hpp"}  # need a package


def layer(name):
    headers = sorted((root / "include/sinew" / name).glob("*.hpp"))
    return "".join(f"#include <sinew/{name}/{h.name}>\n" for h in headers if h.name not in optional)


def program(parts):
    return ("#include <sinew/sinew.hpp>\nusing namespace sinew;\nint main() {\n  Simulation sim{node<\"root\">(\n"
            "      EulerImplicitSolver{}, CGLinearSolver<>{},\n      " + ",\n      ".join(parts) +
            ")};\n  sim.init();\n  sim.animate(0.1);\n}\n")


def nodes(n):
    """n nodes below the root, each a body of its own."""
    return program(f'node<"body{i}">(MechanicalObject<Vec3d>{{}}, UniformMass<Vec3d>{{}}, StiffSpringForceField<Vec3d>{{}},\n'
                   f'          FixedConstraint<Vec3d>{{}})' for i in range(n))


def components(n):
    """A root with n components on one state: springs, and loads, of few types, as scenes have them."""
    return program(["MechanicalObject<Vec3d>{}", "UniformMass<Vec3d>{}"] +
                   [("StiffSpringForceField<Vec3d>{}", "ConstantForceField<Vec3d>{}")[i % 2] for i in range(n)])


def readme():
    page = (root / "README.md").read_text()
    return page.split("```cpp\n")[1].split("```")[0]


def subjects():
    """Names and sources; those with COMPILED see sinew::compiled."""
    yield "sinew.hpp alone", "#include <sinew/sinew.hpp>\n"
    yield "sinew.hpp, sinew::compiled", COMPILED + "#include <sinew/sinew.hpp>\n"
    for part in ("mechanics", "contact", "engines", "control", "lagrangian"):
        yield f"{part}.hpp alone", f"#include <sinew/{part}.hpp>\n"
        yield f"{part}.hpp, sinew::compiled", COMPILED + f"#include <sinew/{part}.hpp>\n"
    yield "README.md", readme()
    yield "README.md, sinew::compiled", COMPILED + readme()
    for name in layers:
        yield f"layer {name}", layer(name)
    for n in (1, 4, 16, 64):
        yield f"{n} nodes", nodes(n)
    for n in (4, 16, 64, 256):
        yield f"{n} components", components(n)
    yield "runtime scene, precompiled", root / "tests/install/consumer/scene.cpp"
    for name in ("one_tetrahedron", "string_on_rigid", "liver", "vitrectomy"):
        yield f"example {name}", root / f"examples/{name}/main.cpp"


def compile_once(compiler, flags, source):
    """Processor seconds of the user (of use on a machine that others use, too) and peak memory in MB."""
    if "clang" in compiler:
        flags = [*flags, "-fbracket-depth=1024"]  # by default 256: the components of a node are one fold
    command = [compiler, "-std=c++20", *flags, f"-I{root}/include", f"-I{root}/examples", "-isystem", "/usr/include/eigen3",
               "-c", str(source), "-o", "/dev/null"]
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"bench: {' '.join(command)} failed")
    return usage.ru_utime, usage.ru_maxrss / 1024


def examples(rounds=3, compiler="g++", level="-O2"):
    """Of headers and programs as users have them: header-only, and with sinew::compiled."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "subject.cpp"
        subjects = [(f"`{name}.hpp` alone", f"#include <sinew/{name}.hpp>\n") for name in ("sinew", "mechanics", "contact", "lagrangian")]
        subjects += [("the liver of README.md", readme())]
        subjects += [(f"`examples/{name}`", root / f"examples/{name}/main.cpp") for name in ("liver", "vitrectomy")]
        for name, subject in subjects:
            if isinstance(subject, str):
                source.write_text(subject)
            for compiled in (False, True):
                flags = [level, "-DSINEW_COMPILED"] if compiled else [level]
                runs = [compile_once(compiler, flags, source if isinstance(subject, str) else subject) for _ in range(rounds)]
                seconds, memory = (statistics.median(column) for column in zip(*runs))
                rows.append({"subject": name, "compiled": compiled, "compiler": compiler, "level": level, "cpu_s": seconds, "memory_mb": memory})
    return rows


def longest_of_tests(build, count=5):
    """The files of the tests that took longest, [s] of the clock, as ninja noted it at its last build."""
    log = build / ".ninja_log"
    if not log.exists():
        return []
    took = {}
    for line in log.read_text().splitlines()[1:]:
        start, end, _, name, *_ = line.split("\t")
        if name.startswith("tests/") and name.endswith(".o"):
            took[name] = (int(end) - int(start)) / 1000
    return sorted(took.items(), key=lambda item: -item[1])[:count]


def table(rounds=3, only="", compilers=("g++", "clang++"), levels=("-O0", "-O2"), build=root / "build/test-gcc"):
    columns = [(c, level) for c in compilers if shutil.which(c) for level in levels]
    print(f"\ncompiling: processor seconds, peak memory [MB], medians of {rounds}\n  {'':28}" +
          "".join(f"{c + ' ' + level:>18}" for c, level in columns), flush=True)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name, subject in subjects():
            if only not in name:
                continue
            source = subject
            if isinstance(subject, str):
                source = pathlib.Path(folder) / "subject.cpp"
                source.write_text(subject)
            print(f"  {name:28}", end="", flush=True)
            for compiler, level in columns:
                runs = [compile_once(compiler, [level], source) for _ in range(rounds)]
                seconds, memory = (statistics.median(column) for column in zip(*runs))
                print(f"{seconds:9.2f} s {memory:6.0f}", end=" ", flush=True)
                rows.append({"subject": name, "compiler": compiler, "level": level, "cpu_s": seconds, "memory_mb": memory})
            print(flush=True)
    longest = longest_of_tests(build)
    if longest and not only:
        print(f"  longest files of the tests at the last build in {build.name} [s of the clock]")
        for name, seconds in longest:
            print(f"    {seconds:7.1f}  {name}")
            rows.append({"subject": name, "wall_s": seconds})
    return rows


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="", help="subjects with this in their names")
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--compilers", nargs="+", default=["g++", "clang++"])
    parser.add_argument("--levels", nargs="+", default=["-O0", "-O2"])
    arguments = parser.parse_args()
    table(arguments.rounds, arguments.only, arguments.compilers, arguments.levels)
