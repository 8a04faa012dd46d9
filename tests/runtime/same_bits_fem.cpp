// SPDX-License-Identifier: BSL-1.0
#include "liver/scene.hpp"
#include "one_tetrahedron/scene.hpp"
#include "same_bits.hpp"

namespace test_same_bits_fem {

TEST_CASE("one tetrahedron: typed and runtime tree have the same bits") {
  same_bits::check(examples::one_tetrahedron(), 0.01);
}

TEST_CASE("the liver: typed and runtime tree have the same bits", "[long]") {
  examples::LiverOptions options;
  options.tetrahedra = 300;
  const examples::LiverBody body = examples::make_body(options);
  same_bits::check(examples::liver_scene(body, options), 0.02);
}

}  // namespace test_same_bits_fem
