#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Strong and weak scaling of scenes in several processes, and a model of more ranks than this machine has cores for.

  benchmarks/mpi.py PROGRAM [--mpirun MPIRUN] [--ranks 1,2] [--cells 24] [--steps 5] [--table FILE]

PROGRAM is sinew-mpi. A block of corotational hexahedra takes implicit steps, each with 50 iterations of conjugate gradients. Of each rank
the program's --profile says how long its processor worked in a step without what it took to wait (W), how often ghost points came (E)
and in how many bytes (B), and how many sums over all ranks there were (S). So a step takes

  T = max over ranks of W + (E + S l(n)) t + B / b

where t is the time of a message between two processes, l(n) = ceil(log2 n) how often a sum waits for one, and b the bytes a second that a
rank sends while it receives as many; t and b are measured here by mpirun with two ranks, between processes of one machine: t as the shortest
of 500 sums, b as the shortest of 50 messages of 1 MB. What a network has instead is to be put in by --latency and --bandwidth. W of more
ranks than there are here is that of a part of the same number of points, and B that of its surface; strong scaling is that of a body of
--points, since a part of the block measured would be a few points:
  W = w points,  B = B(2) (points of a part / points of a part with 2 ranks)^(2/3) times its neighbours, six sides for two ranks' one
"""
import argparse
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests" / "mpi"))
import scenes


def block(n, length):
    """n[0] x n[1] x n[2] cells."""
    points, cells = scenes.grid([k + 1 for k in n], (0, 0, 0), [length * k / n[1] for k in n])
    held = " ".join(str(i) for i, p in enumerate(points) if p[0] == 0)
    return len(points), scenes.scene("0 -9.81 0", 0.01, f"""
  <Node name="block">
    <EulerImplicitSolver rayleighStiffness="0.01"/>
    <CGLinearSolver iterations="50" tolerance="0"/>
    <MeshTopology position="{scenes.words(points)}" hexahedra="{scenes.words(cells)}"/>
    <MechanicalObject/>
    <UniformMass totalMass="{len(points) * 1e-3}"/>
    <HexahedronFEMForceField youngModulus="1e5" poissonRatio="0.3"/>
    <FixedConstraint indices="{held}"/>
  </Node>
""")


def profile(arguments, path, ranks):
    done = subprocess.run([arguments.mpirun, "--oversubscribe", "--allow-run-as-root", "-n", str(ranks), arguments.program, "run", path, "--mpi",
                           "--steps", str(arguments.steps), "--profile"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    lines = []
    for line in done.stdout.splitlines():
        words = line.split()
        if len(words) == 10 and words[-1] == "%":
            lines.append(dict(zip(("rank", "points", "ghosts", "exchanges", "messages", "bytes", "sums", "work", "waiting"), map(float, words[:9]))))
    sum_us, megabyte_us = map(float, re.search(r"a sum over all ranks takes (\S+) us, and 1 MB to the next rank (\S+) us", done.stdout).groups())
    wall = 1e3 * float(re.search(r"steps of \S+ s in (\S+) s", done.stdout).group(1)) / arguments.steps
    return {"ranks": ranks, "work": max(l["work"] for l in lines), "points": sum(l["points"] for l in lines),
            "ghosts": max(l["ghosts"] for l in lines), "exchanges": lines[0]["exchanges"], "bytes": max(l["bytes"] for l in lines),
            "sums": lines[0]["sums"], "sum_us": sum_us, "bandwidth": 1e12 / megabyte_us, "wall": wall}


def modelled(one, two, ranks, points, latency, bandwidth):
    """Milliseconds of a step: work, messages, bytes."""
    part = points / ranks
    work = one["work"] / one["points"] * part
    if ranks == 1:
        return work, 0, 0
    sides = min(6, 2 * math.log2(ranks)) if ranks > 2 else 1
    sent = two["bytes"] * sides * (part / (two["points"] / 2)) ** (2 / 3)
    messages = (two["exchanges"] + two["sums"] * math.ceil(math.log2(ranks))) * latency * 1e-3
    return work, messages, 1e3 * sent / bandwidth


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--ranks", default="1,2")
    parser.add_argument("--cells", type=int, default=24, help="along each side of the block")
    parser.add_argument("--steps", type=int, default=5)
    parser.add_argument("--latency", type=float, help="of a message [us]; measured here unless it is given")
    parser.add_argument("--bandwidth", type=float, help="bytes a second between two ranks; measured here unless it is given")
    parser.add_argument("--points", type=float, default=1e8, help="of the body whose strong scaling is modelled")
    parser.add_argument("--table", help="file for the numbers (JSON)")
    arguments = parser.parse_args()
    counts = [int(n) for n in arguments.ranks.split(",")]
    strong, weak = [], []
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/block.scn"
        for ranks in counts:
            n = arguments.cells
            points, text = block((n, n, n), 1)
            pathlib.Path(path).write_text(text)
            strong.append(profile(arguments, path, ranks))
            points, text = block((n * ranks, n, n), 1)
            pathlib.Path(path).write_text(text)
            weak.append(profile(arguments, path, ranks))
    print("| block | ranks | points | ghosts of a rank | work [ms] | efficiency | exchanges | sums | sent [kB] |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for name, runs, per in (("strong", strong, True), ("weak", weak, False)):
        for r in runs:
            efficiency = runs[0]["work"] / r["work"] / (r["ranks"] if per else 1)
            print(f"| {name} | {r['ranks']} | {r['points']:.0f} | {r['ghosts']:.0f} | {r['work']:.1f} | {efficiency:.2f} | {r['exchanges']:.0f} | "
                  f"{r['sums']:.0f} | {r['bytes'] / 1e3:.0f} |")
    latency = arguments.latency or strong[-1]["sum_us"]
    bandwidth = arguments.bandwidth or strong[-1]["bandwidth"]
    model = []
    if len(counts) > 1:
        print(f"\nA message takes {latency:.2g} us, a second has room for {bandwidth:.3g} bytes. By the model:\n")
        print(f"| ranks | {arguments.points:.3g} points [ms] | speedup | weak [ms] | efficiency |\n| --- | --- | --- | --- | --- |")
        base = sum(modelled(strong[0], strong[1], 1, arguments.points, latency, bandwidth))
        one = sum(modelled(weak[0], weak[1], 1, weak[0]["points"], latency, bandwidth))
        for ranks in (1, 2, 4, 8, 16, 100, 1000, 10000):
            s = sum(modelled(strong[0], strong[1], ranks, arguments.points, latency, bandwidth))
            w = sum(modelled(weak[0], weak[1], ranks, weak[0]["points"] * ranks, latency, bandwidth))
            model.append({"ranks": ranks, "strong": s, "weak": w})
            print(f"| {ranks:,} | {s:.3g} | {base / s:.3g} | {w:.3g} | {one / w:.2f} |")
    if arguments.table:
        pathlib.Path(arguments.table).write_text(json.dumps({"strong": strong, "weak": weak, "model": model, "latency": latency, "bandwidth": bandwidth}, indent=1) + "\n")


if __name__ == "__main__":
    main()
