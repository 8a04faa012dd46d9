// SPDX-License-Identifier: BSL-1.0
// Contacts by multipliers of bodies on the device.
#include "scenes_contact.hpp"

#include "error_of.hpp"
#include "same_as_host.hpp"

#include <sinew/gpu/recorded_step.hpp>

#include <limits>
#include <type_traits>

namespace test_scenes_contact {

using namespace gpu_test;

namespace {

constexpr double dt = 0.01, g = BlockOnPlane::g, mass = BlockOnPlane::mass;

template <class Sim>
auto const& result_of(Sim& sim) {
  return sim.root().template first<role::ConstraintSolver>().result;
}
// of all contacts of the last step
template <class Sim>
Eigen::Vector3d force_of(Sim& sim) {
  auto const& f = sim.root().template first<role::LagrangianConstraint>().multipliers;
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t i = 0; i < f.size(); ++i) sum[Eigen::Index(i % 3)] += f[i];
  return sum;
}
template <class Sim>
Eigen::Vector3d mean_velocity(Sim& sim) {
  Eigen::Vector3d sum(0, 0, 0);
  auto const& v = std::as_const(sim.template at<"body">().state().velocity);
  for (std::size_t i = 0; i < v.size(); ++i) sum += v[i];
  return sum / double(v.size());
}

}  // namespace

TEST_CASE("a block slides on a plane on the device as on the host") {
  // Each of 30 steps is solved to 1e-12 m by both, in another order of sums; as a velocity that goes on to
  // the end, which makes 30^2 / 2 of them, 5e-10 m, where all have one sign.
  same_as_host<SlidingBlock, Vec3d>(1e-8);
}
TEST_CASE("a block slides on a plane on the device in float as on the host") {
  same_as_host<SlidingBlock, Vec3f>(1e-4);
}
TEST_CASE("contacts of a block that is held on the device stick, slide and open as on the host") {
  same_as_host<HeldBlock, Vec3d>(1e-8);
}
TEST_CASE("blocks on the device slide on each other as on the host") {
  same_as_host<StackedBlocks, Vec3d>(1e-8);
}
TEST_CASE("the motion with contacts of bodies on the device is found there") {
  auto on_device = [](auto sim) {
    sim.init();
    for (int i = 0; i < 3; ++i) sim.animate(dt);
    auto const& solver = sim.root().template first<role::ConstraintSolver>();
    CHECK(solver.result.conjugateGradients > 0);
    return solver.preconditioner.system.empty();  // the matrix of the host
  };
  CHECK(on_device(SlidingBlock::make<CudaVec3f>()));
  CHECK(on_device(HeldBlock::make<CudaVec3d>()));
  CHECK(on_device(StackedBlocks::make<CudaVec3d>()));
}

TEST_CASE("what a linear solver on the device leaves of the free motion is solved with the contacts") {
  auto at_end = []<class Linear>(double tolerance, std::type_identity<Linear>) {
    auto sim = BlockOnPlane{.slope = 0.3, .linearTolerance = tolerance}.make<CudaVec3d, Linear>();
    sim.init();
    for (int i = 0; i < 20; ++i) sim.animate(dt);
    return places<SlidingBlock>(sim);
  };
  auto far = [](auto const& a, auto const& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
  };
  constexpr std::type_identity<CGLinearSolver<>> scattered;
  constexpr std::type_identity<CGLinearSolver<CompressedRowSparseMatrixMat3x3d>> assembled;
  const auto exact = at_end(1e-12, scattered);
  CHECK(far(at_end(1e-2, scattered), exact) < 1e-8);
  CHECK(far(at_end(1e-2, assembled), exact) < 1e-8);
}

TEST_CASE("a copy of a scene with contacts on the device goes on with the same bits") {
  auto sim = SlidingBlock::make<CudaVec3d>();
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(dt);
  auto copy = sim;
  for (int i = 0; i < 3; ++i) sim.animate(dt), copy.animate(dt);
  CHECK(places<SlidingBlock>(copy) == places<SlidingBlock>(sim));
}

