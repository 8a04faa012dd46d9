// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "liver/scene.hpp"

namespace test_liver {

using namespace sinew;

namespace {

auto small_liver(double density = 0) {
  examples::LiverOptions options;
  options.tetrahedra = 400;
  options.density = density;
  const auto body = examples::make_body(options);
  return examples::liver_scene(body, options);
}

}  // namespace

TEST_CASE("liver: hangs in equilibrium once it has settled", "[long]") {
  auto sim = small_liver();
  sim.init();
  for (int i = 0; i < 3000; ++i) sim.animate(0.02);
  auto& state = sim.at<"liver">().state();
  double fastest = 0;
  for (auto const& v : state.velocity) fastest = std::max(fastest, v.norm());
  CHECK(fastest < 1e-6);
  // all forces at rest: elastic and weight cancel at the free points, and the fixed ones carry the weight of
  // all
  const auto scope = Scope<std::decay_t<decltype(sim.root())>, NoScope>{sim.root(), NoScope{}};
  MechanicalOperations<std::decay_t<decltype(scope)>> operations(scope);
  operations.computeForce(vec_id::force, vec_id::position, vec_id::velocity);
  auto const& held = sim.at<"liver">().get<FixedConstraint<Vec3d>>().indices;
  auto const& mass = sim.at<"liver">().get<DiagonalMass<Vec3d>>().lumped;
  const double weight = 9.81 * mass.totalMass(state.size());
  Eigen::Vector3d support = Eigen::Vector3d::Zero();
  for (const int i : held) {
    support += state.force[std::size_t(i)];
    state.force[std::size_t(i)].setZero();
  }
  CHECK((support - Eigen::Vector3d(0, -weight, 0)).norm() < 1e-5 * weight);
  for (auto const& f : state.force) REQUIRE(f.norm() < 1e-5 * weight);
}

TEST_CASE("liver: the skin stays where it was when gravity is nearly nothing") {
  auto sim = small_liver(1e-9);
  sim.init();
  const Mesh before = sim.at<"liver/skin">().visual().current();
  for (int i = 0; i < 20; ++i) sim.animate(0.02);
  const Mesh after = sim.at<"liver/skin">().visual().current();
  for (std::size_t i = 0; i < before.positions.size(); ++i)
    REQUIRE((before.positions[i] - after.positions[i]).norm() < 1e-6);
}

TEST_CASE("liver: reset runs the same steps again, to the bit") {
  auto sim = small_liver();
  sim.init();
  for (int i = 0; i < 20; ++i) sim.animate(0.02);
  const auto first = sim.at<"liver">().state().position;
  sim.reset();
  CHECK(sim.time() == 0);
  for (int i = 0; i < 20; ++i) sim.animate(0.02);
  CHECK(sim.at<"liver">().state().position == first);
}

}  // namespace test_liver
