#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes what was measured into the pages of docs/: tables, plots, and the line that says where and when.

A table stands in its page between the lines `<!-- table NAME -->` and `<!-- end -->`, the line of the run between
`<!-- run -->` and `<!-- end -->`; both are written here, from one run. The run that a page is made of lies beside its plots,
in docs/performance/PAGE.json.

usage: pages.py            writes the pages and the plots anew from the runs in docs/performance
       pages.py --check    says which page is not what its run makes of it
"""
import json
import pathlib
import re
import sys

import plots
from tools import fail, markdown

DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"
VARIANTS = {"double": "double", "double-float-matrix": "double, matrix in float", "float": "float", "double-matrix-free": "double, matrix-free",
         "float-matrix-free": "float, matrix-free", "yardstick": "yardstick"}


def of(rows, **wanted):
    """The first row that has these values, or None."""
    return next((row for row in rows if all(row.get(key) == value for key, value in wanted.items())), None)


def kinds(rows, key):
    return list(dict.fromkeys(row[key] for row in rows))


def digits(value, count=3):
    """A number with so many digits, and commas; whole where it is large."""
    if value is None:
        return "-"
    if value == 0 or value >= 10 ** (count - 1):
        return f"{round(float(f'{value:.{count}g}')):,}"
    return f"{float(f'{value:.{count}g}'):g}"


def power(value, count=0):
    """A number as digits and a power of ten: 1e-6."""
    return re.sub(r"e([-+])0*(\d)", lambda m: "e" + m[1].replace("+", "") + m[2], f"{value:.{count}e}") if value else "0"


def percent(share):
    return f"{100 * share:.0f} %"


def body(row):
    return f"{row['points']:,.0f} points, {row['tetrahedra']:,.0f} tetrahedra"


def fem(rows):
    lines = []
    for kind in kinds(rows, "kind"):
        line = [VARIANTS[kind]]
        for points in kinds(rows, "points"):
            row = of(rows, kind=kind, points=points)
            ratios = [f"{row[key]:.{n}f}" for key, n in (("times_yardstick", 2), ("times_sofa", 1)) if row.get(key)]
            line.append(digits(row["steps_per_second"], 4) + (f" ({'; '.join(ratios)})" if ratios else ""))
        aim = of(rows, kind=kind).get("aim")
        lines.append([*line, f"{aim} times SOFA" if aim else "-"])
    with_ratios = " (times the yardstick; times SOFA)" if of(rows, kind="yardstick") else ""
    return markdown(["steps a second" + with_ratios, *(body(of(rows, points=points)) for points in kinds(rows, "points")), "aim"], lines)


def grids(rows):
    lines = []
    for kind in kinds(rows, "kind"):
        line = [VARIANTS[kind]]
        for grid in kinds(rows, "grid"):
            row = of(rows, kind=kind, grid=grid)
            line.append(digits(row["steps_per_second"], 4) + (f" ({row['times_sofa']:.1f})" if row.get("times_sofa") else ""))
        lines.append([*line, f"{rows[0]['aim']} times SOFA"])
    compared = " (times SOFA)" if rows[0].get("times_sofa") else ""
    return markdown(["steps a second" + compared, *kinds(rows, "grid"), "aim"], lines)


def small(rows):
    names = {"tetrahedron-with-skin": "tetrahedron, skin brought up to date in each step", "tetrahedron": "tetrahedron, skin left behind",
             "pendulum": "pendulum on a rigid body"}
    lines = []
    for kind, name in names.items():
        line = [name]
        for row in (of(rows, kind=kind), of(rows, kind=f"{kind}-assembled")):
            line += [digits(row["steps_per_second"], 4), f"{row['times_sofa']:.0f}" if row.get("times_sofa") else "-"] if row else ["-", "-"]
        lines.append([*line, f"{rows[0]['aim']} times SOFA"])
    return markdown(["scene", "steps/s, matrix-free", "times SOFA", "steps/s, assembled", "times SOFA", "aim"], lines)


SOLVERS = {"cg": "conjugate gradients", "jacobi": "Jacobi", "block-jacobi": "block Jacobi", "ssor": "SSOR", "incomplete-cholesky": "incomplete Cholesky",
           "ldl-kept-and-turned": "L D L' kept for 10 steps, turned", "ldl": "L D L' in each step"}


def accuracy(rows):
    bodies = list(dict.fromkeys((row["tetrahedra"], row["young"]) for row in rows))
    best = {key: min(row["seconds"] for row in rows if (row["tetrahedra"], row["young"]) == key) for key in bodies}
    lines = []
    for solver in kinds(rows, "solver"):
        line = [SOLVERS.get(solver, solver)]
        for key in bodies:
            row = of(rows, solver=solver, tetrahedra=key[0], young=key[1])
            words = digits(1e3 * row["seconds"])
            line.append((f"**{words}**" if row["seconds"] == best[key] else words) + ("" if solver == "ldl" else f" ({digits(row['iterations'])})"))
        lines.append(line)
    return markdown(["ms a step (iterations)", *(f"{tetrahedra:,} tetrahedra, {young / 1e3:g} kPa" for tetrahedra, young in bodies)], lines)


LINEAR = {"sinew": "multigrid", "sinew-pattern-kept": "multigrid, pattern kept", "cholmod": "CHOLMOD", "hypre": "BoomerAMG", "hypre-nodal": "BoomerAMG, nodal", "petsc": "GAMG", "ml": "ML",
          "muelu": "MueLu"}
BODIES = {"plain": "", "contrast": ", layers 1e4", "incompressible": ", nu 0.49"}


def linear_bodies(rows):
    """Each system once, with its name."""
    return {key: f"{key[0]:,}{BODIES[key[1]]}" + (f" ({key[2]})" if key[2] else "") for key in dict.fromkeys((row["tetrahedra"], row["kind"], row.get("mesh")) for row in rows)}


def linear_row(rows, key, solver):
    return of(rows, tetrahedra=key[0], kind=key[1], mesh=key[2], solver=solver)


def multigrid(rows):
    """Set-up and solution [ms], iterations of what was measured; and of the best BoomerAMG how often multigrid goes into it."""
    lines = []
    solvers = {solver: name for solver, name in LINEAR.items() if of(rows, solver=solver)}
    for key, name in linear_bodies(rows).items():
        line = [name]
        for solver in solvers:
            row = linear_row(rows, key, solver)
            line.append(f"{digits(1e3 * row['set_up'])} + {digits(1e3 * row['solve'])} ({row['iterations']})" if row else "-")
        whole = {solver: row["set_up"] + row["solve"] for solver in solvers if (row := linear_row(rows, key, solver))}
        others = [whole[solver] for solver in ("hypre", "hypre-nodal") if solver in whole]
        lines.append([*line, f"{min(others) / whole['sinew']:.1f}" if others else "-"])
    return markdown(["tetrahedra", *solvers.values(), "times BoomerAMG"], lines)


def multigrid_steps(rows):
    def words(row):
        return f"{digits(row['steps_per_second'])} ({digits(row['iterations'])})"
    return markdown(["tetrahedra", "made anew in each step", "in each tenth, turned"],
                    [[name, *(words(linear_row(rows, key, f"steps-{n}")) for n in (1, 10))] for key, name in linear_bodies(rows).items()])


LOOPS = {"matrix-vector": "matrix-vector product", "force": "force pass", "matrix-free-product": "product without matrix"}


def roofline(rows):
    return markdown(["tetrahedra", "loop", "us", "MB", "Mflop", "GB/s", "triad, GB/s", "Gflop/s", "peak, Gflop/s", "share"],
                    [[f"{r['tetrahedra']:,}", LOOPS.get(r["loop"], r["loop"]), digits(1e6 * r["seconds"]), digits(r["bytes"] / 1e6), digits(r["flops"] / 1e6),
                      digits(r["bytes"] / r["seconds"] / 1e9, 2), digits(r["bandwidth"] / 1e9), digits(r["flops"] / r["seconds"] / 1e9, 2),
                      digits(r["peak"] / 1e9), f"{percent(r['share'])} of {r['bound']}"] for r in rows])


def growth(rows):
    return markdown(["tetrahedra", "points", "ns a step", "ns an iteration", "bytes after init", "of a step's arrays", "at least", "ratio"],
                    [[f"{r['tetrahedra']:,.0f}", f"{r['points']:,.0f}", digits(1e9 * r["step"] / r["tetrahedra"]), digits(1e9 * r["iteration"] / r["tetrahedra"], 2),
                      *(f"{r[key] / r['tetrahedra']:,.0f}" for key in ("resident", "arrays", "least")), f"{r['arrays'] / r['least']:.1f}"] for r in rows])


def threads(rows):
    counts, lines = kinds(rows, "threads"), []
    for tetrahedra in kinds(rows, "tetrahedra"):
        for kind in kinds(rows, "kind"):
            found = [of(rows, tetrahedra=tetrahedra, kind=kind, threads=count) for count in counts]
            lines.append([f"{tetrahedra:,}", kind.replace(",", ", "), *(digits(1e3 * row["step"]) for row in found), f"{found[-1]['speedup']:.2f}"])
    return markdown(["tetrahedra", "", *(f"ms a step, {count} thread{'s' if count > 1 else ''}" for count in counts), f"speed-up by {counts[-1]}"], lines)


BUILDS = {"native_fast": "native, -ffast-math"}
SCENES = {"fem-double": "body of 6,000 tetrahedra, double", "fem-float": "the same, float", "fem-double-matrix-free": "the same, double, matrix-free",
          "grid-double": "grid 17x8x10, double"}


FLUIDS = {"sph": "particles, SPHFluidForceField", "sphf": "particles, SPHFluidForceField in float", "pysph": "particles, PySPH", "dfsph": "particles, DFSPHSolver", "splishsplash": "particles, SPlisHSPlasH", "grid": "cells, Fluid3D"}


def fluids(rows):
    lines = []
    for kind, parts in dict.fromkeys((row["kind"], row["parts"]) for row in rows):
        runs = [row for row in rows if (row["kind"], row["parts"]) == (kind, parts)]
        one, many = runs[0], runs[-1]
        lines.append([f"{parts:,} {FLUIDS[kind]}", digits(1e3 * one["step"]), digits(1e3 * many["step"]), digits(1 / many["step"]), digits(1e6 * one["step"] / parts),
                      one["iterations"] or "-"])
    most = max(row["threads"] for row in rows)
    return markdown(["fluid", "ms a step, 1 thread", f"ms a step, {most} threads", f"steps a second, {most} threads", "us a step and particle or cell, 1 thread", "iterations"], lines)


def portability(rows):
    builds = kinds(rows, "build")
    lines = []
    for scene in kinds(rows, "scene"):
        found = [of(rows, scene=scene, build=build) for build in builds]
        lines.append([SCENES.get(scene, scene), *(digits(r["steps_per_second"], 4) + (f" ({power(r['distance'])} m)" if r["build"] != builds[0] else "") for r in found)])
    return markdown(["steps a second", *(f"{BUILDS.get(build, build)}, {of(rows, build=build)['register_bytes']} bytes" for build in builds)], lines)


BY_HAND = {"string": "string of 10 masses", "string-4": "the same, springs in four lanes", "liver": "body of tetrahedra"}


def by_hand(rows):
    return markdown(["scene", "typed, us a step", "by hand, us a step", "ratio", "apart [m]"],
                    [[BY_HAND.get(r["scene"], r["scene"]), digits(r["typed_us"], 4), digits(r["hand_us"], 4), f"{r['ratio']:.2f}", power(r["distance"]) if r.get("distance") is not None else "-"] for r in rows])


def vitrectomy(rows):
    return markdown(["surgery", "springs are taken", "typed, us a step", "by hand, us a step", "ratio"],
                    [[f"{r['points']:,.0f} points, {r['springs']:,.0f} springs", {"lanes": "in lanes", "four lanes": "in four lanes"}.get(r["kind"], r["kind"]),
                      digits(r["typed_us"], 4), digits(r["hand_us"], 4), f"{r['ratio']:.2f}"] for r in rows])


def runtime(rows):
    return markdown(["scene", "points", "runtime, us a step", "typed, us a step", "ratio"],
                    [[r["scene"], f"{r['points']:,.0f}", digits(r["runtime_us"]), digits(r["typed_us"]), f"{r['ratio']:.2f}"] for r in rows])


def families(rows):
    columns = ["double", "double_one_by_one", "float", "float_one_by_one"]
    return markdown(["ns an element", "operation", "double, lanes", "double, one by one", "float, lanes", "float, one by one"],
                    [[r["family"], r["operation"], *(digits(r.get(key)) for key in columns)] for r in rows])


def collision(rows):
    lines = []
    for row in (r for r in rows if r["for"] == "native"):
        other = of(rows, scene=row["scene"], boxes=row["boxes"], **{"for": "any"})
        lines.append([row["scene"], f"{row['boxes']:,}", f"{row['pairs']:,}", digits(row["sinew"]) + (f" ({digits(other['sinew'])})" if other else ""),
                      digits(row.get("bullet")), digits(row.get("fcl")), digits(1e3 * row["sinew"] / row["boxes"], 2)])
    return markdown(["scene", "boxes", "pairs", "Sinew [us]", "Bullet [us]", "FCL [us]", "Sinew, ns a box"], lines)


def compiling(rows):
    lines = []
    for subject in kinds(rows, "subject"):
        found = [of(rows, subject=subject, compiled=compiled) for compiled in (False, True)]
        lines.append([subject, *(f"{r['cpu_s']:.1f} s, {r['memory_mb']:,.0f} MB" if r else "-" for r in found)])
    return markdown(["", "header-only", "`sinew::compiled`"], lines)


def contact(rows):
    return markdown(["workload", "contacts", "solver", "tolerance [m]", "ms a step", "iterations", "residual [m]", "penetration [m]", "detection"],
                    [[r["workload"], f"{r['contacts']:,.0f}", r["solver"].removesuffix("ConstraintSolver"), power(r["tolerance"]) if r["tolerance"] else "-",
                      digits(1e3 / r["steps_per_second"]), f"{r['iterations']:,.0f}", power(r["residual"], 1), power(r["penetration"], 1),
                      percent(r["detection"]) if r["detection"] else "-"] for r in rows])


def siconos(rows):
    def ms(row, key):
        return digits(row[key]) + (" !" if key in row["unsolved"] else "")
    return markdown(["problem", "contacts", "Gauss-Seidel", "ms", "NNCG", "ms", "Siconos NSGS", "ms, dense", "ms, sparse"],
                    [[r["problem"].replace("with compliant", "the same, compliant"), r["contacts"], f"{r['sweeps']:,}", ms(r, "sweeps_ms"), f"{r['nncg']:,}", ms(r, "nncg_ms"),
                      f"{r['siconos']:,}", ms(r, "dense_ms"), ms(r, "sparse_ms")] for r in rows])


def organ(row):
    return f"{int(row['resolution']):,} tetrahedra" if row["model"].lower() == "fem" else f"grid {row['resolution']}"


def laparoscopy(rows):
    return markdown(["liver", "steps/s", "paper, 2007", "detection", "contact forces", "solver and all other forces"],
                    [[organ(r), digits(r["steps_per_second"]), r["paper"], *(f"{100 * r[key]:.1f} %" for key in ("detection", "response", "rest"))] for r in rows])


def bounds(rows):
    return markdown(["liver", "fastest point", "kinetic, elastic energy", "deepest penetration", "volumes of skins", "least volume of an element", "inverted", "passed through"],
                    [[organ(r), f"{r['fastest']:.2f} m/s", f"{1e3 * r['kinetic']:.2g}, {1e3 * r['elastic']:.2g} mJ", f"{r['penetration']:.2f} mm",
                      f"{r['smallest']:.2f} to {r['largest']:.2f}", f"{r['element']:.2f}",
                      f"{r['inverted']:.0f}, for up to {r['inverted_for']:.1f} s" if r["inverted"] else "0", f"{r['passed']:.0f} times"] for r in rows])


# SOFA's CUDA plugin (v26, CudaVec3f) on an H200, and the GPU of Faure et al. 2007 [steps/s]
SOFA_CUDA = {"grid 17x8x10": (404, 261), "grid 20x10x12": (314, 227), "grid 24x13x15": (223, 178), "596 tetrahedra": (648, None),
             "1,493 tetrahedra": (612, None), "29,478 tetrahedra": (562, None)}
FORMS = {"loops": "loop by loop", "graph": "graph", "assembled": "graph, assembled", "fused": "fused"}


def gpu_scenes(rows, real):
    lines = []
    for scene in kinds([r for r in rows if r["real"] == real], "scene"):
        found = {form: of(rows, real=real, scene=scene, form=form) for form in FORMS}
        line = [scene, f"{of(rows, real=real, scene=scene)['points']:,}", *(digits(row["steps_per_second"], 4) if row else "-" for row in found.values())]
        if real == "float":
            sofa, paper = SOFA_CUDA.get(scene, (None, None))
            line += [digits(sofa), digits(found["fused"]["steps_per_second"] / sofa, 2) if sofa and found["fused"] else "-", digits(paper)]
        lines.append(line)
    return markdown([f"steps a second, {real}", "points", *FORMS.values(), *(["SOFA", "fused / SOFA", "paper"] if real == "float" else [])], lines)


def gpu_float(rows):
    return gpu_scenes(rows, "float")


def gpu_double(rows):
    return gpu_scenes(rows, "double")


def gpu_iterations(rows):
    """Of each scene the form that is fastest: what an iteration reads and writes, against a copy of as many bytes."""
    lines = []
    for r in rows:
        lines.append([r["scene"], r["real"], FORMS[r["form"]], digits(1e6 * r["iteration"]), digits(r["megabytes"]), digits(r["of_copy"], 2) + " %"])
    return markdown(["scene", "", "form", "us an iteration", "MB", "of a copy"], lines)


def gpu_copies(rows):
    counts = kinds(rows, "copies")
    return markdown(["steps a second of all copies", *(f"{count:,}" for count in counts), "of peak"],
                    [[f"{scene}, {real}", *(digits(of(rows, scene=scene, real=real, copies=count)["steps_per_second"]) for count in counts),
                      f"{of(rows, scene=scene, real=real, copies=counts[-1])['of_peak']:.1f} %"]
                     for scene, real in dict.fromkeys((r["scene"], r["real"]) for r in rows)])


def gpu_contact(rows):
    return markdown(["`gpu_contact`", "tetrahedra", "contacts", "", "steps/s", "iterations a step", "residual [m]", "forces against the weight"],
                    [[f"`{r['arguments']}`", f"{r['tetrahedra']:,}", f"{r['contacts']:,}", r["real"], digits(r["steps_per_second"], 4), digits(r["iterations"]),
                      power(r["residual"]), power(r["forces"])] for r in rows])


def gpu_fluids(rows):
    def steps(row):
        return digits(row["steps_per_second"], 4)
    lines = []
    for particles in kinds(rows, "particles"):
        line = [f"{particles:,}"]
        for real in ("float", "double"):
            launches, graph = (of(rows, particles=particles, real=real, form=form) for form in ("launches", "graph"))
            line += [steps(launches), steps(graph), digits(1e9 / graph["steps_per_second"] / particles)]
        lines.append(line)
    return markdown(["particles", *(f"{words}, {real}" for real in ("float", "double") for words in ("steps/s", "as a graph", "ns a step and particle"))], lines)


def gpu_grids(rows):
    lines = []
    for cells in kinds(rows, "cells"):
        line = [f"{round(cells ** (1 / 3))}³"]
        for real in ("float", "double"):
            row = of(rows, cells=cells, real=real)
            line += [digits(row["steps_per_second"], 4), digits(row["iterations"], 2), digits(row["million_cells_per_second"]), f"{100 * row['of_copy']:.0f} %"]
        lines.append(line)
    return markdown(["cells", *(f"{words}, {real}" for real in ("float", "double") for words in ("steps/s", "iterations", "million cells/s", "of a copy's bandwidth"))], lines)


def gpu_multigrid(rows):
    """Of each body and precision: multigrid, against conjugate gradients with diagonal blocks, which do not get there in float where a body is large."""
    lines = []
    for tetrahedra, real in dict.fromkeys((r["tetrahedra"], r["real"]) for r in rows):
        own, jacobi = (of(rows, tetrahedra=tetrahedra, real=real, solver=solver) for solver in ("multigrid", "block Jacobi"))
        lines.append([f"{tetrahedra:,}", real, digits(own["first"]), digits(own["set_up"]), digits(own["solution"]), own["iterations"],
                      *([digits(jacobi["solution"]), f"{jacobi['iterations']:,}", digits(jacobi["solution"] / own["solution"], 2)] if jacobi else ["-"] * 3), digits(own["step"])])
    return markdown(["tetrahedra", "", "first set-up [ms]", "set-up [ms]", "solution [ms]", "iterations", "diagonal blocks: solution [ms]", "iterations", "times as long", "whole step [ms]"], lines)


def gpu_devices(rows):
    """Steps a second of one body over several GPUs, and of copies spread over them, against one."""
    lines = []
    for r in (r for r in rows if r["devices"] > 1):
        alone = of(rows, scene=r["scene"], tetrahedra=r["tetrahedra"], real=r["real"], devices=1)
        graph = of(rows, scene=r["scene"], tetrahedra=r["tetrahedra"], real=r["real"], devices=0)
        lines.append([r["scene"], f"{r['tetrahedra']:,}", r["real"], digits(graph["steps_per_second"], 4) if graph else "-", digits(alone["steps_per_second"], 4),
                      r["devices"], digits(r["steps_per_second"], 4), f"{r['steps_per_second'] / alone['steps_per_second']:.2f}", power(r["difference"]) if graph else "-"])
    return markdown(["steps a second", "tetrahedra", "", "`Simulation`, as a graph", "one GPU", "GPUs", "on these", "times one", "difference of positions"], lines)


TABLES = {"fem": fem, "grids": grids, "small": small, "accuracy": accuracy, "roofline": roofline, "growth": growth, "threads": threads, "fluids": fluids, "portability": portability,
          "by-hand": by_hand, "vitrectomy": vitrectomy, "runtime": runtime, "families": families, "collision": collision, "compile": compiling, "contact": contact,
          "siconos": siconos, "laparoscopy": laparoscopy, "bounds": bounds, "gpu-float": gpu_float, "gpu-double": gpu_double, "gpu-iterations": gpu_iterations,
          "gpu-copies": gpu_copies, "gpu-contact": gpu_contact, "gpu-fluids": gpu_fluids, "gpu-grids": gpu_grids, "gpu-multigrid": gpu_multigrid,
          "gpu-devices": gpu_devices, "multigrid": multigrid, "multigrid-steps": multigrid_steps}
# rows that two tables are made of
SOURCE = {"gpu-float": "gpu-scenes", "gpu-double": "gpu-scenes", "multigrid-steps": "multigrid"}
# the tables of each page; all of them are of one run
PAGES = {"performance": ["fem", "grids", "small", "accuracy", "roofline", "growth", "threads", "portability", "by-hand", "runtime", "collision", "compile"],
         "families": ["families"],
         "contact": ["contact", "siconos"], "fluids": ["fluids"], "laparoscopy": ["laparoscopy", "bounds"], "vitrectomy": ["vitrectomy"], "multigrid": ["multigrid", "multigrid-steps"],
         "gpu": ["gpu-float", "gpu-double", "gpu-iterations", "gpu-copies", "gpu-contact", "gpu-fluids", "gpu-grids", "gpu-multigrid", "gpu-devices"]}
# tables that a run may lack, and what their place on the page says then
LACKING = {"gpu-multigrid": "The run of this page has not measured it.", "gpu-devices": "The run of this page has not measured it: it needs two GPUs."}


def source(table):
    """The rows that a table is made of."""
    return SOURCE.get(table, table)


def rows_of(results, name):
    return results[source(name)]


def run_line(run):
    """Where, when and how a page's figures were measured."""
    words = [f"Measured {run['date']} at commit {run['commit']} by `{run['command']}`: {run['machine']}", run["compiler"]]
    if run.get("rounds"):
        words.append(f"medians of {run['rounds']} rounds in turn" if run["rounds"] > 1 else "one round")
    if "load" in run:
        words.append(f"load {run['load'][0]:.1f} when it began and {run['load'][1]:.1f} at its end")
    return "; ".join(words) + "."


