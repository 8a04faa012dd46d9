// SPDX-License-Identifier: BSL-1.0
// The surface around particles: of one it is a sphere in closed form, with order 2; it is closed and looks
// outwards, wherever particles are; a visual model has it while a scene runs.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/mapping/sph_fluid_surface_mapping.hpp>
#include <sinew/mechanics.hpp>

#include <map>
#include <numbers>
#include <random>

namespace test_particle_surface {

using namespace sinew;
using Vectors = std::vector<Eigen::Vector3d>;

namespace {

ParticleSurface surface_of(Vectors const& particles, double radius, double step, double iso = 0.5) {
  ParticleSurface surface;
  surface.find(particles, radius, step, iso, "test");
  return surface;
}
// by the divergence theorem, each quad as two triangles
double volume_of(ParticleSurface const& s) {
  double sum = 0;
  auto cone = [&](Index a, Index b, Index c) {
    sum += s.points[std::size_t(a)].dot(s.points[std::size_t(b)].cross(s.points[std::size_t(c)])) / 6;
  };
  for (auto const& [a, b, c, d] : s.quads) cone(a, b, c), cone(a, c, d);
  return sum;
}
// whether each edge is gone along as often one way as the other
bool is_closed(ParticleSurface const& s) {
  std::map<Edge, int> edges;
  for (Quad const& q : s.quads)
    for (std::size_t k = 0; k < 4; ++k) ++edges[{q[k], q[(k + 1) % 4]}];
  for (auto const& [edge, times] : edges)
    if (auto const back = edges.find({edge[1], edge[0]}); back == edges.end() || back->second != times)
      return false;
  return true;
}

}  // namespace

TEST_CASE("the surface around one particle is a sphere, to the second order of the step") {
  // (1 - r^2/h^2)^3 = iso
  const double h = 0.8;
  for (const double iso : {0.2, 0.5}) {
    const double r = h * std::sqrt(1 - std::cbrt(iso)), volume = 4. / 3 * std::numbers::pi * r * r * r;
    std::array<double, 2> errors{}, far{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double step = k == 0 ? 0.1 : 0.05;
      for (Eigen::Vector3d const& at : Vectors{{0, 0, 0}, {-3.31, 100.02, 0.377}, {0.05, 0.05, -0.02}}) {
        const auto surface = surface_of({at}, h, step, iso);
        REQUIRE(is_closed(surface));
        for (auto const& p : surface.points) far[k] = std::max(far[k], std::abs((p - at).norm() - r));
        ParticleSurface centred = surface;
        for (auto& p : centred.points) p -= at;
        errors[k] = std::max(errors[k], std::abs(volume_of(centred) / volume - 1));
      }
    }
    CHECK(far[1] < 0.05 * 0.05 / r);  // the sagitta of a cell's diagonal
    CHECK(far[0] / far[1] > 2.5);
    CHECK(errors[0] / errors[1] == Approx(4).margin(1.2));
  }
}

TEST_CASE("surfaces around many particles are closed and look outwards") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1, 1);
  for (const int n : {2, 40, 2000}) {
    Vectors particles;
    for (int i = 0; i < n; ++i) particles.push_back({place(random), place(random), 3 * place(random)});
    particles.push_back(particles[0]);  // at one place
    const auto surface = surface_of(particles, 0.4, 0.1);
    CHECK(is_closed(surface));
    CHECK(volume_of(surface) > 0);
  }
  // a lattice with a value of 1 inside: a box with its corners rounded, within the radius of the particles
  Vectors block;
  for (int i = 0; i < 1000; ++i) block.push_back(0.1 * Eigen::Vector3d(i % 10, i / 10 % 10, i / 100));
  const auto surface = surface_of(block, 0.2, 0.05);
  REQUIRE(is_closed(surface));
  CHECK(volume_of(surface) > 0.9 * 0.9 * 0.9);
  CHECK(volume_of(surface) < 1.2 * 1.2 * 1.2);
  for (auto const& p : surface.points) {
    const double outside = (p - p.cwiseMax(0).cwiseMin(0.9)).norm();
    CHECK(outside < 0.2);
    CHECK((outside > 0 || (p.array() - 0.45).abs().maxCoeff() > 0.35));
  }
  CHECK(surface_of({}, 1, 1).points.empty());
}