TEST_CASE("multipliers on the device sum to the weight of a block at rest") {
  const BlockOnPlane block{.cells = 2, .slope = 0.1, .mu = 0.3};
  auto sim = block.make<CudaVec3d>();
  sim.init();
  for (int i = 0; i < 300; ++i) sim.animate(dt);
  REQUIRE(result_of(sim).converged);
  const Eigen::Vector3d f = force_of(sim);
  const double normal = mass * g * std::cos(block.slope), along = mass * g * std::sin(block.slope);
  CAPTURE(f.transpose(), mean_velocity(sim).transpose());
  CHECK(f[0] == Approx(normal).epsilon(1e-5));
  CHECK(f.tail<2>().norm() == Approx(along).epsilon(1e-5));
}

TEST_CASE("a block on an incline on the device sticks and slides at the angle of friction") {
  const double mu = 0.2, angle = std::atan(mu);
  for (const double slope : {0.99 * angle, 1.2 * angle, 2 * angle}) {
    auto sim = BlockOnPlane{.cells = 2, .slope = slope, .mu = mu}.make<CudaVec3d>();
    sim.init();
    int unsolved = 0;
    auto velocity_at = [&](double time) {
      while (sim.time() < time - dt / 2) {
        sim.animate(dt);
        unsolved += !result_of(sim).converged;
      }
      return mean_velocity(sim)[0];
    };
    // when the oscillations of the start have gone, and all of it slides still
    const double before = velocity_at(1.5), after = velocity_at(2);
    const double acceleration = g * (std::sin(slope) - mu * std::cos(slope));
    CAPTURE(slope / angle, before, after, acceleration);
    CHECK(before > 0.01);
    CHECK(std::abs((after - before) / 0.5 - acceleration) < 1e-5);
    if (slope < angle) CHECK(std::abs(velocity_at(3.5)) < 1e-6);
    CHECK(unsolved == 0);
  }
}

TEST_CASE("a step with constraints on the device that is not solved says which constraint that is of") {
  auto sim = SlidingBlock::make<CudaVec3d>();
  auto& solver = sim.root().first<role::ConstraintSolver>();
  solver.maxUpdates = 1;
  solver.stopsUnsolved = true;
  sim.init();
  const std::string said = error_of([&] { sim.animate(dt); });
  CHECK(said.find("ConvexConstraintSolver: the constraints are not solved after ") != std::string::npos);
  CHECK(said.find("UnilateralLagrangianConstraint<CudaVec3d") != std::string::npos);
}

TEST_CASE("a body on the device that is not finite stops a step with constraints by an error") {
  auto sim = SlidingBlock::make<CudaVec3d>();
  sim.init();
  sim.animate(dt);
  sim.at<"body">().state().velocity[0][2] = std::numeric_limits<double>::quiet_NaN();
  const std::string said = error_of([&] { sim.animate(dt); });
  CHECK(said.find("UnilateralLagrangianConstraint<CudaVec3d") != std::string::npos);
  CHECK(said.find("is not finite after the motion without multipliers") != std::string::npos);
}

TEST_CASE("a step with constraints by multipliers is not recorded") {
  auto sim = SlidingBlock::make<CudaVec3d>();
  sim.init();
  CHECK(error_of([&] { gpu::RecordedStep recorded(sim, dt); }) ==
        "/root: FreeMotionAnimationLoop solves constraints in every step, with rows from the host, which a "
        "recorded step cannot; animate() the simulation");
  CHECK(sim.step() == 0);
  sim.animate(dt);
}

#if !SINEW_CUDA
TEST_CASE("several threads solve a step with constraints together, each time the same bits") {
  auto run = [](int threads) {
    gpu::host_team_threads() = threads;
    auto sim = HeldBlock::make<CudaVec3d>();
    sim.init();
    for (int i = 0; i < 5; ++i) sim.animate(dt);
    gpu::host_team_threads() = 1;
    return places<HeldBlock>(sim);
  };
  const auto one = run(1), three = run(3);
  CHECK(run(3) == three);
  double difference = 0;
  for (std::size_t i = 0; i < one.size(); ++i) difference = std::max(difference, std::abs(one[i] - three[i]));
  CHECK(difference < 1e-9);
}
#endif

}  // namespace test_scenes_contact
