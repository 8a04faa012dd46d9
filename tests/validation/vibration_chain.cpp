// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "record.hpp"
#include "registry_scene.hpp"
#include "ring.hpp"

#include <sinew/sinew.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>

namespace test_vibration_chain {

using namespace sinew;

TEST_CASE("a chain of springs rings in each of its modes as its dispersion says", "[page]") {
  // n springs k between n + 1 masses m, the ends held: w_j = 2 sqrt(k/m) sin(j pi / 2n)
  Record curve("chain", {"chain", "mode", "frequency"});
  const int n = 16;
  const double k = 50, m = 0.02, c = std::sqrt(k / m);
  for (int mode = 1; mode < n; ++mode) {
    Vec1d::VecCoord rest;
    std::vector<Spring> springs;
    for (int i = 0; i <= n; ++i) rest.push_back(Vec<double, 1>(i));
    for (int i = 0; i < n; ++i) springs.push_back({.first = i, .second = i + 1, .stiffness = k});
    RegistryScene sim{node<"root">(NewmarkImplicitSolver{},
                                   SparseLDLSolver<CompressedRowSparseMatrixd>{},
                                   MechanicalObject<Vec1d>{rest},
                                   UniformMass<Vec1d>{.vertexMass = m},
                                   StiffSpringForceField<Vec1d>{.springs = springs},
                                   FixedConstraint<Vec1d>{.indices = {0, n}})};
    sim.init();
    for (int i = 0; i <= n; ++i)
      sim.root().state().position[std::size_t(i)][0] += 1e-3 * std::sin(pi * mode * i / n);
    const double closed = 2 * c * std::sin(mode * pi / (2 * n)), found = ring(sim, rest, 0.1 / closed);
    // 1 - cos(W h) keeps 12 digits at this step
    CHECK(found == Approx(closed).epsilon(1e-9));
    curve.row("springs", mode, found / c);
    curve.row("2 sin(j pi / 2n)", mode, closed / c);
    curve.row("string without lumps", mode, mode * pi / n);
  }
}

}  // namespace test_vibration_chain
