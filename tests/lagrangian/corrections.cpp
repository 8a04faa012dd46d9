// SPDX-License-Identifier: BSL-1.0
// What bodies answer to multipliers: by their solver, with a factor or without, or by compliances of their
// own.
#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

namespace test_corrections {

using namespace sinew;

namespace {

constexpr double dt = 0.01;

// a string of springs between two points that multipliers hold, one of them moved by a rest position of its
// own; the second point of it is held by a projective constraint too
template <class Linear, class... Correction>
auto string_of(Linear linear, Correction... correction) {
  constexpr int n = 12;
  MechanicalObject<Vec3d> state;
  StiffSpringForceField<Vec3d> springs;
  for (int i = 0; i < n; ++i) {
    state.position.push_back({0.1 * i, 0.02 * (i % 3), 0});
    if (i > 0) springs.springs.push_back({i - 1, i, 500, 1, 0.1});
  }
  return RegistryScene{
      node<"root">(FreeMotionAnimationLoop{},
                   BlockGaussSeidelConstraintSolver{.maxIterations = 10000, .tolerance = 1e-15},
                   Gravity{{0, -10, 0}},
                   node<"string">(EulerImplicitSolver{.rayleighStiffness = 0.01},
                                  linear,
                                  state,
                                  UniformMass<Vec3d>{.totalMass = 1.2},
                                  springs,
                                  PartialFixedConstraint<Vec3d>{.indices = {1}},
                                  FixedLagrangianConstraint<Vec3d>{.indices = {0, 5, n - 1}},
                                  correction...))};
}
template <class Sim>
auto run(Sim sim) {
  sim.init();
  for (int i = 0; i < 20; ++i) sim.animate(dt);
  return sim.template at<"string">().state().position;
}

double apart(Vec3d::VecCoord const& a, Vec3d::VecCoord const& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

}  // namespace

TEST_CASE("a body answers alike, whichever linear solver says how") {
  const auto factor = run(string_of(SparseLDLSolver<>{}));
  CHECK(apart(factor, run(string_of(CGLinearSolver<>{.iterations = 500, .tolerance = 1e-15}))) < 1e-10);
  CHECK(apart(factor, run(string_of(SparseLDLSolver<CompressedRowSparseMatrixd>{}))) < 1e-10);
  // once more with the matrix of the last solve, from 0 whatever the last solution was
  using Scalars = CompressedRowSparseMatrixd;
  CHECK(apart(factor,
              run(string_of(CGLinearSolver<>{.iterations = 500, .tolerance = 1e-15, .warmStart = true}))) <
        1e-10);
  CHECK(apart(factor,
              run(string_of(CGLinearSolver<Scalars>{
                  .iterations = 500, .tolerance = 1e-15, .warmStart = true}))) < 1e-10);
  CHECK(apart(factor, run(string_of(MinResLinearSolver<>{.iterations = 500, .tolerance = 1e-15}))) < 1e-10);
  CHECK(apart(factor, run(string_of(MinResLinearSolver<Scalars>{.iterations = 500, .tolerance = 1e-15}))) <
        1e-10);
  CHECK(apart(factor, run(string_of(ShewchukPCGLinearSolver<>{.iterations = 500, .tolerance = 1e-15}))) <
        1e-10);
  CHECK(
      apart(factor, run(string_of(ShewchukPCGLinearSolver<Scalars>{.iterations = 500, .tolerance = 1e-15}))) <
      1e-10);
  CHECK(apart(factor, run(string_of(CholeskySolver<>{}))) < 1e-10);
  CHECK(apart(factor, run(string_of(SparseLDLSolver<>{}, LinearSolverConstraintCorrection{}))) == 0);
}

TEST_CASE("points that answer alone do what their compliance says") {
  // a heavy and a light point, joined: the impulse moves each by its compliance
  RegistryScene sim{node<"root">(
      FreeMotionAnimationLoop{},
      BlockGaussSeidelConstraintSolver{.maxIterations = 10000, .tolerance = 1e-15},
      BilateralLagrangianConstraint<Vec3d, Between<"a", "b">>{.first_point = {0}, .second_point = {0}},
      node<"a">(EulerExplicitSolver{},
                MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {5, 0, 0}}},
                UniformMass<Vec3d>{.totalMass = 2},
                UncoupledConstraintCorrection<Vec3d>{.compliance = {3, 1}}),
      node<"b">(EulerExplicitSolver{},
                MechanicalObject<Vec3d>{.position = {{1, 0, 0}}},
                UniformMass<Vec3d>{.totalMass = 1},
                UncoupledConstraintCorrection<Vec3d>{.defaultCompliance = 1}))};
  sim.init();
  sim.animate(dt);
  auto const& a = sim.at<"a">().state();
  auto const& b = sim.at<"b">().state();
  // 1 m between them, shared 3 to 1
  CHECK(a.position[0][0] == Approx(0.75).epsilon(1e-12));
  CHECK(b.position[0][0] == Approx(0.75).epsilon(1e-12));
  CHECK(a.velocity[0][0] == Approx(0.75 / dt).epsilon(1e-12));
  CHECK(a.position[1][0] == 5);
}

