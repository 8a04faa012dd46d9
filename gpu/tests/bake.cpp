// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/gpu/gpu.hpp>

#include <sinew/runtime/bake.hpp>

namespace test_bake {

using namespace sinew;

namespace {

struct Few : Registry<Gravity, EulerExplicitSolver, MechanicalObject<CudaVec3f>, UniformMass<CudaVec3f>> {};

}  // namespace

TEST_CASE("a scene on a device is baked with its header") {
  const std::string scene = R"(<Node><EulerExplicitSolver/>
    <MechanicalObject template="CudaVec3f" position="1 2 3  4 5 6.5"/><UniformMass/></Node>)";
  const std::string cpp = bake_text(parse_scene<Few>("two.scn", scene), "two.scn");
  CHECK_THAT(cpp, Catch::Contains("#include <sinew/gpu/gpu.hpp>\n\n#include <sinew/sinew.hpp>"));
  CHECK_THAT(cpp, Catch::Contains("MechanicalObject<CudaVec3f>"));
  CHECK_THAT(cpp, Catch::Contains("6.5"));
}

}  // namespace test_bake
