# SPDX-License-Identifier: BSL-1.0
"""The plots of the pages: bars, and lines over logarithmic axes, as SVG that follows the light or dark scheme of its reader."""
import math

NAMES, BARS, ROW, GAP = 300, 430, 17, 40
WIDTH = NAMES + BARS + 110
LEFT, PLOT, HEIGHT = 70, 430, 300
# told apart by most eyes (Okabe, Ito 2008); lighter ones on dark ground
LIGHT = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8c6d00", "#56b4e9"]
DARK = ["#56b4e9", "#ff8c42", "#3fd6a5", "#e7a3cb", "#f0d060", "#9ad0f5"]


def escape(words):
    return str(words).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def style():
    def scheme(ground, words, lines, colours):
        return (f".ground{{fill:{ground}}}text{{fill:{words}}}.line{{stroke:{lines};fill:none}}.mark{{stroke:{words};stroke-width:2}}" +
                "".join(f".c{i}{{fill:{c};stroke:{c}}}" for i, c in enumerate(colours)) + ".series{fill:none;stroke-width:1.8}")
    return ("<style>" + scheme("#ffffff", "#222222", "#d8d8d8", LIGHT) +
            "@media(prefers-color-scheme:dark){" + scheme("#1e2129", "#e4e4e4", "#484c56", DARK) + "}</style>")


def document(width, height, title, parts):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
            f'font-family="Helvetica, Arial, sans-serif" font-size="12">\n{style()}\n<title>{escape(title)}</title>\n'
            f'<rect class="ground" width="{width}" height="{height}"/>\n'
            f'<text x="12" y="24" font-size="15" font-weight="bold">{escape(title)}</text>\n' + "\n".join(parts) + "\n</svg>\n")


def number(value):
    return f"{round(float(f'{value:.3g}')):,}" if value >= 100 else f"{float(f'{value:.3g}'):g}"


def bars(title, unit, groups, note="", full=None):
    """groups: (heading, [(name, value, mark or None, colour)]), each with a scale of its own, or one that ends at `full`; a mark is a line
    across the bar."""
    parts, y = [], 44
    for heading, rows in groups:
        top = full or max(max(value, mark or 0) for _, value, mark, _ in rows)
        parts.append(f'<text x="12" y="{y + 4}" font-weight="bold">{escape(heading)}</text>')
        y += 12
        for name, value, mark, colour in rows:
            width = BARS * value / top if top > 0 else 0
            parts.append(f'<text x="{NAMES - 8}" y="{y + 12}" text-anchor="end">{escape(name)}</text>')
            parts.append(f'<rect class="c{colour}" x="{NAMES}" y="{y + 2}" width="{max(width, 1):.1f}" height="{ROW - 5}"/>')
            end = max(width, BARS * (mark or 0) / top if top > 0 else 0)
            parts.append(f'<text x="{NAMES + end + 6:.1f}" y="{y + 12}">{number(value)} {escape(unit)}</text>')
            if mark:
                x = NAMES + BARS * mark / top
                parts.append(f'<path class="mark" d="M{x:.1f} {y}v{ROW}"/>')
            y += ROW
        y += GAP - ROW
    if note:
        parts.append(f'<text x="12" y="{y}">{escape(note)}</text>')
        y += 18
    return document(WIDTH, y, title, parts)


def power(exponent):
    return "10" + "".join("⁻" if c == "-" else "⁰¹²³⁴⁵⁶⁷⁸⁹"[int(c)] for c in str(exponent))


def scale(values, first, last):
    """Places values on a logarithmic axis between two pixels; its decades, or digits of them where there are few."""
    low, high = math.log10(min(values)), math.log10(max(values))
    room = 0.05 * (high - low) or 0.1
    low, high = low - room, high + room
    place = lambda value: first + (math.log10(value) - low) / (high - low) * (last - first)
    decades = [d for d in range(math.ceil(low), math.floor(high) + 1)]
    ticks = [(10.0**d, power(d)) for d in decades]
    if len(decades) < 2:
        ticks = [(m * 10.0**d, number(m * 10.0**d)) for d in range(math.floor(low), math.ceil(high) + 1) for m in (1, 2, 5) if low <= math.log10(m) + d <= high]
    return place, ticks


