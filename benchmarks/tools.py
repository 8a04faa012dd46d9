# SPDX-License-Identifier: BSL-1.0
"""What the parts of run.py share: programs are run, and errors said, in one way."""
import pathlib
import re
import resource
import subprocess
import sys


def fail(message):
    print(f"bench: {message}", file=sys.stderr)
    sys.exit(1)


def output(*command):
    """What a program prints."""
    return output_and_time(*command)[0]


def spent():
    """Seconds of the processor that all programs took together which were run and have ended."""
    return sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])


def output_and_time(*command):
    """What a program prints, and the seconds of the processor that it takes."""
    command = [str(c) for c in command]
    before = spent()
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except FileNotFoundError:
        fail(f"there is no {command[0]}; build the benchmarks with ./dev bench, or name their folder with --build")
    except PermissionError:
        fail(f"{command[0]} is not a program that may be run")
    if done.returncode != 0:
        fail(f"{' '.join(command)} failed:\n{done.stderr}")
    return done.stdout, spent() - before


def markdown(header, rows):
    """A table of Markdown; cells that are figures, in all rows but the first column, stand to the right."""
    rows = [[str(cell) for cell in row] for row in rows]
    figure = lambda cell: not cell or cell[0].isdigit() or cell[0] in "-*"
    rules = ["---" if i == 0 or not all(figure(row[i]) for row in rows) else "--:" for i in range(len(header))]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [[str(cell) for cell in header], rules, *rows])


def mesh_size(path):
    """Points and tetrahedra of a Gmsh file of the versions 1 and 2, or None."""
    try:
        lines = pathlib.Path(path).read_text().split("\n")
    except (OSError, UnicodeDecodeError) as error:
        fail(f"the mesh {path} cannot be read ({error}); name a Gmsh file (.msh)")
    counts = {}
    for number, line in enumerate(lines):
        word = line.strip()
        if word in ("$NOD", "$Nodes") and number + 1 < len(lines):
            counts["points"] = int(lines[number + 1])
        if word in ("$ELM", "$Elements") and number + 1 < len(lines):
            first = number + 2
            counts["tetrahedra"] = sum(row.split()[1:2] == ["4"] for row in lines[first:first + int(lines[number + 1])])
    return (counts["points"], counts["tetrahedra"]) if len(counts) == 2 else None


def block_mesh(path, nx, ny, nz):
    """A Gmsh 1 file of nx x ny x nz cells of one size, six tetrahedra a cell, for machines without a mesh of their own."""
    size = max(nx, ny, nz)
    points = [(i / size, j / size, k / size) for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    at = lambda i, j, k: 1 + i + (nx + 1) * (j + (ny + 1) * k)
    elements = []
    for i in range(nx):
        for j in range(ny):
            for k in range(nz):
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
    return path


class Yardstick:
    """A program to compare with, made of one C++ source: `yardstick MESH STEPS` prints nodes, tetrahedra, steps a second, and
    where point 100 is at the end. Its speed is taken from the processor's time, as that of the benchmarks is: what a
    run takes longer than one of a single step. On a quiet machine that is what it prints."""

    LINE = re.compile(r"(\d+) nodes (\d+) tetrahedra: ([\d.]+) steps/s, point 100 at (\S+) (\S+) (\S+)")

    def __init__(self, source, compiler, folder):
        try:
            source.read_text()
        except (OSError, UnicodeDecodeError) as error:
            fail(f"the yardstick {source} cannot be read ({error}); name its C++ source after --yardstick")
        self.source, self.program, self.start = source, folder / "yardstick", {}
        command = [compiler, "-O3", "-march=native", "-ffast-math", "-std=c++20", "-I/usr/include/eigen3", source, "-o", self.program]
        try:
            done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
        except (FileNotFoundError, PermissionError):
            fail(f"there is no compiler {compiler} for the yardstick; install g++, or name another one with --compiler")
        if done.returncode != 0:
            first = [line for line in done.stderr.splitlines() if "error" in line][:3]
            fail(f"{compiler} does not compile the yardstick {source}:\n" + "\n".join(first or done.stderr.splitlines()[:3]))

    def run(self, mesh, steps):
        """nodes, tetrahedra, steps a second, position of point 100"""
        if steps > 1 and mesh not in self.start:
            self.start[mesh] = min(output_and_time(self.program, mesh, 1)[1] for _ in range(3))
        text, time = output_and_time(self.program, mesh, steps)
        found = self.LINE.search(text)
        if not found:
            fail(f"the yardstick {self.source} did not print 'N nodes M tetrahedra: X steps/s, point 100 at X Y Z' for {mesh}, but:\n{text}")
        nodes, tetrahedra, rate, *place = found.groups()
        if float(rate) <= 0:
            fail(f"the yardstick {self.source} is said to make {rate} steps a second with {mesh}")
        rate = float(rate)
        if steps > 1 and time > 2 * self.start[mesh]:
            rate = (steps - 1) / (time - self.start[mesh])
        return int(nodes), int(tetrahedra), rate, [float(x) for x in place]


def programs(build, names):
    """Those of the benchmarks `names` that are built."""
    return [name for name in names if pathlib.Path(build, name).is_file()]
