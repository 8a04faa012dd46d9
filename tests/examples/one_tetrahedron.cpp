// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "one_tetrahedron/scene.hpp"

namespace test_one_tetrahedron {

using namespace sinew;

TEST_CASE("one tetrahedron: every skin vertex is the affine image of where it was") {
  auto sim = examples::one_tetrahedron();
  sim.init();
  const Mesh before = sim.at<"tetrahedron/skin">().visual().current();
  REQUIRE(before.positions.size() > 1000);
  for (int i = 0; i < 50; ++i) sim.animate(0.01);
  auto const& x = sim.at<"tetrahedron">().state().position;
  const Mesh after = sim.at<"tetrahedron/skin">().visual().current();
  Eigen::Matrix3d f;
  for (int c = 0; c < 3; ++c) f.col(c) = x[std::size_t(c) + 1] - x[0];
  CHECK((x[1] - Eigen::Vector3d(1, 0, 0)).norm() > 0.01);  // it moved
  for (std::size_t i = 0; i < before.positions.size(); ++i)
    REQUIRE((after.positions[i] - (x[0] + f * before.positions[i])).norm() <
            1e-6);  // float: 2^-24 of numbers near 1
}

TEST_CASE("one tetrahedron: visual models are brought up to date when they are looked at") {
  auto sim = examples::one_tetrahedron();
  sim.init();
  auto const& skin = sim.at<"tetrahedron/skin">().visual();
  const auto before = skin.position;
  sim.animate(0.01);
  CHECK(skin.position == before);
  sim.updateVisual();
  CHECK(skin.position != before);
}

}  // namespace test_one_tetrahedron
