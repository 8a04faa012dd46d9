// SPDX-License-Identifier: BSL-1.0
#include "bars.hpp"
#include "catch.hpp"
#include "record.hpp"
#include "registry_scene.hpp"

#include <sinew/solver/pcg_linear_solver.hpp>

#include <Eigen/LU>

namespace test_low_rank {

using namespace bars;

namespace {

const Bar bar{.length = 6, .E = 1e5, .nu = 0.3, .along = 12, .across = 2};
const Mesh mesh = bar.mesh(Cells::hexahedra);
// the corner at the middle of the upper side, which gets a spring to where it was
const int changed = nearest_point(mesh, {3, 0.5, 0.5});

/// The bar held at one end and loaded at the other, its one point on a spring of stiffness k, solved once.
template <class Linear>
auto solved(Linear linear, double k) {
  HexahedronFEMForceField<Vec3d> fem{.method = HexahedronMethod::small};
  fem.youngModulus = {bar.E}, fem.poissonRatio = bar.nu;
  RestShapeSpringsForceField<Vec3d> spring;
  spring.points = {changed}, spring.stiffness = {k};
  RegistryScene sim{node<"root">(to_rounding(1),
                                 linear,
                                 MeshTopology{.hexahedra = mesh.hexahedra},
                                 MechanicalObject<Vec3d>{mesh.positions},
                                 fem,
                                 spring,
                                 on_end_face(mesh, bar, {2, -5, 1}),
                                 FixedConstraint<Vec3d>{.indices = points_at(mesh, 0)})};
  sim.init();
  sim.animate(1);
  return sim;
}
/// Displacements, as one vector.
template <class Sim>
Eigen::VectorXd way(Sim& sim) {
  auto const& x = sim.root().state().position;
  Eigen::VectorXd u(3 * long(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) u.segment<3>(3 * long(i)) = x[i] - mesh.positions[i];
  return u;
}

}  // namespace

TEST_CASE(
    "the stiffness of one point changes: a low-rank update, a direct solution and conjugate gradients "
    "agree",
    "[page]") {
  // Sherman, Morrison, Woodbury: with A = L D L' of the body as it was, S = k I the stiffness that point i
  // gets, E its three columns of the identity and C = A^-1 E,
  //   (A + E S E')^-1 f = u - C (S^-1 + E' C)^-1 E' u,   u = A^-1 f
  Record table("low_rank", {"k", "change", "smw", "cg", "iterations", "preconditioned"}),
      curve("low_rank_residuals", {"solver", "iteration", "residual"});
  auto before = solved(SparseLDLSolver<>{}, 0);
  const Eigen::VectorXd u = way(before);
  auto& factor = before.root().get<SparseLDLSolver<>>().factor;
  Eigen::MatrixXd C(u.size(), 3);
  for (int c = 0; c < 3; ++c) {
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(u.size()), column = unit;
    unit[3 * changed + c] = 1;
    factor.solve(unit, column);
    C.col(c) = column;
  }
  const Eigen::Matrix3d own = C.middleRows<3>(3 * changed);

  for (const double k : {1e1, 1e3, 1e5, 1e7, 1e9}) {
    INFO("k = " << k);
    const Eigen::Matrix3d inner = Eigen::Matrix3d::Identity() / k + own;
    const Eigen::VectorXd updated = u - C * inner.lu().solve(u.segment<3>(3 * changed));
    auto direct = solved(SparseLDLSolver<>{}, k);
    const Eigen::VectorXd exact = way(direct);
    auto cg = solved(CGLinearSolver<>{.iterations = 5000, .tolerance = 1e-10}, k);
    auto pcg = solved(ShewchukPCGLinearSolver<>{.iterations = 5000, .tolerance = 1e-10}, k);
    const double smw = (updated - exact).norm() / exact.norm(),
                 iterated = (way(cg) - exact).norm() / exact.norm();
    // rounding times the condition of a bar of 12 x 2 x 2 cells, some 1e5
    CHECK(smw < 1e-10);
    // a residual of 1e-10 times the condition at most
    CHECK(iterated < 1e-6);
    CHECK((way(pcg) - exact).norm() < 1e-6 * exact.norm());
    auto const& residuals = cg.root().template get<CGLinearSolver<>>().residuals;
    auto const& preconditioned = pcg.root().template get<ShewchukPCGLinearSolver<>>().residuals;
    table.row(k,
              (exact - u).norm() / u.norm(),
              smw,
              iterated,
              int(residuals.size()) - 1,
              int(preconditioned.size()) - 1);
    if (k == 1e3 || k == 1e7)
      for (auto const& [name, list] :
           {std::pair{"CGLinearSolver", &residuals}, {"with block Jacobi", &preconditioned}})
        for (std::size_t i = 0; i < list->size(); i += 2)
          curve.row(text(name, k < 1e5 ? ", k = 1e3" : ", k = 1e7"), int(i), (*list)[i]);
  }
  // a spring that changes nothing would prove nothing
  auto stiff = solved(SparseLDLSolver<>{}, 1e5);
  CHECK((way(stiff) - u).norm() > 0.1 * u.norm());
}

}  // namespace test_low_rank
