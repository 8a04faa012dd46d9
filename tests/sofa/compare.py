#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Runs SOFA's example scenes with the program sinew, 300 steps of each, and says which run, which are refused and why, and, beside
SOFA's own answers, how far positions are apart and how fast the steps are. A scene that runs has to agree to 1e-3 of the largest
displacement, or to stand in the table of docs/sofa.md with the reason; else the exit status is 1. With --write the counts and the
list of all scenes of that page are written anew, between <!-- sofa counts --> or <!-- sofa scenes --> and <!-- end -->.

The answers are a JSON file, packed by gzip or not: for each scene, by its path below the examples, an object with `steps` that were
done, `dt` [s], `sofaStepsPerSecond`, and `states`, a list of {path, template, positions}: of each MechanicalObject its path, as
/Node/Child/Name, its DataTypes, and its coordinates after the steps, one after the other."""
import argparse
import concurrent.futures
import gzip
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

AGREES = 1e-3
NUMBERS = {"Vec1": 1, "Vec2": 2, "Vec3": 3, "Vec6": 6, "Rigid2": 3, "Rigid3": 7}


def kind(types):
    return types.rstrip("df")


def frames_of(file):
    """Frames of a file of `sinew run --record`: of each the positions of each body, with how many numbers a point has."""
    frames = []
    lines = iter(open(file))
    for line in lines:
        words = line.split()
        if words[:1] == ["frame"]:
            frames.append({})
        elif words[:1] == ["state"]:
            size = NUMBERS[kind(words[1])]
            points = [[float(w) for w in next(lines).split()[:size]] for _ in range(int(words[2]))]
            frames[-1][" ".join(words[3:])] = (size, points)
    return frames


def node_of(path):
    """The node of a state in SOFA, by its path here, where a node without a name is called Node."""
    parts = path.split("/")[1:-1]
    return "/" + "/".join(part.replace(" ", "_") or "Node" for part in parts)


def made_by_contact(node):
    """Whether SOFA's responses made this node for themselves: their names are 15 letters and digits at random, or those of the two
    models in contact."""
    return any(re.fullmatch(r"[A-Za-z0-9]{15}|.+-.+", part) for part in node.split("/"))


def furthest(points, others):
    """The largest distance of one of the points to the nearest of the others."""
    return max(min(math.dist(p, o) for o in others) for p in points)


def difference(first, last, states):
    """The largest distance of a point from where SOFA has it, over the largest displacement of its body (over its extent where
    nothing moves), and of which body."""
    worst, body = 0.0, ""
    named = {node_of(s["path"]) for s in states}
    for state in states:
        size = NUMBERS.get(kind(state["template"]), 0)
        numbers, node = state["positions"], node_of(state["path"])
        if size == 0 or not numbers or (node not in last and made_by_contact(node)) or not all(map(math.isfinite, numbers)):
            continue
        count, place = len(numbers) // size, 3 if size == 7 else size
        if node not in last:  # the outermost node has another name here
            node = next((n for n, (s, p) in last.items() if s == size and len(p) == count and n not in named), node)
        if node not in last or len(last[node][1]) != count:
            return math.inf, f"{node}: SOFA has {count} points"
        theirs = [numbers[i * size : i * size + place] for i in range(count)]
        ours = [p[:place] for p in last[node][1]]
        start = [p[:place] for p in first[node][1]]
        if len(start) == count:
            moved, apart = max(map(math.dist, start, theirs)), max(map(math.dist, ours, theirs))
        else:  # points have gone, and SOFA puts the last one into the place of each
            moved, apart = furthest(theirs, start), max(furthest(theirs, ours), furthest(ours, theirs))
        extent = math.dist(*zip(*((min(c), max(c)) for c in zip(*theirs)))) or 1.0
        apart /= moved if moved > 1e-6 * extent else extent
        if apart > worst:
            worst, body = apart, node
    return worst, body


def run(options, scene, answer):
    """What became of a scene: (state, reason or body, difference, speed over SOFA's)."""
    data = [options.examples, options.examples.parent / "share", options.examples.parent / "share/mesh"]
    with tempfile.TemporaryDirectory() as folder:
        compared = answer["steps"] if answer else options.steps
        command = [options.sinew, "run", options.examples / scene, "--every", compared, "--json"]
        command += [w for d in data if d.is_dir() for w in ("--data", d)]
        if answer:
            command += ["--dt", repr(answer["dt"])]

        def done_with(steps, *more):
            words = [str(w) for w in (*command, "--steps", steps, *more)]
            return subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=options.timeout)

        try:
            done = done_with(max(options.steps, compared), "--record", f"{folder}/record")
        except subprocess.TimeoutExpired:
            return "too long", f"more than {options.timeout:g} s", None, None
        if done.returncode != 0:
            said = next((line for line in done.stderr.splitlines() if not line.startswith(("ignored", "warning"))), "")
            state = "refused" if done.returncode == 1 else "failed"
            return state, named(said) or f"exit status {done.returncode}", None, None
        if not answer:
            return "runs", "", None, None
        # without recording, which is no part of a step; a scene of some bodies takes 0.1 ms in all
        try:
            speeds = [json.loads(done_with(compared).stdout).get("stepsPerSecond") for _ in range(options.repeats)]
        except subprocess.TimeoutExpired:
            speeds = []
        speed = statistics.median(speeds) if speeds and all(speeds) else None
        first, then = frames_of(f"{folder}/record")[:2]
        apart, body = difference(first, then, answer["states"])
        return "runs", body, apart, speed / answer["sofaStepsPerSecond"] if speed else None


