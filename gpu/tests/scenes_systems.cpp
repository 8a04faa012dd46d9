// SPDX-License-Identifier: BSL-1.0
#include "scenes_systems.hpp"

#include "same_as_host.hpp"

#include <sinew/gpu/recorded_step.hpp>

namespace test_scenes_systems {

using namespace gpu_test;

TEST_CASE("conjugate gradients with diagonal blocks are those of the host, iteration by iteration") {
  same_as_host<BlockJacobiBar, Vec3d>(1e-10);
}
TEST_CASE("conjugate gradients with a diagonal are those of the host, iteration by iteration") {
  same_as_host<JacobiBar, Vec3d>(1e-10);
}
TEST_CASE("conjugate gradients without a preconditioner are those of the host") {
  same_as_host<PlainBar, Vec3d>(1e-10);
}
TEST_CASE("conjugate gradients with blocks of rigid bodies are those of the host") {
  same_as_host<RigidsOnSprings, Rigid3d>(1e-10);
}
TEST_CASE("an assembled system with diagonal blocks is that of the host, iteration by iteration") {
  same_as_host<AssembledBar, Vec3d>(1e-10);
}
TEST_CASE("two assembled bodies under one solver are those of the host") {
  same_as_host<TwoAssembled<false>, Vec3d>(1e-10);
}
TEST_CASE("an assembled system of masses alone is that of the host") {
  same_as_host<LoosePoints, Vec3d>(1e-12);
}
TEST_CASE("a matrix with a mapped body is assembled by the host") {
  same_as_host<TwoAssembled<true>, Vec3d>(1e-10);
}
TEST_CASE("a recorded step over an assembled matrix is the step") {
  using Scene = TwoAssembled<false>;
  auto stepped = Scene::make<CudaVec3d>(), recorded = Scene::make<CudaVec3d>();
  stepped.init();
  recorded.init();
  gpu::RecordedStep record(recorded, Scene::dt);  // makes the first
  record.animate(Scene::steps - 1);
  record.finish();
  for (int i = 0; i < Scene::steps; ++i) stepped.animate(Scene::dt);
  // each solves the system to rounding, in its own order of sums
  const std::vector<double> a = places<Scene>(recorded), b = places<Scene>(stepped);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == Approx(b[i]).margin(1e-10));
}
TEST_CASE("another preconditioner is another motion while few iterations are made") {
  const Course blocks = run<BlockJacobiBar, CudaVec3d>([] {}), none = run<PlainBar, CudaVec3d>([] {}),
               exact = run<Preconditioned<PreconditionerMethod::blockJacobi, true, 400>, CudaVec3d>([] {});
  auto off = [&](Course const& c) {
    double largest = 0;
    for (std::size_t i = 0; i < exact.position.size(); ++i)
      largest = std::max(largest, std::abs(c.position[i] - exact.position[i]));
    return largest;
  };
  INFO("off by " << off(blocks) << " with blocks, " << off(none) << " without");
  CHECK(off(blocks) < 0.5 * off(none));
}

}  // namespace test_scenes_systems
