// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/sinew.hpp>

#include <limits>

namespace test_bad_input {

using namespace sinew;

namespace {

const double notANumber = std::numeric_limits<double>::quiet_NaN();

#define CHECK_SAYS(expression, ...)                               \
  do {                                                            \
    const std::string said = error_of([&] { (void)expression; }); \
    for (const std::string word : {__VA_ARGS__}) {                \
      INFO(said);                                                 \
      CHECK(said.find(word) != std::string::npos);                \
    }                                                             \
  } while (false)

const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<Tetrahedron> one{{0, 1, 2, 3}};

auto scene(TetrahedronFEMForceField<Vec3d> fem, TetrahedronTopology topology, MechanicalObject<Vec3d> state,
           DiagonalMass<Vec3d> mass, EulerExplicitSolver solver = {}) {
  return Simulation{node<"root">(solver, node<"body">(topology, state, mass, fem))};
}
auto init(TetrahedronFEMForceField<Vec3d> fem, TetrahedronTopology topology = {one},
          MechanicalObject<Vec3d> state = {corners}, DiagonalMass<Vec3d> mass = {.massDensity = 1}) {
  auto sim = scene(fem, topology, state, mass);
  sim.init();
  return sim;
}

}  // namespace

TEST_CASE("parameters out of range name node, component, field, value and range") {
  CHECK(error_of([] { init({.youngModulus = {3000}, .poissonRatio = 0.3}); }).empty());
  CHECK_SAYS(init({.youngModulus = {-3}}),
             "/root/body",
             "TetrahedronFEMForceField<Vec3d>",
             "youngModulus[0] is -3 Pa",
             "greater than 0");
  CHECK_SAYS(init({.youngModulus = {notANumber}}), "youngModulus[0] is nan", "finite");
  CHECK_SAYS(init({.youngModulus = {0}}), "youngModulus[0] is 0", "greater than 0");
  CHECK_SAYS(init({.poissonRatio = 0.5}), "poissonRatio is 0.5", "less than 0.5");
  CHECK_SAYS(init({.poissonRatio = -1}), "poissonRatio is -1", "greater than -1");
  CHECK_SAYS(init({.youngModulus = {1, 2}}), "youngModulus has 2 values for 1 tetrahedra");
  CHECK_SAYS(init({}, {one}, {corners}, {.massDensity = 0}),
             "/root/body",
             "DiagonalMass<Vec3d>",
             "massDensity is 0",
             "greater than 0");
  CHECK_SAYS(init({}, {one}, {corners}, {.massDensity = -2}), "massDensity is -2");
  CHECK_SAYS(init({}, {one}, {corners}, {.vertexMass = {1, 1, 0, 1}}), "vertexMass[2] is 0");
  CHECK_SAYS(init({}, {one}, {corners}, {.vertexMass = {1, 1, 1}}), "3 entries for 4 points", "one for all");
  CHECK_SAYS(init({}, {one}, {corners}, {}), "exactly one of massDensity, totalMass and vertexMass");
}

TEST_CASE("bad meshes name the element or the point") {
  CHECK_SAYS(init({}, {{{0, 2, 1, 3}}}), "/root/body", "tetrahedron 0 is inside out");
  CHECK_SAYS(init({}, {one}, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}), "tetrahedron 0 has no volume");
  CHECK_SAYS(init({}, {{{0, 1, 2, 4}}}), "tetrahedron 0 refers to point 4", "4 points");
  CHECK_SAYS(init({}, {{{0, 1, 2, -1}}}), "tetrahedra[0][3] is -1", "at least 0");
  CHECK_SAYS(init({}, {}), "topology with tetrahedra");
  CHECK_SAYS(init({}, {one}, {{{0, 0, 0}, {1, notANumber, 0}, {0, 1, 0}, {0, 0, 1}}}),
             "MechanicalObject<Vec3d>",
             "position[1] is nan",
             "finite");
  // a point that no tetrahedron uses gets no mass
  CHECK_SAYS(init({}, {one}, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}}}),
             "no element has point 4");
}

