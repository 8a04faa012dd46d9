# SPDX-License-Identifier: BSL-1.0
"""Contact with friction: time and residual of each workload with each constraint solver that suits it, and Bullet."""
from tools import output, programs

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)  # [m]: residual against time
CONVEX = {"convex": (1e-4, 1e-6)}
SWEEPS = {"sweeps": (1e-4, 1e-6), "nncg": (1e-4, 1e-6)}
# title, program and its arguments, steps, tolerances by solver; whether only --long has it. W is dense: sweeps have what it
# takes less than a second a step for.
WORKLOADS = [
    ("soft block, 1,458 tetrahedra", ("block", 9, 9, 3, 10, 10), 100, CONVEX | SWEEPS, False),
    ("soft block, 1,458 tetrahedra", ("block", 9, 9, 3, 22, 22), 100, CONVEX | SWEEPS, False),
    ("soft block, 28,830 tetrahedra", ("block", 31, 31, 5, 10, 10), 10, CONVEX | {"sweeps": (1e-6,)}, False),
    ("soft block, 28,830 tetrahedra", ("block", 31, 31, 5, 22, 22), 10, CONVEX, False),
    ("soft block, 28,830 tetrahedra", ("block", 31, 31, 5, 22, 22), 5, {"sweeps": (1e-6,)}, True),
    ("soft block, 28,830 tetrahedra", ("block", 31, 31, 5, 32, 32), 10, CONVEX, False),
    ("soft block, 29,400 tetrahedra", ("block", 70, 70, 1, 71, 71), 10, CONVEX, False),
    ("two livers, 1,500 tetrahedra each", ("bodies", "livers", 1500), 50, CONVEX | SWEEPS, False),
    ("two livers, 6,000 tetrahedra each", ("bodies", "livers", 6000), 20, CONVEX | {"sweeps": (1e-6,)}, False),
    ("stack of five soft blocks", ("bodies", "stack", 5), 20, CONVEX | {"sweeps": (1e-6,), "nncg": (1e-6,)}, False),
    ("pile of 100 boxes", ("pile", 100), 20, {"convex": TOLERANCES, "bullet": (10, 100, 1000)}, False),
    ("pile of 100 boxes", ("pile", 100), 5, {"sweeps": (1e-6,), "unbuilt": (1e-6,)}, False),
    ("pile of 1,000 boxes", ("pile", 1000), 10, {"convex": TOLERANCES, "bullet": (10, 100, 1000)}, False),
    ("pile of 1,000 boxes", ("pile", 1000), 3, {"unbuilt": (1e-6,)}, False),
    ("pile of 10,000 boxes", ("pile", 10000), 5, {"convex": TOLERANCES[:2], "bullet": (10, 100)}, True),
]


def contact(build, long):
    rows = []
    for title, (program, *arguments), steps, solvers, only_long in WORKLOADS:
        program = f"bench_contact_{program}"
        if (only_long and not long) or not programs(build, [program]):
            continue
        for solver, tolerances in solvers.items():
            for line in output(build / program, *arguments, steps, solver, *tolerances).splitlines():
                name, tolerance, *figures = line.split("; ")
                contacts, speed, iterations, residual, penetration, detection = (float(x) for x in figures)
                rows.append({"workload": title, "solver": name, "tolerance": float(tolerance), "contacts": contacts, "steps_per_second": speed,
                             "iterations": iterations, "residual": residual, "penetration": penetration, "detection": detection})
    return rows
