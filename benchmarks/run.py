#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Runs the benchmarks and prints their tables; writes the figures to a JSON file. With --pages the tables and plots of pages
in docs/ are written, each page from this one run.

Programs that are compared take turns on the same machine; figures are medians over the rounds. A body is compared with the
same scene in a yardstick program, where one is named: a C++ source that prints steps a second for MESH STEPS. Where that is
the one that SOFA was measured with, so are bodies, grids and small scenes with SOFA (table.py).
"""
import argparse
import datetime
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent / "compile"))
import contact_table  # noqa: E402
import measure  # noqa: E402
import pages  # noqa: E402
import programs_table  # noqa: E402
import table  # noqa: E402
from tools import Yardstick, fail, spent  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
# the programs of each table, which must be there for a page
PROGRAMS = {"fem": ["fem"], "grids": ["grid"], "small": ["small"], "accuracy": ["accuracy"], "roofline": ["roofline"], "growth": ["growth"], "threads": ["threads"], "fluids": ["fluids"],
            "portability": ["portable_native", "portable_native_fast"], "by-hand": ["by_hand"], "vitrectomy": ["vitrectomy"], "runtime": ["runtime"],
            "families": ["families"], "collision": ["collision", "collision_portable"], "contact": ["contact_block", "contact_bodies", "contact_pile"],
            "siconos": ["siconos"], "laparoscopy": ["laparoscopy"], "bounds": ["laparoscopy_bounds"],
            "multigrid": ["linear"], "compile": []}
TABLES = list(PROGRAMS)
# what takes minutes and is no figure of speed, or needs a package, is measured when it is asked for
DEFAULT = [name for name in TABLES if name not in ("siconos", "bounds", "multigrid")]
WRITTEN = [name for name in pages.PAGES if name != "gpu"]


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.processor()


def said_by(*command):
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    return done.stdout.strip() if done.returncode == 0 else ""


def compiler_of(build):
    """The compiler of a build and its version, with what it was told, as cmake keeps them."""
    try:
        cache = dict(re.findall(r"^(\w+):\w+=(.*)$", (build / "CMakeCache.txt").read_text(), flags=re.M))
    except OSError as error:
        fail(f"{build} is no build folder ({error}); build the benchmarks with ./dev bench, or name their folder with --build")
    program = cache.get("CMAKE_CXX_COMPILER", "c++")
    flags = [cache.get("CMAKE_CXX_FLAGS", ""), cache.get("CMAKE_CXX_FLAGS_RELEASE", ""), "-march=native" if cache.get("SINEW_NATIVE") == "ON" else ""]
    kind = pathlib.Path(program).name.replace("c++", "g++") if "clang" not in program else "clang++"
    return " ".join(filter(None, [kind, said_by(program, "-dumpfullversion") or said_by(program, "-dumpversion"), *flags]))


def commit():
    """The commit of what was measured; what differs from it in pages alone does not count."""
    name = said_by("git", "describe", "--always", "--abbrev=7", "--exclude=*")
    changed = said_by("git", "status", "--porcelain", "--untracked-files=no", "--", "include", "src", "gpu", "examples", "benchmarks", "cmake", "CMakeLists.txt")
    return name + (" with changes" if changed else "") if name else "unknown"


def day():
    today = datetime.date.today()
    return f"{today.day} {today:%B %Y}"


def command_line(words):
    """What a run was called with, as ./dev has it; of paths the names of the files."""
    shown, skip = ["./dev bench"], False
    for word in words:
        if skip or word.startswith(("--build=", "--json=")):
            skip = False
        elif word in ("--build", "--json"):
            skip = True
        else:
            shown.append(pathlib.Path(word).name if "/" in word else word)
    return " ".join(shown)


class Runs:
    """What makes the rows of each table; meshes and the yardstick are made when the first one asks for them."""

    def __init__(self, arguments, folder):
        self.a, self.folder, self.build, self.rounds = arguments, folder, arguments.build, arguments.rounds
        self.made = {}

    def once(self, name, make):
        if name not in self.made:
            self.made[name] = make()
        return self.made[name]

    def meshes(self):
        return self.once("meshes", lambda: table.meshes_of(self.a.meshes, self.folder))

    def yardstick(self):
        return self.once("yardstick", lambda: Yardstick(self.a.yardstick, self.a.compiler, self.folder)) if self.a.yardstick else None

    def reference(self):
        return self.once("reference", lambda: table.Reference(self.yardstick(), self.a.meshes or [], self.folder)) if self.a.yardstick else None

    def rows(self, name):
        build, rounds = self.build, self.rounds
        makers = {
            "fem": lambda: table.fem(build, self.meshes(), self.yardstick(), self.reference(), rounds),
            "grids": lambda: table.grids(build, self.reference(), rounds),
            "small": lambda: table.small(build, self.reference(), rounds),
            # factors of the largest body take seconds
            "accuracy": lambda: table.accuracy(build, self.meshes()[:2], rounds),
            "roofline": lambda: table.roofline(build, rounds),
            "growth": lambda: table.growth(build, rounds),
            "threads": lambda: table.threads(build, self.a.cells, self.a.threads),
            "fluids": lambda: table.fluids(build),
            "portability": lambda: table.portability(build, rounds),
            "by-hand": lambda: programs_table.by_hand(build),
            "vitrectomy": lambda: programs_table.vitrectomy(build, rounds),
            "runtime": lambda: programs_table.runtime(build),
            "families": lambda: programs_table.families(build, 2 * rounds + 1),
            "collision": lambda: programs_table.collision(build, rounds),
            "contact": lambda: contact_table.contact(build, self.a.long),
            "siconos": lambda: programs_table.siconos(build),
            "laparoscopy": lambda: programs_table.laparoscopy(build, 1000),
            "bounds": lambda: programs_table.bounds(build, 40),
            "multigrid": lambda: table.multigrid(build, self.a.meshes or [], rounds),
            "compile": lambda: measure.examples(1),
        }
        return makers[name]()


def parsed():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, prog="./dev bench",
                                     epilog="On a machine with a GPU, './dev bench --gpu' measures and writes docs/gpu.md (benchmarks/gpu.py).")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/bench", help="build folder of the benchmarks")
    parser.add_argument("--meshes", type=pathlib.Path, nargs="+", metavar="FILE",
                        help="tetrahedral meshes (.msh), in place of those of the blocks made here that have their size")
    parser.add_argument("--yardstick", type=pathlib.Path, metavar="SOURCE", help="C++ source of a program to compare bodies with")
    parser.add_argument("--compiler", default="g++", help="what compiles the yardstick (default: g++)")
    parser.add_argument("--cells", type=int, nargs="+", default=[17, 55], metavar="N", help="cells along the cubes of the table of threads (default: 17 55)")
    parser.add_argument("--threads", type=int, nargs="+", metavar="N", help="numbers of threads in it (default: 1, 2, 4, ... all)")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", choices=TABLES, action="append", help="this table instead of all; may be repeated")
    parser.add_argument("--pages", nargs="*", metavar="PAGE", help=f"measure all tables of these pages and write them (default: all of {', '.join(WRITTEN)})")
    parser.add_argument("--long", action="store_true", help="contact: also what takes minutes for one line")
    parser.add_argument("--json", type=pathlib.Path, default=pathlib.Path("out/bench.json"))
    a = parser.parse_args()
    if a.rounds < 1:
        fail(f"{a.rounds} rounds cannot be run; give --rounds at least 1")
    for mesh in a.meshes or []:
        if not mesh.is_file():
            fail(f"there is no mesh {mesh}; name files after --meshes")
    if a.pages is not None:
        if a.only:
            fail("a page is of one run of all its tables; leave --only out to write pages, or --pages to print a table")
        a.pages = a.pages or WRITTEN
        for page in a.pages:
            if page not in WRITTEN:
                fail(f"there is no page '{page}' to write; name some of {', '.join(WRITTEN)}" +
                     (" (docs/gpu.md is written by --gpu)" if page == "gpu" else ""))
    return a


def main():
    arguments = parsed()
    wanted = arguments.only or DEFAULT
    if arguments.pages:
        wanted = [name for name in TABLES if any(name in map(pages.source, pages.PAGES[page]) for page in arguments.pages)]
        missing = [f"bench_{program}" for name in wanted for program in PROGRAMS[name] if not (arguments.build / f"bench_{program}").is_file()]
        if missing:
            fail(f"pages need all of their benchmarks, but {arguments.build} has no {', '.join(missing)}; ./dev bench builds what the packages "
                 "that are installed allow (Debian: libbullet-dev libfcl-dev libccd-dev libsiconos-numerics-dev python3-pysph catch2)")
        for page in arguments.pages:
            pages.check_blocks(page, (pages.DOCS / f"{page}.md").read_text())
    run = {"date": day(), "commit": commit(), "command": command_line(sys.argv[1:]), "machine": f"{processor()}, {os.cpu_count()} cores",
           "compiler": compiler_of(arguments.build), "rounds": arguments.rounds, "load": [os.getloadavg()[0]], "seconds": {}}
    results = {"run": run}
    print(f"{run['machine']}, {run['compiler']}, load {run['load'][0]:.1f}; rounds: {run['rounds']}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(arguments, pathlib.Path(folder))
        for name in wanted:
            began = spent()
            results[name] = runs.rows(name)
            run["seconds"][name] = round(spent() - began, 1)
            if results[name]:
                print(f"\n{name}, measured in {run['seconds'][name]:.0f} s of the processor\n\n{pages.TABLES[name](results[name])}", flush=True)
    run["load"].append(os.getloadavg()[0])
    arguments.json.parent.mkdir(parents=True, exist_ok=True)
    arguments.json.write_text(pages.record(results))
    print(f"\nall of it took {sum(run['seconds'].values()):.0f} s of the processor; figures written to {arguments.json}")
    for page in arguments.pages or []:
        # only some tables are made in rounds
        of_page = run if page in ("performance", "families", "vitrectomy", "multigrid") else {key: value for key, value in run.items() if key != "rounds"}
        sources = dict.fromkeys(map(pages.source, pages.PAGES[page]))
        seconds = {name: run["seconds"][name] for name in sources}
        pages.write(page, {"run": of_page | {"seconds": seconds}} | {name: results[name] for name in sources})
        print(f"docs/{page}.md and its plots are written")


if __name__ == "__main__":
    main()
