#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Runs the benchmarks of a GPU, prints their tables, and writes docs/gpu.md with its plots from this one run; what was
measured goes to a JSON file, too. It needs the programs gpu_scenes, gpu_contact, gpu_fluids, gpu_multigrid and gpu_devices and a GPU of
NVIDIA; with two of them it measures what several GPUs do, too. --several measures these and
multigrid alone, and writes no page."""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import pages
import table
from run import ROOT, command_line, commit, day, said_by
from tools import fail, output

# the scenes of gpu_scenes; bodies of 600 and 1,500 tetrahedra are meshes, which --meshes may name
SCENES = [("grid 17x8x10", "grid 17 8 10"), ("grid 20x10x12", "grid 20 10 12"), ("grid 24x13x15", "grid 24 13 15"), ("29,478 tetrahedra", "block 17"),
          ("29,478 hyperelastic tetrahedra", "hyperelastic 17"), ("4,913 hexahedra", "hexahedra 17"), ("998,250 tetrahedra", "block 55"),
          ("9,858,192 tetrahedra", "block 118")]
COPIES = 16384
CONTACT = ["32 32 6", "32 32 6 --double", "16 16 1", "32 32 6 --mu 0", "32 32 6 --given"]
PARTICLES = [10_648, 97_336, 1_000_000]
CELLS = [64, 128, 256]
# of gpu_multigrid, cells along a side of the cubes
CUBES = [6, 17, 26, 55, 118]
# of gpu_devices
LARGE = 118


def form_of(words):
    """The name of a form that the page has, of what gpu_scenes calls it; None for the others."""
    if words.startswith("fused"):
        return "fused" if words.endswith("all steps in one launch") else None
    return {"launch by launch": "loops", "graph": "graph", "graph, assembled": "assembled"}.get(words)


def scene_rows(name, text):
    """What gpu_scenes says of one scene."""
    rows = []
    copy = re.search(r"a copy of ([\d.]+) MB", text)
    for line in text.splitlines():
        found = re.match(r"[^;]+; (\d+); (\d+); (float|double); ([^;]+); ([\d.]+); \S+; ([\d.]+) us an iteration, .*iterations \S+ GB/s, ([\d.]+) %$", line)
        if found and form_of(found[4]):
            rows.append({"scene": name, "points": int(found[1]), "elements": int(found[2]), "real": found[3], "form": form_of(found[4]),
                         "steps_per_second": float(found[5]), "iteration": float(found[6]) / 1e6, "of_copy": float(found[7]),
                         "megabytes": float(copy[1]) if copy else None})
    if not rows:
        fail(f"gpu_scenes said nothing of {name} that its table knows, but:\n{text}")
    return rows


def iterations(rows):
    """Of each scene the form that is fastest, with what an iteration of it moves."""
    fastest = {}
    for row in rows:
        key = row["scene"], row["real"]
        if key not in fastest or row["steps_per_second"] > fastest[key]["steps_per_second"]:
            fastest[key] = row
    return list(fastest.values())


def copies_rows(name, text):
    rows = []
    for line in text.splitlines():
        if found := re.match(r"batch [^;]+; \d+; \d+; (float|double); (\d+) copies, .*; ([\d.]+) of one; .*, ([\d.]+) %$", line):
            rows.append({"scene": name, "real": found[1], "copies": int(found[2]), "steps_per_second": float(found[3]), "of_peak": float(found[4])})
    if not rows:
        fail(f"gpu_scenes said nothing of copies of {name} that its table knows, but:\n{text}")
    return rows


def contact_row(arguments, text):
    found = re.search(r"^(\d+); \d+; (\d+); (float|double); ([\d.]+); .* ([\d.]+) conjugate gradients, .*; (\S+) m, \S+; (\d+) unsolved; forces (\S+)$", text, flags=re.M)
    if not found:
        fail(f"gpu_contact {arguments} did not print the line that its table knows, but:\n{text}")
    return {"arguments": arguments, "tetrahedra": int(found[1]), "contacts": int(found[2]), "real": found[3], "steps_per_second": float(found[4]),
            "iterations": float(found[5]), "residual": float(found[6]), "unsolved": int(found[7]), "forces": float(found[8])}


def fluid_row(text):
    found = re.match(r"(\d+); (float|double); (launches|graph); ([\d.]+); ", text)
    if not found:
        fail(f"gpu_fluids did not print the line that its table knows, but:\n{text}")
    return {"particles": int(found[1]), "real": found[2], "form": found[3], "steps_per_second": float(found[4])}


def grid_row(text):
    found = re.match(r"(\d+); (float|double); ([\d.]+); ([\d.]+); ([\d.]+); ([\d.]+) of ([\d.]+) TB/s; ", text)
    if not found:
        fail(f"gpu_fluids grid did not print the line that its table knows, but:\n{text}")
    return {"cells": int(found[1]), "real": found[2], "steps_per_second": float(found[3]), "iterations": float(found[4]),
            "million_cells_per_second": float(found[5]), "of_copy": float(found[6]), "copy": float(found[7])}


def multigrid_rows(text):
    rows = []
    for line in text.splitlines():
        if found := re.match(r"(\d+); (\d+); (float|double); ([^;]+); ([\d.]+); ([\d.]+); ([\d.]+); (\d+); (\S+); \d+; ([\d.]+); ", line):
            rows.append({"tetrahedra": int(found[1]), "points": int(found[2]), "real": found[3], "solver": found[4], "first": float(found[5]),
                         "set_up": float(found[6]), "solution": float(found[7]), "iterations": int(found[8]), "residual": float(found[9]), "step": float(found[10])})
    if {row["solver"] for row in rows} != {"multigrid", "block Jacobi"}:
        fail(f"gpu_multigrid did not print the lines that its table knows, but:\n{text}")
    return rows


def devices_rows(name, text):
    """What gpu_devices says; `devices` is 0 for the step of Simulation."""
    rows = []
    for line in text.splitlines():
        if found := re.match(r"\w+; (\d+); (\d+); (float|double); ([^;]+); ([\d.]+); [\d.]+; (\S+)$", line):
            count = re.search(r"(\d+) devices?$", found[4])
            rows.append({"scene": name, "points": int(found[1]), "tetrahedra": int(found[2]), "real": found[3], "devices": int(count[1]) if count else 0,
                         "steps_per_second": float(found[5]), "difference": float(found[6])})
    if not rows:
        fail(f"gpu_devices said nothing of {name} that its table knows, but:\n{text}")
    return rows


def several(build, meshes, gpus, say):
    """The rows of multigrid, and of several GPUs where there are some."""
    results = {"gpu-multigrid": [], "gpu-devices": []}
    for real in ([], ["--float"]):
        say(f"gpu_multigrid {' '.join(map(str, CUBES))} {' '.join(real)}")
        results["gpu-multigrid"] += multigrid_rows(output(build / "gpu_multigrid", *CUBES, "--threads", 16, *real))
    if gpus < 2:
        del results["gpu-devices"]
        say("there is one GPU, so that gpu_devices is not measured")
        return results
    for real in ([], ["--double"]):
        for name, arguments in (("implicit Euler", f"implicit {LARGE}"), ("explicit Euler", f"explicit {LARGE}"),
                                *((f"{COPIES:,} copies", f"copies {mesh} {COPIES}") for mesh, _, _ in meshes)):
            say(f"gpu_devices {arguments} {' '.join(real)}")
            results["gpu-devices"] += devices_rows(name, output(build / "gpu_devices", *arguments.split(), *real))
    return results


def measured(build, meshes, say):
    """The rows of the other tables of the page."""
    results = {"gpu-scenes": [], "gpu-copies": [], "gpu-contact": [], "gpu-fluids": [], "gpu-grids": []}
    bodies = [(f"{tetrahedra:,} tetrahedra", f"fem {mesh}") for mesh, _, tetrahedra in meshes]
    scenes = SCENES[:3] + bodies + SCENES[3:]
    for real in ([], ["--double"]):
        for name, arguments in scenes:
            say(f"gpu_scenes {arguments} {' '.join(real)}")
            results["gpu-scenes"] += scene_rows(name, output(build / "gpu_scenes", *arguments.split(), *real, "--no-host", "--blocks", 0))
    results["gpu-iterations"] = iterations(results["gpu-scenes"])
    for (name, _), (mesh, _, _) in zip(bodies, meshes):
        for real in ([], ["--double"]):
            say(f"gpu_scenes batch {mesh} {COPIES} {' '.join(real)}")
            results["gpu-copies"] += copies_rows(name, output(build / "gpu_scenes", "batch", mesh, COPIES, *real))
    for arguments in CONTACT:
        say(f"gpu_contact {arguments}")
        results["gpu-contact"].append(contact_row(arguments, output(build / "gpu_contact", *arguments.split())))
    for particles in PARTICLES:
        for options in ([], ["--graph"], ["--double"], ["--double", "--graph"]):
            say(f"gpu_fluids {particles} {' '.join(options)}")
            results["gpu-fluids"].append(fluid_row(output(build / "gpu_fluids", particles, *options)))
    for cells in CELLS:
        for real in ([], ["--double"]):
            say(f"gpu_fluids grid {cells} {' '.join(real)}")
            results["gpu-grids"].append(grid_row(output(build / "gpu_fluids", "grid", cells, *real)))
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__, prog="./dev bench --gpu")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/test-gcc/gpu", help="folder of gpu_scenes and the other programs")
    parser.add_argument("--meshes", type=pathlib.Path, nargs="+", metavar="FILE", help="tetrahedral meshes (.msh) of about 600 and 1,500 tetrahedra, in place of blocks")
    parser.add_argument("--several", action="store_true", help="prints the tables of multigrid and of several GPUs alone, and writes --json only")
    parser.add_argument("--json", type=pathlib.Path, default=pathlib.Path("out/gpu.json"))
    arguments = parser.parse_args()
    for mesh in arguments.meshes or []:
        if not mesh.is_file():
            fail(f"there is no mesh {mesh}; name files after --meshes")
    pages.check_blocks("gpu", (pages.DOCS / "gpu.md").read_text())
    try:
        done = subprocess.run(["nvidia-smi", "--query-gpu=name,driver_version", "--format=csv,noheader"], capture_output=True, text=True)
        gpus = len(done.stdout.splitlines())
        name, driver = done.stdout.splitlines()[0].split(", ")
    except (OSError, IndexError, ValueError):
        fail("nvidia-smi names no GPU; run this on a machine that has one of NVIDIA, with its driver")
    version = re.search(r"release ([\d.]+)", said_by("nvcc", "--version") or said_by("/usr/local/cuda/bin/nvcc", "--version"))
    run = {"date": day(), "commit": commit(), "command": command_line(["--gpu", *sys.argv[1:]]), "machine": f"{name}, driver {driver}" + (f", {gpus} of them" if gpus > 1 else ""),
           "compiler": f"nvcc {version[1] if version else ''} -O3"}
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        meshes = table.meshes_of(arguments.meshes, pathlib.Path(folder))[:2]
        def say(words):
            print(f"{time.monotonic() - began:6.0f} s  {words}", flush=True)
        results = {"run": run}
        if not arguments.several:
            results |= measured(arguments.build, meshes, say)
        results |= several(arguments.build, meshes, gpus, say)
    arguments.json.parent.mkdir(parents=True, exist_ok=True)
    arguments.json.write_text(pages.record(results))
    for table_name in (t for t in pages.PAGES["gpu"] if results.get(pages.source(t))):
        print(f"\n{table_name}\n\n{pages.TABLES[table_name](pages.rows_of(results, table_name))}")
    if arguments.several:
        return
    pages.write("gpu", results)
    print(f"\nfigures written to {arguments.json}, docs/gpu.md and its plots are written")


if __name__ == "__main__":
    main()