BLOCK = re.compile(r"<!-- (?:table ([\w-]+)|(run)) -->\n(.*?)<!-- end -->", re.S)


def unpaired(text):
    """What is wrong with the markers of a page: (line, sentence)."""
    found, open_at = [], None
    for number, line in enumerate(text.splitlines(), 1):
        if re.fullmatch(r"<!-- (table [\w-]+|run) -->", line):
            if open_at:
                found.append((number, f"the block of line {open_at} has no <!-- end --> in front of this one"))
            open_at = number
        elif line == "<!-- end -->":
            if not open_at:
                found.append((number, "this <!-- end --> closes nothing"))
            open_at = None
        elif re.search(r"<!--\s*(table|run|end)\b", line):
            found.append((number, "a marker must be a line of its own: <!-- table NAME -->, <!-- run --> or <!-- end -->"))
    if open_at:
        found.append((open_at, "this block has no <!-- end -->"))
    return found


def check_blocks(name, text):
    """Fails where a page lacks one of its tables or the line of the run, has others, or markers without a pair."""
    if wrong := unpaired(text):
        fail(f"docs/{name}.md, line {wrong[0][0]}: {wrong[0][1]}")
    blocks = [table or "run" for table, _, _ in BLOCK.findall(text)]
    if sorted(blocks) != sorted([*PAGES[name], "run"]):
        fail(f"docs/{name}.md has the blocks {', '.join(blocks)}, but must have each of run, {', '.join(PAGES[name])} once")


