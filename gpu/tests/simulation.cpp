// SPDX-License-Identifier: BSL-1.0
// What else a Simulation does, with a body on the device.
#include "catch.hpp"
#include "scenes_bar.hpp"

#include <sinew/gpu/gpu.hpp>
#include <sinew/gpu/recorded_step.hpp>

namespace test_simulation {

using namespace gpu_test;

namespace {

auto bar() {
  auto sim = Bar::make<CudaVec3d>();
  sim.init();
  return sim;
}
template <class Sim>
void steps(Sim& sim, int n) {
  for (int i = 0; i < n; ++i) sim.animate(Bar::dt);
}

}  // namespace

TEST_CASE("copies of a simulation on the device are independent, and go the same way") {
  auto sim = bar();
  steps(sim, 5);
  auto copy = sim;
  const std::vector<double> there = places<Bar>(copy);
  CHECK(places<Bar>(sim) == there);
  steps(sim, 5);
  CHECK(places<Bar>(copy) == there);
  CHECK(places<Bar>(sim) != there);
  steps(copy, 5);
  CHECK(places<Bar>(copy) == places<Bar>(sim));
}

TEST_CASE("a simulation on the device goes back to its start, and the same way again") {
  auto sim = bar();
  const std::vector<double> start = places<Bar>(sim);
  steps(sim, 5);
  const std::vector<double> there = places<Bar>(sim);
  sim.reset();
  CHECK(places<Bar>(sim) == start);
  steps(sim, 5);
  CHECK(places<Bar>(sim) == there);
}

TEST_CASE("what the host writes between steps is where the device goes on from") {
  auto sim = bar(), other = bar();
  steps(sim, 3);
  steps(other, 3);
  for (auto& v : sim.at<"body">().state().velocity) v = {0, 0, 1};
  steps(sim, 1);
  steps(other, 1);
  auto const &a = sim.at<"body">().state().position, &b = other.at<"body">().state().position;
  CHECK((a.back() - b.back())[2] > 0.5 * Bar::dt);
}

TEST_CASE("a recorded step is the step, to the bit") {
  auto stepped = bar(), recorded = bar();
  gpu::RecordedStep record(recorded, Bar::dt);
  record.animate(9);
  record.animate();
  record.finish();
  steps(stepped, 11);
  CHECK(places<Bar>(recorded) == places<Bar>(stepped));
  CHECK(recorded.step() == stepped.step());
  CHECK(recorded.time() == Approx(stepped.time()));
}

TEST_CASE("elements that are removed on the device are gone") {
  auto sim = bar();
  steps(sim, 2);
  auto const& body = sim.at<"body">();
  const std::size_t points = body.state().size();
  ElementNumbers some;
  for (int e = 0; e < 30; ++e) some.tetrahedra.push_back(70 + e);
  sim.removeElements("body", some);
  steps(sim, 20);
  CHECK(sim.at<"body">().state().size() <= points);
  CHECK(std::isfinite(sim.potentialEnergy()));
}

}  // namespace test_simulation