def curves(title, x, y, series):
    """series: (name, [(x, y)]) over two logarithmic axes, whose labels are x and y."""
    parts, top, bottom = [], 40, 40 + HEIGHT
    points = [p for _, some in series for p in some]
    px, xticks = scale([p[0] for p in points], LEFT, LEFT + PLOT)
    py, yticks = scale([p[1] for p in points], bottom, top)
    for value, label in xticks:
        parts.append(f'<path class="line" d="M{px(value):.1f} {top}V{bottom}"/><text x="{px(value):.1f}" y="{bottom + 16}" text-anchor="middle">{label}</text>')
    for value, label in yticks:
        parts.append(f'<path class="line" d="M{LEFT} {py(value):.1f}h{PLOT}"/><text x="{LEFT - 6}" y="{py(value) + 4:.1f}" text-anchor="end">{label}</text>')
    parts.append(f'<rect class="line" x="{LEFT}" y="{top}" width="{PLOT}" height="{HEIGHT}"/>')
    parts.append(f'<text x="{LEFT + PLOT / 2:.0f}" y="{bottom + 36}" text-anchor="middle">{escape(x)}</text>')
    parts.append(f'<text transform="translate(16 {top + HEIGHT / 2:.0f}) rotate(-90)" text-anchor="middle">{escape(y)}</text>')
    for i, (name, some) in enumerate(series):
        dashed = ' stroke-dasharray="6 4"' if i >= len(LIGHT) else ""
        line = "L".join(f"{px(a):.1f} {py(b):.1f}" for a, b in some)
        parts.append(f'<path class="c{i % len(LIGHT)} series"{dashed} d="M{line}"/>')
        parts += [f'<circle class="c{i % len(LIGHT)}" cx="{px(a):.1f}" cy="{py(b):.1f}" r="3.5"/>' for a, b in some]
        at = top + 12 + 20 * i
        parts.append(f'<path class="c{i % len(LIGHT)} series"{dashed} d="M{LEFT + PLOT + 12} {at}h22"/><text x="{LEFT + PLOT + 40}" y="{at + 4}">{escape(name)}</text>')
    return document(LEFT + PLOT + 60 + max(round(6.6 * len(name)) for name, _ in series), bottom + 50, title, parts)


def in_order(rows, key):
    return list(dict.fromkeys(key(row) for row in rows))


def fem(rows, names):
    groups = []
    for tetrahedra in in_order(rows, lambda r: r["tetrahedra"]):
        groups.append((f"{tetrahedra:,} tetrahedra", [(names[r["kind"]], 1e9 / r["steps_per_second"] / tetrahedra, None, int(r["kind"] == "yardstick"))
                                                       for r in rows if r["tetrahedra"] == tetrahedra]))
    return bars("A step of a corotational body, 25 iterations: time for each tetrahedron", "ns", groups)


def accuracy(rows, names):
    groups = []
    for tetrahedra, young in in_order(rows, lambda r: (r["tetrahedra"], r["young"])):
        found = [r for r in rows if (r["tetrahedra"], r["young"]) == (tetrahedra, young)]
        groups.append((f"{tetrahedra:,} tetrahedra, {young / 1e3:g} kPa", [(names.get(r["solver"], r["solver"]), 1e3 * r["seconds"], None, 0) for r in found]))
    return bars("A step to a residual of 1e-6", "ms", groups)


def roofline(rows):
    groups = [(f"{tetrahedra:,} tetrahedra", [(f"{r['loop']}, of {r['bound']}", 100 * r["share"], None, 0) for r in rows if r["tetrahedra"] == tetrahedra])
              for tetrahedra in in_order(rows, lambda r: r["tetrahedra"])]
    return bars("Share of what the processor can do at best", "%", groups, full=100)