def written(name, text, results):
    """The page with its tables and its line of the run from these results."""
    check_blocks(name, text)
    missing = [table for table in PAGES[name] if not results.get(source(table)) and table not in LACKING]
    if missing:
        fail(f"docs/{name}.md: {', '.join(missing)} was not measured; a page is of one run, so that all of its tables are measured together")

    def block(match):
        table = match[1]
        if table in LACKING and not results.get(source(table)):
            return f"{match[0].splitlines()[0]}\n\n{LACKING[table]}\n\n<!-- end -->"
        made = TABLES[table](rows_of(results, table)) if table else run_line(results["run"])
        return f"{match[0].splitlines()[0]}\n\n{made}\n\n<!-- end -->"
    return BLOCK.sub(block, text)


def figures(name, results):
    """The plots of a page: file name and SVG."""
    return {f"{plot}.svg": made for plot, made in plots.of_page(name, results).items()}


def write(name, results, docs=DOCS):
    """Rewrites a page, its plots, and the record of the run that they are of."""
    page, folder = docs / f"{name}.md", docs / "performance"
    kept = record(results)
    results = json.loads(kept)
    text = written(name, page.read_text(), results)
    drawn = figures(name, results)
    folder.mkdir(exist_ok=True)
    page.write_text(text)
    for file, svg in drawn.items():
        (folder / file).write_text(svg)
    (folder / f"{name}.json").write_text(kept)


