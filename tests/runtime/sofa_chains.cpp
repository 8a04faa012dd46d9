// SPDX-License-Identifier: BSL-1.0
// Scenes of SOFA with chains: a string that is made without a file, a block tridiagonal solver, equalities by
// conjugate residuals.
#include "catch.hpp"

#include <sinew/engine/string_mesh_creator.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/registry.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>

namespace test_sofa_chains {

using namespace sinew;

namespace {

using Mine = Standard;

// a string of 6 points that swings from its first one
std::string string_of(std::string const& constraintSolver, std::string const& linear) {
  return "<Node name='root' gravity='0 -9.81 0' dt='0.01'><FreeMotionAnimationLoop/>" + constraintSolver +
         "<StringMeshCreator name='loader' resolution='6' scale3d='1 1 1'/>"
         "<EulerImplicitSolver rayleighStiffness='0'/>" +
         linear +
         "<EdgeSetTopologyContainer name='edges' src='@loader'/>"
         "<MechanicalObject name='points' template='Vec3d' src='@loader'/>"
         "<UniformMass vertexMass='1'/><FixedConstraint indices='0'/>"
         "<Node name='lengths'><MechanicalObject template='Vec1d'/><DistanceMapping/>"
         "<UniformLagrangianConstraint iterative='0'/></Node></Node>";
}
auto swung(std::string const& scene) {
  auto read = parse_scene<Mine>("string.scn", scene);
  CHECK(read.warnings.empty());
  Simulation sim{read.root};
  sim.init();
  for (int i = 0; i < 30; ++i) sim.animate(0.01);
  return sim.root().template get<MechanicalObject<Vec3d>>()->position;
}

}  // namespace

TEST_CASE("a string of a scene file swings with the same motion by conjugate residuals and by sweeps") {
  const std::string btd = "<BTDLinearSolver template='BTDMatrix6d' printLog='0' verbose='0' bandWidth='11'/>";
  const auto x = swung(
                 string_of("<PreconditionedConjugateResidual maxIterations='100' tolerance='1e-13'/>", btd)),
             y = swung(string_of("<GenericConstraintSolver maxIterations='100000' tolerance='1e-14'/>",
                                 "<SparseLDLSolver/>"));
  REQUIRE(x.size() == 6);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - y[i]).norm() < 1e-8);
  // what falls by its own length in sqrt(2 / g) = 0.45 s has come some way
  CHECK(x[5][1] < -0.3);
  // edges are as long as at the start, but for what is of second order in a step: (v h)^2 / (2 l)
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    CHECK((x[i + 1] - x[i]).norm() == Approx(1 / 5.).epsilon(0.02));
}

TEST_CASE("a block tridiagonal solver of rigid bodies has the solution of the system") {
  auto end = [](std::string const& linear) {
    auto read =
        parse_scene<Mine>("rigids.scn",
                          "<Node dt='0.01'><EulerImplicitSolver/>" + linear +
                              "<MechanicalObject template='Rigid3d' position='0 0 0 0 0 0 1  1 0 0 0 0 0 1' "
                              "velocity='0 1 0 0 0 2  0 0 3 1 0 0'/><UniformMass totalMass='2'/>"
                              "<RestShapeSpringsForceField stiffness='100' angularStiffness='10'/></Node>");
    CHECK(read.warnings.empty());
    Simulation sim{read.root};
    sim.init();
    for (int i = 0; i < 10; ++i) sim.animate(0.01);
    return sim.root().template get<MechanicalObject<Rigid3d>>()->velocity;
  };
  CHECK(end("<BTDLinearSolver template='BTDMatrix6d'/>") == end("<SparseLDLSolver/>"));
}

TEST_CASE("multi_grid of LCPConstraintSolver is taken where it is off, and refused where it is on") {
  auto read = [](std::string const& value) {
    return parse_scene<Mine>("lcp.scn",
                             "<Node><FreeMotionAnimationLoop/><LCPConstraintSolver multi_grid='" + value +
                                 "'/><MechanicalObject position='0 0 0'/></Node>");
  };
  CHECK(read("false").warnings.empty());
  CHECK(read("0").warnings.empty());
  CHECK_THROWS_WITH(read("true"),
                    Catch::Contains("lcp.scn:1:") && Catch::Contains("multi_grid is not simulated"));
}

}  // namespace test_sofa_chains
