// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/mapping/subset_mapping.hpp>

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
                    Catch::Contains("no point within 1e-5 m of 5 6 7"));
}

}  // namespace test_subset_mapping