TEST_CASE("springs, constraints, forces and mappings check their indices") {
  auto with = [](auto... extra) {
    Simulation sim{node<"root">(
        EulerExplicitSolver{}, MechanicalObject<Vec3d>{corners}, UniformMass<Vec3d>{}, extra...)};
    sim.init();
  };
  using Springs = StiffSpringForceField<Vec3d>;
  CHECK(error_of([&] { with(Springs{{{.first = 0, .second = 1}}}); }).empty());
  CHECK_SAYS(with(Springs{{{.first = 0, .second = 9}}}), "springs[0] refers to point 9", "4 points");
  CHECK_SAYS(with(Springs{{{.first = 2, .second = 2}}}), "joins point 2 to itself");
  CHECK_SAYS(with(Springs{{{.first = 0, .second = 1, .stiffness = -1}}}),
             "springs[0].stiffness is -1",
             "at least 0");
  CHECK_SAYS(with(Springs{{{.first = 0, .second = 1, .length = -1}}}), "springs[0].length is -1");
  CHECK_SAYS(with(FixedConstraint<Vec3d>{{4}}), "FixedConstraint<Vec3d>", "indices has 4");
  CHECK_SAYS(with(FixedConstraint<Vec3d>{{-1}}), "indices[0] is -1");
  CHECK_SAYS(with(ConstantForceField<Vec3d>{.indices = {7}, .forces = {{1, 0, 0}}}), "indices has 7");
  CHECK_SAYS(with(ConstantForceField<Vec3d>{.indices = {1, 2, 3}, .forces = {{1, 0, 0}, {0, 0, 0}}}),
             "2 entries for 3 indices");
  CHECK_SAYS(with(node<"sub">(MechanicalObject<Vec3d>{}, SubsetMapping<Vec3d, Vec3d>{{5}})),
             "/root/sub",
             "indices has 5");
  CHECK_SAYS(with(node<"sub">(MechanicalObject<Vec3d>{{{0, 0, 0}}}, SubsetMapping<Vec3d, Vec3d>{{1, 2}})),
             "1 points for 2 indices");
}

TEST_CASE("masses check themselves") {
  auto with = [](auto mass) {
    using D = typename decltype(mass)::DataTypes;
    Simulation sim{node<"root">(EulerExplicitSolver{}, MechanicalObject<D>{.position = {D::zero()}}, mass)};
    sim.init();
  };
  CHECK_SAYS(with(UniformMass<Vec3d>{.vertexMass = 0}), "vertexMass is 0");
  CHECK_SAYS(with(UniformMass<Vec3d>{.totalMass = -1}), "totalMass is -1");
  CHECK_SAYS(with(UniformMass<Vec3d>{.vertexMass = 1, .totalMass = 1}), "both given");
  using M = RigidMass<double, 3>;
  CHECK_SAYS(with(UniformMass<Rigid3d>{.vertexMass = M{0, Eigen::Matrix3d::Identity()}}),
             "mass 0 is 0 kg",
             "greater than 0");
  CHECK_SAYS(with(UniformMass<Rigid3d>{.vertexMass = M{1, -Eigen::Matrix3d::Identity()}}),
             "positive definite");
  Eigen::Matrix3d skew = Eigen::Matrix3d::Identity();
  skew(0, 1) = 0.5;
  CHECK_SAYS(with(UniformMass<Rigid3d>{.vertexMass = M{1, skew}}), "symmetric");
  CHECK_SAYS(with(UniformMass<Rigid3d>{.vertexMass = M{notANumber, Eigen::Matrix3d::Identity()}}),
             "greater than 0");
}

TEST_CASE("animate refuses a bad dt and an uninitialised scene, and nothing has moved") {
  auto sim = scene({}, {one}, {corners}, {.massDensity = 1});
  CHECK_SAYS(sim.animate(0.01), "init()");
  sim.init();
  const auto before = sim.at<"body">().state().position;
  for (const double dt : {0.0, -0.01, notANumber, std::numeric_limits<double>::infinity()})
    CHECK_SAYS(sim.animate(dt), "dt is", "greater than 0");
  CHECK(sim.time() == 0);
  CHECK(sim.at<"body">().state().position == before);
}

TEST_CASE("a diverging simulation stops with step, node and component") {
  auto sim = init({.youngModulus = {1e9}, .poissonRatio = 0.3});
  sim.at<"body">().state().velocity[1] = {1, 0, 0};
  std::string said;
  for (int i = 0; i < 2000 && said.empty(); ++i) said = error_of([&] { sim.animate(0.1); });
  INFO(said);
  CHECK(said.find("step ") == 0);
  CHECK(said.find("/root/body") != std::string::npos);
  CHECK(said.find("MechanicalObject<Vec3d>") != std::string::npos);
  CHECK(said.find("diverged") != std::string::npos);
  // reset brings it back
  sim.reset();
  sim.animate(1e-6);
  CHECK(sim.at<"body">().state().position[1].allFinite());
}

TEST_CASE("solver settings are checked") {
  auto with = [](EulerImplicitSolver ode, CGLinearSolver<> cg) {
    Simulation sim{node<"root">(ode, cg, MechanicalObject<Vec3d>{corners}, UniformMass<Vec3d>{})};
    sim.init();
  };
  CHECK_SAYS(with(EulerImplicitSolver{.rayleighMass = -1}, {}), "EulerImplicitSolver", "rayleighMass is -1");
  CHECK_SAYS(with({}, {.iterations = 0}), "CGLinearSolver", "iterations is 0");
  CHECK_SAYS(with({}, {.tolerance = notANumber}), "tolerance is nan");
}

}  // namespace test_bad_input
