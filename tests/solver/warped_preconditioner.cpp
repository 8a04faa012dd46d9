// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "registry_scene.hpp"
#include "solver/fem_bar.hpp"

#include <sinew/solver/pcg_linear_solver.hpp>

namespace test_warped_preconditioner {

using namespace sinew;

namespace {

using Matrix3d = CompressedRowSparseMatrixMat3x3d;

template <class Matrix>
ShewchukPCGLinearSolver<Matrix> kept(PreconditionerMethod method, bool warp, int updateStep = 0) {
  return {
      .iterations = 2000, .tolerance = 1e-9, .updateStep = updateStep, .precondition = method, .warp = warp};
}

/// Iterations of the step after one in which a free bar was turned as a whole by `degrees`.
template <class Matrix>
int after_turn(ShewchukPCGLinearSolver<Matrix> solver, double degrees, Eigen::VectorXd* result = nullptr) {
  auto sim = fem_bar::simulation(solver, 8, false);
  fem_bar::velocities(sim, 2);
  auto& state = sim.root().state();
  const Eigen::AngleAxisd rotation(degrees * 3.14159265358979 / 180,
                                   Eigen::Vector3d(1, -2, 0.5).normalized());
  for (auto& x : state.position) x = rotation * x;
  // waves of several lengths run through it
  for (std::size_t i = 0; i < state.size(); ++i)
    state.velocity[i] =
        rotation *
        Eigen::Vector3d(std::sin(3. * double(i)), std::cos(2. * double(i)), std::sin(0.1 * double(i)));
  sim.animate(0.02);
  if (result) *result = vec::flat(state.velocity);
  return int(sim.root().template get<ShewchukPCGLinearSolver<Matrix>>().residuals.size()) - 1;
}

}  // namespace

TEST_CASE("a factorisation that is kept serves a body that has turned, where it turns with it") {
  Eigen::VectorXd exact, warped;
  for (const double degrees : {20., 90., 170.}) {
    using enum PreconditionerMethod;
    const int fresh = after_turn(kept<Matrix3d>(ldl, false, 1), degrees, &exact),
              plain = after_turn(kept<Matrix3d>(ldl, false), degrees),
              turned = after_turn(kept<Matrix3d>(ldl, true), degrees, &warped),
              free = after_turn(kept<GraphScattered>(ldl, true), degrees),
              scalar = after_turn(kept<CompressedRowSparseMatrixd>(ldl, true), degrees),
              incomplete = after_turn(kept<Matrix3d>(incompleteCholesky, true), degrees),
              incompleteFresh = after_turn(kept<Matrix3d>(incompleteCholesky, true, 1), degrees);
    INFO(degrees << " degrees: fresh " << fresh << ", kept " << plain << ", warped " << turned
                 << ", matrix-free " << free << ", IC(0) " << incomplete << " for " << incompleteFresh);
    CHECK((warped - exact).norm() < 1e-6 * exact.norm());
    CHECK(fresh <= 2);
    // the matrix has turned as a whole, and changed by what little the bar has deformed in one step
    CHECK(turned <= 5);
    CHECK(plain > 2 * turned);
    if (degrees > 45) CHECK(plain > 5 * turned);
    CHECK(free == turned);
    CHECK(scalar == turned);
    CHECK(incomplete <= incompleteFresh + 3);
  }
}

TEST_CASE("a bar that bends by its weight: rotations differ from point to point") {
  auto iterations = [](auto solver) {
    auto sim = fem_bar::simulation(solver, 16);
    int sum = 0;
    for (int i = 0; i < 60; ++i) {
      sim.animate(0.02);
      sum += int(sim.root().template get<decltype(solver)>().residuals.size()) - 1;
    }
    const auto x = sim.root().state().position.back();
    return std::pair{sum, x};
  };
  using enum PreconditionerMethod;
  const auto [plain, x0] = iterations(kept<Matrix3d>(ldl, false));
  const auto [warped, x1] = iterations(kept<Matrix3d>(ldl, true));
  const auto [renewed, x2] = iterations(kept<Matrix3d>(ldl, true, 10));
  const auto [blocks, x3] = iterations(kept<Matrix3d>(blockJacobi, false, 1));
  INFO("60 steps: kept " << plain << ", warped " << warped << ", warped and renewed in each tenth step "
                         << renewed << ", block Jacobi " << blocks << ", tip at " << x0.transpose());
  CHECK(x0[1] < -5);  // of a length of 8
  CHECK((x1 - x0).norm() < 1e-5);
  CHECK((x2 - x0).norm() < 1e-5);
  CHECK((x3 - x0).norm() < 1e-5);
  CHECK(3 * warped < 2 * plain);
  CHECK(renewed < warped);
  CHECK(4 * renewed < blocks);
}

TEST_CASE("coordinates that are held stay held, though the rotation of their point mixes them with others") {
  // a bar held at one end turns about it; the points of its lower side may not move along z
  const Mesh mesh = regular_grid_tetrahedra(9, 3, 3, {0, 0, 0}, {4, 1, 1});
  std::vector<int> end, side;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.positions[i][0] < 1e-9) end.push_back(int(i));
    if (mesh.positions[i][1] < 1e-9) side.push_back(int(i));
  }
  auto bar = [&](auto linear) {
    RegistryScene sim{node<"root">(
        Gravity{{0, -9.81, 0}},
        EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
        linear,
        TetrahedronTopology{mesh.tetrahedra},
        MechanicalObject<Vec3d>{mesh.positions},
        DiagonalMass<Vec3d>{.massDensity = 1000},
        TetrahedronFEMForceField<Vec3d>{.youngModulus = {3e4}, .poissonRatio = 0.4},
        ConstantForceField<Vec3d>{.indices = {8}, .force = Eigen::Vector3d(0, 0, 300)},
        FixedConstraint<Vec3d>{.indices = end},
        PartialFixedConstraint<Vec3d>{.indices = side, .fixedDirections = {false, false, true}})};
    sim.init();
    for (int i = 0; i < 30; ++i) sim.animate(0.02);
    return Eigen::VectorXd(vec::flat(sim.root().state().position));
  };
  const Eigen::VectorXd exact = bar(SparseLDLSolver<>{}),
                        formed = bar(kept<Matrix3d>(PreconditionerMethod::ldl, true)),
                        free = bar(kept<GraphScattered>(PreconditionerMethod::ldl, true));
  CHECK(exact.tail(3)[1] < 0);  // it hangs down by more than its height
  CHECK((formed - exact).norm() < 1e-6 * exact.norm());
  CHECK((free - exact).norm() < 1e-6 * exact.norm());
  for (const int i : side) CHECK(free[3 * i + 2] == mesh.positions[std::size_t(i)][2]);
}

