#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Runs the benchmarks and prints their tables; writes the figures to a JSON file.

Speed is given as a ratio of two programs that take turns on the same machine, as the median over the rounds. The liver
scene is compared with the same scene in a yardstick program, where one is named: a C++ source that prints steps a second for
MESH STEPS.
"""
import argparse
import json
import os
import pathlib
import platform
import re
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent / "compile"))
import measure  # noqa: E402


def fail(message):
    print(f"bench: {message}", file=sys.stderr)
    sys.exit(1)


def output(*command):
    try:
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    except FileNotFoundError:
        fail(f"there is no {command[0]}; build the benchmarks with ./dev bench, or name their folder with --build")
    if done.returncode != 0:
        fail(f"{' '.join(str(c) for c in command)} failed:\n{done.stderr}")
    return done.stdout


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.processor()


def block_mesh(path, n):
    """A Gmsh 1 file of n x n x n cells, six tetrahedra a cell, for machines without a mesh of their own."""
    points = [(i / n, j / n, k / n) for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)]
    at = lambda i, j, k: 1 + i + (n + 1) * (j + (n + 1) * k)
    elements = []
    for i in range(n):
        for j in range(n):
            for k in range(n):
                for a, b in ((0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)):
                    corner, chain = [i, j, k], [at(i, j, k)]
                    for axis in (a, b, 3 - a - b):
                        corner[axis] += 1
                        chain.append(at(*corner))
                    if (a, b) in ((0, 2), (1, 0), (2, 1)):  # odd permutations are inside out
                        chain[2], chain[3] = chain[3], chain[2]
                    elements.append(chain)
    with open(path, "w") as file:
        print("$NOD", len(points), sep="\n", file=file)
        for number, p in enumerate(points, 1):
            print(number, *p, file=file)
        print("$ENDNOD", "$ELM", len(elements), sep="\n", file=file)
        for number, e in enumerate(elements, 1):
            print(number, 4, 1, 1, 4, *e, file=file)
        print("$ENDELM", file=file)


def fem(build, meshes, yardstick, rounds):
    rows = []
    for mesh in meshes:
        # rounds of about a second each
        first = output(build / "bench_fem", mesh, 5)
        slowest = min(float(line.split()[1]) for line in first.splitlines())
        steps = max(20, int(slowest / 2))
        speed, ratios, places = {}, {}, {}
        for _ in range(rounds):
            reference = None
            if yardstick:
                text = output(yardstick, mesh, steps)
                reference = float(re.search(r"([\d.]+) steps/s", text)[1])
                places["yardstick"] = [float(x) for x in re.search(r"at (\S+) (\S+) (\S+)", text).groups()]
                speed.setdefault("yardstick", []).append(reference)
            for line in output(build / "bench_fem", mesh, steps).splitlines():
                kind, rate, *place = line.split()
                speed.setdefault(kind, []).append(float(rate))
                places[kind] = [float(x) for x in place]
                if reference:
                    ratios.setdefault(kind, []).append(float(rate) / reference)
        print(f"\n{mesh.name}, {steps} steps a round, {rounds} rounds")
        for kind in speed:
            row = {"mesh": mesh.name, "kind": kind, "steps_per_second": statistics.median(speed[kind])}
            line = f"  {kind:22} {row['steps_per_second']:10.1f} steps/s"
            if kind in ratios:
                row["times_yardstick"] = statistics.median(ratios[kind])
                row["distance"] = max(abs(a - b) for a, b in zip(places[kind], places["yardstick"]))
                line += f"  {row['times_yardstick']:6.2f} x yardstick, point 100 differs by {row['distance']:.1e}"
            print(line)
            rows.append(row)
    return rows


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
    parser.add_argument("--meshes", type=pathlib.Path, nargs="*", help="tetrahedral meshes (.msh); default: blocks made here")
    parser.add_argument("--yardstick", type=pathlib.Path, help="C++ source of a program to compare the liver with")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--only", choices=["fem", "by-hand", "vitrectomy", "runtime", "families", "collision", "laparoscopy", "compile"], help="one table instead of all")
    parser.add_argument("--json", type=pathlib.Path, default=pathlib.Path("out/bench.json"))
    arguments = parser.parse_args()
    for mesh in arguments.meshes or []:
        if not mesh.is_file():
            fail(f"there is no mesh {mesh}; name a file after --meshes")

    results = {"machine": processor(), "cores": os.cpu_count()}
    print(f"machine: {results['machine']}, {results['cores']} cores; one thread")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        if arguments.only in (None, "fem"):
            yardstick = None
            if arguments.yardstick:
                yardstick = folder / "yardstick"
                output("g++", "-O3", "-march=native", "-ffast-math", "-std=c++20", "-I/usr/include/eigen3", arguments.yardstick, "-o", yardstick)
            meshes = arguments.meshes
            if not meshes:
                meshes = [folder / "block-6.msh", folder / "block-17.msh"]
                block_mesh(meshes[0], 6)
                block_mesh(meshes[1], 17)
            results["fem"] = fem(arguments.build, meshes, yardstick, arguments.rounds)
        if arguments.only in (None, "by-hand"):
            print("\ntyped scene against the same simulation by hand, medians of 21 rounds in turn")
            text = output(arguments.build / "bench_by_hand")
            print("  " + text.replace("\n", "\n  ").rstrip())
            results["by_hand"] = [
                {"name": line.split()[0], "ratio": float(re.search(r"ratio ([\d.]+)", line)[1])} for line in text.splitlines()
            ]
        if arguments.only in (None, "vitrectomy"):
            print(f"\nthe vitrectomy against the same by hand, medians of {arguments.rounds} rounds in turn")
            text = output(arguments.build / "bench_vitrectomy", arguments.rounds)
            print("  " + text.replace("\n", "\n  ").rstrip())
            results["vitrectomy"] = [float(ratio) for ratio in re.findall(r"ratio ([\d.]+)", text)]
        if arguments.only in (None, "runtime"):
            print("\nruntime tree against typed tree of the same scene, medians of 11 rounds in turn")
            text = output(arguments.build / "bench_runtime")
            print("  " + text.replace("\n", "\n  ").rstrip())
            results["runtime"] = [
                {"name": line[:34].strip(), "ratio": float(re.search(r"ratio ([\d.]+)", line)[1])} for line in text.splitlines()
            ]
        if arguments.only in (None, "families"):
            results["families"] = families(arguments.build, 2 * arguments.rounds + 1)
        if arguments.only in (None, "collision"):
            results["collision"] = collision(arguments.build, arguments.rounds)
        if arguments.only in (None, "laparoscopy"):
            results["laparoscopy"] = laparoscopy(arguments.build, 200 * arguments.rounds)
        if arguments.only in (None, "compile"):
            results["compile"] = measure.table()
    arguments.json.parent.mkdir(parents=True, exist_ok=True)
    arguments.json.write_text(json.dumps(results, indent=1))
    print(f"\nfigures written to {arguments.json}")


if __name__ == "__main__":
    main()