def growth(rows):
    per = lambda key: [(r["tetrahedra"], 1e9 * r[key] / r["tetrahedra"]) for r in rows]
    return curves("Growth: time for each tetrahedron", "tetrahedra", "ns", [("a step of 25 iterations", per("step")), ("an iteration", per("iteration"))])


def collision(rows):
    groups = []
    for r in (r for r in rows if r["for"] == "native"):
        found = [(name, 1e3 * r[key] / r["boxes"], None, i) for i, (name, key) in enumerate((("Sinew", "sinew"), ("Bullet", "bullet"), ("FCL", "fcl"))) if r.get(key)]
        groups.append((f"{r['scene']}, {r['boxes']:,} boxes", found))
    return bars("Pairs of boxes that overlap: time of a step for each box", "ns", groups)


def residuals(rows):
    """Time against residual of the workloads that are solved to several tolerances."""
    series = []
    for workload, solver in in_order(rows, lambda r: (r["workload"], r["solver"])):
        found = [r for r in rows if (r["workload"], r["solver"]) == (workload, solver) and r["residual"] > 0]
        if "pile" in workload and len(found) > 1:
            series.append((f"{workload}, {solver.removesuffix('ConstraintSolver')}", sorted((r["residual"], 1e3 / r["steps_per_second"]) for r in found)))
    return curves("Piles of boxes: time and residual", "residual [m]", "ms a step", series) if series else ""


def by_contacts(rows):
    """Time against the number of contacts, at the smallest tolerance."""
    series = {}
    for r in rows:
        if r["workload"].startswith("soft block, ") and r["tolerance"] == 1e-6:
            name = f"{r['workload'].removeprefix('soft block, ')}, {r['solver'].removesuffix('ConstraintSolver')}"
            series.setdefault(name, []).append((r["contacts"], 1e3 / r["steps_per_second"]))
    return curves("A soft block on a slope, to 1e-6 m", "contacts", "ms a step", list(series.items())) if series else ""


def laparoscopy(rows):
    found = [(f"{r['model']} {r['resolution']}", r["steps_per_second"], r["paper"], 0) for r in rows]
    return bars("Laparoscopy: steps a second", "steps/s", [("liver", found)], "A line across a bar: the paper of 2007, on a processor of that time")


def gpu_scenes(rows, forms):
    groups = []
    for scene in in_order(rows, lambda r: r["scene"]):
        found = [r for r in rows if r["scene"] == scene and r["real"] == "float"]
        groups.append((scene, [(forms[r["form"]], r["steps_per_second"], None, list(forms).index(r["form"])) for r in found]))
    return bars("Steps a second on a GPU, float", "", groups)


def gpu_copies(rows):
    series = [(f"{scene}, {real}", [(r["copies"], r["steps_per_second"]) for r in rows if (r["scene"], r["real"]) == (scene, real)])
              for scene, real in in_order(rows, lambda r: (r["scene"], r["real"]))]
    return curves("Copies of a body in one launch", "copies", "steps a second of all", series)


def of_page(page, results):
    """The plots of a page from its results, by name."""
    import pages
    if page == "performance":
        return {"bodies": fem(results["fem"], pages.VARIANTS), "accuracy": accuracy(results["accuracy"], pages.SOLVERS), "roofline": roofline(results["roofline"]),
                "growth": growth(results["growth"]), "collision": collision(results["collision"])}
    if page == "contact":
        return {"contact": by_contacts(results["contact"]), "piles": residuals(results["contact"])}
    if page == "laparoscopy":
        return {"laparoscopy": laparoscopy(results["laparoscopy"])}
    if page == "gpu":
        return {"gpu": gpu_scenes(results["gpu-scenes"], pages.FORMS), "copies": gpu_copies(results["gpu-copies"])}
    return {}
