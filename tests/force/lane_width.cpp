// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/sinew.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace test_lane_width {

using namespace sinew;

namespace {

/// A bar of tetrahedra and springs that falls and swings, its skin mapped, after ten implicit steps.
template <class D>
Eigen::VectorXd swing() {
  const Mesh mesh = regular_grid_tetrahedra(5, 3, 3, {0, 0, 0}, {2, 1, 1});
  typename D::VecCoord points;
  for (auto const& p : mesh.positions) points.push_back(p.template cast<typename D::Real>());
  Simulation sim{node<"root">(
      Gravity{{0, -9.81, 0}},
      EulerImplicitSolver{},
      CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 500, .tolerance = 1e-14},
      node<"bar">(TetrahedronTopology{mesh.tetrahedra},
                  MechanicalObject<D>{points},
                  DiagonalMass<D>{.massDensity = 1000},
                  TetrahedronFEMForceField<D>{.youngModulus = {1e5}, .poissonRatio = 0.4},
                  StiffSpringForceField<D>{.springs = {{.first = 4, .second = 44, .stiffness = 300}}},
                  PlaneForceField<D>{.d = 0.1},
                  FixedConstraint<D>{.indices = {0, 5, 10}},
                  node<"skin">(MechanicalObject<Vec3d>{mesh.positions}, BarycentricMapping<D, Vec3d>{})))};
  sim.init();
  for (int i = 0; i < 10; ++i) sim.animate(0.02);
  return vec::flat(sim.template at<"bar/skin">().state().position);
}

}  // namespace

TEST_CASE("as many elements at a time as a DataTypes says: another order of sums, the same motion") {
  using One = TetrahedronFEMForceField<WithLanes<Vec3d, 1>>;
  static_assert(std::is_same_v<One::Driver::L, double>);
  static_assert(std::is_same_v<TetrahedronFEMForceField<WithLanes<Vec3d, 2>>::Driver::L, Lanes<double, 2>>);
  CHECK(component_name<One>() == "TetrahedronFEMForceField<Vec3dx1>");
  const Eigen::VectorXd native = swing<Vec3d>(), one = swing<WithLanes<Vec3d, 1>>(),
                        two = swing<WithLanes<Vec3d, 2>>();
  // of the order of what the linear solver leaves
  REQUIRE(native.norm() > 1);
  CHECK((one - native).norm() < 1e-11 * native.norm());
  CHECK((two - native).norm() < 1e-11 * native.norm());
  const Eigen::VectorXd single = swing<WithLanes<Vec3f, 1>>();
  CHECK((single - native).norm() < 1e-4 * native.norm());
}

}  // namespace test_lane_width