TEST_CASE("rotations of points come from their neighbours, of bodies from their orientation") {
  const Eigen::AngleAxisd rotation(1.2, Eigen::Vector3d(2, 1, -1).normalized());
  // a square of springs, flat; a wire, whose twist is not seen; a rigid body
  RegistryScene sim{node<"root">(
      EulerImplicitSolver{},
      ShewchukPCGLinearSolver<CompressedRowSparseMatrixd>{.updateStep = 0, .warp = true},
      node<"square">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
                     UniformMass<Vec3d>{.vertexMass = 1},
                     StiffSpringForceField<Vec3d>{.springs = {{.first = 0, .second = 1},
                                                              {.first = 1, .second = 2},
                                                              {.first = 2, .second = 3},
                                                              {.first = 3, .second = 0}}}),
      node<"wire">(
          MechanicalObject<Vec2d>{.position = {{0, 0}, {1, 0}, {2, 0}}},
          UniformMass<Vec2d>{.vertexMass = 1},
          StiffSpringForceField<Vec2d>{.springs = {{.first = 0, .second = 1}, {.first = 1, .second = 2}}}),
      node<"body">(MechanicalObject<Rigid3d>{.position = {{}}}, UniformMass<Rigid3d>{.vertexMass = {{}}}))};
  sim.init();
  sim.animate(0.01);
  for (auto& x : sim.at<"square">().state().position) x = rotation * x;
  for (auto& x : sim.at<"wire">().state().position) x = Eigen::Rotation2Dd(0.7) * x;
  sim.at<"body">().state().position[0].orientation = rotation;
  sim.animate(0.01);
  auto const& turns =
      sim.root().get<ShewchukPCGLinearSolver<CompressedRowSparseMatrixd>>().rotations.rotation;
  REQUIRE(turns.size() == 8);
  const Eigen::Matrix3d inSpace = rotation.toRotationMatrix(),
                        inPlane = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (std::size_t i = 0; i < 8; ++i)
    CHECK((turns[i] - (i >= 4 && i < 7 ? inPlane : inSpace)).norm() < (i < 7 ? 1e-5 : 1e-14));
}

}  // namespace test_warped_preconditioner
