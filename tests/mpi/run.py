# SPDX-License-Identifier: BSL-1.0
"""`mpirun -n N sinew-mpi run bar.scn --mpi` writes the same positions with 1, 2, 3 and 4 ranks, to the tolerance of the solver, and
refuses what it does not have with one message.

run.py MPIRUN PROGRAM SCENE OTHER_SCENE FOLDER
"""
import array
import base64
import pathlib
import re
import subprocess
import sys

mpirun, program, scene, other, folder = sys.argv[1:]


def run(ranks, *arguments):
    return subprocess.run([mpirun, "--oversubscribe", "--allow-run-as-root", "-n", str(ranks), program, "run", *arguments, "--mpi"],
                          capture_output=True, text=True, timeout=280)


def positions(path):
    text = pathlib.Path(path).read_text()
    data = base64.b64decode(re.search(r'Name="Points".*?format="binary">([^<]*)<', text).group(1))
    return array.array("d", data[8:])


expected = None
for ranks in 1, 2, 3, 4:
    out = f"{folder}/{ranks}"
    result = run(ranks, scene, "--steps", "10", "--every", "10", "--vtk", out)
    assert result.returncode == 0, result.stdout + result.stderr
    assert result.stdout.count("10 steps of 0.01 s") == 1, result.stdout
    x = positions(f"{out}/root/bar_0001.vtu")
    expected = expected or x
    error = max(abs(a - b) for a, b in zip(x, expected))
    assert len(x) == len(expected) and error < 1e-8, f"{ranks} ranks: positions differ by {error} m"
    first = positions(f"{out}/root/bar_0000.vtu")
    assert max(abs(a - b) for a, b in zip(x, first)) > 1e-3, "the bar has not bent"


def refused(ranks, status, words, *arguments):
    result = run(ranks, *arguments)
    said = result.stderr
    assert result.returncode == status, f"status {result.returncode}: {said}"
    for word in words:
        assert said.count(word) == 1, f"'{word}' should be said once: {said}"


refused(2, 1, ["<BarycentricMapping> is not distributed yet", "<HexahedronFEMForceField> is not distributed yet"], other)
refused(2, 2, ["--save is not there with --mpi"], scene, "--save", f"{folder}/saved.scn")
refused(2, 1, ["no_such_scene.scn"], "no_such_scene.scn")
refused(2, 3, ["has not converged in 2 iterations"], scene, "--set", "bar/PetscLinearSolver.iterations=2")
print("the same with 1, 2, 3 and 4 ranks")
