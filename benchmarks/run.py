#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Runs the benchmarks and prints their tables; writes the figures to a JSON file, and a picture of them beside it.

Speed is given as a ratio of two programs that take turns on the same machine, as the median over the rounds. A body is
compared with the same scene in a yardstick program, where one is named: a C++ source that prints steps a second for
MESH STEPS. Where that is the one that SOFA was measured with, so are bodies, grids and small scenes with SOFA (table.py).
"""
import argparse
import json
import os
import pathlib
import platform
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent / "compile"))
import contact_table  # noqa: E402
import measure  # noqa: E402
import picture  # noqa: E402
import table  # noqa: E402
from tools import Yardstick, fail, output  # noqa: E402

TABLES = ["fem", "grids", "small", "accuracy", "roofline", "growth", "threads", "portability", "by-hand", "vitrectomy", "runtime", "families", "collision", "contact",
          "laparoscopy", "compile"]


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.processor()


def families(build, rounds):
    kinds = ["double", "double_one_by_one", "float", "float_one_by_one"]
    print(f"\nnanoseconds an element of a body of 1,331 points, medians of {rounds} rounds in turn")
    print(f"  {'':36} {'':18} {'double,':>10} {'double,':>10} {'float,':>10} {'float,':>10}")
    print(f"  {'family':36} {'operation':18} {'lanes':>10} {'one by one':>10} {'lanes':>10} {'one by one':>10}")
    rows = []
    for line in output(build / "bench_families", rounds).splitlines():
        family, operation, count, *times = line.split("; ")
        row = {"family": family, "operation": operation, "count": int(count)}
        row.update({kind: float(time) for kind, time in zip(kinds, times) if time != "-"})
        rows.append(row)
        print(f"  {family:36} {operation:18}" + "".join(f" {row[k]:10.2f}" if k in row else f" {'-':>10}" for k in kinds))
    return rows


def collision(build, rounds):
    rows = []
    for program, target in (("bench_collision", "this processor"), ("bench_collision_portable", "any x86-64, as the other two are")):
        print(f"\ncollision: microseconds of the processor a step, medians of {rounds} rounds in turn; Sinew compiled for {target}")
        print(f"  {'scene':22} {'boxes':>8} {'pairs':>7} {'Sinew':>10} {'Bullet':>10} {'FCL':>10}  ns a box")
        for line in output(build / program, rounds).splitlines():
            scene, boxes, pairs, *times = line.split("; ")
            row = {"scene": scene, "for": target, "boxes": int(boxes), "pairs": int(pairs)}
            row.update({name: float(time) for name, time in zip(("sinew", "bullet", "fcl"), times) if time != "-"})
            rows.append(row)
            print(f"  {scene:22} {boxes:>8} {pairs:>7}" + "".join(f" {row[k]:10.1f}" if k in row else f" {'-':>10}" for k in ("sinew", "bullet", "fcl"))
                  + f" {1000 * row['sinew'] / row['boxes']:9.1f}")
    return rows


# steps a second that Faure et al. 2007 give for their laparoscopy, on a processor of that time
PAPER_2007 = {"1800": 65, "30000": 4, "17x8x10": 110, "20x10x12": 67, "24x13x15": 37}


def laparoscopy(build, steps):
    print(f"\nlaparoscopy: steps a second over the first {steps} steps of the script (a tenth of them for 30000 tetrahedra)")
    print(f"  {'liver':16} {'paper 2007':>10} {'steps/s':>10} {'detection':>10} {'contacts':>10} {'the rest':>10}")
    rows = []
    for line in output(build / "bench_laparoscopy", steps).splitlines():
        model, resolution, *figures = line.split("; ")
        rate, detection, response, rest = (float(x) for x in figures)
        rows.append({"model": model, "resolution": resolution, "steps_per_second": rate, "paper": PAPER_2007[resolution],
                     "detection": detection, "response": response, "rest": rest})
        print(f"  {model + ' ' + resolution:16} {PAPER_2007[resolution]:10} {rate:10.1f}" + "".join(f" {100 * x:8.1f} %" for x in (detection, response, rest)))
    return rows


def main():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, default=here.parent / "build/bench", help="build folder of the benchmarks")
    parser.add_argument("--meshes", type=pathlib.Path, nargs="+", metavar="FILE", help="tetrahedral meshes (.msh); default: blocks made here")
    parser.add_argument("--yardstick", type=pathlib.Path, metavar="SOURCE", help="C++ source of a program to compare bodies with")
    parser.add_argument("--compiler", default="g++", help="what compiles the yardstick (default: g++)")
    parser.add_argument("--cells", type=int, nargs="+", default=[17, 55], metavar="N", help="cells along the cubes of the table of threads (default: 17 55)")
    parser.add_argument("--threads", type=int, nargs="+", metavar="N", help="numbers of threads in it (default: 1, 2, 4, ... all)")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--only", choices=TABLES, action="append", help="this table instead of all; may be repeated")
    parser.add_argument("--long", action="store_true", help="contact: also what takes minutes for one line")
    parser.add_argument("--json", type=pathlib.Path, default=pathlib.Path("out/bench.json"))
    arguments = parser.parse_args()
    if arguments.rounds < 1:
        fail(f"{arguments.rounds} rounds cannot be run; give --rounds at least 1")
    for mesh in arguments.meshes or []:
        if not mesh.is_file():
            fail(f"there is no mesh {mesh}; name files after --meshes")
    wanted = lambda *names: any(name in (arguments.only or TABLES) for name in names)
    build, rounds = arguments.build, arguments.rounds

    results = {"machine": processor(), "cores": os.cpu_count(), "rounds": rounds}
    print(f"machine: {results['machine']}, {results['cores']} cores, load {os.getloadavg()[0]:.1f}; one thread")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        yardstick = reference = None
        if wanted("fem", "accuracy"):
            meshes = table.meshes_of(arguments.meshes, folder)
        if arguments.yardstick and wanted("fem", "grids", "small"):
            yardstick = Yardstick(arguments.yardstick, arguments.compiler, folder)
            reference = table.Reference(yardstick, arguments.meshes or [], folder)
        if wanted("fem"):
            results["fem"] = table.fem(build, meshes, yardstick, reference, rounds)
        if wanted("grids"):
            results["grids"] = table.grids(build, reference, rounds)
        if wanted("small"):
            results["small"] = table.small(build, reference, rounds)
        if wanted("accuracy"):
            results["accuracy"] = table.accuracy(build, meshes, rounds)
        if wanted("roofline"):
            results["roofline"] = table.roofline(build, rounds)
        if wanted("growth"):
            results["growth"] = table.growth(build, rounds)
        if wanted("threads"):
            results["threads"] = table.threads(build, arguments.cells, arguments.threads)
        if wanted("contact"):
            results["contact"] = contact_table.contact(build, arguments.long)
        if wanted("portability"):
            results["portability"] = table.portability(build, rounds)
        if wanted("by-hand"):
            print("\ntyped scene against the same simulation by hand, medians of 21 rounds in turn")
            text = output(arguments.build / "bench_by_hand")
            print("  " + text.replace("\n", "\n  ").rstrip())
            results["by_hand"] = [
                {"name": line.split()[0], "ratio": float(re.search(r"ratio ([\d.]+)", line)[1])} for line in text.splitlines()
            ]
        if wanted("vitrectomy"):
            print(f"\nthe vitrectomy against the same by hand, medians of {arguments.rounds} rounds in turn")
            text = output(arguments.build / "bench_vitrectomy", arguments.rounds)
            print("  " + text.replace("\n", "\n  ").rstrip())
            results["vitrectomy"] = [float(ratio) for ratio in re.findall(r"ratio ([\d.]+)", text)]
        if wanted("runtime"):
            print("\nruntime tree against typed tree of the same scene, medians of 11 rounds in turn")
            text = output(arguments.build / "bench_runtime")
            print("  " + text.replace("\n", "\n  ").rstrip())
            results["runtime"] = [
                {"name": line[:34].strip(), "ratio": float(re.search(r"ratio ([\d.]+)", line)[1])} for line in text.splitlines()
            ]
        if wanted("families"):
            results["families"] = families(arguments.build, 2 * arguments.rounds + 1)
        if wanted("collision"):
            results["collision"] = collision(arguments.build, arguments.rounds)
        if wanted("laparoscopy"):
            results["laparoscopy"] = laparoscopy(arguments.build, 200 * arguments.rounds)
        if wanted("compile"):
            results["compile"] = measure.table()
    arguments.json.parent.mkdir(parents=True, exist_ok=True)
    arguments.json.write_text(json.dumps(results, indent=1))
    drawing = arguments.json.with_suffix(".svg")
    drawing.write_text(picture.svg(results))
    print(f"\nfigures written to {arguments.json}, a picture to {drawing}")


if __name__ == "__main__":
    main()
