#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Mutates scene files and runs them with sinew_server, the program sinew for many scenes. A scene that is wrong has to be refused with
a message; a defect is a signal, a finding of a sanitizer, a leak, a run that takes --timeout seconds of the processor, or WAIT times as
long by the clock, a refusal without a word, or an end at a kinetic energy that is not finite, unless the scene itself asks for places or
speeds beyond 1e150. Defects are kept in --keep with what the program said. A mutant depends on the seed and its number only: --only
NUMBER makes it again.

Mutations: values (special numbers, lists that are cut, longer or empty, links that lead elsewhere, words), attributes, and
components and nodes that are removed, copied, moved, nested, or replaced by those of other scenes and by classes of
`sinew list`."""
import argparse
import copy
import json
import math
import multiprocessing
import os
import pathlib
import random
import re
import select
import signal
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

NUMBERS = ["0", "-0", "-1", "1", "2", "3", "7", "0.5", "99999", "-99999", "1e9", "1e300", "-1e300", "1e-300", "1e-9", "nan", "inf",
           "2147483647", "-2147483648", "4294967296", "9223372036854775807", "1e999"]
WORDS = ["", " ", "true", "x", "@", "@.", "@..", "@/", "@../..", "@[-1]", "@[1]", "@name.position", "Vec3d", "Rigid3d", "Vec1d,Vec3d",
         "1 2 3 4 5 6 7 8 9 10 11 12", "a" * 5000, "\u00e9\u202e", "0-5", "1e", "--1", "0x10", "1,2,3"]
NUMBER = re.compile(r"[-+]?\d+(\.\d+)?([eE][-+]?\d+)?")
WAIT = 10  # seconds by the clock for each of the processor, which others use too
SCENES_OF_ONE = 20  # scenes that one process runs before it looks for leaks
EXITS = tuple(f"exit {status}" for status in range(5))


def all_classes(program):
    """Names of the classes that scenes may have."""
    lines = subprocess.run([program, "list"], capture_output=True, text=True, check=True).stdout.splitlines()
    return sorted({line.split()[0] for line in lines if line.startswith("  ") and line.split() and line.split()[0].isidentifier()})


def parsed(path):
    try:
        return ET.parse(path)
    except (OSError, ET.ParseError) as error:
        sys.exit(f"mutate: {path}: {error}")


class Mutator:
    def __init__(self, scenes, classes):
        self.trees = [(path, parsed(path)) for path in scenes]
        self.classes = classes
        self.pool = [e for _, tree in self.trees for e in tree.iter() if e.tag != "Node"]
        self.values = [v for e in self.pool for v in e.attrib.values()]

    def mutant(self, seed, number):
        """The scene that a mutant is of, and its text."""
        rng = random.Random(f"{seed} {number}")
        path, tree = rng.choice(self.trees)
        root = copy.deepcopy(tree.getroot())
        for _ in range(rng.choice([1, 1, 1, 2, 3, 5, 8])):
            self.mutate(root, rng)
        return path, ET.tostring(root, encoding="unicode")

    def mutate(self, root, rng):
        nodes = [e for e in root.iter() if e.tag == "Node"]
        components = [(p, c) for p in nodes for c in p if c.tag != "Node"]
        kind = rng.random()
        if kind < 0.5 and components:
            self.value(rng.choice(components)[1], rng)
        elif kind < 0.6 and components:
            parent, component = rng.choice(components)
            parent.remove(component)
        elif kind < 0.7 and components:  # copied, or moved
            parent, component = rng.choice(components)
            if rng.random() < 0.5:
                parent.remove(component)
            self.insert(rng.choice(nodes), copy.deepcopy(component), rng)
        elif kind < 0.82:
            self.insert(rng.choice(nodes), copy.deepcopy(rng.choice(self.pool)), rng)
        elif kind < 0.9:
            element = ET.Element(rng.choice(self.classes))
            if components and rng.random() < 0.5:
                element.attrib.update(rng.choice(components)[1].attrib)
            self.insert(rng.choice(nodes), element, rng)
        elif kind < 0.95 and len(nodes) > 1:  # a node copied somewhere, also into itself
            self.insert(rng.choice(nodes), copy.deepcopy(rng.choice(nodes[1:])), rng)
        elif kind < 0.97 and components:
            rng.choice(components)[1].tag = rng.choice(self.classes)
        else:
            self.value(rng.choice(nodes), rng)

    @staticmethod
    def insert(node, element, rng):
        element.attrib.pop("name", None)
        node.insert(rng.randrange(len(node) + 1), element)

    def value(self, element, rng):
        names = list(element.attrib)
        if not names or rng.random() < 0.05:
            names.append(rng.choice(["template", "position", "indices", "name", "n", "src", "filename", "dt", "gravity"]))
        name = rng.choice(names)
        value = element.attrib.get(name, "")
        words = value.split()
        kind = rng.random()
        if kind < 0.45 and words:
            count = 0 if rng.random() < 0.2 else 1 + len(words) // 2
            value = NUMBER.sub(lambda m: rng.choice(NUMBERS) if rng.random() < 0.4 else m.group(0), value, count=count)
        elif kind < 0.6:
            value = " ".join(words[:rng.randrange(len(words) + 1)])
        elif kind < 0.72:
            value = " ".join(words * rng.choice([2, 3, 50]))[:20000]
        elif kind < 0.84:
            value = rng.choice(NUMBERS + WORDS)
        elif kind < 0.94:
            value = rng.choice(self.values)
        else:
            element.attrib.pop(name, None)
            return
        element.attrib[name] = value


def finite(result, content):
    """Whether the states are: of speeds beyond 1e150 m/s, as a scene may ask for, the energy is beyond the largest number."""
    energy = result.get("kineticEnergy")
    return isinstance(energy, (int, float)) and math.isfinite(energy) or any(abs(v) > 1e150 for v in motions_of(content))


def motions_of(content):
    """Numbers of a scene that are places, speeds and what makes them."""
    for values in re.findall(r'\b(?:position|velocity|movements|keyTimes|gravity|forces?|dt|translation|target)="([^"]*)"', content, re.I):
        for match in NUMBER.finditer(values):
            value = float(match.group(0))
            if math.isfinite(value):
                yield value


class Server:
    """Runs scenes one after the other (serve.cpp)."""

    def __init__(self, program, timeout, scenes):
        self.program, self.wait = program, WAIT * timeout
        self.environment = dict(os.environ, SINEW_SERVER_SCENES=str(scenes), SINEW_SERVER_SECONDS=str(timeout),
                                ASAN_OPTIONS="exitcode=99:allocator_may_return_null=0:max_allocation_size_mb=4000:quarantine_size_mb=32",
                                UBSAN_OPTIONS="halt_on_error=1:exitcode=99:print_stacktrace=1")
        self.start()

    def start(self):
        self.process = subprocess.Popen([self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=self.environment,
                                        start_new_session=True)

    def stop(self):
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()

    def run(self, folder, arguments):
        """How sinew ends, and what it writes on standard output and standard error."""
        self.process.stdin.write(("\t".join([folder, *arguments]) + "\n").encode())
        self.process.stdin.flush()
        ended = "hang"
        if select.select([self.process.stdout], [], [], self.wait)[0]:
            ended = self.process.stdout.readline().decode().strip()
        else:
            self.stop()
            self.start()
        if not ended:
            raise RuntimeError(f"the server of scenes has ended with {self.process.wait()}")
        said = [pathlib.Path(folder, name) for name in ("out", "err")]
        return ended, *(path.read_text(errors="replace") if path.exists() else "" for path in said)


class Runner:
    """Of one process of those that share the work."""

    def __init__(self, arguments, classes):
        self.arguments = arguments
        self.mutator = Mutator(arguments.scenes, classes)
        self.server = Server(arguments.program, arguments.timeout, 1 if arguments.only is not None else SCENES_OF_ONE)

    def run(self, number):
        """What is wrong with a mutant, and what the program said; nothing is wrong: None."""
        path, content = self.mutator.mutant(self.arguments.seed, number)
        with tempfile.TemporaryDirectory() as here:
            pathlib.Path(here, "mutant.scn").write_text(content)
            ended, out, err = self.server.run(here, ["run", "mutant.scn", "--steps", "5", "--json", "--data", str(path.parent)])
        wrong = None
        if ended == "hang":
            wrong = f"hangs for {self.arguments.timeout} s"
        elif ended == "leak":
            wrong = f"leaks, or one of the {SCENES_OF_ONE - 1} before it that this process ran"
        elif ended not in EXITS:
            wrong = f"ends by {ended}"
        elif ended != "exit 0" and not err.strip() and '"errors"' not in out:
            wrong = f"ends with {ended} and says nothing"
        elif ended == "exit 0" and not finite(json.loads(out), content):
            wrong = "ends well with a kinetic energy that is not finite"
        return number, path, content, wrong, err, ended


runner = None


def start_runner(arguments, classes):
    global runner
    runner = Runner(arguments, classes)


def run_mutant(number):
    return runner.run(number)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="sinew_server; built with sanitizers it finds more")
    parser.add_argument("scenes", nargs="+", type=pathlib.Path)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--only", type=int, help="the number of one mutant: it is printed and run")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--timeout", type=int, default=20)
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("mutants"), help="folder for what goes wrong")
    arguments = parser.parse_args()
    arguments.program = os.path.abspath(arguments.program)
    arguments.scenes = [scene.resolve() for scene in arguments.scenes]
    classes = all_classes(arguments.program)
    if arguments.only is not None:
        start_runner(arguments, classes)
        number, path, content, wrong, said, ended = run_mutant(arguments.only)
        print(content)
        print(f"{path}: {wrong or ended}\n{said}", file=sys.stderr)
        return 1 if wrong else 0
    exits, defects = {}, 0
    with multiprocessing.Pool(arguments.jobs, start_runner, (arguments, classes)) as pool:
        for number, path, content, wrong, said, ended in pool.imap_unordered(run_mutant, range(arguments.count), 20):
            exits[ended] = exits.get(ended, 0) + 1
            if not wrong:
                continue
            defects += 1
            arguments.keep.mkdir(parents=True, exist_ok=True)
            kept = arguments.keep / f"{arguments.seed}_{number}_{path.stem}"
            kept.with_suffix(".scn").write_text(content)
            kept.with_suffix(".txt").write_text(f"{wrong}\n{said}")
            print(f"mutant {number} of {path.name} {wrong}; see {kept}.txt", flush=True)
    ended = ", ".join(f"{count} with {how}" for how, count in sorted(exits.items()))
    print(f"seed {arguments.seed}: {arguments.count} mutants of {len(arguments.scenes)} scenes, {defects} defects; ended: {ended}")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main())