TEST_CASE("compliances that move nothing, or are too few, are refused") {
  auto wrong = [](UncoupledConstraintCorrection<Rigid3d> correction, std::string const& words) {
    RegistryScene sim{node<"root">(FreeMotionAnimationLoop{},
                                   BlockGaussSeidelConstraintSolver{},
                                   EulerExplicitSolver{},
                                   MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{}}},
                                   UniformMass<Rigid3d>{},
                                   correction)};
    CHECK_THROWS_WITH(sim.init(), Catch::Contains(words) && Catch::Contains("UncoupledConstraintCorrection"));
  };
  wrong({.compliance = {1, 2}}, "give 7");
  wrong({.compliance = {1, 1, 0, 0, 0, 0, 1}}, "compliance[4] is 0");
  wrong({.compliance = {-1, 1, 0, 0, 1, 0, 1}}, "compliance[0] is -1");
  wrong({.defaultCompliance = -1}, "defaultCompliance");
  wrong({.compliance = {1, 1, 2, 0, 1, 0, 1}}, "positive definite");
  wrong({.compliance = {1, 1, 0.9, 0.9, 1, -0.9, 1}}, "positive definite");
}

namespace {

// W of a step that holds a turned body in its place, over h^2: compliances of the centre and of the rotation
template <class... Correction>
Eigen::MatrixXd mobility_of(UniformMass<Rigid3d> const& mass, Quat<double> const& orientation,
                            Correction... correction) {
  Rigid3d::Coord place;
  place.orientation = orientation;
  RegistryScene sim{node<"root">(FreeMotionAnimationLoop{},
                                 BlockGaussSeidelConstraintSolver{},
                                 EulerExplicitSolver{},
                                 MechanicalObject<Rigid3d>{.position = {place}},
                                 mass,
                                 FixedLagrangianConstraint<Rigid3d>{.indices = {0}},
                                 correction...)};
  sim.init();
  sim.animate(dt);
  return sim.root().template get<FreeMotionAnimationLoop>().motion.problem.compliance / (dt * dt);
}

}  // namespace

TEST_CASE("rigid bodies answer by their masses, with the inertia where it has turned to") {
  const UniformMass<Rigid3d> mass{
      .vertexMass = RigidMass<double, 3>{2, Eigen::Matrix3d(Eigen::Vector3d(1, 2, 3).asDiagonal())}};
  const Quat<double> turned(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  const Eigen::Matrix3d R = turned.toRotationMatrix();
  Eigen::MatrixXd exact = Eigen::MatrixXd::Zero(6, 6);
  exact.topLeftCorner<3, 3>().setIdentity();
  exact.topLeftCorner<3, 3>() /= 2;
  exact.bottomRightCorner<3, 3>() = R * Eigen::Vector3d(1, 1 / 2., 1 / 3.).asDiagonal() * R.transpose();
  CHECK((mobility_of(mass, turned) - exact).norm() < 1e-12);
  using Uncoupled = UncoupledConstraintCorrection<Rigid3d>;
  CHECK((mobility_of(mass, turned, Uncoupled{}) - exact).norm() < 1e-12);
  CHECK((mobility_of(mass, turned, Uncoupled{.useOdeSolverIntegrationFactors = false}) - exact).norm() <
        1e-12);
  // seven numbers are in world axes, whatever the orientation
  Eigen::MatrixXd given = Eigen::MatrixXd::Zero(6, 6);
  given.diagonal() << 5, 5, 5, 4, 2, 1;
  given(3, 4) = given(4, 3) = 0.5;
  CHECK((mobility_of(mass, turned, Uncoupled{.compliance = {5, 4, 0.5, 0, 2, 0, 1}}) - given).norm() < 1e-12);
}

TEST_CASE("positions and velocities take parts of what a compliance of positions says") {
  constexpr double c = 1e-4, part = 0.25, share = 0.5;
  RegistryScene sim{node<"root">(FreeMotionAnimationLoop{},
                                 BlockGaussSeidelConstraintSolver{.tolerance = 1e-15},
                                 EulerExplicitSolver{},
                                 MechanicalObject<Vec3d>{.position = {{0, 0, 0}}, .velocity = {{2, 0, 0}}},
                                 UniformMass<Vec3d>{},
                                 UncoupledConstraintCorrection<Vec3d>{.defaultCompliance = c,
                                                                      .useOdeSolverIntegrationFactors = false,
                                                                      .correctionPositionFactor = part,
                                                                      .correctionVelocityFactor = share},
                                 FixedLagrangianConstraint<Vec3d>{.indices = {0}})};
  sim.init();
  sim.animate(dt);
  // the free motion goes 2 dt, which the multiplier -2 dt / c would take back
  CHECK(sim.root().get<FixedLagrangianConstraint<Vec3d>>().multipliers[0] == Approx(-2 * dt / c));
  CHECK(sim.root().state().position[0][0] == Approx(2 * dt * (1 - part)));
  CHECK(sim.root().state().velocity[0][0] == Approx(2 * (1 - share)));
}

TEST_CASE("bodies of one solver answer each in its own way") {
  auto share = [](auto ode, auto... linear) {
    RegistryScene sim{node<"root">(
        FreeMotionAnimationLoop{},
        BlockGaussSeidelConstraintSolver{.maxIterations = 10000, .tolerance = 1e-15},
        ode,
        linear...,
        BilateralLagrangianConstraint<Vec3d, Between<"a", "b">>{.first_point = {0}, .second_point = {0}},
        node<"a">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                  UniformMass<Vec3d>{.totalMass = 7},
                  UncoupledConstraintCorrection<Vec3d>{.defaultCompliance = 3}),
        node<"b">(MechanicalObject<Vec3d>{.position = {{1, 0, 0}}}, UniformMass<Vec3d>{.totalMass = 1}))};
    sim.init();
    sim.animate(dt);
    // 3 / kg against 1 / (1 kg)
    CHECK(sim.template at<"a">().state().position[0][0] == Approx(0.75).epsilon(1e-10));
    CHECK(sim.template at<"b">().state().position[0][0] == Approx(0.75).epsilon(1e-10));
  };
  share(EulerExplicitSolver{});
  share(EulerImplicitSolver{}, SparseLDLSolver<>{});
  share(EulerImplicitSolver{}, CGLinearSolver<>{.tolerance = 1e-14});
}

