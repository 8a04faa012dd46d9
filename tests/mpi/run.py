# SPDX-License-Identifier: BSL-1.0
"""The program sinew-mpi: scenes are the same with 1, 2, 3 and 4 ranks, to the tolerance of the solver; checkpoints go on with
another number of ranks, also where one was killed; what goes wrong on one rank is said once, and ends all; and the runs of a sweep
are shared out among ranks.

run.py MPIRUN PROGRAM SCENE OTHER_SCENE FOLDER
"""
import array
import base64
import csv
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

import scenes

mpirun, program, scene, other, folder = sys.argv[1:]
shutil.rmtree(folder, ignore_errors=True)
made = scenes.write(f"{folder}/scenes")
environment = dict(os.environ, OMPI_MCA_btl_vader_single_copy_mechanism="none", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
start = [mpirun, "--oversubscribe", "-n"]


def call(words, limit=250):
    done = subprocess.run(words, capture_output=True, text=True, timeout=limit, env=environment)
    return done.returncode, done.stdout, done.stderr


def run(ranks, *arguments):
    return call([*start, str(ranks), program, "run", *map(str, arguments), "--mpi"])


def well(ranks, *arguments):
    status, said, error = run(ranks, *arguments)
    assert status == 0, f"{ranks} ranks, {arguments}: status {status}\n{said}{error}"
    return said


def values(text, name, kind):
    data = base64.b64decode(re.search(rf'Name="{name}".*?format="binary">([^<]*)<', text).group(1))
    return array.array(kind, data[8:])


def positions(stem):
    """Of all points of a body, in their order, from the pieces that ranks have written."""
    whole = pathlib.Path(stem + ".pvtu").read_text()
    pieces = re.findall(r'Source="([^"]*)"', whole)
    at, cells = {}, 0
    for piece in pieces:
        text = (pathlib.Path(stem).parent / piece).read_text()
        x, numbers = values(text, "Points", "d"), values(text, "point", "d")
        cells += int(re.search(r'NumberOfCells="(\d+)"', text).group(1))
        for i, n in enumerate(numbers):
            p = tuple(x[3 * i:3 * i + 3])
            assert at.setdefault(int(n), p) == p, f"{stem}: point {n} is at two places"
    assert sorted(at) == list(range(len(at))), f"{stem}: not all points are there"
    return len(pieces), cells, [at[i] for i in range(len(at))]


def seen(stem):
    """Of the vertices that rank 0 has written of a visual model."""
    x = values(pathlib.Path(stem + ".vtu").read_text(), "Points", "d")
    return [tuple(x[i:i + 3]) for i in range(0, len(x), 3)]


def distance(a, b):
    assert len(a) == len(b), f"{len(a)} and {len(b)} points"
    return max(abs(x - y) for p, q in zip(a, b) for x, y in zip(p, q))


def same_on_ranks(path, bodies, steps, tolerance, moved, most=4, looks=()):
    expected = {}
    for ranks in range(1, most + 1):
        out = f"{folder}/{pathlib.Path(path).stem}{ranks}"
        said = well(ranks, path, "--steps", steps, "--every", steps, "--vtk", out)
        assert said.count(f"{steps} steps of") == 1, said
        for body in bodies:
            pieces, cells, x = positions(f"{out}/root/{body}_0001")
            assert pieces == ranks
            before = expected.setdefault(body, (cells, x))
            assert cells == before[0], f"{ranks} ranks have {cells} elements of {body}, and one has {before[0]}"
            error = distance(x, before[1])
            assert error < tolerance, f"{path}, {body}: {ranks} ranks: positions differ by {error} m"
            if ranks == 1:
                far = distance(x, positions(f"{out}/root/{body}_0000")[2])
                assert far > moved, f"{path}: {body} has moved by {far} m only"
        for look in looks:
            x = seen(f"{out}/root/{look}_0001")
            error = distance(x, expected.setdefault(look, x))
            assert error < max(tolerance, 1e-6), f"{path}, {look}: {ranks} ranks: vertices differ by {error} m"
            assert distance(x, seen(f"{out}/root/{look}_0000")) > moved, f"{path}: {look} has not moved"
    return expected


# the same with 1, 2, 3 and 4 ranks; the condition of the matrix times the tolerance of its solution
same_on_ranks(scene, ["bar"], 10, 1e-8, 1e-3)
alike = {}
for name, bodies, steps, tolerance, moved in (("mapped", ["bar", "bar/skin", "bar/skin/tips", "bar/copy"], 6, 1e-7, 1e-3),
                                              ("constraints", ["bar"], 6, 1e-7, 1e-2),
                                              ("contact", ["bodies/lower", "bodies/upper", "bodies/upper/surface"], 10, 1e-7, 1e-3),
                                              ("rigid", ["bodies/soft", "bodies/rigids", "bodies/rigids/carried"], 10, 1e-7, 1e-4),
                                              ("bodies", [f"all/{b}" for b in ("hyperelastic", "viscoelastic", "prisms", "pyramids", "quadratic")], 6, 1e-7, 1e-3),
                                              ("sheets", [f"all/{b}" for b in ("fem", "tensor", "quadratic", "biquadratic", "quads", "shell", "beams")], 6, 1e-7, 1e-3)):
    for solver in "cg", "petsc":
        found = same_on_ranks(made[f"{name}_{solver}"], bodies, steps, tolerance, moved, 4 if solver == "cg" else 2,
                              {"mapped": ["bar/look"], "rigid": ["bodies/rigids/carried/look"]}.get(name, []))
        for body in bodies:
            assert distance(found[body][1], alike.setdefault((name, body), found[body][1])) < tolerance
for ode in scenes.ODE_SOLVERS:
    same_on_ranks(made[f"stepped_{ode}"], ["all/bar"], 5, 1e-8, 1e-5, 2)

# a checkpoint goes on with another number of ranks; with as many bit by bit
bar = made["mapped_cg"]
whole = f"{folder}/whole.scn"
well(2, bar, "--steps", 8, "--save", whole)
assert pathlib.Path(whole).read_text().count("<VisualModel ") == 1, "a checkpoint has no visual model"
half = f"{folder}/half.scn"
well(2, bar, "--steps", 5, "--save", half)
for ranks, exact in (2, True), (3, False), (1, False):
    rest = f"{folder}/rest{ranks}.scn"
    said = well(ranks, half, "--steps", 3, "--save", rest)
    assert "from step 5 on" in said, said
    a, b = (re.search(r'<MechanicalObject name="[^"]*" template="Vec3d" position="([^"]*)"', pathlib.Path(f).read_text()).group(1)
            for f in (whole, rest))
    if exact:
        assert a == b, "a checkpoint has other bits"
    error = max(abs(float(x) - float(y)) for x, y in zip(a.split(), b.split()))
    assert error < 1e-7, f"going on with {ranks} ranks: positions differ by {error} m"


def begin(*words):
    return subprocess.Popen([*start, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)


def ranks_of(process):
    """The processes that mpirun has started."""
    children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    return [int(c) for c in children if "sinew" in pathlib.Path(f"/proc/{c}/comm").read_text()]


def wait_for(what, seconds=120):
    end = time.time() + seconds
    while not what():
        assert time.time() < end, "it has not come"
        time.sleep(0.02)


def steps_in(path):
    found = re.search(r'step="(\d+)"', pathlib.Path(path).read_text()[:400]) if os.path.exists(path) else None
    return int(found.group(1)) if found else 0


# a rank that is killed ends all, which say where to go on
last = f"{folder}/last.scn"
process = begin(3, program, "run", bar, "--mpi", "--steps", 100000, "--save", last, "--save-every", 4)
wait_for(lambda: steps_in(last) >= 8)
os.kill(ranks_of(process)[1], signal.SIGKILL)
_, error = process.communicate(timeout=60)
assert process.returncode != 0
assert error.count(f"{last} has it up to step ") == 1, error
step = int(re.search(r"up to step (\d+)", error).group(1))
assert steps_in(last) >= step > 0
assert f"from step {steps_in(last)} on" in well(2, last, "--steps", 3)

# one that stands still ends them, too, and all say where they are
process = begin(2, program, "run", bar, "--mpi", "--steps", 100000, "--patience", 2)
wait_for(lambda: len(ranks_of(process)) == 2)
time.sleep(2)
os.kill(ranks_of(process)[1], signal.SIGSTOP)
_, error = process.communicate(timeout=60)
assert process.returncode != 0
assert re.search(r"rank 0 of 2 has waited 2 s for .*; rank 1 does not answer: it (works on|waits for) ", error), error


def refused(ranks, status, words, *arguments):
    result, _, said = run(ranks, *arguments)
    assert result == status, f"status {result}: {said}"
    for word in words:
        assert said.count(word) == 1, f"'{word}' should be said once: {said}"


refused(2, 1, ["<SparseGridTopology> is not distributed yet"], other)
refused(2, 2, ["--threads is not there with --mpi"], scene, "--threads", "2")
refused(2, 1, ["no_such_scene.scn"], "no_such_scene.scn")
refused(2, 3, ["has not converged in 2 iterations"], scene, "--set", "bar/PetscLinearSolver.iterations=2")
refused(2, 4, ["/no/such/folder/x.scn"], scene, "--steps", "1", "--save", "/no/such/folder/x.scn")
# a file that one rank alone sees, and one that has another content
with_other = pathlib.Path(folder) / "other.scn"
with_other.write_text(pathlib.Path(scene).read_text().replace('0.5 0 0 ', '0.6 0 0 ', 1))


def one_is_different(status, words, first, second, *options, programs=(program, program)):
    """Two ranks with another scene, folder of data or program each: one sentence, and all end, at once."""
    began = time.time()
    result, _, said = call([*start, "1", *programs[0:1], "run", *map(str, first), *options, "--mpi", ":",
                            "-n", "1", *programs[1:], "run", *map(str, second), *options, "--mpi"])
    assert result == status, f"status {result}, not {status}: {said}"
    for word in words:
        assert said.count(word) == 1, f"'{word}' should be said once: {said}"
    assert time.time() - began < 200, "it has waited for its patience"


one_is_different(1, ["rank 1 of 2: ", "seen_by_none.scn"], [scene], ["seen_by_none.scn"])
one_is_different(1, ["rank 1 of 2: ", "not that of rank 0"], [scene], [with_other])

# meshes that ranks read each a part of: the same as one process, and what is wrong with them
meshes = [pathlib.Path(folder) / f"data{i}" for i in range(3)]
for i, there in enumerate(meshes):
    there.mkdir()
    if i < 2:
        (there / "bar.msh").write_text(scenes.gmsh((9, 3, 3), (0, 0, 0), (4 + i, 1, 1)))
loaded = pathlib.Path(folder) / "loaded.scn"
loaded.write_text(scenes.loaded("bar.msh"))
ends = []
for ranks in 1, 3:
    out = f"{folder}/loaded{ranks}.scn"
    well(ranks, loaded, "--data", meshes[0], "--steps", 3, "--save", out)
    ends.append([float(x) for x in re.search(r'<MechanicalObject name="[^"]*" template="Vec3d" position="([^"]*)"', pathlib.Path(out).read_text()).group(1).split()])
assert len(ends[0]) == 3 * 81 and max(abs(a - b) for a, b in zip(*ends)) < 1e-8, "a mesh that ranks have read together is another one"
one_is_different(1, ["rank 1 of 2: ", "bar.msh", "<MeshGmshLoader>"], [loaded, "--data", meshes[0]], [loaded, "--data", meshes[2]])
one_is_different(1, ["rank 1 of 2: ", "bar.msh: is another file on this rank"], [loaded, "--data", meshes[0]], [loaded, "--data", meshes[1]])
# more ranks than elements
few = pathlib.Path(folder) / "few.scn"
few.write_text(scenes.scene("0 -9.81 0", 0.01, """
  <Node name="bar"><EulerImplicitSolver/><CGLinearSolver/><MeshTopology position="0 0 0  1 0 0  0 1 0  0 0 1  1 1 1" tetrahedra="0 1 2 3  1 2 3 4"/>
    <MechanicalObject/><UniformMass totalMass="1"/><TetrahedronFEMForceField youngModulus="1e3" poissonRatio="0.3"/></Node>
"""))
refused(3, 1, ["/root/bar: 5 points with 2 elements cannot be shared out among 3 ranks; take fewer ranks (mpirun -n)"], few, "--steps", "1")

# another version of the program on a rank
bytes_of = pathlib.Path(program).read_bytes()
header = (pathlib.Path(__file__).resolve().parents[2] / "include/sinew/version.hpp").read_text()
version = ".".join(re.findall(r"#define SINEW_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header)).encode() + b"\0"
for name, content in (("version", bytes_of.replace(version, b"9" + version[1:])), ("build", bytes_of + b"another")):
    assert content != bytes_of
    other_program = pathlib.Path(folder) / f"sinew-mpi-{name}"
    other_program.write_bytes(content)
    other_program.chmod(0o755)
    one_is_different(1, ["rank 1 of 2: the program: this is Sinew " + ("9" if name == "version" else ""), "rank 0 runs another version or build; start the same program"],
                     [scene], [scene], programs=(program, str(other_program)))

# out of memory on one rank, while it makes a large scene: from there on it gets no more


def memory(pid, what):
    """Of a process [kB]: VmSize, its addresses; VmRSS, what it has now; VmHWM, the most that it had."""
    return int(re.search(rf"{what}:\s+(\d+)", pathlib.Path(f"/proc/{pid}/status").read_text()).group(1))


def needs(path):
    saved = f"{folder}/memory.scn"
    pathlib.Path(saved).unlink(missing_ok=True)
    process = begin(2, program, "run", path, "--mpi", "--steps", 1000000, "--save", saved, "--save-every", 2)
    wait_for(lambda: steps_in(saved) >= 2)
    most = memory(ranks_of(process)[1], "VmHWM")
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    return most


large = pathlib.Path(folder) / "large.scn"
large.write_text(scenes.large())
small_needs, large_needs = needs(scene), needs(large)
assert large_needs > small_needs + 15000, f"{small_needs} and {large_needs} kB"
process = begin(2, program, "run", large, "--mpi", "--steps", 100000)
wait_for(lambda: len(ranks_of(process)) == 2)
second = ranks_of(process)[1]
while memory(second, "VmRSS") < (2 * small_needs + large_needs) / 3:
    time.sleep(0.001)
limit = memory(second, "VmSize") * 1024
resource.prlimit(second, resource.RLIMIT_AS, (limit, limit))
_, error = process.communicate(timeout=120)
# where it ends in a component, this says so
said = re.findall("rank 1 of 2: (?:out of memory; take more ranks on more machines, or fewer on one|.*: there is not enough memory for it)", error)
assert process.returncode == 1 and len(said) == 1, f"status {process.returncode}: {error}"

# the runs of a sweep
sinew = pathlib.Path(program).parent / "sinew"
if sinew.exists():
    oscillator = pathlib.Path(folder) / "oscillator.scn"
    oscillator.write_text("""<Node name="root" dt="0.001">
  <Node name="body">
    <EulerExplicitSolver/>
    <MechanicalObject name="dofs" position="0 0 0" velocity="1 0 0"/>
    <UniformMass name="mass" vertexMass="2"/>
    <RestShapeSpringsForceField name="spring" points="0" stiffness="100"/>
  </Node>
</Node>
""")
    sweep = ["sweep", str(oscillator), "--set", "body/spring.stiffness=10:160:10,-1", "--steps", "2000", "--measure", "body/dofs.position[0]"]

    def rows(path):
        lines = pathlib.Path(path).read_text().splitlines()
        table = list(csv.DictReader(lines[1:]))
        for row in table:
            del row["seconds"]
        return table

    one, many, whole, killed = (f"{folder}/{name}.csv" for name in ("one", "many", "whole", "killed"))
    assert call([str(sinew), *sweep, "--output", one])[0] == 0
    status, said, error = call([*start, "3", program, *sweep, "--mpi", "--output", many])
    assert status == 0 and "on 3 ranks" in said and "17 runs in" in said and "1 with an error, run 17" in said, said + error
    assert rows(many) == rows(one), "a sweep on ranks has another table"
    status, said, error = call([*start, "2", program, *sweep, "--mpi", "--output", many])
    assert status == 0 and "17 are in" in said and "0 runs in" in said, said + error

    # killed on the way, and gone on with by another number of ranks
    long = [*sweep[:4], "--steps", "150000", *sweep[6:]]
    assert call([str(sinew), *long, "--output", whole])[0] == 0
    process = begin(2, program, *long, "--mpi", "--output", killed)
    wait_for(lambda: os.path.exists(killed) and len(pathlib.Path(killed).read_text().splitlines()) > 3)
    os.kill(ranks_of(process)[0], signal.SIGKILL)
    process.communicate(timeout=60)
    assert 0 < len(rows(killed)) < 17, "it was over before it was killed"
    status, said, error = call([*start, "3", program, *long, "--mpi", "--output", killed])
    assert status == 0 and "are in" in said, said + error
    assert rows(killed) == rows(whole), "what was killed has another table"

    status, said, error = call([*start, "1", program, *sweep, "--mpi", "--output", many, ":", "-n", "1", program, "sweep", "none.scn", *sweep[2:],
                                "--mpi", "--output", many])
    assert status != 0 and error.count("none.scn") == 1 and "rank 1 of 2: " in error, error
    status, said, error = call([*start, "2", program, *sweep, "--set", "body/spring.stifness=1", "--mpi", "--output", f"{folder}/x.csv"])
    assert status == 2 and error.count("stifness") >= 1, error
print("the same with 1, 2, 3 and 4 ranks")
