// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "mpi/ranks.hpp"

#include <sinew/visual/visual_model.hpp>

namespace test_rigid {

using namespace ranks_test;

/// A bar that is held at one end.
template <class... More>
auto soft(More... more) {
  const Mesh mesh = regular_grid_tetrahedra(7, 3, 3, {0, 0, 0}, {3, 1, 1});
  std::vector<int> fixed;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i][0] < 1e-9) fixed.push_back(int(i));
  return node<"soft">(more...,
                      MeshTopology{.tetrahedra = mesh.tetrahedra},
                      MechanicalObject<Vec3d>{mesh.positions},
                      DiagonalMass<Vec3d>{.massDensity = 1000},
                      TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e5}, .poissonRatio = 0.3},
                      FixedConstraint<Vec3d>{.indices = fixed});
}
/// Three rigid bodies one behind the other, of which the last is held and the others turn; points of
/// different ones are joined by springs.
template <class... More>
auto rigids(More... more) {
  using Frame = Rigid3d::Coord;
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, -1).normalized()));
  Eigen::Matrix<double, 6, 1> turns, stands = Eigen::Matrix<double, 6, 1>::Zero();
  turns << 0, 0, 0, 1, 0.5, -0.3;
  return node<"rigids">(
      more...,
      MechanicalObject<Rigid3d>{.position = {Frame{{4, 0.5, 0.5}, {1, 0, 0, 0}},
                                             Frame{{5.5, 0.5, 0.5}, turned},
                                             Frame{{7, 0.5, 0.5}, turned}},
                                .velocity = {turns, -turns, stands}},
      UniformMass<Rigid3d>{
          .vertexMass = RigidMass<double, 3>{50, Eigen::Vector3d(5, 8, 10).asDiagonal().toDenseMatrix()}},
      FixedConstraint<Rigid3d>{.indices = {2}},
      node<"carried">(MechanicalObject<Vec3d>{.position = {{-0.5, -0.5, -0.5},
                                                           {-0.5, 0.5, -0.5},
                                                           {-0.5, -0.5, 0.5},
                                                           {-0.5, 0.5, 0.5},
                                                           {-0.5, 0, 0},
                                                           {0.5, 0.1, 0},
                                                           {-0.5, 0, 0.2},
                                                           {0, 0.5, 0}}},
                      RigidMapping<Rigid3d, Vec3d>{.rigidIndices = {0, 0, 0, 0, 1, 1, 2, 2},
                                                   .geometricStiffness = RotationalStiffness::symmetrized},
                      StiffSpringForceField<Vec3d>{.springs = {{1, 4, 3000, 20}, {2, 4, 2000, 20}},
                                                   .springsIndices1 = {5},
                                                   .springsIndices2 = {6},
                                                   .stiffness = {5000}},
                      UniformVelocityDampingForceField<Vec3d>{.dampingCoefficient = 3}),
      // of the first body alone
      node<"one">(MechanicalObject<Vec3d>{.position = {{0.5, 0, 0}, {0, 0.5, 0}}},
                  RigidMapping<Rigid3d, Vec3d>{.rigidIndices = {0}},
                  ConstantForceField<Vec3d>{.forces = {{30, 0, 0}, {0, 0, -50}}},
                  PlaneForceField<Vec3d>{.normal = {0, 1, 0}, .d = 0.7, .stiffness = 400}),
      node<"look">(VisualModel{.mesh = {.positions = {{0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}},
                                        .triangles = {{0, 1, 2}}}},
                   RigidMapping<Rigid3d, Vec3f>{.rigidIndices = {1}}));
}
auto springs() {
  return StiffSpringForceField<Vec3d, Between<"soft", "rigids/carried">>{
      .springs = {{6, 0, 2e4, 10}, {20, 1, 2e4, 10}, {48, 2, 2e4, 10}, {62, 3, 2e4, 10}, {3, 7, 500, 1}},
      .springsIndices1 = {34},
      .springsIndices2 = {4},
      .stiffness = {700},
      .lengths = {2}};
}
template <class Ode, class Linear>
auto together(Ode ode, Linear linear) {
  return node<"root">(Gravity{{0, -9.81, 0}}, ode, linear, springs(), soft(), rigids());
}
/// Each body has a solver of its own.
template <class Ode, class Linear>
auto apart(Ode ode, Linear linear) {
  return node<"root">(Gravity{{0, -9.81, 0}}, springs(), soft(ode, linear), rigids(ode, linear));
}

double distance_of_frames(Rigid3d::VecCoord const& a, Rigid3d::VecCoord const& b) {
  double most = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max({most,
                     (a[i].center - b[i].center).norm(),
                     (a[i].orientation.coeffs() - b[i].orientation.coeffs()).norm()});
  return most;
}

