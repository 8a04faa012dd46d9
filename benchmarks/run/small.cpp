// SPDX-License-Identifier: BSL-1.0
// Steps a second of scenes of a few points: small STEPS. One tetrahedron whose skin has 2,194 vertices,
// implicit Euler and up to 25 conjugate-gradient iterations, with the skin brought up to date in each step
// and without; and a pendulum of two springs that carries a rigid body, explicit Euler. Prints one line a
// scene: its name, steps a second, kinetic energy [J].
#include "paired.hpp"

#include <sinew/sinew.hpp>

#include <cmath>
#include <cstdlib>
#include <numbers>

using namespace sinew;

namespace {

/// A sphere of `rings` rings of `around` vertices, and its poles.
Mesh round_skin(int rings, int around, double radius, Eigen::Vector3d const& center) {
  Mesh mesh;
  mesh.positions.push_back(center + Eigen::Vector3d(0, 0, radius));
  for (int i = 1; i <= rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double a = std::numbers::pi * i / (rings + 1), b = 2 * std::numbers::pi * j / around;
      mesh.positions.push_back(center + radius * Eigen::Vector3d(std::sin(a) * std::cos(b),
                                                                 std::sin(a) * std::sin(b),
                                                                 std::cos(a)));
    }
  mesh.positions.push_back(center - Eigen::Vector3d(0, 0, radius));
  const Index last = Index(mesh.positions.size()) - 1;
  auto at = [&](int i, int j) { return Index(1 + i * around + j % around); };
  for (int j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(0, j), at(0, j + 1)});
    for (int i = 0; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, j), last, at(rings - 1, j + 1)});
  }
  return mesh;
}

template <class Linear>
auto tetrahedron(Linear linear) {
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
      linear,
      node<"tetrahedron">(TetrahedronTopology{{{0, 1, 2, 3}}},
                          MechanicalObject<Vec3d>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                          UniformMass<Vec3d>{.totalMass = 1},
                          TetrahedronFEMForceField<Vec3d>{.youngModulus = {500}, .poissonRatio = 0.3},
                          FixedConstraint<Vec3d>{.indices = {0}},
                          node<"skin">(VisualModel{round_skin(16, 137, 0.3, {0.25, 0.25, 0.25})},
                                       BarycentricMapping<Vec3d, Vec3f>{})))};
}

/// A fixed point, a spring, a mass, a spring to the corner of a brick of 1 kg.
auto pendulum() {
  const RigidMass<double, 3> brick{
      1, Eigen::Vector3d(0.02 / 12, 0.05 / 12, 0.05 / 12).asDiagonal().toDenseMatrix()};
  const Spring link{.first = 0, .second = 1, .stiffness = 500, .damping = 0.2, .length = 0.5};
  const Spring joint{.first = 1, .second = 0, .stiffness = 500, .damping = 0.2, .length = 0.1};
  return Simulation{
      node<"root">(Gravity{{0, -9.81, 0}},
                   EulerExplicitSolver{},
                   StiffSpringForceField<Vec3d, Between<"string", "brick/corner">>{.springs = {joint}},
                   node<"string">(MechanicalObject<Vec3d>{{{0, 0, 0}, {0.5, 0, 0}}},
                                  UniformMass<Vec3d>{.vertexMass = 0.05},
                                  StiffSpringForceField<Vec3d>{{link}},
                                  FixedConstraint<Vec3d>{.indices = {0}}),
                   node<"brick">(MechanicalObject<Rigid3d>{.position = {{.center = {0.7, -0.05, 0}}}},
                                 UniformMass<Rigid3d>{.vertexMass = brick},
                                 node<"corner">(MechanicalObject<Vec3d>{.position = {{-0.1, 0.05, 0}}},
                                                RigidMapping<Rigid3d, Vec3d>{})))};
}

// a scene that has come to rest would ask for fewer iterations
constexpr int again = 200;

template <class Sim>
void report(char const* name, Sim sim, int steps, double dt, bool skin) {
  sim.init();
  const double time = bench::processor_seconds([&] {
    for (int i = 0; i < steps; ++i) {
      if (i % again == 0) sim.reset();
      sim.animate(dt);
      if (skin) sim.updateVisual();
    }
  });
  std::printf("%s %.0f %.9g\n", name, steps / time, sim.kineticEnergy());
}

}  // namespace

int main(int argc, char** argv) try {
  const int steps = argc == 2 ? std::atoi(argv[1]) : 0;
  if (steps < 1) {
    std::fprintf(stderr, "usage: small STEPS\n");
    return 2;
  }
  const CGLinearSolver<> free{.iterations = 25, .tolerance = 1e-9};
  const CGLinearSolver<CompressedRowSparseMatrixMat3x3d> assembled{.iterations = 25, .tolerance = 1e-9};
  report("tetrahedron-with-skin", tetrahedron(free), steps, 0.02, true);
  report("tetrahedron", tetrahedron(free), steps, 0.02, false);
  report("tetrahedron-with-skin-assembled", tetrahedron(assembled), steps, 0.02, true);
  report("tetrahedron-assembled", tetrahedron(assembled), steps, 0.02, false);
  report("pendulum", pendulum(), steps, 0.0005, false);
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "small: %s\n", error.what());
  return 1;
}
