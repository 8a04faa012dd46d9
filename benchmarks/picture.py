# SPDX-License-Identifier: BSL-1.0
"""A picture of what run.py measured: bars, with a mark where the aim is. `picture.py bench.json bench.svg` makes it again."""
import json
import pathlib
import sys

NAMES, BARS, ROW, GAP = 330, 470, 18, 44
FILL, MARK = "#0072b2", "#d55e00"


def escape(words):
    return str(words).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def panels(results):
    """(title, unit, [(name, value, aim or None)]) of each group of bars."""
    groups = []
    for table, place in (("fem", "mesh"), ("grids", "grid"), ("small", None)):
        bars = [(", ".join(filter(None, [row.get(place), row["kind"]])), row["times_sofa"], row["aim"]) for row in results.get(table, []) if row.get("times_sofa")]
        groups.append((f"Speed in times that of SOFA: {table}", "x", bars))
    for mesh, young in dict.fromkeys((row["mesh"], row["young"]) for row in results.get("accuracy", [])):
        bars = [(row["solver"], 1e3 * row["seconds"], None) for row in results["accuracy"] if (row["mesh"], row["young"]) == (mesh, young)]
        groups.append((f"A step to a residual of 1e-6: {mesh}, E {young:,} Pa", "ms", bars))
    shares = [(f"{row['loop']}, {row['tetrahedra']:,} tetrahedra", 100 * row["share"], 60) for row in results.get("roofline", [])]
    groups.append(("Share of what the processor can do", "%", shares))
    groups.append(("Time of a step for each tetrahedron", "ns", [(f"{row['tetrahedra']:,.0f}", 1e9 * row["step"] / row["tetrahedra"], None) for row in results.get("growth", [])]))
    groups.append(("Memory of each tetrahedron, and what the method needs", "bytes",
                   [(f"{row['tetrahedra']:,.0f}", row["arrays"] / row["tetrahedra"], row["least"] / row["tetrahedra"]) for row in results.get("growth", [])]))
    for scene in dict.fromkeys(row["scene"] for row in results.get("portability", [])):
        groups.append((f"Builds for levels of x86-64: {scene}", "steps/s", [(row["build"], row["steps_per_second"], None) for row in results["portability"] if row["scene"] == scene]))
    return [group for group in groups if group[2]]


def svg(results):
    parts, y = [], 30
    for title, unit, bars in panels(results):
        top = max(max(value, aim or 0) for _, value, aim in bars)
        parts.append(f'<text x="12" y="{y}" font-weight="bold">{escape(title)}</text>')
        y += 10
        for name, value, aim in bars:
            width = BARS * value / top if top > 0 else 0
            parts.append(f'<text x="{NAMES - 8}" y="{y + 13}" text-anchor="end">{escape(name)}</text>')
            parts.append(f'<rect x="{NAMES}" y="{y + 2}" width="{max(width, 1):.1f}" height="{ROW - 4}" fill="{FILL}"/>')
            parts.append(f'<text x="{NAMES + max(width, BARS * (aim or 0) / top if top > 0 else 0) + 6:.1f}" y="{y + 13}">{value:,.4g} {escape(unit)}</text>')
            if aim:
                x = NAMES + BARS * aim / top
                parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{y}" y2="{y + ROW}" stroke="{MARK}" stroke-width="2"/>')
            y += ROW
        y += GAP
    words = f"{results.get('machine', '')}; a line across a bar: the aim, or the least"
    parts.append(f'<text x="12" y="{y - 14}" fill="#555">{escape(words)}</text>')
    width = NAMES + BARS + 130
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{y}" viewBox="0 0 {width} {y}" font-family="sans-serif" font-size="12">\n'
            f'<rect width="{width}" height="{y}" fill="white"/>\n' + "\n".join(parts) + "\n</svg>\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: picture.py bench.json bench.svg")
    try:
        measured = json.loads(pathlib.Path(sys.argv[1]).read_text())
    except (OSError, ValueError) as error:
        sys.exit(f"picture.py: {sys.argv[1]} cannot be read ({error})")
    pathlib.Path(sys.argv[2]).write_text(svg(measured))
