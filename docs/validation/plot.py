#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Makes docs/validation/*.svg and the tables of docs/validation.md from what the tests of tests/validation record.

usage: plot.py FOLDER [OUT]    where FOLDER holds the CSV files that the tests wrote with SINEW_VALIDATION_DIR=FOLDER;
                               the page and its plots are written to OUT, or where they are

A plot or a table is one entry of FIGURES or TABLES at the end of this file. The page has a plot by the name of its
file, and a table between the lines `<!-- table NAME -->` and `<!-- end -->`. Only Python's standard library is used.
"""
import csv
import math
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent

# colours that are told apart by most eyes (Okabe, Ito 2008), with a mark for each
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#444444", "#8c564b", "#7f7f00", "#b30000", "#6a3d9a",
           "#1b6e5a"]
MARKS = ["circle", "square", "triangle", "diamond", "down", "cross"]
LEFT, TOP, BOTTOM, PLOT_WIDTH, PLOT_HEIGHT = 74, 44, 56, 470, 330


def read(folder, names):
    """Rows of the CSV files that blanks separate in `names`, with numbers where a cell is one."""
    def value(cell):
        try:
            return float(cell)
        except ValueError:
            return cell
    rows = []
    for name in names.split():
        try:
            with open(folder / f"{name}.csv", newline="") as file:
                read = [{key: value(cell) for key, cell in row.items()} for row in csv.DictReader(file)]
        except FileNotFoundError:
            raise SystemExit(f"plot.py: {folder}/{name}.csv is missing; run the tests of tests/validation")
        if not read:
            raise SystemExit(f"plot.py: {folder}/{name}.csv has no rows")
        rows += read
    return rows


def escape(words):
    return words.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def power_of_ten(exponent):
    return "10" + "".join("⁻" if c == "-" else "⁰¹²³⁴⁵⁶⁷⁸⁹"[int(c)] for c in str(exponent))


class Axis:
    """Places values between two pixels, and says where the ticks are."""

    def __init__(self, values, log, first, last, limits=None):
        self.log, self.first, self.last = log, first, last
        self.whole = not limits and all(float(v).is_integer() for v in values)
        low, high = limits or (min(values), max(values))
        if log:
            low, high = math.log10(low), math.log10(high)
        room = 0 if limits else 0.04 * (high - low) or abs(high) * 0.1 or 1
        self.low, self.high = low - room, high + room

    def __call__(self, value):
        value = math.log10(value) if self.log else value
        return self.first + (value - self.low) / (self.high - self.low) * (self.last - self.first)

    def holds(self, value):
        if self.log and value <= 0:
            return False
        value = math.log10(value) if self.log else value
        return self.low - 1e-9 <= value <= self.high + 1e-9

    def ticks(self):
        """(value, label) of each tick; a label may be empty."""
        if not self.log:
            span = self.high - self.low
            step = 10 ** math.floor(math.log10(span / 4))
            step *= next(f for f in ((1, 2, 5, 10) if self.whole else (1, 2, 2.5, 5, 10)) if span / (f * step) <= 7)
            digits = max(0, -math.floor(math.log10(step) + 1e-9))
            if round(step * 10 ** digits) != step * 10 ** digits and step < 1 or step == 2.5:
                digits += 1
            ticks = []
            for i in range(math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9) + 1):
                ticks.append((i * step, f"{i * step:.{digits}f}".replace("-", "−") if i else "0"))
            return ticks
        decades = range(math.floor(self.low), math.ceil(self.high) + 1)
        whole = [d for d in decades if self.low <= d <= self.high]
        every = max(1, math.ceil(len(whole) / 9))
        ticks = []
        for d in decades:
            for digit in range(1, 10):
                value = digit * 10.0 ** d
                if not self.holds(value):
                    continue
                label = ""
                if digit == 1 and d % every == 0:
                    label = power_of_ten(d)
                elif len(whole) < 2 and digit in (1, 2, 5):
                    label = f"{value:g}"
                if every == 1 or label:
                    ticks.append((value, label))
        if len(whole) < 2:
            ticks = [(v, f"{v:g}" if t else t) for v, t in ticks]
        return ticks


def mark(kind, x, y, colour):
    r = 4
    shapes = {
        "square": [(-r, -r), (r, -r), (r, r), (-r, r)],
        "triangle": [(0, -r * 1.3), (r * 1.2, r), (-r * 1.2, r)],
        "diamond": [(0, -r * 1.4), (r * 1.4, 0), (0, r * 1.4), (-r * 1.4, 0)],
        "down": [(0, r * 1.3), (r * 1.2, -r), (-r * 1.2, -r)],
    }
    if kind == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r}" fill="white" stroke="{colour}" stroke-width="1.8"/>'
    if kind == "cross":
        return (f'<path d="M{x - r:.1f} {y - r:.1f}L{x + r:.1f} {y + r:.1f}M{x - r:.1f} {y + r:.1f}L{x + r:.1f} {y - r:.1f}"'
                f' fill="none" stroke="{colour}" stroke-width="1.8"/>')
    points = " ".join(f"{x + a:.1f},{y + b:.1f}" for a, b in shapes[kind])
    return f'<polygon points="{points}" fill="white" stroke="{colour}" stroke-width="1.8"/>'


def path(points, colour, width=1.8, dash=""):
    d = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
    dashed = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<path d="{d}" fill="none" stroke="{colour}" stroke-width="{width}"{dashed}/>'


def figure(rows, title, x, y, series=None, line=None, log="", slopes=(), marks=True, dashed=(), hidden=(), xlim=None,
           ylim=None, square=False, names=None):
    """The SVG of one plot.

    x, y      column, and label of the axis
    series    column by which rows are told apart
    line      column of a closed form: it is drawn as a line, and y as marks that are not joined
    log       "x", "y" or "xy"
    slopes    (order, series, factor): a dashed line of that slope that starts at `factor` times the series' end
    marks     False for lines alone, or the names of the series that have marks
    dashed    series drawn as dashed lines without marks
    hidden    series left out
    names     of series in the legend, where they are others than in the file
    """
    labels = {}
    for row in rows:
        if (name := str(row[series]) if series else "") not in hidden:
            labels.setdefault(name, []).append(row)
    (xc, xlabel), (yc, ylabel) = x, y
    usable = [r for group in labels.values() for r in group if not ("y" in log and r[yc] <= 0)]
    ys = [r[yc] for r in usable] + [r[line] for r in usable if line]
    height = PLOT_WIDTH if square else PLOT_HEIGHT
    ax = Axis([r[xc] for r in usable], "x" in log, LEFT, LEFT + PLOT_WIDTH, xlim)
    ay = Axis(ys, "y" in log, TOP + height, TOP, ylim)
    if line and not series:
        labels = {"computed": rows}
    legend = [(names or {}).get(name, name) for name in labels] if series or line else []
    legend += [f"line: {line}"] if line else []
    width = LEFT + PLOT_WIDTH + (46 + max(round(6.7 * len(name)) for name in legend) if legend else 20)
    total = TOP + height + BOTTOM

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{total}" viewBox="0 0 {width} {total}" '
           'font-family="Helvetica, Arial, sans-serif" font-size="12" fill="#222222">',
           f"<title>{escape(title)}</title>",
           f'<rect width="{width}" height="{total}" fill="white"/>',
           f'<text x="{LEFT}" y="26" font-size="15" font-weight="bold">{escape(title)}</text>']
    for value, label in ax.ticks():
        px = ax(value)
        out.append(f'<path d="M{px:.1f} {TOP}V{TOP + height}" stroke="{"#dddddd" if label else "#f2f2f2"}"/>')
        if label:
            out.append(f'<text x="{px:.1f}" y="{TOP + height + 18}" text-anchor="middle">{label}</text>')
    for value, label in ay.ticks():
        py = ay(value)
        out.append(f'<path d="M{LEFT} {py:.1f}H{LEFT + PLOT_WIDTH}" stroke="{"#dddddd" if label else "#f2f2f2"}"/>')
        if label:
            out.append(f'<text x="{LEFT - 8}" y="{py + 4:.1f}" text-anchor="end">{label}</text>')
    out.append(f'<rect x="{LEFT}" y="{TOP}" width="{PLOT_WIDTH}" height="{height}" fill="none" stroke="#222222"/>')
    out.append(f'<text x="{LEFT + PLOT_WIDTH / 2:.0f}" y="{total - 14}" text-anchor="middle" font-size="13">'
               f'{escape(xlabel)}</text>')
    out.append(f'<text transform="translate(18 {TOP + height / 2:.0f}) rotate(-90)" text-anchor="middle" '
               f'font-size="13">{escape(ylabel)}</text>')
    out.append(f'<clipPath id="plot"><rect x="{LEFT}" y="{TOP}" width="{PLOT_WIDTH}" '
               f'height="{height}"/></clipPath>')
    out.append('<g clip-path="url(#plot)">')

    for order, name, factor in slopes:
        points = sorted((r[xc], r[yc]) for r in labels[name] if r[yc] > 0)
        (x0, _), (x1, y1) = points[0], points[-1]
        ends = [(v, y1 * factor * (v / x1) ** order) for v in (x0, x1)]
        # as far as the plot goes
        low = 10 ** ay.low
        if ends[0][1] < low and order > 0:
            v = x1 * (low / (y1 * factor)) ** (1 / order)
            ends[0] = (v, low)
        placed = [(ax(a), ay(b)) for a, b in ends]
        out.append(path(placed, "#888888", 1.2, "6 4"))
        px, py = (0.45 * placed[0][0] + 0.55 * placed[1][0], 0.45 * placed[0][1] + 0.55 * placed[1][1])
        up = -8 if factor >= 1 else 16
        anchor = "end" if (factor >= 1) == (order > 0) else "start"
        out.append(f'<text x="{px:.1f}" y="{py + up:.1f}" text-anchor="{anchor}" fill="#666666">slope {order:g}</text>')

    entries, shapes = [], []
    for i, (name, group) in enumerate(labels.items()):
        colour, kind = COLOURS[i % len(COLOURS)], MARKS[i % len(MARKS)]
        style = "6 4" if name in dashed else ""
        marked = name not in dashed and (marks is True or (marks and name in marks))
        drawn = [r for r in group if not ("y" in log and r[yc] <= 0)]
        if line:
            closed = [(ax(r[xc]), ay(r[line])) for r in group]
            out.append(path(closed, colour, 1.5))
        else:
            out.append(path([(ax(r[xc]), ay(r[yc])) for r in drawn], colour, 1.8 if marked or style else 1.4, style))
        if marked:
            shapes += [mark(kind, ax(r[xc]), ay(r[yc]), colour) for r in drawn if ax.holds(r[xc]) and ay.holds(r[yc])]
        entries.append((name, colour, kind if marked else None, style))
    out.append("</g>")
    out += shapes
    if legend:
        px = LEFT + PLOT_WIDTH + 14
        for i, (name, colour, kind, style) in enumerate(entries):
            py = TOP + 12 + 20 * i
            out.append(path([(px - 4, py), (px + 16, py)], colour, 1.8, style))
            if kind:
                out.append(mark(kind, px + 6, py, colour))
            out.append(f'<text x="{px + 24}" y="{py + 4}">{escape((names or {}).get(name, name))}</text>')
        if line:
            out.append(f'<text x="{px - 4}" y="{TOP + 18 + 20 * len(entries)}" fill="#666666">line: {line}</text>')
    out.append("</svg>")
    return "\n".join(out) + "\n"


def short(value):
    """A number with three digits, in powers of ten where it is far from 1."""
    if isinstance(value, str):
        return value
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e4:
        return f"{value:.{max(0, 2 - math.floor(math.log10(abs(value))))}f}"
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def digits(n):
    return lambda value: f"{value:.{n}f}" if not isinstance(value, str) else value


def whole(value):
    return f"{value:.0f}"


def plain(value):
    return f"{value:g}"


def table(rows, columns):
    """Markdown of a table; a column is its name in the file, its heading, and what writes its values."""
    lines = ["| " + " | ".join(heading for _, heading, _ in columns) + " |", "|" + " --- |" * len(columns)]
    lines += ["| " + " | ".join(write(row[name]) for name, _, write in columns) + " |" for row in rows]
    return "\n".join(lines)


def main():
    if len(sys.argv) not in (2, 3):
        raise SystemExit(__doc__)
    folder, page = pathlib.Path(sys.argv[1]), HERE.parent / "validation.md"
    out = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else page.parent
    words = page.read_text()
    shown, places = re.findall(r"\]\(validation/(\w+)\.svg\)", words), re.findall(r"<!-- table (\w+) -->", words)
    for kind, made, used in (("plot", FIGURES, shown), ("table", TABLES, places)):
        if sorted(made) != sorted(used):
            raise SystemExit(f"plot.py: {page.name} must have each {kind} once; it lacks {sorted(set(made) - set(used))}, "
                             f"and these are made by nobody or shown twice: "
                             f"{sorted({n for n in used if n not in made or used.count(n) > 1})}")
    (out / "validation").mkdir(exist_ok=True)
    for name, (source, settings) in FIGURES.items():
        (out / "validation" / f"{name}.svg").write_text(figure(read(folder, source), **settings))
    for svg in HERE.glob("*.svg"):
        if svg.stem not in FIGURES:
            raise SystemExit(f"plot.py: {svg} is no longer made; delete it")
    for name, (source, columns) in TABLES.items():
        made = f"<!-- table {name} -->\n\n{table(read(folder, source), columns)}\n\n<!-- end -->"
        words, found = re.subn(rf"<!-- table {name} -->.*?<!-- end -->", lambda _: made, words, flags=re.S)
        if found != 1:
            raise SystemExit(f"plot.py: the table {name} of {page.name} has no <!-- end -->")
    (out / page.name).write_text(words)
    print(f"{len(FIGURES)} plots and {len(TABLES)} tables in {out / page.name}")


# name of the plot: the files it is made of, and the arguments of figure()
FIGURES = {
    "cantilever": ("cantilever", dict(
        title="Cantilever, length 10, against Timoshenko", series="element", x=("h", "side of a cell, in heights of the bar"),
        y=("error", "stiffness in excess, w_T / w − 1"), log="xy", slopes=[(2, "HexahedronFEM", 0.5)])),
    "hexahedra_bending": ("hexahedra_bending", dict(
        title="Pure bending of a bar of hexahedra", x=("a", "length of a hexahedron along the bar, in heights of the bar"),
        y=("ratio", "rotation of the end, against theory"), line="closed form", log="x", ylim=(0, 1.05))),
    "elastica": ("elastica", dict(
        title="Tip of a slender cantilever, 20 beams", series="coordinate", x=("load", "dead load, PL²/EI"),
        y=("tip", "place of the tip / L"), line="closed form")),
    "elastica_convergence": ("elastica_convergence", dict(
        title="The same, against the size of elements", series="load", x=("h", "length of an element / L"),
        y=("error", "distance of the tip from the elastica / L"), log="xy", slopes=[(2, "PL²/EI = 1", 0.5)])),
    "beam_frequencies": ("beam_frequencies", dict(
        title="First frequencies of a beam", series="mode", x=("h", "length of an element / L"),
        y=("error", "relative error, its size"), log="xy",
        slopes=[(2, "stretch", 0.5), (4, "bending, on simple supports", 2)])),
    "plates": ("plates", dict(
        title="Plates under an even load, against Kirchhoff", series="plate", x=("h", "1 / cells along a side or a radius"),
        y=("error", "relative error of the middle"), log="xy", slopes=[(2, "disc, clamped", 0.5)])),
    "locking": ("locking", dict(
        title="Cantilever, length 5, near incompressibility", series="element",
        x=("compressibility", "1/2 − ν"), y=("ratio", "tip, against Timoshenko"), log="x", ylim=(0, 1.05))),
    "cylinder": ("cylinder", dict(
        title="Cylinder under traction, corotational elements", series="method", x=("pressure", "traction p/E"),
        y=("error", "relative error of the strains"), log="xy", ylim=(1e-16, 1),
        slopes=[(1, "TetrahedronFEM large", 6)])),
    "hyperelastic_uniaxial": ("hyperelastic_uniaxial", dict(
        title="Hyperelastic laws: one axis pulled", series="law", x=("stretch", "stretch"),
        y=("stress", "nominal stress / shear modulus"), line="closed form")),
    "hyperelastic_biaxial": ("hyperelastic_biaxial", dict(
        title="Hyperelastic laws: two axes pulled", series="law", x=("stretch", "stretch"),
        y=("stress", "nominal stress / shear modulus"), line="closed form")),
    "hyperelastic_shear": ("hyperelastic_shear", dict(
        title="Hyperelastic laws: simple shear", series="law", x=("shear", "shear"),
        y=("stress", "shear stress / shear modulus"), line="closed form")),
    "relaxation": ("relaxation", dict(
        title="Relaxation of a Prony series in a held shear", series="step", x=("time", "time [s]"),
        y=("modulus", "shear stress / shear [Pa]"), line="closed form", log="x")),
    "chain": ("chain", dict(
        title="Modes of a chain of 16 springs", series="chain", x=("mode", "mode"),
        y=("frequency", "angular frequency / sqrt(k/m)"), dashed=["string without lumps"],
        marks=["springs"])),
    "vibration": ("vibration", dict(
        title="First frequencies of bars", series="bar", x=("h", "side of a cell [m]"),
        y=("error", "relative error, its size"), log="xy",
        slopes=[(2, "bending, hexahedra, consistent mass", 0.4)])),
    "orders": ("orders", dict(
        title="Convergence of the solvers in time", series="solver", x=("h", "time step h [s]"),
        y=("error", "error of position and velocity at t = 2 s"), log="xy",
        slopes=[(1, "EulerImplicitSolver", 2.5), (2, "BDFOdeSolver", 2.5), (4, "RungeKutta4Solver", 4),
                (5, "RungeKutta45Solver", 0.3)])),
    "energy_drift": ("energy_drift", dict(
        title="Energy of a mass that a spring slings around", series="solver", x=("step", "step"),
        y=("error", "largest relative error so far"), log="xy")),
    "kepler_energy": ("kepler_energy", dict(
        title="Energy of a planet, 100 steps a year", series="solver", x=("year", "year"),
        y=("error", "largest relative error in the year"), log="xy")),
    "kepler_orbits": ("kepler_orbits", dict(
        title="Ten years of a planet, 60 steps a year", series="solver", x=("x", "x"), y=("y", "y"), marks=False,
        square=True, xlim=(-1.6, 1.6), ylim=(-1.6, 1.6))),
    "low_rank_residuals": ("low_rank_residuals", dict(
        title="Conjugate gradients after one point has changed", series="solver", x=("iteration", "iteration"),
        y=("residual", "relative residual"), log="y", marks=False)),
    "free_form_volume": ("free_form_volume", dict(
        title="Volume of the sparse grid around a liver", series="cells", x=("width", "side of a cell [mm]"),
        y=("ratio", "volume of the cells / volume of the liver"), ylim=(0, 2))),
    "fluid_vortex": ("fluid_vortex", dict(
        title="Taylor and Green's vortex on a grid, dt = 1.6 / n", series="method", x=("n", "cells along a side"),
        y=("error", "root of the mean square error of velocity"), log="xy", slopes=[(-1, "macCormack", 0.5)])),
    "fluid_wave": ("fluid_wave", dict(
        title="Standing wave in a tank", series="who", x=("time", "time [s]"), y=("height", "height at the wall [m]"),
        marks=False, dashed=("linear theory",))),
}

# name of the table: the file it is made of, and its columns
TABLES = {
    "cantilever": ("cantilever_table", [("element", "element", str), ("across", "cells across", whole),
                                        ("points", "points", whole), ("ratio", "w / w_T", digits(4))]),
    "roof": ("roof", [("cells", "cells a side", whole), ("sinks", "edge sinks by", digits(4)),
                      ("ratio", "against 0.3024", digits(4))]),
    "bent_beam": ("bent_beam", [("who", "who, and elements", str), ("x", "x", digits(2)), ("y", "y", digits(2)),
                                ("z", "z", digits(2))]),
    "cylinder_hyperelastic": ("cylinder_hyperelastic", [
        ("law", "law", str), ("p1", "strain at p/E = 1e-4", short), ("p2", "stretch at 0.02", digits(4)),
        ("p3", "at 0.1", digits(4)), ("p4", "at 0.3", digits(4)), ("error", "largest difference", short)]),
    "orders": ("orders_table", [("solver", "solver", str), ("claimed", "claimed order", whole),
                                ("measured", "measured", digits(3))]),
    "kepler": ("kepler", [
        ("solver", "solver", str), ("years", "years", whole), ("first", "energy error, first year", short),
        ("last", "last year", short), ("momentum", "angular momentum error", short),
        ("turn", "turn of the ellipse [degrees a year]", short)]),
    "settled": ("settled", [("element", "element", str), ("sag", "sag [m]", digits(3)),
                            ("difference", "difference [m]", short), ("iterations", "Newton iterations", whole)]),
    "spring_networks": ("spring_networks", [
        ("load", "load on a point [N]", plain), ("way", "largest way [m]", short),
        ("ldl", "difference, SparseLDLSolver [m]", short), ("cg", "difference, CGLinearSolver [m]", short)]),
    "low_rank": ("low_rank", [
        ("k", "k [N/m]", plain), ("change", "change of the solution", short), ("smw", "error, low rank", short),
        ("cg", "error, CG", short), ("iterations", "iterations, CG", whole),
        ("preconditioned", "with block Jacobi", whole)]),
    "free_form": ("free_form", [("width", "side of a cell [mm]", plain), ("cells", "cells", whole),
                                ("ratio", "sag, against tetrahedra", digits(3))]),
}

if __name__ == "__main__":
    main()