TEST_CASE("the compliance of a system is scaled and made regular") {
  auto compliance = [](LinearSolverConstraintCorrection const& correction) {
    auto sim = string_of(SparseLDLSolver<>{}, correction);
    sim.init();
    sim.animate(dt);
    return Eigen::MatrixXd(sim.root().get<FreeMotionAnimationLoop>().motion.problem.compliance);
  };
  const Eigen::MatrixXd W = compliance({});
  CHECK((compliance({.complianceFactor = 3}) - 3 * W).norm() < 1e-12 * W.norm());
  const Eigen::MatrixXd regular = compliance({.regularizationTerm = 0.5});
  CHECK((regular - W - dt * 0.5 * Eigen::MatrixXd::Identity(W.rows(), W.cols())).norm() <
        1e-12 * regular.norm());
}

TEST_CASE("a correction of a mapped state is refused") {
  RegistryScene sim{node<"root">(FreeMotionAnimationLoop{},
                                 BlockGaussSeidelConstraintSolver{},
                                 EulerExplicitSolver{},
                                 MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                 UniformMass<Vec3d>{},
                                 node<"same">(MechanicalObject<Vec3d>{},
                                              IdentityMapping<Vec3d, Vec3d>{},
                                              UncoupledConstraintCorrection<Vec3d>{}))};
  CHECK_THROWS_WITH(sim.init(), Catch::Contains("/root/same") && Catch::Contains("mapping"));
}

TEST_CASE("a solver that asks the systems alone refuses a correction, which it would leave out") {
  RegistryScene sim{node<"root">(FreeMotionAnimationLoop{},
                                 ConvexConstraintSolver{},
                                 EulerExplicitSolver{},
                                 MechanicalObject<Vec3d>{.position = {{0, 0, 1}}},
                                 UniformMass<Vec3d>{},
                                 FixedLagrangianConstraint<Vec3d>{.indices = {0}},
                                 UncoupledConstraintCorrection<Vec3d>{})};
  sim.init();
  CHECK_THROWS_WITH(sim.animate(dt),
                    Catch::Contains("/root: UncoupledConstraintCorrection<Vec3d>") &&
                        Catch::Contains("leave this correction out"));
  // one that stands for the systems is refused where it changes them
  auto by_system = [](LinearSolverConstraintCorrection const& correction) {
    return RegistryScene{node<"root">(FreeMotionAnimationLoop{},
                                      ConvexConstraintSolver{},
                                      EulerImplicitSolver{},
                                      SparseLDLSolver<>{},
                                      MechanicalObject<Vec3d>{.position = {{0, 0, 1}}},
                                      UniformMass<Vec3d>{},
                                      FixedLagrangianConstraint<Vec3d>{.indices = {0}},
                                      correction)};
  };
  for (auto const& correction : {LinearSolverConstraintCorrection{.regularizationTerm = 0.5},
                                 LinearSolverConstraintCorrection{.complianceFactor = 2}}) {
    auto changed = by_system(correction);
    changed.init();
    CHECK_THROWS_WITH(changed.animate(dt),
                      Catch::Contains("/root: LinearSolverConstraintCorrection") &&
                          Catch::Contains("leave this correction out"));
  }
  auto same = by_system({});
  same.init();
  CHECK_NOTHROW(same.animate(dt));
}

}  // namespace test_corrections
