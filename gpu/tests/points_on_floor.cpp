// SPDX-License-Identifier: BSL-1.0
// Scenes whose contacts are found on the device, with the violations of their rows, against the host.
#include "scenes_found.hpp"

#include "error_of.hpp"
#include "host_scenes.hpp"
#include "same_as_host.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace test_points_on_floor {

using namespace gpu_test;

namespace {

template <class Sim>
auto& manager_of(Sim& sim) {
  return sim.root().template first<role::ContactManager>();
}
template <class Sim>
std::vector<double> const& violations_of(Sim& sim) {
  return sim.root().template first<role::AnimationLoop>().motion.rows.violation;
}
template <class Sim>
bool found_on_device(Sim& sim) {
  auto const& contacts = manager_of(sim).contacts;
  for (Contact const& c : contacts)
    if (c.place < 0) return false;
  return !contacts.empty();
}
template <class Sim>
std::string warned(Sim& sim) {
  std::string all;
  for (StepWarning const& w : sim.warnings().list()) all += w.message + "\n";
  return all;
}

// two scenes step by step: the same contacts with the same forces
template <class A, class B>
void go_together(A& device, B& host, int steps, double near) {
  for (int step = 0; step < steps; ++step) {
    device.animate(0.01);
    host.animate(0.01);
    auto const &found = manager_of(device).contacts, &expected = manager_of(host).contacts;
    CAPTURE(step);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(found[i].key() == expected[i].key());
      CHECK(found[i].rows == expected[i].rows);
      CHECK(found[i].isNew == expected[i].isNew);
      CHECK((found[i].normal - expected[i].normal).norm() < near);
      CHECK(std::abs(found[i].distance - expected[i].distance) < near);
      CHECK((found[i].force - expected[i].force).norm() < 1e5 * near);
    }
  }
}

}  // namespace

TEST_CASE("a block on the device slides over triangles that the device finds, as on the host") {
  same_as_host<PointsOnFloor, Vec3d>(1e-8);
}
TEST_CASE("a block on the device slides over triangles in float as on the host") {
  same_as_host<PointsOnFloor, Vec3f>(1e-4);
}
TEST_CASE("a block on the device slides over triangles by rates as on the host") {
  same_as_host<RatesOnFloor, Vec3d>(1e-8);
}
TEST_CASE("spheres of a block on the device lie on triangles without friction as on the host") {
  same_as_host<SpheresOnFloor, Vec3d>(1e-8);
}
TEST_CASE("points that are held on the device touch triangles as on the host") {
  same_as_host<HeldOnFloor, Vec3d>(1e-8);
}

TEST_CASE("contacts that the device finds are those of the host, and so are their forces") {
  auto device = PointsOnFloor::make<CudaVec3d>();
  auto host = PointsOnFloor::make<Vec3d>();
  device.init();
  host.init();
  go_together(device, host, 30, 1e-9);
  CHECK(found_on_device(device));
  CHECK(warned(device).empty());
  CHECK(device.forces().size() == host.forces().size());
}

TEST_CASE("a floor that is moved from outside is seen by the device where it is") {
  auto device = PointsOnFloor::make<CudaVec3d>();
  auto host = PointsOnFloor::make<Vec3d>();
  device.init();
  host.init();
  for (int step = 0; step < 15; ++step) {
    auto move = [&](auto& sim) {
      auto& floor = sim.template at<"floor">().state();
      for (std::size_t i = 0; i < floor.position.size(); ++i) {
        floor.velocity[i] = {0.02, 0.01, step < 8 ? 0.05 : -0.01};
        floor.position[i] += 0.01 * floor.velocity[i];
      }
    };
    move(device);
    move(host);
    go_together(device, host, 1, 1e-9);
  }
  CHECK(found_on_device(device));
}

TEST_CASE("more contacts on the device than there was room for are all found") {
  const BlockOnFloor scene{.capacity = 3};
  auto device = scene.make<CudaVec3d>(PointCollisionModel<CudaVec3d>{});
  auto host = scene.make<Vec3d>(PointCollisionModel<Vec3d>{});
  device.init();
  host.init();
  go_together(device, host, 10, 1e-9);
  CHECK(found_on_device(device));
  CHECK(manager_of(device).grown > 0);
}

TEST_CASE("with a model that the device cannot meet all contacts are the host's, which is said") {
  const BlockOnFloor scene{.cells = 4};  // of 3 cells more contacts touch than there are forces to find
  auto device = scene.make<CudaVec3d>(TriangleCollisionModel<CudaVec3d>{}, PointCollisionModel<CudaVec3d>{});
  auto host = scene.make<Vec3d>(TriangleCollisionModel<Vec3d>{}, PointCollisionModel<Vec3d>{});
  device.init();
  host.init();
  go_together(device, host, 10, 1e-9);
  CHECK_FALSE(found_on_device(device));
  CHECK(warned(device).find("contacts of bodies on a device are found on the host") != std::string::npos);
}

TEST_CASE("what is held from outside makes contacts the host's, until it is released") {
  auto device = PointsOnFloor::make<CudaVec3d>();
  auto host = PointsOnFloor::make<Vec3d>();
  auto attach = [](auto& sim) {
    const auto place = sim.pick({1.0 / 3, 1.0 / 3, 2}, {0, 0, -1}, 10, 1e-3);
    REQUIRE(place);
    return sim.attach(*place, {.stiffness = 1e3});
  };
  device.init();
  host.init();
  go_together(device, host, 3, 1e-9);
  const int a = attach(device), b = attach(host);
  go_together(device, host, 3, 1e-9);
  CHECK_FALSE(found_on_device(device));
  device.release(a);
  host.release(b);
  go_together(device, host, 4, 1e-9);
  CHECK(found_on_device(device));
}

TEST_CASE("contacts of the device are found again after a reset with the first bits") {
  auto sim = PointsOnFloor::make<CudaVec3d>();
  sim.init();
  auto course = [&] {
    for (int i = 0; i < 6; ++i) sim.animate(0.01);
    return places<PointsOnFloor>(sim);
  };
  const auto first = course();
  sim.animate(0.01);
  sim.reset();
  CHECK(course() == first);
}

TEST_CASE("contacts of the device go on in a copy") {
  auto sim = PointsOnFloor::make<CudaVec3d>();
  sim.init();
  for (int i = 0; i < 6; ++i) sim.animate(0.01);
  auto copy = sim;
  sim.animate(0.01);
  copy.animate(0.01);
  CHECK(places<PointsOnFloor>(copy) == places<PointsOnFloor>(sim));
}

TEST_CASE("a velocity on the device that is not finite stops contacts that were found there by an error") {
  auto sim = PointsOnFloor::make<CudaVec3d>();
  sim.init();
  for (int i = 0; i < 4; ++i) sim.animate(0.01);
  REQUIRE(found_on_device(sim));
  const int touching = manager_of(sim).contacts.front().b.vertices[0];
  sim.at<"body">().state().velocity[std::size_t(touching)][2] = std::numeric_limits<double>::quiet_NaN();
  const std::string said = error_of([&] { sim.animate(0.01); });
  CHECK(said.find("the contact of /root/floor and /root/body") != std::string::npos);
}

}  // namespace test_points_on_floor
