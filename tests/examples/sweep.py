#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""sinew sweep, sweep.py SINEW SCENES FOLDER: tables of runs against runs on their own and closed forms; what is left of a sweep
that is killed, interrupted or out of room, and goes on; parts and their merging; bad input."""
import csv
import json
import math
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

program, scenes, work = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3])
shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
os.chdir(work)
shutil.copy(scenes / "hanging_mass.scn", "hanging.scn")

mistakes = []


def check(right, message):
    if not right:
        mistakes.append(message)


def sinew(*words, status=0, error="", **options):
    """Runs it; checks its exit status, and what standard error says."""
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, **options)
    line = " ".join(map(str, words))
    check(done.returncode == status, f"sinew {line}: status {done.returncode}, not {status}\n{done.stdout}{done.stderr}")
    check(error in done.stderr, f"sinew {line}: standard error has no '{error}':\n{done.stderr}")
    return done.stdout


def rows(path, times=False):
    """The runs of a table, as dictionaries; without what takes another time each time."""
    lines = pathlib.Path(path).read_text().splitlines()
    check(lines[0].startswith("# sinew sweep 1, key "), f"{path} begins with {lines[0]}")
    table = list(csv.DictReader(lines[1:]))
    for row in table:
        check(None not in row and None not in row.values(), f"{path}: a row is not whole: {row}")
        if not times:
            del row["seconds"]
    return table


# an oscillator, and as many springs and masses as wanted
OSCILLATOR = """<Node name="root" dt="0.001">
  <Node name="body">
    <EulerExplicitSolver/>
    <MechanicalObject name="dofs" position="0 0 0" velocity="1 0 0"/>
    <UniformMass name="mass" vertexMass="2"/>
    <RestShapeSpringsForceField name="spring" points="0" stiffness="100"/>
  </Node>
