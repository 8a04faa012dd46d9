#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Tests what benchmarks/pages.py writes: measured.py ROOT. From the small run of tests/docs/measured.json it makes the tables of
measured.md; wrong markers and a run that lacks a table are refused, with a sentence; the pages of docs/ are what the runs beside
their plots make of them, and have no table of figures that no benchmark writes."""
import contextlib
import io
import json
import pathlib
import re
import sys
import tempfile

root = pathlib.Path(sys.argv[1]).resolve()
here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(root / "benchmarks"))
sys.path.insert(0, str(root / "benchmarks/compile"))
import gpu  # noqa: E402
import pages  # noqa: E402
import programs_table  # noqa: E402
import run  # noqa: E402

wrong = []


def check(holds, words):
    if not holds:
        wrong.append(words)


def refused(act, *words):
    """That an action ends with an error, which says these words."""
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said):
            act()
    except SystemExit:
        check(all(word in said.getvalue() for word in words), f"the error does not say {words}, but: {said.getvalue()}")
    else:
        wrong.append(f"was not refused, with {words}")


def tables():
    """Each table from a small run is as written down."""
    results = json.loads((here / "measured.json").read_text())
    expected = dict(re.findall(r"^## ([\w-]+)\n\n(.*?)\n\n", (here / "measured.md").read_text() + "\n", flags=re.M | re.S))
    made = {name: pages.TABLES[name](pages.rows_of(results, name)) for name in pages.TABLES} | {"run": pages.run_line(results["run"])}
    for name in made:
        check(expected.get(name) == made[name], f"{name} is not as in tests/docs/measured.md, but\n{made[name]}\n")
    for page in pages.PAGES:
        text = "# A page\n\nWords.\n\n" + "\n\nMore words.\n\n".join(f"<!-- {block} -->\nold\n<!-- end -->" for block in ["run", *(f"table {t}" for t in pages.PAGES[page])])
        once = pages.written(page, text, results)
        check(once.count("Words.") == 1 and "old" not in once, f"{page}: words beside the tables are kept, tables are not\n{once}")
        check(all(made[name] in once for name in [*pages.PAGES[page], "run"]), f"{page}: a table is missing\n{once}")
        check(pages.written(page, once, results) == once, f"{page}: written twice it is another page")
        for file, svg in pages.figures(page, results).items():
            check("prefers-color-scheme:dark" in svg and "<script" not in svg and svg.count("<svg") == svg.count("</svg>") == 1, f"{file} is no plot for both schemes")
    with tempfile.TemporaryDirectory() as folder:
        docs = pathlib.Path(folder)
        (docs / "vitrectomy.md").write_text("<!-- run -->\n<!-- end -->\n<!-- table vitrectomy -->\n<!-- end -->\n")
        pages.write("vitrectomy", results, docs)
        check(pages.written("vitrectomy", (docs / "vitrectomy.md").read_text(), pages.recorded("vitrectomy", docs)) == (docs / "vitrectomy.md").read_text(),
              "the record of a run makes another page than the run")


def refusals():
    results = json.loads((here / "measured.json").read_text())
    good = "<!-- run -->\n<!-- end -->\n<!-- table vitrectomy -->\n<!-- end -->\n"
    refused(lambda: pages.written("vitrectomy", good.replace("<!-- end -->\n<!-- table", "<!-- table"), results), "docs/vitrectomy.md, line 2", "line 1 has no <!-- end -->")
    refused(lambda: pages.written("vitrectomy", "<!-- end -->\n" + good, results), "line 1", "closes nothing")
    refused(lambda: pages.written("vitrectomy", good + "see <!-- table fem -->\n", results), "line 5", "a line of its own")
    refused(lambda: pages.written("vitrectomy", good + "<!-- table fem -->\n<!-- end -->\n", results), "run, vitrectomy, fem", "must have")
    refused(lambda: pages.written("vitrectomy", good, {"run": results["run"]}), "vitrectomy was not measured", "of one run")

    def parse(*words):
        def act():
            sys.argv = ["run.py", *words]
            run.parsed()
        return act
    refused(parse("--pages", "--only", "fem"), "a page is of one run")
    refused(parse("--pages", "contacts"), "there is no page 'contacts'", "contact")
    refused(parse("--pages", "gpu"), "--gpu")
    parse("--pages", "contact")()
    check(run.command_line(["--pages", "--build", "b", "--meshes", "/a/liver.msh"]) == "./dev bench --pages --meshes liver.msh", "a command names folders")


def gpu_output():
    """Rows of what the programs of the GPU print."""
    text = ("best; 60.8 Tflop/s; a copy of 1.40 MB: 1200 GB/s; a launch takes 2.00 us, in a graph 1.00 us\n"
            "grid 17x8x10; 1360; 9000; float; launch by launch; 1217.0; 0.0e+00; 30.00 us an iteration, 9.0 us besides; 1.0 Gflop/s, 0.10 %; 9 GB/s, 1.0 %; iterations 80 GB/s, 7.0 %\n"
            "grid 17x8x10; 1360; 9000; float; graph, assembled, block-Jacobi; 900.0; 0.0e+00; 30.00 us an iteration, 9.0 us besides; 1.0 Gflop/s, 0.10 %; 9 GB/s, 1.0 %; iterations 80 GB/s, 7.0 %\n"
            "grid 17x8x10; 1360; 9000; float; fused, 16 x 256 (chosen), all steps in one launch; 17620.0; 0.0e+00; 1.90 us an iteration, 9.0 us besides; 303.0 Gflop/s, 0.50 %; "
            "700 GB/s, 58.0 %; iterations 733 GB/s, 61.0 %\n")
    rows = gpu.scene_rows("grid 17x8x10", text)
    check([row["form"] for row in rows] == ["loops", "fused"], f"forms of gpu_scenes: {rows}")
    check(gpu.iterations(rows)[0]["steps_per_second"] == 17620 and gpu.iterations(rows)[0]["of_copy"] == 61 and rows[1]["megabytes"] == 1.4, f"rows of gpu_scenes: {rows}")
    rows = gpu.copies_rows("596 tetrahedra", "batch liver.msh; 181; 596; float; 4 copies, 4 x 256; 15550.0 steps a second of all; 62200 of one; 300.0 Gflop/s, 0.50 %\n")
    check(rows == [{"scene": "596 tetrahedra", "real": "float", "copies": 4, "steps_per_second": 62200, "of_peak": 0.5}], f"copies: {rows}")
    row = gpu.contact_row("32 32 6", "28830; 7168; 1024; float; 1203.0; 1.0 updates, 2.0 Newton, 44.0 conjugate gradients, 2.0 looks; 1.0e-06 m, 2.0e-07; 0 unsolved; forces 9.0e-05\n")
    check((row["contacts"], row["steps_per_second"], row["iterations"], row["forces"]) == (1024, 1203, 44, 9e-5), f"contacts: {row}")
    row = gpu.fluid_row("1000000; float; graph; 672.1; 0.00149; front at 1.064 m after 0.014 s\n")
    check(row == {"particles": 1000000, "real": "float", "form": "graph", "steps_per_second": 672.1}, f"fluids: {row}")
    rows = gpu.multigrid_rows("# level of 5832\n29478; 5832; double; multigrid; 50.1; 0.700; 0.750; 14; 8e-07; 3; 2.100; # scene made in 90 ms\n"
                              "29478; 5832; double; block Jacobi; 0.0; 0.100; 15.000; 518; 9e-07; 0; 16.200; # scene made in 90 ms\n")
    check(rows[0] | {"solver": ""} == {"tetrahedra": 29478, "points": 5832, "real": "double", "solver": "", "first": 50.1, "set_up": 0.7, "solution": 0.75, "iterations": 14,
                                       "residual": 8e-7, "step": 2.1} and rows[1]["iterations"] == 518, f"multigrid: {rows}")
    rows = gpu.devices_rows("implicit Euler", "# 2 parts made in 3.0 s\nimplicit; 1685159; 9858192; float; 1 device; 76.00; 1.000; 0.0e+00\n"
                            "implicit; 1685159; 9858192; float; 2 devices; 139.00; 1.829; 1.8e-07\nimplicit; 1685159; 9858192; float; Simulation, as a graph; 76.50; 1.007; 0.0e+00\n")
    rows += gpu.devices_rows("copies", "copies; 181; 596; double; 16384 copies, 2 devices; 1480000; 1.970; 0\n")
    check([(row["devices"], row["steps_per_second"]) for row in rows] == [(1, 76), (2, 139), (0, 76.5), (2, 1480000)] and rows[1]["difference"] == 1.8e-7, f"devices: {rows}")
    refused(lambda: gpu.multigrid_rows("nothing\n"), "gpu_multigrid")
    refused(lambda: gpu.devices_rows("copies", "nothing\n"), "gpu_devices said nothing of copies")
    refused(lambda: gpu.fluid_row("nothing\n"), "gpu_fluids")
    refused(lambda: gpu.scene_rows("grid", "nothing\n"), "gpu_scenes said nothing of grid")


# what examples print of their physics, the same on all machines: page and first line
PHYSICS = {("vitrectomy", '| time | springs to cut | traction of the scar | tension in the retina | energy in it | off its shape, rms |')}


def program_output():
    """Rows of what programs of the processor print."""
    def rows(table, text, *arguments):
        programs_table.output = lambda *command: text
        return table(root, *arguments)
    found = rows(programs_table.by_hand, "string   scene      0.135 us/step, by hand      0.062 us/step, ratio 2.167, positions differ by 0.0e+00\n")
    check(found == [{"scene": "string", "typed_us": 0.135, "hand_us": 0.062, "ratio": 2.167, "distance": 0}], f"by hand: {found}")
    found = rows(programs_table.vitrectomy, "240 points, 1200 springs, 288 to cut\n  one by one  scene     103.7 us/step, by hand     113.7 us/step, ratio 0.912; the same springs are "
                 "cut: yes; points of the retina differ by 6e-08 m before the cut, 1e-06 during it, 1e-13 in the end\n", 3)
    check(found == [{"points": 240, "springs": 1200, "kind": "one by one", "typed_us": 103.7, "hand_us": 113.7, "ratio": 0.912}], f"vitrectomy: {found}")
    line = "FEM block 4^3, assembled               64 points  runtime     22.200 us/step  typed     22.000 us/step  ratio 1.009  "
    found = rows(programs_table.runtime, line + "same bits\n")
    check(found == [{"scene": "FEM block 4^3, assembled", "points": 64, "runtime_us": 22.2, "typed_us": 22, "ratio": 1.009, "bits": "same"}], f"runtime: {found}")
    refused(lambda: rows(programs_table.runtime, line + "other bits\n"), "other bits")
    refused(lambda: rows(programs_table.by_hand, "something else\n"), "does not know", "something else")
    found = rows(programs_table.siconos, f"{'':28} contacts | Gauss-Seidel\nstack of 20 rigid boxes            80 | 100000   1469.00! |  21133    311.00  | 100000   3505.00!   1836.00!\n")
    check(found == [{"problem": "stack of 20 rigid boxes", "contacts": 80, "sweeps": 100000, "sweeps_ms": 1469, "nncg": 21133, "nncg_ms": 311, "siconos": 100000,
                     "dense_ms": 3505, "sparse_ms": 1836, "unsolved": ["sweeps_ms", "dense_ms", "sparse_ms"]}], f"Siconos: {found}")
    found = rows(programs_table.bounds, "fastest point 0.215 m/s, kinetic energy up to 0.0014 J, elastic up to 0.027 J\n"
                 "up to 60 contacts, deepest penetration 0.98 mm (tool and liver); skins at least 2.1 mm inside of the wall\n"
                 "volumes of skins 0.99 to 1.00 of those at rest, of elements at least -1.53; up to 2 elements inverted, for up to 0.6 s; ribs or tool inside an organ: 0 times\n", 120)
    check(len(found) == 5 and found[0] == {"model": "fem", "resolution": "1800", "fastest": 0.215, "kinetic": 0.0014, "elastic": 0.027, "penetration": 0.98, "inside": 2.1,
                                           "smallest": 0.99, "largest": 1, "element": -1.53, "inverted": 2, "inverted_for": 0.6, "passed": 0}, f"bounds: {found}")


def figures_by_hand():
    """Rows of tables outside of the markers of the pages that benchmarks write, that have a cell which is a figure."""
    for name in pages.PAGES:
        text = (root / "docs" / f"{name}.md").read_text()
        for number, sentence in pages.unpaired(text):
            wrong.append(f"docs/{name}.md:{number}: {sentence}")
        inside, head = False, ""
        for number, line in enumerate(text.splitlines(), 1):
            inside = inside or re.match(r"<!-- (table|run)\b", line) is not None
            head = (head or line) if line.startswith("|") else ""
            if not inside and line.startswith("|") and (name, head) not in PHYSICS and any(re.match(r"[*~<>]*[-+]?\d[\d,.]*", cell.strip()) for cell in line.split("|")):
                wrong.append(f"docs/{name}.md:{number}: a figure in a table that no benchmark writes: {line}")
            inside = inside and line != "<!-- end -->"
    for page in root.glob("docs/*.md"):
        if page.stem not in pages.PAGES and page.stem != "validation" and re.search(r"^<!-- (table|run)\b", page.read_text(), flags=re.M):
            wrong.append(f"docs/{page.name} has markers, but benchmarks/pages.py writes nothing there")


tables()
refusals()
gpu_output()
program_output()
figures_by_hand()
wrong += pages.differences()
print("\n".join(wrong))
sys.exit(1 if wrong else 0)
