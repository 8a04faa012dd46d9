# SPDX-License-Identifier: BSL-1.0
"""The dam break of fluids.cpp by PySPH (Debian: python3-pysph): fluids_pysph.py SIZE SECONDS. As many particles, steps, walls
and neighbours, with the cubic spline, densities by sums, a pressure by the speed of sound, and an artificial viscosity. Prints
a line as fluids does; OMP_NUM_THREADS is the number of threads."""
import os
import sys
import tempfile
import time

import numpy
from pysph.base.kernels import CubicSpline
from pysph.base.utils import get_particle_array
from pysph.solver.application import Application
from pysph.solver.solver import Solver
from pysph.sph.basic_equations import IsothermalEOS, SummationDensity
from pysph.sph.equation import Equation, Group
from pysph.sph.integrator import EulerIntegrator
from pysph.sph.integrator_step import EulerStep
from pysph.sph.wc.basic import MomentumEquation

SIZE, SECONDS = int(sys.argv[1]), float(sys.argv[2])
N = round(SIZE ** (1 / 3))
DISTANCE, DENSITY, GRAVITY = 1 / N, 1000.0, 9.81
SOUND = 10 * 2 * GRAVITY**0.5  # ten times the speed of the front
STEP = 0.2 * 2 * DISTANCE / SOUND


class Walls(Equation):
    """Springs that keep particles half a distance away from a floor and four walls."""

    def __init__(self, dest, sources, half, stiffness):
        self.half = half
        self.stiffness = stiffness  # over the mass
        super().__init__(dest, sources)

    def post_loop(self, d_idx, d_x, d_y, d_z, d_au, d_av, d_aw):
        d_au[d_idx] += self.stiffness * (max(self.half - d_x[d_idx], 0.0) - max(d_x[d_idx] - 3.0, 0.0))
        d_av[d_idx] += self.stiffness * max(self.half - d_y[d_idx], 0.0)
        d_aw[d_idx] += self.stiffness * (max(self.half - d_z[d_idx], 0.0) - max(d_z[d_idx] - 1.0 + self.half, 0.0))


class DamBreak(Application):
    def initialize(self):
        self.times = [time.perf_counter()]

    def create_particles(self):
        z, y, x = (DISTANCE * (axis.ravel() + 0.5) for axis in numpy.mgrid[0:N, 0:N, 0:N])
        # the support of the kernel is 2 h
        fluid = get_particle_array(name="fluid", x=x, y=y, z=z, m=DENSITY * DISTANCE**3, h=DISTANCE, rho=DENSITY, additional_props=["arho", "cs", "dt_cfl", "dt_force"])
        fluid.cs[:] = SOUND
        return [fluid]

    def create_solver(self):
        return Solver(kernel=CubicSpline(dim=3), dim=3, integrator=EulerIntegrator(fluid=EulerStep()), dt=STEP, tf=1e9 * STEP, pfreq=10**9)

    def create_equations(self):
        return [Group([SummationDensity("fluid", ["fluid"])]), Group([IsothermalEOS("fluid", None, rho0=DENSITY, c0=SOUND, p0=0.0)]),
                Group([MomentumEquation("fluid", ["fluid"], c0=SOUND, alpha=0.05, beta=0.0, gy=-GRAVITY),
                       Walls("fluid", None, half=DISTANCE / 2, stiffness=(SOUND / (2 * DISTANCE)) ** 2)])]

    def post_step(self, solver):
        self.times.append(time.perf_counter())
        taken = numpy.diff(self.times)[20:]  # behind the first 20
        if len(taken) >= 3 and taken.sum() >= SECONDS:
            solver.set_max_steps(solver.count)


with tempfile.TemporaryDirectory() as folder:
    app = DamBreak(fname="dam", output_dir=folder)
    app.run(["--openmp", "--disable-output", "--logfile", os.path.join(folder, "log"), "--no-adaptive-timestep"])
    fluid = app.particles[0]
    if not numpy.isfinite(fluid.y).all():
        sys.exit("the particles of PySPH have no finite positions")
    print("pysph", N**3, os.environ.get("OMP_NUM_THREADS", "1"), f"{numpy.median(numpy.diff(app.times)[20:]):.6g}", 1, 0, 0, file=sys.__stdout__)
