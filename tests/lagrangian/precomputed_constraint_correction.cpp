// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "io/files.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <cstring>
#include <fstream>
#include <limits>

namespace test_precomputed_constraint_correction {

using namespace sinew;
using Precomputed = PrecomputedConstraintCorrection<Vec3d>;

namespace {

constexpr double dt = 0.02;

// a block of tetrahedra that is turned from rest
template <class Linear, class Constraint, class... Correction>
auto held_block(Linear linear, Eigen::Matrix3d const& R, Constraint constraint, Correction... correction) {
  const Mesh mesh = regular_grid_tetrahedra(3, 3, 2, {0, 0, 0}, {0.2, 0.2, 0.1});
  Vec3d::VecCoord turned;
  for (auto const& x : mesh.positions) turned.push_back(R * x + Eigen::Vector3d(1, 2, 3));
  MechanicalObject<Vec3d> state{.position = turned};
  state.restPosition = mesh.positions;
  return Simulation{node<"root">(FreeMotionAnimationLoop{},
                                 BlockGaussSeidelConstraintSolver{.maxIterations = 10000, .tolerance = 1e-15},
                                 EulerImplicitSolver{.rayleighStiffness = 0.01},
                                 linear,
                                 TetrahedronTopology{mesh.tetrahedra},
                                 state,
                                 DiagonalMass<Vec3d>{.massDensity = 1000},
                                 TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e5}, .poissonRatio = 0.3},
                                 constraint,
                                 correction...)};
}
template <class Linear, class... Correction>
auto block(Linear linear, Eigen::Matrix3d const& R, Correction... correction) {
  return held_block(linear, R, UniformLagrangianConstraint<Vec3d>{}, correction...);
}
template <class Sim>
Eigen::MatrixXd compliance_of(Sim sim) {
  sim.init();
  sim.animate(dt);
  return sim.root().template get<FreeMotionAnimationLoop>().motion.problem.compliance;
}
double apart(Eigen::MatrixXd const& a, Eigen::MatrixXd const& b) { return (a - b).norm() / b.norm(); }

}  // namespace

TEST_CASE("a body answers by the compliance that it has at rest, whichever solver finds it") {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Matrix3d still = Eigen::Matrix3d::Identity();
  const Eigen::MatrixXd rest = compliance_of(block(SparseLDLSolver<>{}, still));
  CHECK(apart(compliance_of(block(SparseLDLSolver<>{}, still, Precomputed{})), rest) < 1e-10);
  // few iterations in a step, but all that it takes before the first
  CHECK(
      apart(compliance_of(block(CGLinearSolver<>{.iterations = 3, .tolerance = 1e-2}, still, Precomputed{})),
            rest) < 1e-9);
  // the stiffness turns with the body, to what polar decomposition leaves
  const Eigen::MatrixXd turned = compliance_of(block(SparseLDLSolver<>{}, R));
  CHECK(apart(turned, rest) > 0.1);
  CHECK(apart(compliance_of(block(SparseLDLSolver<>{}, R, Precomputed{.rotations = true})), turned) < 1e-7);
  CHECK(apart(compliance_of(block(SparseLDLSolver<>{}, R, Precomputed{})), rest) < 1e-10);
}

TEST_CASE("what a precomputed compliance moves is where its multipliers want it") {
  auto sim = held_block(SparseLDLSolver<>{},
                        Eigen::Matrix3d::Identity(),
                        FixedLagrangianConstraint<Vec3d>{.indices = {0, 7}},
                        Precomputed{.rotations = true});
  auto& state = sim.root().state();
  state.position = state.restPosition;
  sim.init();
  for (std::size_t i = 0; i < state.size(); ++i) state.velocity[i] = {0, 0, 20 * state.position[i][0] - 20};
  for (int i = 0; i < 5; ++i) sim.animate(dt);
  for (const std::size_t held : {std::size_t(0), std::size_t(7)})
    CHECK((state.position[held] - state.restPosition[held]).norm() < 1e-10);
  CHECK((state.position[17] - state.restPosition[17]).norm() > 0.01);
}

