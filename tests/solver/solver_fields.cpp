// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/registry.hpp>

#include <limits>
#include <map>

namespace test_solver_fields {

using namespace sinew;

namespace {

template <class C>
std::string refused(C const& component) {
  try {
    check_fields(component, "/root");
  } catch (Error const& error) {
    return error.what();
  }
  return "";
}
bool has(std::string const& text, std::string_view word) { return text.find(word) != std::string::npos; }

}  // namespace

TEST_CASE("settings of solvers out of range are refused by name") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(has(refused(EulerImplicitSolver{.rayleighMass = -1}), "rayleighMass is -1"));
  CHECK(has(refused(EulerImplicitSolver{.vdamping = nan}), "vdamping is nan"));
  CHECK(has(refused(NewmarkImplicitSolver{.gamma = 1.5}), "gamma is 1.5"));
  CHECK(has(refused(NewmarkImplicitSolver{.beta = 0.6}), "beta is 0.6"));
  CHECK(has(refused(CentralDifferenceSolver{.rayleighMass = -1}), "rayleighMass is -1"));
  CHECK(has(refused(BDFOdeSolver{.order = 4}), "order is 4"));
  CHECK(has(refused(BDFOdeSolver{.maxNbIterationsNewton = 0}), "maxNbIterationsNewton is 0"));
  CHECK(has(refused(StaticSolver{.maxNbIterationsNewton = 0}), "maxNbIterationsNewton is 0"));
  CHECK(has(refused(EulerImplicitSolver{.maxNbIterationsNewton = 0}), "maxNbIterationsNewton is 0"));
  CHECK(has(refused(StaticSolver{.lineSearchCoefficient = 1}), "lineSearchCoefficient is 1"));
  CHECK(refused(StaticSolver{.absoluteResidualStoppingThreshold = -1}).empty());  // not looked at, as in SOFA
  CHECK(has(refused(VariationalSymplecticSolver{.newtonError = -1}), "newtonError is -1"));
  CHECK(has(refused(VariationalSymplecticSolver{.steps = 0}), "steps is 0"));
  CHECK(has(refused(RungeKutta45Solver{.tolerance = -1}), "tolerance is -1"));
  CHECK(has(refused(RungeKutta45Solver{.maxSubsteps = 0}), "maxSubsteps is 0"));
  CHECK(has(refused(MinResLinearSolver<>{.iterations = 0}), "iterations is 0"));
  CHECK(has(refused(MinResLinearSolver<>{.tolerance = nan}), "tolerance is nan"));
  CHECK(has(refused(ShewchukPCGLinearSolver<>{.iterations = 0}), "iterations is 0"));
  CHECK(has(refused(ShewchukPCGLinearSolver<>{.updateStep = -1}), "update_step is -1"));
  CHECK(has(refused(ShewchukPCGLinearSolver<>{.omega = 2}), "omega is 2"));
}

TEST_CASE("solvers are refused nothing by default, and no two share a name") {
  std::map<std::string, std::string_view> owner;
  for_each_registered<StandardSolvers>([&]<class C>() {
    CHECK(refused(C{}).empty());
    auto claim = [&](std::string_view name) {
      const auto [entry, fresh] = owner.emplace(name, C::className);
      INFO(name);
      CHECK((fresh || entry->second == C::className));
    };
    claim(C::className);
    for_each_name(class_aliases<C>(), claim);
  });
  CHECK(owner.at("EulerImplicit") == "EulerImplicitSolver");
  CHECK(owner.at("CGSolver") == "CGLinearSolver");
  for (const std::string direct :
       {"EigenSimplicialLDLT", "EigenSimplicialLLT", "EigenSparseLU", "EigenSparseQR"})
    CHECK(owner.at(direct) == "SparseLDLSolver");
  CHECK(owner.at("PCGLinearSolver") == "ShewchukPCGLinearSolver");
}

}  // namespace test_solver_fields