def explained(page):
    """The scenes that the tables of the page name, but for what is written by --write: in the first column and in code."""
    text = re.sub(r"^<!-- sofa .*?^<!-- end -->$", "", page.read_text(), flags=re.M | re.S) if page.is_file() else ""
    return set(re.findall(r"^\| `([^`]+\.(?:scn|xml))`", text, re.M))


def written(text, block, lines):
    """The text of a page with other lines between <!-- sofa BLOCK --> and <!-- end -->."""
    parts = re.fullmatch(rf"(.*^<!-- sofa {block} -->\n).*?(^<!-- end -->$.*)", text, re.M | re.S)
    if not parts:
        sys.exit(f"the page has no lines <!-- sofa {block} --> and <!-- end --> for what is to be written")
    return parts[1] + "".join(line + "\n" for line in lines) + parts[2]


def figure(apart):
    """A difference with one digit; that of a body with other points is none."""
    return "other points" if apart == math.inf else f"{apart:.1g}" if apart >= 0.01 or apart == 0 else f"{apart:.0e}".replace("e-0", "e-")


def named(message):
    """An error with the names of scene files for their paths."""
    return re.sub(r"\S*/([^/\s]+\.(?:scn|xml))\b", r"\1", message)


def short(message):
    """What an error says, without the folders that were searched and what to do."""
    return re.sub(r" in /.*", "", message.split(";")[0]).replace("|", "\\|").replace("<", "&lt;")


def row(scene, more, result, reasons):
    """The row of a scene for a page, with further cells behind its name."""
    state, why, apart = result[:3]
    cells = [f"`{scene}`", *map(str, more), state if state == "runs" else f"{state}: {short(why)}",
             "" if apart is None else figure(apart) + (", above" if scene in reasons and apart > AGREES else "")]
    return f"| {' | '.join(cells)} |".replace("|  |", "| |")


