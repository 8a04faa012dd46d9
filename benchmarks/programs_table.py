# SPDX-License-Identifier: BSL-1.0
"""Tables that one program each prints: what it says a line becomes the rows of its table; pages.py writes it."""
import re

from tools import fail, output

# steps a second that Faure et al. 2007 give for their laparoscopy, on a processor of that time
PAPER_2007 = {"1800": 65, "30000": 4, "17x8x10": 110, "20x10x12": 67, "24x13x15": 37}
LAPAROSCOPY = [("fem", "1800"), ("fem", "30000"), ("grid", "17x8x10"), ("grid", "20x10x12"), ("grid", "24x13x15")]


def number(word):
    """A word as a number where it is one; None where there is none."""
    if word is None:
        return None
    return float(word) if re.fullmatch(r"[-+]?[\d.]+(e[-+]?\d+)?", word) else word.strip()


def lines(pattern, *command):
    """What each line of a program has in the groups of the pattern; all that it prints must be such lines."""
    found = []
    for line in output(*command).splitlines():
        match = re.search(pattern, line)
        if not match:
            fail(f"{command[0].name} printed a line that its table does not know:\n{line}")
        found.append([number(x) for x in match.groups()])
    return found


def by_hand(build):
    keys = ("scene", "typed_us", "hand_us", "ratio", "distance")
    return [dict(zip(keys, row)) for row in lines(r"^(\S.{7}) scene +(\S+) us/step, by hand +(\S+) us/step, ratio (\S+), positions differ by (\S+)", build / "bench_by_hand")]


def vitrectomy(build, rounds):
    rows, size = [], {}
    for points, springs, kind, *figures in lines(r"^(?:(\d+) points, (\d+) springs, .*|  (\S.{10}) scene +(\S+) us/step, by hand +(\S+) us/step, ratio ([\d.]+);.*)$",
                                                 build / "bench_vitrectomy", rounds):
        if points:
            size = {"points": points, "springs": springs}
        else:
            rows.append(size | dict(zip(("kind", "typed_us", "hand_us", "ratio"), (kind, *figures))))
    return rows


def runtime(build):
    keys = ("scene", "points", "runtime_us", "typed_us", "ratio", "bits")
    rows = [dict(zip(keys, row)) for row in lines(r"^(.{34}) +(\d+) points +runtime +(\S+) us/step +typed +(\S+) us/step +ratio (\S+) +(same|other) bits",
                                                  build / "bench_runtime")]
    if any(row["bits"] != "same" for row in rows):
        fail("a runtime tree and the typed tree of the same scene have energies of other bits; this is a mistake in Sinew")
    return rows


def families(build, rounds):
    kinds = ["double", "double_one_by_one", "float", "float_one_by_one"]
    rows = []
    for line in output(build / "bench_families", rounds).splitlines():
        family, operation, count, *times = line.split("; ")
        row = {"family": family, "operation": operation, "count": int(count)}
        rows.append(row | {kind: float(time) for kind, time in zip(kinds, times) if time != "-"})
    return rows


def collision(build, rounds):
    rows = []
    for program, target in (("bench_collision", "native"), ("bench_collision_portable", "any")):
        for line in output(build / program, rounds).splitlines():
            scene, boxes, pairs, *times = line.split("; ")
            row = {"scene": scene, "for": target, "boxes": int(boxes), "pairs": int(pairs)}
            rows.append(row | {name: float(time) for name, time in zip(("sinew", "bullet", "fcl"), times) if time != "-"})
    return rows


def siconos(build):
    """Iterations and milliseconds of friction problems, by sweeps and by Siconos; `!` where 100,000 do not suffice."""
    keys = ("problem", "contacts", "sweeps", "sweeps_ms", "nncg", "nncg_ms", "siconos", "dense_ms", "sparse_ms")
    rows = []
    for line in output(build / "bench_siconos", "[table]").splitlines():
        if found := re.match(r"(.{28}) +(\d+) \| +(\d+) +([\d.]+)(.) \| +(\d+) +([\d.]+)(.) \| +(\d+) +([\d.]+)(.) +([\d.]+)(.)", line):
            name, contacts, sweeps, a, a_mark, nncg, b, b_mark, count, c, c_mark, d, d_mark = found.groups()
            row = dict(zip(keys, (name.strip(), int(contacts), int(sweeps), float(a), int(nncg), float(b), int(count), float(c), float(d))))
            rows.append(row | {"unsolved": [key for key, mark in zip(keys[3::2] + keys[8:], (a_mark, b_mark, c_mark, d_mark)) if mark == "!"]})
    return rows


def laparoscopy(build, steps):
    rows = []
    for line in output(build / "bench_laparoscopy", steps).splitlines():
        model, resolution, *figures = line.split("; ")
        rate, detection, response, rest = (float(x) for x in figures)
        rows.append({"model": model, "resolution": resolution, "steps_per_second": rate, "paper": PAPER_2007[resolution],
                     "detection": detection, "response": response, "rest": rest})
    return rows


def bounds(build, seconds):
    """What the example says at its end, of each model: speeds, energies, penetrations, volumes."""
    patterns = {"fastest": r"fastest point (\S+) m/s", "kinetic": r"kinetic energy up to (\S+) J", "elastic": r"elastic up to (\S+) J",
                "penetration": r"deepest penetration (\S+) mm", "inside": r"skins at least (\S+) mm inside", "smallest": r"volumes of skins (\S+) to",
                "largest": r"volumes of skins \S+ to (\S+) of", "element": r"of elements at least (\S+);", "inverted": r"up to (\d+) elements",
                "inverted_for": r"inverted, for up to (\S+) s", "passed": r"inside an organ: (\d+) times"}
    rows = []
    for model, resolution in LAPAROSCOPY:
        text = output(build / "bench_laparoscopy_bounds", "--model", model, "--resolution", resolution, "--time", seconds, "--output", "")
        found = {key: re.search(pattern, text) for key, pattern in patterns.items()}
        if not all(found.values()):
            fail(f"bench_laparoscopy_bounds did not print {[key for key in found if not found[key]]}, but:\n{text}")
        rows.append({"model": model, "resolution": resolution} | {key: float(match[1]) for key, match in found.items()})
    return rows