TEST_CASE("a visual model is the surface of particles that move, come and go, and goes with every look") {
  Simulation sim{node<"water">(
      Gravity{{0, -10, 0}},
      EulerExplicitSolver{.symplectic = true},
      MechanicalObject<Vec3d>{Vectors{{0, 0, 0}}},
      UniformMass<Vec3d>{.vertexMass = {1}},
      ParticleSource<Vec3d>{
          .center = {{5, 0, 0}}, .velocity = {0, 1, 0}, .delay = 0.1, .addNoise = false, .capacity = 100},
      node<"surface">(VisualModel{}, SPHFluidSurfaceMapping<Vec3d, Vec3f>{.step = 0.1, .radius = 0.5}))};
  sim.init();
  auto& visual = sim.at<"surface">().visual();
  auto centre = [&] {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const Mesh mesh = visual.current();
    for (auto const& p : mesh.positions) sum += p;
    return Eigen::Vector3d(sum / double(mesh.positions.size()));
  };
  sim.updateVisual();
  const Mesh first = visual.current();
  REQUIRE(first.quads.size() > 50);
  check_mesh("surface", first);
  CHECK(centre().norm() < 0.01);
  for (int i = 0; i < 5; ++i) sim.animate(0.01);
  sim.updateVisual();
  check_mesh("surface", visual.current());
  for (int i = 0; i < 30; ++i) sim.animate(0.01);
  sim.updateVisual();
  const Mesh more = visual.current();
  check_mesh("surface", more);
  CHECK(more.quads.size() > first.quads.size());
  const Eigen::Vector3d state = sim.root().state().position[0];
  double nearest = 1e9;
  for (auto const& p : more.positions) nearest = std::min(nearest, (p - state).norm());
  const double r = 0.5 * std::sqrt(1 - std::cbrt(0.5));
  CHECK(nearest == Approx(r).margin(3 * 0.1 * 0.1 / (8 * r)));  // the sagitta of a cell's diagonal
  sim.init();  // again, with the faces of the last time
  sim.updateVisual();
  check_mesh("surface", visual.current());
}

TEST_CASE("a surface of steps that are too small, or for a state, is refused") {
  auto run = [](SPHFluidSurfaceMapping<Vec3d, Vec3f> const& mapping) {
    return error_of([&] {
      Simulation sim{
          node<"water">(EulerExplicitSolver{},
                        MechanicalObject<Vec3d>{Vectors{{0, 0, 0}}},
                        UniformMass<Vec3d>{},
                        node<"surface">(VisualModel{}, SPHFluidSurfaceMapping<Vec3d, Vec3f>(mapping)))};
      sim.init();
    });
  };
  CHECK(run({.step = 0.1, .radius = 0.5}).empty());
  CHECK_THAT(run({.step = 0.01, .radius = 0.5}),
             Catch::Contains("/water/surface: SPHFluidSurfaceMapping") && Catch::Contains("50 steps") &&
                 Catch::Contains("take a longer step"));
  CHECK_THAT(run({.step = 0, .radius = 0.5}), Catch::Contains("step"));
  CHECK_THAT(run({.step = 0.1, .radius = 0.5, .isoValue = 1}), Catch::Contains("isoValue"));
  CHECK_THAT(error_of([] { surface_of({{1e300, 0, 0}}, 1, 1); }), Catch::Contains("too far away"));
  CHECK_THAT(error_of([] {
               surface_of({{std::nan(""), 0, 0}}, 1, 1);
             }),
             Catch::Contains("not a finite number"));
  Simulation state{
      node<"water">(EulerExplicitSolver{},
                    MechanicalObject<Vec3d>{Vectors{{0, 0, 0}}},
                    UniformMass<Vec3d>{},
                    node<"surface">(MechanicalObject<Vec3f>{}, SPHFluidSurfaceMapping<Vec3d, Vec3f>{}))};
  CHECK_THAT(error_of([&] { state.init(); }),
             Catch::Contains("put a visual model in the place of the state"));
}

}  // namespace test_particle_surface