</Node>
"""
pathlib.Path("oscillator.scn").write_text(OSCILLATOR)

# closed form: m g / k, to the rounding of a solve
hanging = ["sweep", "hanging.scn", "--set", "mass/spring.stiffness=100:500:100", "--set", "mass/weight.vertexMass=1,2", "--steps", 1]
sinew(*hanging, "--measure", "mass/dofs.position[0][1]", "--measure", "mass/dofs.position[0]", "--measure", "mass/StaticSolver.residual",
      "--measure", "mass.potentialEnergy", "--measure", "mass/dofs.position")
table = rows("hanging.sweep.csv")
check([r["run"] for r in table] == [str(i + 1) for i in range(10)], "runs are not in order")
check([(r["mass/spring.stiffness"], r["mass/weight.vertexMass"]) for r in table]
      == [(k, m) for k in ("100", "200", "300", "400", "500") for m in ("1", "2")], "the combinations are others")
for r in table:
    k, m = float(r["mass/spring.stiffness"]), float(r["mass/weight.vertexMass"])
    sag = m * 9.81 / k
    for value, exact in ((-float(r["mass/dofs.position[0][1]"]), sag), (float(r["largestDisplacement"]), sag),
                         (float(r["potentialEnergy"]), k * sag**2 / 2), (float(r["mass.potentialEnergy"]), k * sag**2 / 2)):
        check(abs(value - exact) <= 1e-12 * exact, f"k = {k}, m = {m}: {value}, not {exact}")
    check(r["converged"] == "1" and r["steps"] == "1" and r["error"] == "", f"{r}")
    check(r["mass/dofs.position"].split() == [r[f"mass/dofs.position[0][{i}]"] for i in range(3)], f"a list is another one: {r}")
    check(float(r["mass/StaticSolver.residual"]) <= 1e-12, f"the residual is {r}")

# closed form: after half a period, pi sqrt(m/k), an oscillator is back with the opposite velocity. The error of
# symplectic Euler is below w dt.
pathlib.Path("times.csv").write_text("# periods\nroot.dt,body/spring.stiffness\n" + "".join(
    f"{math.pi * math.sqrt(2 / k) / 1000!r},{k}\n" for k in (50, 100, 800)))
sinew("sweep", "oscillator.scn", "--table", "times.csv", "--steps", 1000, "--measure", "body/dofs.velocity[0][0]", "--output", "half.csv")
for r in rows("half.csv"):
    v = float(r["body/dofs.velocity[0][0]"])
    check(abs(v + 1) < math.pi / 1000, f"half a period: the velocity is {v}, not -1")

# the same bits as runs on their own, whatever the number of processes
spread = ["sweep", "oscillator.scn", "--set", "body/spring.stiffness=log:1:1e4:5", "--set", "root.dt=0.001,0.0005", "--set", "body/mass.vertexMass=0.1:0.3:0.1",
          "--steps", 200, "--measure", "body/dofs.position[0]"]
sinew(*spread, "--jobs", 1, "--output", "one.csv")
sinew(*spread, "--jobs", 5, "--output", "five.csv")
whole = rows("one.csv")
check(whole == rows("five.csv"), "other values with another number of processes")
check(len(whole) == 30 and [r["body/mass.vertexMass"] for r in whole[:3]] == ["0.1", "0.2", "0.3"], "decimal steps are not decimal")
check([r["body/spring.stiffness"] for r in whole[::6]] == ["1", "10", "100", "1000", "10000"], "powers are not exact")
for r in whole[::7]:
    one = json.loads(sinew("run", "oscillator.scn", "--steps", 200, "--json", "--every", 200, "--record", "one.txt",
                           *(w for name, value in r.items() if name.startswith(("body/spring.", "root.", "body/mass.")) for w in ("--set", f"{name}={value}"))))
    check(repr(float(r["kineticEnergy"])) == repr(one["kineticEnergy"]) and float(r["potentialEnergy"]) == one["potentialEnergy"], f"{r} is not {one}")
    last = pathlib.Path("one.txt").read_text().splitlines()[-2].split()
    check([r[f"body/dofs.position[0][{i}]"] for i in range(3)] == last[:3], f"{r} is not at {last}")

# goes on with what is missing: lines, and a line that is not whole
lines = pathlib.Path("one.csv").read_text().splitlines(keepends=True)
pathlib.Path("torn.csv").write_text("".join(lines[:9] + lines[20:25]) + lines[11][:7])
said = json.loads(sinew(*spread, "--output", "torn.csv", "--json"))
check(said["before"] == 12 and said["runs"] == 18, f"goes on with {said}")
check(rows("torn.csv") == whole, "a table that was torn is another one")
pathlib.Path("begun.csv").write_text(lines[0][:10])
sinew(*spread, "--output", "begun.csv", "--quiet")
check(rows("begun.csv") == whole, "a table that was begun is another one")
check(json.loads(sinew(*spread, "--output", "torn.csv", "--json"))["runs"] == 0, "runs again what is there")

# kill -9 in the middle; the processes of its runs go, too
slow = ["sweep", "oscillator.scn", "--set", "body/spring.stiffness=1:24", "--steps", 40000, "--jobs", 2]
sinew(*slow, "--output", "slow.csv", "--quiet")


def count_lines(path):
    return path.read_text().count("\n") if path.exists() else 0


def children(pid):
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = entry.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == pid:
            found.append(int(entry.parent.name))
    return found


def is_alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def begun(name, at, *words):
    """A sweep that has so many lines."""
    path = pathlib.Path(name)
    running = subprocess.Popen([program, *map(str, slow), "--output", name, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    end = time.monotonic() + 60
    while count_lines(path) < at and running.poll() is None and time.monotonic() < end:
        time.sleep(0.002)
    return running


for signal_number in (signal.SIGKILL, signal.SIGINT, signal.SIGTERM):
    name = f"ended_{signal_number}.csv"
    running = begun(name, 6)
    ran = children(running.pid)
    running.send_signal(signal_number)
    out, _ = running.communicate()
    if signal_number != signal.SIGKILL:
        check(running.returncode == 130, f"a sweep that was interrupted ends with {running.returncode}")
        check("the same command goes on" in out, f"a sweep that was interrupted says {out}")
    there = rows(name)
    check(4 <= len(there) < 24, f"{signal_number} came too late: {len(there)} runs")
    end = time.monotonic() + 10
    while any(map(is_alive, ran)) and time.monotonic() < end:
        time.sleep(0.01)
    check(not any(map(is_alive, ran)), "processes of runs are left behind")
    sinew(*slow, "--output", name, "--quiet")
    check(rows(name) == rows("slow.csv"), f"a sweep that was ended by {signal_number} and went on has another table")

# a run that is killed costs its row; --retry runs it again
slow = ["sweep", "oscillator.scn", "--set", "body/spring.stiffness=1:4", "--steps", 2000000, "--jobs", 2]
running = begun("killed.csv", 2)
while not (ran := [pid for pid in children(running.pid) if is_alive(pid)]):
    time.sleep(0.001)
os.kill(ran[0], signal.SIGKILL)
out, errors = running.communicate()
killed = [r for r in rows("killed.csv") if r["error"]]
check(running.returncode == 0 and len(killed) == 1 and "signal 9" in killed[0]["error"] and killed[0]["steps"] == "", f"a run was killed: {killed} {out} {errors}")
check(len(rows("killed.csv")) == 4 and "1 with an error" in out, f"a run was killed: {out}")
sinew(*slow, "--output", "killed.csv", "--quiet")
check([r for r in rows("killed.csv") if r["error"]] == killed, "a run with an error is run again without --retry")
sinew(*slow, "--output", "killed.csv", "--quiet", "--retry")
check([(r["run"], r["steps"], r["error"]) for r in rows("killed.csv")] == [(str(i), "2000000", "") for i in range(1, 5)], "--retry does not run what was killed")
sinew("sweep", "oscillator.scn", "--set", "root.dt=0.001", "--steps", 1000000000, "--time-limit", 0.5, "--output", "long.csv")
check("more than the 0.5 s of --time-limit" in rows("long.csv")[0]["error"], "a run takes as long as it wants")

# two sweeps do not write one table
running = begun("both.csv", 3)
sinew(*slow, "--output", "both.csv", status=4, error="another sweep writes this table now")
running.kill()
running.communicate()

# parts, and what is made of them
for part in (3, 1, 2):
    sinew(*spread, "--part", f"{part}/3", "--quiet")
check([r["run"] for r in rows("oscillator.sweep.2of3.csv")] == [str(i) for i in range(2, 31, 3)], "a part has other runs")
out = sinew("sweep", "--merge", "oscillator.sweep.3of3.csv", "oscillator.sweep.1of3.csv", "--output", "merged.csv")
check("20 runs of 30; 10 missing" in out, out)
said = json.loads(sinew("sweep", "--merge", "oscillator.sweep.2of3.csv", "merged.csv", "--output", "merged.csv", "--json"))
check(said["missing"] == 0 and rows("merged.csv") == whole, "parts are another table than the whole")
check(json.loads(sinew(*spread, "--output", "merged.csv", "--json"))["runs"] == 0, "a merged table is not whole")
sinew("sweep", "--merge", "merged.csv", "slow.csv", "--output", "mixed.csv", status=2, error="slow.csv: is a part of another sweep")
sinew("sweep", "--merge", "merged.csv", status=2, error="--output")
sinew("sweep", "--set", "root.dt=1", "--output", "mixed.csv", "--merge", "merged.csv", status=2, error="takes no --set")
sinew("sweep", "--merge", "none.csv", "--output", "mixed.csv", status=1, error="none.csv")
sinew("sweep", "--merge", "merged.csv", "--output", "times.csv", status=1, error="times.csv: is no table of a sweep")
check(not os.path.exists("mixed.csv"), "a table of two sweeps was written")

# job arrays: what Slurm and Grid Engine tell the jobs of an array, and what these do when they are killed and put into the queue again


def submit(script, killed=()):
    """What sbatch and qsub do with a job array: each job runs the script, with the numbers of the array in its environment. Those in
    `killed` reach their limit of time, and run again when the others have ended."""
    text = pathlib.Path(script).read_text()
    slurm = re.search(r"^#SBATCH .*--array=(\S+)", text, flags=re.M)
    words = (slurm or re.search(r"^#\$ .*-t (\S+)", text, flags=re.M))[1]
    tasks = []
    for piece in words.partition("%")[0].split(","):
        first, last, step = re.fullmatch(r"(\d+)(?:-(\d+)(?::(\d+))?)?", piece).groups()
        tasks += range(int(first), int(last or first) + 1, int(step or 1))
    step = tasks[1] - tasks[0] if len(tasks) > 1 and "," not in words else 1
    names = (("SLURM_ARRAY_TASK_MIN", tasks[0]), ("SLURM_ARRAY_TASK_MAX", tasks[-1]), ("SLURM_ARRAY_TASK_STEP", step), ("SLURM_ARRAY_TASK_COUNT", len(tasks)),
             ("SLURM_CPUS_PER_TASK", 2)) if slurm else (("SGE_TASK_FIRST", tasks[0]), ("SGE_TASK_LAST", tasks[-1]), ("SGE_TASK_STEPSIZE", step), ("NSLOTS", 2))
    queue, ended = [(task, task in killed) for task in tasks], {}
    while queue:
        task, dies = queue.pop(0)
        environment = os.environ | {name: str(value) for name, value in names} | {"SLURM_ARRAY_TASK_ID" if slurm else "SGE_TASK_ID": str(task),
                                                                                  "PATH": f"{os.path.dirname(program)}:{os.environ['PATH']}"}
        job = subprocess.Popen(["bash", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment, start_new_session=True)
        if dies:
            part = pathlib.Path(f"jobs.sweep.{tasks.index(task) + 1}of{len(tasks)}.csv")
            end = time.monotonic() + 60
            while count_lines(part) < 3 and job.poll() is None and time.monotonic() < end:
                time.sleep(0.002)
            os.killpg(job.pid, signal.SIGKILL)
            queue.append((task, False))
        out, errors = job.communicate()
        check(not dies or job.returncode == -signal.SIGKILL, f"job {task} had ended before it was killed: {out}{errors}")
        ended[task] = job.returncode, out + errors
    return ended


shutil.copy("oscillator.scn", "jobs.scn")
jobs = ["sweep", "jobs.scn", "--set", "body/spring.stiffness=1:12", "--steps", 150000]
sinew(*jobs, "--output", "all_jobs.csv", "--quiet")
for head, jobs_each, killed in (("#SBATCH --array=1-4%2 --requeue", "$SLURM_CPUS_PER_TASK", (2,)), ("#SBATCH --array=0-9:3", "$SLURM_CPUS_PER_TASK", ()),
                                ("#$ -t 1-4 -cwd", "$NSLOTS", ()), ("#$ -t 2-8:2 -r y -cwd", "$NSLOTS", (6,))):
    pathlib.Path("job.sh").write_text(f"#!/bin/bash\n{head}\nexec sinew {' '.join(map(str, jobs))} --part array --jobs {jobs_each} --quiet\n")
    for part in range(1, 5):
        pathlib.Path(f"jobs.sweep.{part}of4.csv").unlink(missing_ok=True)
    ended = submit("job.sh", killed)
    check(all(status == 0 for status, _ in ended.values()), f"{head}: {ended}")
    check([len(rows(f"jobs.sweep.{part}of4.csv")) for part in range(1, 5)] == [3, 3, 3, 3], f"{head}: a job has done another part")
    sinew("sweep", "--merge", *(f"jobs.sweep.{part}of4.csv" for part in range(1, 5)), "--output", "jobs_merged.csv", "--quiet")
    check(rows("jobs_merged.csv") == rows("all_jobs.csv"), f"{head}: the parts are another table than the whole")
pathlib.Path("job.sh").write_text(f"#!/bin/bash\n#SBATCH --array=1,3,7\nexec sinew {' '.join(map(str, jobs))} --part array\n")
check(all(status == 2 and "no range from first to last" in said for status, said in submit("job.sh").values()), "a job array that is no range is not refused")
sinew(*jobs, "--part", "array", status=2, error="there is none here", env={name: value for name, value in os.environ.items() if not name.startswith(("SLURM", "SGE"))})
sinew(*jobs, "--part", "array", status=2, error="there is none here", env=os.environ | {"SGE_TASK_ID": "undefined", "SGE_TASK_FIRST": "undefined", "SGE_TASK_LAST": "undefined"})

# files that a scene writes, of each run in a folder of its own
pathlib.Path("writes.scn").write_text(OSCILLATOR.replace("  </Node>", '    <WriteState filename="out/states.txt"/>\n  </Node>'))
sinew("sweep", "writes.scn", "--set", "body/spring.stiffness=1,2", "--steps", 3)
check(sorted(str(p) for p in pathlib.Path("writes.sweep.files").rglob("*.*"))
      == [f"writes.sweep.files/00000{i}/out/states.txt" for i in (1, 2)], "files of runs are missing")
check(rows("writes.sweep.csv")[0]["error"] == "" and not os.path.exists("out"), "files of runs are in one place")
pathlib.Path("writes.scn").write_text(pathlib.Path("writes.scn").read_text().replace("out/states.txt", str(work.resolve() / "states.txt")))
sinew("sweep", "writes.scn", "--set", "body/spring.stiffness=1,2", "--output", "absolute.csv", status=1, error="give a relative name")

# what a component refuses is in its row, and so is what diverges
sinew("sweep", "oscillator.scn", "--set", "body/mass.vertexMass=-1,1,soft", "--set", "root.dt=1e-3,1", "--steps", 10000, "--output", "refused.csv")
refused = rows("refused.csv")
check("vertexMass" in refused[0]["error"] and "-1" in refused[0]["error"] and "'soft' is no" in refused[5]["error"], f"refused: {refused}")
check(refused[2]["error"] == "" and "diverged" in refused[3]["error"] and 0 < int(refused[3]["steps"]) < 10000, f"diverged: {refused[3]}")
check(all(r["converged"] == ("1" if r is refused[2] else "0") or r["steps"] == "" for r in refused), "what diverges converges")
# springs that cannot be solved in one iteration
sinew("sweep", scenes / "static.scn", "--set", "static/StaticSolver.newton_iterations=1,20", "--steps", 1, "--output", "newton.csv",
      "--measure", "static/StaticSolver.residual", "--measure", "static.reaction")
newton = rows("newton.csv")
check([r["converged"] for r in newton] == ["0", "1"], f"converged: {newton}")
check(abs(float(newton[1]["static.reaction[1]"]) - 9.81) < 1e-4, f"the wall does not carry the weight: {newton[1]}")

# bad input
steps = ["sweep", "oscillator.scn", "--steps", 1]
for values, message in {
        "1:10:0": "step of 0", "1:10:-1": "do not lead from 1 to 10", "10:1": "do not lead from 10 to 1", "1:10:x": "'x', which is no number",
        "nan:1:1": "not finite", "1:inf:1": "not finite", "nan": "not a finite number", "1:2:3:4": "is no range", "1,,2": "a value is missing", "": "a value is missing",
        "log:1:10": "log:first:last:count", "log:-1:10:3": "both above 0", "log:0:10:3": "both above 0", "lin:0:1:1": "from 2 on", "lin:0:1:x": "from 2 on",
        "0:1e12": "1e+12 values", "lin:0:1:2000000": "1000000 runs", "1e-300:1e300:1": "too different sizes", "1.0000000000000000000001:2:1": "too many digits",
}.items():
    sinew(*steps, "--set", f"body/spring.stiffness={values}", status=2, error=message)
sinew(*steps, "--set", "body/spring.stiffness=1:1e4", "--set", "body/mass.vertexMass=1:1e4", "--set", "root.dt=1e-4:1:1e-4", status=2, error="1e+12 combinations")
sinew(*steps, status=2, error="--set")
sinew(*steps, "--set", "stiffness=1", status=2, error="path.attribute=value")
sinew(*steps, "--set", "body/sprig.stiffness=1,2", status=2, error="did you mean 'spring'")
sinew(*steps, "--set", "body/spring.stifness=1,2", status=2, error="has no attribute 'stifness'; did you mean 'stiffness'")
sinew(*steps, "--set", "root.dt=1,2", "--set", "root.dt=1", status=2, error="root.dt is given twice")
sinew(*steps, "--set", "root.dt=1,2", "--dt", 1, status=2, error="leave one out")
sinew(*steps, "--set", "root.dt=1,2", "--part", "0/3", status=2, error="numbered from 1 to N")
sinew(*steps, "--set", "root.dt=1,2", "--part", "4/3", status=2, error="numbered from 1 to N")
sinew(*steps, "--set", "root.dt=1,2", "--jobs", 0, status=2)
for measure, message in {
        "position": "is not of the form", "body/dofs.position[": "is not of the form", "body/dofs.positions": "did you mean 'position'", "bodi.kineticEnergy": "did you mean 'body'",
        "body/dofs.position[1]": "it has 1, numbered from 0", "body/dofs.position[0][3]": "it has 3, numbered from 0", "body.kinetic": "kineticEnergy",
        "body/dofs/x.position": "is a component", "body/spring.residual": "has no 'residual'", "body.kineticEnergy[0]": "it is one number",
        "root.reaction[3]": "it has 3 numbers",
}.items():
    sinew(*steps, "--set", "root.dt=1,2", "--measure", measure, status=2, error=message)
for content, message in {
        "": "table.csv", "root.dt\n": "has no combination", "dt\n1\n": "'dt' is no attribute", "root.dt,body/spring.stiffness\n1\n": "table.csv:2: has 1 values for 2 columns",
        'root.dt\n"1\n': "table.csv:2: a quote is not closed", "root.dt\nnan\n": "not a finite number", "root.dt\n1\n": "root.dt is given twice",
        "root.dt,body/spring.stiffness\n1,\n": "has no value of body/spring.stiffness",
}.items():
    pathlib.Path("table.csv").write_text(content)
    sinew(*steps, "--set", "root.dt=1", "--table", "table.csv", status=2, error=message)
sinew(*steps, "--table", "none.csv", status=2, error="none.csv")
sinew("sweep", "none.scn", "--set", "root.dt=1", status=1, error="none.scn: cannot be read")
pathlib.Path("wrong.scn").write_text("<Node><Foo/></Node>")
sinew("sweep", "wrong.scn", "--set", "root.dt=1", status=1, error="wrong.scn:1:7")
check(not os.path.exists("oscillator.sweep.csv") and not os.path.exists("wrong.sweep.csv"), "a table was begun of what is wrong")
stiffness = ["--set", "body/spring.stiffness=1,2"]
sinew(*steps, *stiffness, "--output", "no/such/folder/t.csv", status=4, error="no/such/folder/t.csv: cannot be written")
sinew(*steps, *stiffness, "--output", ".", status=4, error="is a folder")
sinew(*steps, *stiffness, "--output", "oscillator.scn", status=1, error="oscillator.scn: is no table of a sweep")
check(pathlib.Path("oscillator.scn").read_text() == OSCILLATOR, "a scene was written over")
sinew(*steps, *stiffness, "--output", "one.csv", status=2, error="one.csv: is of another sweep, 'sinew sweep oscillator.scn")
sinew(*steps, *stiffness)
pathlib.Path("oscillator.scn").write_text(OSCILLATOR.replace('vertexMass="2"', 'vertexMass="3"'))
sinew(*steps, *stiffness, status=2, error="oscillator.sweep.csv: was begun with another scene file")
pathlib.Path("oscillator.scn").write_text(OSCILLATOR)
content = pathlib.Path("oscillator.sweep.csv").read_text()
pathlib.Path("oscillator.sweep.csv").write_text(content + "2,1\n")
sinew(*steps, *stiffness, status=1, error="oscillator.sweep.csv:5: is no run of this sweep")

# no room on the disk: what is there stays whole, and the same command goes on
room = os.path.getsize("one.csv") // 2
sinew(*spread, "--output", "full.csv", "--jobs", 1, status=4, error="cannot be written further", restore_signals=False,
      preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room)))
content = pathlib.Path("full.csv").read_text()
check(content.endswith("\n") and 5 < len(rows("full.csv")) < 30, "a table without room is not whole")
sinew(*spread, "--output", "full.csv", "--quiet")
check(rows("full.csv") == whole, "a table that had no room is another one")

for message in mistakes:
    print(message)
sys.exit(1 if mistakes else 0)
