# SPDX-License-Identifier: BSL-1.0
"""Speed against a yardstick and against SOFA, time to one accuracy, shares of what the processor can do, growth with the size,
threads, and builds for other processors. Each function runs its programs and returns the rows of its table; pages.py writes it."""
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from tools import block_mesh, fail, mesh_size, output, programs

# SOFA v26 (-O3 -march=native, double, one thread), in times of the steps a second that the yardstick makes with
# liver2.msh: measured on one machine in one run. By tetrahedra, by grid, by scene
SOFA_FEM = {596: 0.94, 1493: 0.395, 29478: 0.0202}
SOFA_GRID = {"17x8x10": 0.131, "20x10x12": 0.0735, "24x13x15": 0.0368}
SOFA_SMALL = {"tetrahedron": 15.5, "pendulum": 19.3}
# what is aimed at, in times SOFA
AIM_FEM, AIM_FEM_FLOAT, AIM_GRID, AIM_SMALL = 8, 10, 10, 50
LIVER2 = (507, 1493)
# blocks of about the sizes of the meshes that SOFA was measured with, in cells
BLOCKS = {"block-600": (5, 5, 4), "block-1500": (25, 5, 2), "block-29478": (17, 17, 17)}


def nearest(sizes, size):
    """The one of `sizes` that is within 5 % of a size, or None."""
    return next((known for known in sizes if abs(known - size) < 0.05 * known), None)


def meshes_of(named, folder):
    """(file, points, tetrahedra) of the meshes that are named, and of blocks of the sizes that these leave out."""
    found = []
    for mesh in named or []:
        size = mesh_size(mesh)
        if not size:
            fail(f"{mesh} has no nodes and elements of Gmsh's versions 1 or 2; name such a file after --meshes")
        found.append((mesh, *size))
    for name, cells in BLOCKS.items():
        if not any(nearest(SOFA_FEM, tetrahedra) == nearest(SOFA_FEM, 6 * math.prod(cells)) for _, _, tetrahedra in found):
            mesh = block_mesh(folder / f"{name}.msh", *cells)
            found.append((mesh, *mesh_size(mesh)))
    return sorted(found, key=lambda mesh: mesh[2])


class Reference:
    """The speed of the yardstick with liver2.msh, or with a block of that size, from which that of SOFA follows."""

    def __init__(self, yardstick, meshes, folder):
        self.yardstick, self.mesh = yardstick, None
        for mesh in meshes:
            if yardstick.run(mesh, 1)[:2] == LIVER2:
                self.mesh = mesh
        if not self.mesh:
            self.mesh = block_mesh(folder / "reference.msh", *BLOCKS["block-1500"])
            print("liver2.msh (507 points, 1,493 tetrahedra) is not among the meshes: SOFA's line is from a block of 1,500, and rough")
        self.steps = max(20, int(self.yardstick.run(self.mesh, 50)[2] / 2))

    def __call__(self):
        return self.yardstick.run(self.mesh, self.steps)[2]


def in_turn(command, rounds, reference=None, other=None):
    """Runs a program that takes a number of steps last and prints `kind rate ...` a line, in rounds, after the reference and another program.

    Returns for each kind its row: median rate, rate by that of the reference round by round, by that of the other, and what
    else it printed last; and the rate of the other.
    """
    first = output(*command, 5)
    steps = max(20, int(min(float(line.split()[1]) for line in first.splitlines()) / 2))
    rates, by_reference, by_other, rest, others = {}, {}, {}, {}, []
    for _ in range(rounds):
        base = reference() if reference else None
        if other:
            others.append(other(steps))
        for line in output(*command, steps).splitlines():
            kind, rate, *rest[kind] = line.split()
            rates.setdefault(kind, []).append(float(rate))
            if base:
                by_reference.setdefault(kind, []).append(float(rate) / base)
            if other:
                by_other.setdefault(kind, []).append(float(rate) / others[-1][2])
    median = statistics.median
    rows = [{"kind": kind, "steps_per_second": median(rates[kind]),
             "by_reference": median(by_reference[kind]) if reference else None,
             "by_other": median(by_other[kind]) if other else None,
             "place": [float(x) for x in rest[kind]]} for kind in rates]
    return rows, others


def against_sofa(row, factor, aim):
    """Adds how a row compares with SOFA, where that can be told."""
    row["aim"] = aim
    if factor and row["by_reference"]:
        row["times_sofa"] = row["by_reference"] / factor
    return row


