// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/mapping/identity_multi_mapping.hpp>

namespace test_identity_multi_mapping {

using namespace sinew;
using Mapping = IdentityMultiMapping<Vec3d, Vec3d>;

TEST_CASE("points of several parents follow one another in their child") {
  const Vec3d::VecCoord a{{1, 0, 0}, {2, 0, 0}}, b{{3, 0, 0}}, none;
  Mapping mapping;
  Vec3d::VecCoord child;
  mapping.init({{"a", a, {}}, {"none", none, {}}, {"b", b, {}}}, {"child", child, {}}, child);
  REQUIRE(child.size() == 3);
  for (std::size_t p = 0; p < 3; ++p) mapping.parts[p].apply(child, p == 0 ? a : p == 1 ? none : b);
  for (std::size_t i = 0; i < 3; ++i) CHECK(child[i][0] == double(i + 1));
  Vec3d::VecDeriv f{{0, 1, 0}, {0, 2, 0}, {0, 3, 0}}, onA(2, Eigen::Vector3d::Zero()),
      onB(1, Eigen::Vector3d::Zero());
  mapping.parts[0].applyJT(onA, f);
  mapping.parts[2].applyJT(onB, f);
  CHECK(onA[1][1] == 2);
  CHECK(onB[0][1] == 3);
  // with a point of a parent goes that of the child
  CHECK(mapping.parts[0].pointsThatStay(Renumbering::of({false, true})) ==
        std::vector<bool>{false, true, true});
  CHECK(mapping.parts[2].pointsThatStay(Renumbering::of({false})) == std::vector<bool>{true, true, false});
  child.resize(2);
  const std::string said = error_of([&] {
    mapping.init({{"a", a, {}}, {"b", b, {}}}, {"child", child, {}}, child);
  });
  CHECK(said.find("child: IdentityMultiMapping<Vec3d, Vec3d") == 0);
  CHECK(said.find("the child has 2 points, and its parents together 3; give the child as many, or none") !=
        std::string::npos);
}

}  // namespace test_identity_multi_mapping
