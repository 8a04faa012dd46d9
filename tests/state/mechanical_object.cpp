// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/sinew.hpp>

namespace test_mechanical_object {

using namespace sinew;

namespace {
Vec3d::VecDeriv started_with(Vec3d::VecDeriv velocity) {
  Simulation sim{node<"root">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
                                                      .velocity = std::move(velocity)})};
  sim.init();
  return sim.root().state().velocity;
}
}  // namespace

TEST_CASE("points that are given no velocity have the last one that is given") {
  CHECK(started_with({}) == Vec3d::VecDeriv{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  CHECK(started_with({{1, 2, 3}}) == Vec3d::VecDeriv{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  CHECK(started_with({{1, 2, 3}, {4, 5, 6}}) == Vec3d::VecDeriv{{1, 2, 3}, {4, 5, 6}, {4, 5, 6}});
  CHECK_THROWS_WITH(started_with(Vec3d::VecDeriv(4, {1, 2, 3})),
                    Catch::Contains("velocity has 4 entries, position has 3"));
}

}  // namespace test_mechanical_object
