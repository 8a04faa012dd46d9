#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Runs the scenes of SOFA's regression tests with the program sinew, as many steps as its references have, and says how far positions
are apart at the end. A scene that runs has to agree to 1e-3 of the largest displacement, or to stand in a table of docs/sofa.md with
the reason; else the exit status is 1. With --write that page gets the list anew, between <!-- sofa regression --> and <!-- end -->.

The scenes and their steps are in RegressionStateScenes.regression-tests of the examples; the references are the folder
references/examples of https://github.com/sofa-framework/Regression: for each state of a scene a file of its positions at the start and
at the end, packed by gzip. A file has no path of its state: its body is the nearest of those with as many numbers. Coordinates have six digits."""
import argparse
import concurrent.futures
import gzip
import math
import pathlib
import subprocess
import sys
import tempfile

import compare


def scenes_of(list_file):
    """(scene, steps) of a list of regression tests."""
    words = (line.split() for line in list_file.read_text().splitlines())
    return [(w[0], int(w[1])) for w in words if len(w) >= 3 and w[0][0] not in "#$"]


def reference(file):
    """Positions of a state at the start and at the end, each a list of numbers, and the time of the end [s]."""
    times, positions = [], []
    with gzip.open(file, "rt") as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["T="]:
                times.append(float(words[1]))
            elif words[:1] == ["X="]:
                positions.append([float(w) for w in words[1:]])
    return positions[0], positions[-1], times[-1]


def distance(point, reference):
    """Of a point from where the reference has it, but for the rounding of that to six digits."""
    def off(x, y):
        return max(abs(x - y) - 0.5 * 10 ** (math.floor(math.log10(abs(y))) - 5), 0) if y else abs(x)
    return math.hypot(*map(off, point, reference))


def apart(first, last, start, end):
    """The smallest difference of a reference from one of the bodies, as compare.difference has it; and of which body."""
    best = math.inf, "no body has as many points"
    for node, (size, points) in last.items():
        if size * len(points) != len(end):
            continue
        place = 3 if size == 7 else size
        theirs, begin = ([numbers[i * size : i * size + place] for i in range(len(points))] for numbers in (end, start))
        worst = max(distance(p[:place], q) for p, q in zip(points, theirs))
        extent = math.dist(*zip(*((min(c), max(c)) for c in zip(*theirs)))) or 1.0
        moved = max(map(math.dist, begin, theirs)) if len(start) == len(end) else 0
        best = min(best, (worst / (moved if moved > 1e-6 * extent else extent), node))
    return best


def run(options, scene, steps):
    """What became of a scene: (state, reason or body, difference)."""
    files = sorted(options.references.glob(f"{scene}.reference*_mstate.txt.gz"))
    if not files:
        return "no reference", "", None
    states = [reference(file) for file in files]
    done = max(steps - 1, 1)  # SOFA writes a state before the step of its time
    with tempfile.TemporaryDirectory() as folder:
        data = [options.examples, options.examples.parent / "share", options.examples.parent / "share/mesh"]
        command = [options.sinew, "run", options.examples / scene, "--steps", done, "--every", done, "--quiet", "--record", f"{folder}/record"]
        command += [w for d in data if d.is_dir() for w in ("--data", d)]
        try:
            ended = subprocess.run([str(w) for w in command], cwd=folder, capture_output=True, text=True, timeout=options.timeout)
        except subprocess.TimeoutExpired:
            return "too long", f"more than {options.timeout:g} s", None
        if ended.returncode != 0:
            said = next((line for line in ended.stderr.splitlines() if not line.startswith(("ignored", "warning"))), "")
            return "refused" if ended.returncode == 1 else "failed", compare.named(said) or f"exit status {ended.returncode}", None
        frames = compare.frames_of(f"{folder}/record")
        worst, body = max(apart(frames[0], frames[-1], start, end) for start, end, _ in states)
        return "runs", body, worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sinew", type=pathlib.Path, help="the program")
    parser.add_argument("--examples", type=pathlib.Path, required=True, help="folder examples/ of SOFA's sources")
    parser.add_argument("--references", type=pathlib.Path, required=True, help="folder references/examples of SOFA's Regression")
    parser.add_argument("--page", type=pathlib.Path, default=pathlib.Path(__file__).parents[2] / "docs/sofa.md", help="with reasons")
    parser.add_argument("--write", action="store_true", help="the list of the page")
    parser.add_argument("--timeout", type=float, default=600, help="[s] for a scene")
    parser.add_argument("--jobs", type=int, default=1, help="scenes at once")
    parser.add_argument("--only", nargs="+", metavar="PART", help="scenes whose path has one of these in it")
    options = parser.parse_args()
    options.sinew, options.examples, options.references = (p.resolve() for p in (options.sinew, options.examples, options.references))
    if not options.sinew.is_file():
        sys.exit(f"regression.py: there is no program {options.sinew}; give that of sinew")
    scenes = scenes_of(options.examples / "RegressionStateScenes.regression-tests")
    scenes = [s for s in scenes if not options.only or any(part in s[0] for part in options.only)]
    if not scenes:
        sys.exit("regression.py: no scene of the regression tests is meant")
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = dict(zip((s for s, _ in scenes), pool.map(lambda s: run(options, *s), scenes)))

    reasons = compare.explained(options.page)
    runs = {s: r for s, r in results.items() if r[0] == "runs"}
    unexplained = {s: r for s, r in runs.items() if r[2] > compare.AGREES and s not in reasons}
    failed = {s: r for s, r in results.items() if r[0] not in ("runs", "refused")}
    for scene, (state, why, worst) in {**failed, **unexplained}.items():
        print(f"{scene}: {state}{'' if worst is None else f', {worst:.1e} apart'}{': ' + why if why else ''}")
    counts = ", ".join(f"{sum(r[2] <= limit for r in runs.values())} to {limit:g}" for limit in (1e-5, 1e-3, 0.05))
    print(f"{len(results)} scenes: {len(runs)} run, {sum(r[0] == 'refused' for r in results.values())} refused, {len(failed)} failed")
    print(f"agree with SOFA: {counts}; {len(unexplained)} differ by more than {compare.AGREES:g} without a reason")
    if options.write:
        rows = [compare.row(s, [steps], results[s], reasons) for s, steps in scenes]
        lines = ["| scene | steps | here | apart |", "| --- | --- | --- | --- |", *rows]
        options.page.write_text(compare.written(options.page.read_text(), "regression", lines))
    return 1 if failed or unexplained else 0


if __name__ == "__main__":
    sys.exit(main())