def counts(results, steps):
    """The counts of a page, a list of it."""
    apart = [r[2] for r in results.values() if r[2] is not None]
    numbers = {state: sum(r[0] == state for r in results.values()) for state in ("runs", "refused", "failed", "too long")}
    return [f"- Of {len(results)} scenes {numbers['runs']} run {steps} steps, {numbers['refused']} are refused with a reason, "
            f"{numbers['failed'] + numbers['too long'] or 'none'} {'fail' if numbers['failed'] + numbers['too long'] > 1 else 'fails'}.",
            f"- Of the {len(apart)} that run and have answers {sum(a <= 1e-5 for a in apart)} agree to 1e-5 of their largest displacement, "
            f"{sum(a <= AGREES for a in apart)} to 1e-3 and {sum(a <= 0.05 for a in apart)} to 5 %."]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sinew", type=pathlib.Path, help="the program")
    parser.add_argument("--examples", type=pathlib.Path, required=True, help="folder examples/ of SOFA's sources")
    parser.add_argument("--answers", type=pathlib.Path, help="SOFA's answers")
    parser.add_argument("--page", type=pathlib.Path, default=pathlib.Path(__file__).parents[2] / "docs/sofa.md", help="with reasons")
    parser.add_argument("--table", type=pathlib.Path, help="file for a row of each scene, apart by tabs")
    parser.add_argument("--steps", type=int, default=300, help="of each scene")
    parser.add_argument("--write", action="store_true", help="counts and list of the page")
    parser.add_argument("--timeout", type=float, default=300, help="[s] for a scene")
    parser.add_argument("--jobs", type=int, default=1, help="scenes at once; speeds mean something with 1 only")
    parser.add_argument("--repeats", type=int, default=5, help="of which the median is a scene's speed; 0: positions only")
    parser.add_argument("--only", nargs="+", metavar="PART", help="scenes whose path has one of these in it")
    options = parser.parse_args()
    options.sinew, options.examples = options.sinew.resolve(), options.examples.resolve()
    if not options.sinew.is_file():
        sys.exit(f"compare.py: there is no program {options.sinew}; give that of sinew")
    if not options.examples.is_dir():
        sys.exit(f"compare.py: there is no folder {options.examples}; give that of SOFA's examples")
    answers = {}
    if options.answers:
        with (gzip.open if options.answers.suffix == ".gz" else open)(options.answers, "rt") as file:
            answers = json.load(file)
    scenes = sorted({*answers, *(str(f.relative_to(options.examples)) for f in options.examples.rglob("*.scn"))})
    scenes = [s for s in scenes if not options.only or any(part in s for part in options.only)]
    if not scenes:
        sys.exit(f"compare.py: no scene of {options.examples} is meant")
    if options.write and (options.only or not options.answers):
        sys.exit("compare.py: the page is of all scenes, beside SOFA's answers; give --answers, and not --only")

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda s: run(options, s, answers.get(s)), scenes))
    rows = [(s, state, "" if apart is None else f"{apart:.1e}", "" if speed is None else f"{speed:.2f}", why)
            for s, (state, why, apart, speed) in zip(scenes, results)]
    if options.table:
        options.table.write_text("".join("\t".join(row) + "\n" for row in rows))
    if options.write:
        all_of = dict(zip(scenes, results))
        text, reasons = options.page.read_text(), explained(options.page)
        text = written(text, "counts", counts(all_of, options.steps))
        table = ["| scene | here | apart |", "| --- | --- | --- |", *(row(s, (), r, reasons) for s, r in all_of.items())]
        options.page.write_text(written(text, "scenes", table))
    known = explained(options.page)
    unexplained = [(s, r) for s, r in zip(scenes, results) if r[2] is not None and r[2] > AGREES and s not in known]
    failed = [(s, r) for s, r in zip(scenes, results) if r[0] in ("failed", "too long")]
    for scene, (state, why, apart, _) in failed + unexplained:
        print(f"{scene}: {state}{'' if apart is None else f', {apart:.1e} apart'}{': ' + why if why else ''}")

    runs = [r for r in results if r[0] == "runs"]
    print(f"{len(scenes)} scenes: {len(runs)} run, {sum(r[0] == 'refused' for r in results)} refused, {len(failed)} failed")
    apart = [r[2] for r in runs if r[2] is not None]
    if apart:
        agree = ", ".join(f"{sum(a <= limit for a in apart)} to {limit:g}" for limit in (1e-5, 1e-3, 0.05))
        print(f"agree with SOFA: {agree}, of {len(apart)}; {len(unexplained)} differ by more than {AGREES:g} without a reason")
    speeds = sorted(r[3] for r in runs if r[3])
    if speeds:
        print(f"speed over SOFA's: median {speeds[len(speeds) // 2]:.2f}, a tenth below {speeds[len(speeds) // 10]:.2f}, "
              f"{sum(s < 1 for s in speeds)} slower")
    return 1 if failed or unexplained else 0


if __name__ == "__main__":
    sys.exit(main())