def distance(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def fem(build, meshes, yardstick, reference, rounds):
    all_rows = []
    for mesh, points, tetrahedra in meshes:
        output(build / "bench_fem", mesh, 1)  # says what is wrong with a mesh
        rows, others = in_turn([build / "bench_fem", mesh], rounds, reference, (lambda steps: yardstick.run(mesh, steps)) if yardstick else None)
        size = {"points": points, "tetrahedra": tetrahedra}
        if others:
            all_rows.append(size | {"kind": "yardstick", "steps_per_second": statistics.median(o[2] for o in others)})
        factor = SOFA_FEM.get(nearest(SOFA_FEM, tetrahedra))
        for row in rows:
            against_sofa(row, factor, AIM_FEM_FLOAT if row["kind"].startswith("float") else AIM_FEM)
            row |= size | {"times_yardstick": row["by_other"]}
            if others:
                row["distance"] = distance(row["place"], others[-1][3])
                if row["kind"] == "double" and row["distance"] > 1e-6:
                    fail(f"{mesh}: point 100 is {row['distance']:.1e} m from that of the yardstick; one of the two is another scene")
            all_rows.append(row)
    return all_rows


def grids(build, reference, rounds):
    all_rows = []
    for name, factor in SOFA_GRID.items():
        rows, _ = in_turn([build / "bench_grid", *name.split("x")], rounds, reference)
        for row in rows:
            against_sofa(row, factor, AIM_GRID)
            row |= {"grid": name, "distance": distance(row["place"], rows[0]["place"])}
            all_rows.append(row)
    return all_rows


def small(build, reference, rounds):
    rows, _ = in_turn([build / "bench_small"], rounds, reference)
    return [against_sofa(row, SOFA_SMALL[row["kind"].split("-")[0]], AIM_SMALL) for row in rows]


def accuracy(build, meshes, rounds):
    rows = []
    for mesh, points, tetrahedra in meshes:
        for young in (3000, 300000):
            for line in output(build / "bench_accuracy", mesh, young, rounds).splitlines():
                name, seconds, iterations, off = line.split()
                rows.append({"points": points, "tetrahedra": tetrahedra, "young": young, "solver": name, "seconds": float(seconds),
                             "iterations": float(iterations), "distance": float(off)})
    return rows


# cells along the cube, and what it is of
SYSTEMS = ((6, "plain"), (17, "plain"), (37, "plain"), (55, "plain"), (17, "contrast"), (37, "contrast"), (17, "incompressible"), (37, "incompressible"))


def multigrid(build, meshes, rounds, systems=SYSTEMS):
    rows = []
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    for what, kind in (*systems, *((mesh, "plain") for mesh in meshes)):
        large = isinstance(what, int) and what > 20
        size, *lines = [line.split() for line in output(build / "bench_linear", what, 1 if large else rounds, kind).splitlines()]
        of = {"points": int(size[0]), "tetrahedra": int(size[1]), "kind": kind} | ({} if isinstance(what, int) else {"mesh": pathlib.Path(what).stem})
        for name, *figures in lines:
            if name.startswith("steps-"):
                rows.append(of | {"solver": name, "steps_per_second": float(figures[0]), "iterations": float(figures[1])})
            else:
                rows.append(of | {"solver": name, "set_up": float(figures[0]), "solve": float(figures[1]), "iterations": int(figures[2]), "residual": float(figures[3])})
    return rows


def roofline(build, rounds, sizes=(17, 55)):
    rows = []
    for cells in sizes:
        first, *found = [line.split() for line in output(build / "bench_roofline", cells, rounds).splitlines()]
        peak = float(first[1])
        for name, *figures in found:
            seconds, flops, size, bandwidth = (float(x) for x in figures)
            of_memory, of_peak = size / seconds / bandwidth, flops / seconds / peak
            rows.append({"tetrahedra": 6 * cells**3, "loop": name, "seconds": seconds, "flops": flops, "bytes": size, "bandwidth": bandwidth, "peak": peak,
                         "share": max(of_memory, of_peak), "bound": "memory" if of_memory > of_peak else "peak"})
    return rows


def growth(build, rounds, sizes=(6, 12, 26, 55)):
    rows = []
    for cells in sizes:
        runs = [[float(x) for x in output(build / "bench_growth", cells).split()] for _ in range(rounds if cells < 30 else 1)]
        n, points, step, iteration, resident, most, arrays, least = (statistics.median(column) for column in zip(*runs))
        rows.append({"tetrahedra": n, "points": points, "step": step, "iteration": iteration, "resident": resident, "most": most, "arrays": arrays, "least": least})
    return rows


def threads(build, cells, counts, seconds=1):
    if not counts:
        most = len(os.sched_getaffinity(0))
        counts = sorted({1, most, *(2**k for k in range(9) if 2**k < most)})
    rows = []
    for size in cells:
        found = [line.split() for line in output(build / "bench_threads", size, seconds, *counts).splitlines()]
        first = {}
        for kind, tetrahedra, count, time, bits in found:
            count, time = int(count), float(time)
            first.setdefault(kind, (count * time, bits))
            speedup = first[kind][0] / time
            rows.append({"tetrahedra": int(tetrahedra), "kind": kind, "threads": count, "step": time, "speedup": speedup, "same_bits": bits == first[kind][1]})
    if not all(row["same_bits"] for row in rows):
        fail("positions after the same steps differ between numbers of threads; this is a mistake in Sinew")
    return rows


def pysph(size, seconds, counts):
    """The lines of run/fluids_pysph.py, one a number of threads, where a Python is found that has PySPH."""
    python = next((p for p in dict.fromkeys((sys.executable, "/usr/bin/python3")) if subprocess.run([p, "-c", "import pysph"], capture_output=True).returncode == 0), None)
    if not python:
        print("\nno PySPH (Debian: python3-pysph): none to compare")
        return []
    lines = []
    with tempfile.TemporaryDirectory() as home:  # of what PySPH compiles
        for count in counts:
            said = output("env", f"HOME={home}", f"OMP_NUM_THREADS={count}", python, pathlib.Path(__file__).parent / "run/fluids_pysph.py", size, seconds)
            lines.append(next(line.split() for line in said.splitlines() if line.startswith("pysph ")))
    return lines


def splishsplash(build, size, seconds, counts):
    """The lines of run/fluids_splishsplash.cpp, where it was built."""
    program = build / "bench_fluids_splishsplash"
    if not program.is_file():
        print("\nno SPlisHSPlasH (cmake -DSINEW_SPLISHSPLASH=FOLDER): none to compare")
        return []
    return [line.split() for line in output(program, size, seconds, *counts).splitlines() if line.startswith("splishsplash ")]


FLUIDS = (("sph", 10000), ("pysph", 10000), ("sph", 100000), ("sphf", 100000), ("sph", 1000000), ("dfsph", 10000), ("dfsph", 100000), ("splishsplash", 100000), ("grid", 32), ("grid", 64), ("grid", 128))


def fluids(build, cases=FLUIDS, seconds=3):
    counts = sorted({1, len(os.sched_getaffinity(0))})
    rows = []
    for kind, size in cases:
        if kind == "pysph":
            found = pysph(size, seconds, counts)
        elif kind == "splishsplash":
            found = splishsplash(build, size, seconds, counts)
        else:
            found = [line.split() for line in output(build / "bench_fluids", kind, size, seconds, *counts).splitlines()]
        for name, parts, count, time, substeps, iterations, bits in found:
            rows.append({"kind": name, "parts": int(parts), "threads": int(count), "step": float(time), "substeps": int(substeps), "iterations": int(iterations),
                         "same_bits": bits == found[0][-1]})
    if not all(row["same_bits"] for row in rows):
        fail("fluids after the same steps differ between numbers of threads; this is a mistake in Sinew")
    return rows


# levels of x86-64: what /proc/cpuinfo lists for those that have them
LEVELS = {"v2": {"sse4_2", "ssse3", "popcnt", "cx16"}, "v3": {"avx2", "bmi1", "bmi2", "f16c", "fma", "movbe"},
          "v4": {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"}}
# how far builds may be apart after 20 steps [m]: rounding was seen to make 1e-13 and 3e-5
APART = {"double": 1e-10, "float": 1e-3}


def portability(build, rounds):
    flags = set()
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("flags"):
            flags = set(line.split(":")[1].split())
    usable, has = [], True
    for level, needed in LEVELS.items():
        has = has and needed <= flags
        if has:
            usable.append(level)
        else:
            print(f"\nthis processor is no x86-64-{level}: that build is left out")
    kinds = programs(build, [f"bench_portable_{kind}" for kind in (*usable, "native", "native_fast")])
    if len(kinds) < 2:
        print(f"\nno builds for levels of x86-64 in {build}: none to compare")
        return []
    speed, places, registers = {}, {}, {}
    for _ in range(rounds):
        for program in kinds:
            kind = program.removeprefix("bench_portable_")
            for line in output(build / program, 10, 60).splitlines():
                first, *rest = line.split()
                if first == "bytes":
                    registers[kind] = int(rest[0])
                elif first == "at":
                    places[kind, rest[0]] = [float(x) for x in rest[1:]]
                else:
                    speed.setdefault((first, kind), []).append(float(rest[0]))
    names = [program.removeprefix("bench_portable_") for program in kinds]
    rows = []
    for scene in dict.fromkeys(scene for scene, _ in speed):
        for kind in names:
            off = distance(places[kind, scene], places[names[0], scene])
            if off > APART["float" if "float" in scene else "double"]:
                fail(f"{scene}: the build for {kind} is {off:.1e} m away from that for {names[0]}")
            rows.append({"scene": scene, "build": kind, "register_bytes": registers[kind], "steps_per_second": statistics.median(speed[scene, kind]),
                         "distance": off})
    return rows
