// SPDX-License-Identifier: BSL-1.0
// Springs between the centres of rigid bodies.
#include "one_component.hpp"

#include <sinew/force/stiff_spring.hpp>

namespace test_rigid_springs {

using namespace sinew;

TEST_CASE("a spring between rigid bodies joins their centres, and turns nothing") {
  Rigid3d::VecCoord x(2, Rigid3d::zero());
  x[1].center = {3, 4, 0};
  x[1].orientation = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX());
  auto springs = one::ready(
      StiffSpringForceField<Rigid3d>{
          .springs = {{.first = 0, .second = 1, .stiffness = 10, .damping = 2, .length = 3}}},
      x);
  Rigid3d::VecDeriv v(2, Rigid3d::Deriv::Zero());
  v[1] << 0.6, 0.8, 0, 5, 6, 7;
  // 2 m longer than without force, and 1 m/s faster apart
  const auto f = one::force(springs, x, v);
  CHECK(f[0].head<3>().isApprox((10 * 2 + 2) * Eigen::Vector3d(0.6, 0.8, 0)));
  CHECK(f[0].tail<3>().norm() == 0);
  CHECK(f[1] == -f[0]);
  // without a length it is that of the centres at rest
  auto relaxed = one::ready(StiffSpringForceField<Rigid3d>{.springs = {{.first = 0, .second = 1}}}, x);
  CHECK(one::force(relaxed, x)[0].norm() < 1e-12);
}

}  // namespace test_rigid_springs