template <class Scene>
void compare(Scene const& scene, int steps, double dt, double tolerance) {
  Simulation one{scene};
  auto ranks = std::make_shared<mpi::Communicator>();
  mpi::DistributedSimulation many{scene, ranks}, again{scene, ranks};
  many.keepWhole();
  one.init(), many.init(), again.init();
  for (int i = 0; i < steps; ++i) one.animate(dt), many.animate(dt), again.animate(dt);
  auto softOf = [](auto& sim) -> auto& { return hana::at_c<0>(sim.root().children).state(); };
  auto rigidOf = [](auto& sim) -> auto& { return hana::at_c<1>(sim.root().children).state(); };
  const Positions v = one.template at<"soft">().state().velocity,
                  w = many.everywhere(softOf(many), vec_id::velocity);
  CHECK(distance(v, w) < tolerance * length(v));
  auto const& expected = one.template at<"rigids">().state().position;
  const auto frames = many.everywhere(rigidOf(many), vec_id::position);
  CHECK(distance_of_frames(frames, expected) < tolerance);
  CHECK(frames == again.everywhere(rigidOf(again), vec_id::position));
  CHECK(w == again.everywhere(softOf(again), vec_id::velocity));
  // they have moved, but for the one that is held
  auto const& start = one.template at<"rigids">().state().restPosition;
  CHECK((frames[0].center - start[0].center).norm() > 1e-4);
  CHECK(distance_of_frames({frames[2]}, {start[2]}) < 1e-12);
  CHECK(many.energies().kinetic == Approx(one.kineticEnergy()).epsilon(100 * tolerance));
  CHECK(many.energies().potential == Approx(one.potentialEnergy()).epsilon(100 * tolerance));
  bool looked = false;
  many.look([&](auto const& whole) {
    looked = true;
    auto const& vertices = hana::at_c<2>(hana::at_c<1>(whole.node.children).children).visual().position;
    CHECK((vertices[1] - one.template at<"rigids/look">().visual().position[1]).norm() < 1e-5f);
  });
  CHECK(looked == (ranks->rank() == 0));
}

TEST_CASE("rigid bodies and a soft one that springs join step as in one process") {
  compare(together(EulerExplicitSolver{}, CGLinearSolver<>{}), 40, 5e-4, 1e-10);
  const EulerImplicitSolver ode{.rayleighStiffness = 0.01, .rayleighMass = 0.1};
  compare(together(ode, CGLinearSolver<>{.iterations = 2000, .tolerance = 1e-12}), 5, 0.01, 1e-7);
  compare(together(ode, PetscLinearSolver<>{.tolerance = 1e-11}), 5, 0.01, 1e-7);
}

TEST_CASE("and so they do where each has a solver of its own") {
  compare(apart(EulerImplicitSolver{.rayleighStiffness = 0.01},
                CGLinearSolver<>{.iterations = 2000, .tolerance = 1e-12}),
          8,
          0.005,
          1e-7);
}

TEST_CASE("many rigid bodies are shared out as points are, few by what they carry") {
  const World world;
  auto chain = [](int n) {
    Rigid3d::VecCoord frames;
    std::vector<Spring> springs;
    for (int i = 0; i < n; ++i) {
      frames.push_back({{double(i), 0.01 * i * i, 0}, {1, 0, 0, 0}});
      if (i > 0) springs.push_back({i - 1, i, 800, 2});
    }
    return node<"root">(Gravity{{0, -9.81, 0}},
                        EulerImplicitSolver{},
                        CGLinearSolver<>{.iterations = 1000, .tolerance = 1e-12},
                        MechanicalObject<Rigid3d>{frames},
                        UniformMass<Rigid3d>{.totalMass = 2.0 * n},
                        FixedConstraint<Rigid3d>{.indices = {0}},
                        StiffSpringForceField<Rigid3d>{.springs = springs});
  };
  for (const int n : {1, 3, 40}) {
    INFO(n);
    Simulation one{chain(n)};
    mpi::DistributedSimulation many{chain(n), std::make_shared<mpi::Communicator>()};
    one.init(), many.init();
    for (int i = 0; i < 5; ++i) one.animate(0.01), many.animate(0.01);
    CHECK(distance_of_frames(many.everywhere(many.root().state(), vec_id::position),
                             one.root().state().position) < 1e-9);
    auto const& halo = many.halo(many.root().state());
    std::size_t least = std::size_t(n), most = 0;
    for (const std::size_t owned : halo.ownedBy) least = std::min(least, owned), most = std::max(most, owned);
    CHECK(most - least <= (n < 40 ? 1u : 8u));
    CHECK(many.root().state().size() > 0);
  }
}

}  // namespace test_rigid
