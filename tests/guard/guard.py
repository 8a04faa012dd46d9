# SPDX-License-Identifier: BSL-1.0
"""Counts the instructions of a step of each scene of step_guard, and compares them with those recorded.

guard.py PROGRAM COUNTS [--update]

Two runs of N and 2 N steps under callgrind differ by N steps. Only instructions of the program itself count: what the C
library does for it depends on the processor. More than recorded by 3 % is an error; less by 5 % is one too, so that what
was won is not lost again. --update records what is counted.
"""
import concurrent.futures
import os
import re
import subprocess
import sys
import tempfile

SCENES = {"fem_assembled": 3, "fem_matrix_free": 3, "spring_grid": 3, "contacts": 40, "string": 100}
MORE, LESS = 0.03, 0.05


def instructions(program, scene, steps):
    """Of a run, in the program without libraries."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        done = subprocess.run(
            ["valgrind", "--tool=callgrind", "--callgrind-out-file=" + out, program, scene, str(steps)],
            capture_output=True, text=True, env={"PATH": os.environ["PATH"], "LC_ALL": "C"})
        if done.returncode != 0:
            sys.exit(f"{program} {scene} {steps} failed under valgrind:\n{done.stdout}{done.stderr}")
        names, mine, total, skip = {}, False, 0, False
        with open(out) as lines:
            for line in lines:
                if line.startswith("ob="):
                    number, name = re.match(r"ob=(\(\d+\))(?: (.*))?", line.rstrip()).groups()
                    names[number] = name or names[number]
                    mine = os.path.basename(names[number]) == os.path.basename(program)
                elif line.startswith("cob="):
                    number, name = re.match(r"cob=(\(\d+\))(?: (.*))?", line.rstrip()).groups()
                    names[number] = name or names[number]
                elif line.startswith("calls="):
                    skip = True  # the line that follows has what was called
                elif line[0] in "0123456789+-*":
                    if mine and not skip:
                        total += int(line.split()[1])
                    skip = False
        return total


def main():
    arguments = [a for a in sys.argv[1:] if a != "--update"]
    update = len(arguments) + 1 < len(sys.argv)
    program, file = arguments
    recorded = {}
    if os.path.exists(file):
        with open(file) as lines:
            recorded = {w[0]: int(w[1]) for w in map(str.split, lines) if w and w[0] != "#"}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = {(s, k): pool.submit(instructions, program, s, k * n) for s, n in SCENES.items() for k in (1, 2)}
        counts = {s: (runs[s, 2].result() - runs[s, 1].result()) // n for s, n in SCENES.items()}
    wrong = []
    print(f"{'instructions of a step':24}{'now':>14}{'recorded':>14}{'change':>10}")
    for scene, now in counts.items():
        was = recorded.get(scene, 0)
        change = now / was - 1 if was else float("inf")
        print(f"{scene:24}{now:14,}{was:14,}{change:10.2%}")
        if change > MORE:
            wrong.append(f"{scene} takes more instructions than recorded: find out why; if it is worth it, ./dev guard --update")
        elif change < -LESS:
            wrong.append(f"{scene} takes fewer instructions than recorded: ./dev guard --update keeps it so")
    if update:
        with open(file, "w") as out:
            out.write("# Instructions of a step (tests/guard): g++ 12 -O2 -march=x86-64-v2; `./dev guard --update` writes this file.\n")
            out.writelines(f"{s} {n}\n" for s, n in counts.items())
        print("recorded in", file)
    elif wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