TEST_CASE("the inertia of a precomputed rigid body turns with it") {
  auto mobility = [](auto... correction) {
    Rigid3d::Coord rest, now;
    rest.orientation = Quat<double>(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()));
    now.orientation = Quat<double>(Eigen::AngleAxisd(1.3, Eigen::Vector3d(1, 2, -1).normalized()));
    MechanicalObject<Rigid3d> state{.position = {now}};
    state.restPosition = {rest};
    Simulation sim{node<"root">(
        FreeMotionAnimationLoop{},
        BlockGaussSeidelConstraintSolver{},
        EulerExplicitSolver{},
        state,
        UniformMass<Rigid3d>{
            .vertexMass = RigidMass<double, 3>{2, Eigen::Matrix3d(Eigen::Vector3d(1, 2, 3).asDiagonal())}},
        FixedLagrangianConstraint<Rigid3d>{.indices = {0}},
        correction...)};
    return compliance_of(std::move(sim));
  };
  using P = PrecomputedConstraintCorrection<Rigid3d>;
  const Eigen::MatrixXd exact = mobility();
  CHECK(apart(mobility(P{.rotations = true, .restDeformations = true}), exact) < 1e-12);
  CHECK(apart(mobility(P{.rotations = true}), exact) > 0.01);  // turned by the orientation at rest too
}

TEST_CASE("a compliance is read from the file to which it was written, and from no other") {
  const files::TempFolder folder;
  const std::string file = folder / "block.comp";
  const Eigen::Matrix3d still = Eigen::Matrix3d::Identity();
  auto with = [&](Precomputed p) {
    p.fileCompliance = "block.comp";
    p.fileDir = folder / "";
    return block(SparseLDLSolver<>{}, still, p);
  };
  const Eigen::MatrixXd made = compliance_of(with({}));
  CHECK(compliance_of(with({})) == made);

  auto bytes = [&] {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string sound = bytes();
  const std::size_t head = sound.find('\n') + 1;
  auto refused = [&](std::string const& content, std::string const& words) {
    std::ofstream(file, std::ios::binary) << content;
    auto sim = with({});
    sim.init();
    CHECK_THROWS_WITH(sim.animate(dt),
                      Catch::Contains(words) && Catch::Contains("block.comp") &&
                          Catch::Contains("PrecomputedConstraintCorrection"));
  };
  // other numbers than those that a solver would find show that it is the file that is read
  std::string doubled = sound;
  for (std::size_t k = head; k < sound.size(); k += sizeof(double)) {
    double value;
    std::memcpy(&value, sound.data() + k, sizeof value);
    value *= 2;
    std::memcpy(doubled.data() + k, &value, sizeof value);
  }
  std::ofstream(file, std::ios::binary) << doubled;
  CHECK(apart(compliance_of(with({})), 2 * made) < 1e-14);
  CHECK(apart(compliance_of(with({.recompute = true})), made) < 1e-14);
  CHECK(bytes() == sound);

  auto replaced = [&](std::size_t number, double value) {
    std::string s = sound;
    std::memcpy(s.data() + head + number * sizeof value, &value, sizeof value);
    return s;
  };
  refused("", "cannot be read");
  refused("solid\n", "does not begin with");
  refused(sound.substr(0, sound.size() - 1), "numbers that it says");
  refused(sound + "x", "numbers that it says");
  refused(replaced(3, std::numeric_limits<double>::quiet_NaN()), "not finite");
  refused(replaced(3, 1e6), "not symmetric");
  refused("sinew-compliance-1 3 0.02 1\n" + sound.substr(head), "another body: it has 3");
  std::ofstream(file, std::ios::binary) << sound;
  auto other = with({});
  other.init();
  CHECK_THROWS_WITH(other.animate(dt / 2), Catch::Contains("of steps of 0.02 s"));
  auto nowhere = block(SparseLDLSolver<>{}, still, Precomputed{.fileCompliance = "/no/such/folder/x.comp"});
  nowhere.init();
  CHECK_THROWS_WITH(nowhere.animate(dt), Catch::Contains("cannot be written"));
}

TEST_CASE("points that no elements join do not say how they turn") {
  Simulation sim{node<"root">(FreeMotionAnimationLoop{},
                              BlockGaussSeidelConstraintSolver{},
                              EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                              UniformMass<Vec3d>{},
                              Precomputed{.rotations = true})};
  CHECK_THROWS_WITH(sim.init(), Catch::Contains("rotations: no elements join the points"));
}

}  // namespace test_precomputed_constraint_correction