def record(results):
    """The run as a file that is read well: a row a line, figures with six digits."""
    def short(value):
        if isinstance(value, float):
            return float(f"{value:.6g}")
        if isinstance(value, dict):
            return {key: short(item) for key, item in value.items() if item is not None and key not in ("place", "by_reference", "by_other")}
        return [short(item) for item in value] if isinstance(value, (list, tuple)) else value
    parts = []
    for key, value in short(results).items():
        if isinstance(value, list):
            parts.append(f"{json.dumps(key)}: [\n" + ",\n".join(" " + json.dumps(row) for row in value) + "\n]")
        else:
            parts.append(f"{json.dumps(key)}: {json.dumps(value)}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def recorded(name, docs=DOCS):
    file = docs / "performance" / f"{name}.json"
    try:
        return json.loads(file.read_text())
    except (OSError, ValueError) as error:
        fail(f"{file} cannot be read ({error}); ./dev bench --pages {name} writes it")


def differences(docs=DOCS):
    """Pages and plots that are not what the run beside them makes."""
    wrong, made = [], set()
    for name in PAGES:
        results, page = recorded(name, docs), docs / f"{name}.md"
        if written(name, page.read_text(), results) != page.read_text():
            wrong.append(f"docs/{name}.md is not what docs/performance/{name}.json makes of it; run benchmarks/pages.py")
        for file, svg in figures(name, results).items():
            made.add(file)
            path = docs / "performance" / file
            if not path.is_file() or path.read_text() != svg:
                wrong.append(f"docs/performance/{file} is not what {name}.json makes of it; run benchmarks/pages.py")
            if f"](performance/{file})" not in page.read_text():
                wrong.append(f"docs/{name}.md does not show performance/{file}")
    wrong += [f"docs/performance/{path.name} is drawn by nobody; delete it" for path in sorted((docs / "performance").glob("*.svg")) if path.name not in made]
    return wrong


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        found = differences()
        print("\n".join(found))
        sys.exit(1 if found else 0)
    if sys.argv[1:]:
        sys.exit(__doc__)
    for page_name in PAGES:
        write(page_name, recorded(page_name))
