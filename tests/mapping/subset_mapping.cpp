// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/mapping/subset_mapping.hpp>

#include <limits>

namespace test_subset_mapping {

using namespace sinew;

TEST_CASE("a SubsetMapping without indices finds the points at the same places") {
  const Vec3d::VecCoord parent{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  SubsetMapping<Vec3d, Vec3f> mapping;
  Vec3f::VecCoord child{{0, 1, 0}, {1, 1e-6f, 0}};
  const Vec3f::VecCoord rest = child;
  mapping.init({"parent", parent, {}}, {"child", rest, {}}, child);
  CHECK(mapping.indices == std::vector<int>{2, 1});

  SubsetMapping<Vec3d, Vec3f> astray;
  Vec3f::VecCoord elsewhere{{0, 1, 0}, {5, 6, 7}};
  CHECK_THROWS_WITH(astray.init({"parent", parent, {}}, {"child", rest, {}}, elsewhere),
                    Catch::Contains("no point within 1e-05 m of 5 6 7"));
}

TEST_CASE("a SubsetMapping takes the nearest point within its radius") {
  const Vec3d::VecCoord parent{{0, 0, 0}, {1, 0, 0}, {1.2, 0, 0}, {1.2, 0, 0}};
  SubsetMapping<Vec3d, Vec3d> mapping{.radius = 0.3};
  Vec3d::VecCoord child{{1.15, 0, 0}, {0, 0.25, 0}, {1.05, 0, 0}};
  const Vec3d::VecCoord rest = child;
  mapping.init({"parent", parent, {}}, {"child", rest, {}}, child);
  CHECK(mapping.indices == std::vector<int>{2, 0, 1});
  mapping.apply(child, parent);
  CHECK(child[1] == parent[0]);

  SubsetMapping<Vec3d, Vec3d> near{.radius = 0.2};
  CHECK_THROWS_WITH(
      near.init({"parent", parent, {}}, {"child", rest, {}}, child = rest),
      Catch::Contains("no point within 0.2 m of 0 0.25 0") && Catch::Contains("a greater radius"));
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_WITH(check_fields(SubsetMapping<Vec3d, Vec3d>{.radius = bad}, "child"),
                      Catch::Contains("radius is"));
}

}  // namespace test_subset_mapping
