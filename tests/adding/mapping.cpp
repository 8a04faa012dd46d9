// SPDX-License-Identifier: BSL-1.0
#include "laws/mapping_laws.hpp"

namespace test_mapping {

using namespace sinew;

TEST_CASE("the law suite proves the mapping that CONTRIBUTING.md adds") {
  laws::check_mappings<Registry<ScaleMapping<Vec3d, Vec3d>, ScaleMapping<Vec3d, Vec3f>>, false>();
}

}  // namespace test_mapping
