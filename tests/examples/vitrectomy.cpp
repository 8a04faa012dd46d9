// SPDX-License-Identifier: BSL-1.0
#include "vitrectomy/scene.hpp"

#include "catch.hpp"

#include <sinew/mass/uniform_mass.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>

#include <Eigen/Eigenvalues>

#include <cstring>

namespace test_vitrectomy {

using namespace sinew;
using examples::Eye;

namespace {

constexpr double dt = 0.005;

Eye small_eye() { return examples::make_eye({.sectors = 24}); }

template <class Sim>
auto& springs_of(Sim& sim) {
  return sim.template at<"eye">().template get<examples::CuttableSpringForceField<Vec3d>>();
}
template <class Sim>
auto& points_of(Sim& sim) {
  return sim.template at<"eye">().state().position;
}
template <class Sim>
examples::RetinaState examined(Eye const& eye, Sim& sim) {
  return examples::examine(eye, points_of(sim), springs_of(sim).springs);
}

/// Distance of a point from the nearest line of the blade.
template <class Sim>
double distance_from_blade(Eye const& eye, Sim& sim, Eigen::Vector3d const& p) {
  auto const& blade = sim.template at<"tool/blade">().state().position;
  double nearest = 1;
  for (auto const& [i, j] : eye.blade.edges) {
    const Eigen::Vector3d a = blade[std::size_t(i)], d = blade[std::size_t(j)] - a;
    const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (a + t * d - p).norm());
  }
  return nearest;
}

}  // namespace

TEST_CASE("vitrectomy: as the cut closes the circle, the retina comes back to its natural shape") {
  const Eye eye = small_eye();
  auto sim = examples::vitrectomy_scene(eye);
  sim.init();
  // made without a strain, but for the scar
  CHECK(examined(eye, sim).energy < 1e-30);
  auto until = [&](double time) {
    while (sim.time() < time - dt / 2) sim.animate(dt);
    return examined(eye, sim);
  };
  const auto before = until(eye.times[1]);
  CHECK(before.rms > 50e-6);  // of a radius of 12 mm
  CHECK(before.maximum > 100e-6);
  CHECK(before.tension > 0.03);
  CHECK(before.traction > 0.05);
  CHECK(springs_of(sim).springs.size() == 144);

  // traction and energy go as the cut does
  double energy = before.energy, traction = before.traction;
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    const auto now = until(eye.cutBegins + part * (eye.cutEnds - eye.cutBegins));
    CHECK(now.energy < energy);
    CHECK(now.traction < traction);
    energy = now.energy, traction = now.traction;
  }
  CHECK(springs_of(sim).springs.empty());

  // the distance u from the natural shape follows from the forces f that are left: f = -K u + O(u^2), so that
  // |u| <= |f| / (least eigenvalue of K) over the free points of the retina
  until(eye.cutEnds + 1);
  auto const& x = points_of(sim);
  auto& retina = sim.at<"eye">().get<StiffSpringForceField<Vec3d>>();
  const std::size_t n = x.size();
  const Vec3d::VecDeriv zero(n, Eigen::Vector3d::Zero());
  auto free = [&](std::size_t i) {
    return i >= std::size_t(eye.sectors) && i < std::size_t(eye.retinaPoints - eye.sectors);
  };
  Vec3d::VecDeriv f = zero;
  add_force(retina, {}, f, eye.position, zero);  // the tangent there
  const auto m = Eigen::Index(eye.retinaPoints - 2 * eye.sectors);
  Eigen::MatrixXd stiffness(3 * m, 3 * m);
  for (Eigen::Index c = 0; c < 3 * m; ++c) {
    Vec3d::VecDeriv dx = zero, df = zero;
    dx[std::size_t(eye.sectors + c / 3)][c % 3] = 1;
    add_dforce(retina, {.k = -1}, df, dx);
    for (Eigen::Index i = 0; i < m; ++i) stiffness.block<3, 1>(3 * i, c) = df[std::size_t(eye.sectors + i)];
  }
  const double softest =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues()[0];
  REQUIRE(softest > 0.01);  // [N/m]
  f = zero;
  add_force(retina, {}, f, x, zero);
  double force = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (free(i)) force += f[i].squaredNorm();
  force = std::sqrt(force);
  const auto after = examined(eye, sim);
  // what is left out, and rounding of forces, are next to nothing beside 1e-12 m
  const double bound = force / softest / std::sqrt(double(eye.retinaPoints)) + 1e-12;
  INFO("forces of " << force << " N are left, softest mode " << softest << " N/m, rms at most " << bound
                    << " m");
  CHECK(after.rms <= bound);
  CHECK(bound < 1e-3 * before.rms);
  CHECK(after.tension < 1e-3 * before.tension);
  CHECK(after.traction == 0);
}

TEST_CASE("vitrectomy: a spring goes when the blade touches one of its ends, and no other") {
  const Eye eye = small_eye();
  auto sim = examples::vitrectomy_scene(eye);
  sim.init();
  const double reach = eye.sphereRadius + eye.contactDistance;
  std::size_t cut = 0;
  while (sim.time() < eye.times.back()) {
    const auto springs = springs_of(sim).springs;
    const auto x = points_of(sim);
    sim.animate(dt);  // the tool goes to its place at the end of the step, then contacts are looked for
    auto touched = [&](Spring const& s) {
      return std::min(distance_from_blade(eye, sim, x[std::size_t(s.first)]),
                      distance_from_blade(eye, sim, x[std::size_t(s.second)])) < reach;
    };
    std::vector<Spring> left;
    for (Spring const& s : springs)
      if (!touched(s)) left.push_back(s);
    auto const& now = springs_of(sim).springs;
    REQUIRE(now.size() == left.size());
    for (std::size_t s = 0; s < now.size(); ++s)
      REQUIRE((now[s].first == left[s].first && now[s].second == left[s].second));
    REQUIRE(springs_of(sim).uncut.driver.size() == now.size());
    cut += springs.size() - now.size();
  }
  CHECK(cut == eye.cuttable.size());
}

TEST_CASE("vitrectomy: the scar is free in the end and as small as it wants to be") {
  const Eye eye = small_eye();
  auto sim = examples::vitrectomy_scene(eye);
  sim.init();
  while (sim.time() < 12) sim.animate(dt);
  // shrunk by 4 % around the axis; no spring in it is strained by more than a thousandth of that
  for (Spring const& s : eye.springs)
    REQUIRE((points_of(sim)[std::size_t(s.first)] - points_of(sim)[std::size_t(s.second)]).norm() ==
            Approx(*s.length).epsilon(4e-5));
}

TEST_CASE("vitrectomy: a reset brings back the springs that were cut, and the run its bits") {
  const Eye eye = small_eye();
  auto sim = examples::vitrectomy_scene(eye), fresh = sim;
  sim.init(), fresh.init();
  for (int i = 0; i < 400; ++i) sim.animate(dt);
  CHECK(springs_of(sim).springs.size() < 144);
  sim.reset();
  CHECK(springs_of(sim).springs.size() == 144);
  CHECK(examined(eye, sim).energy < 1e-30);
  // past the first cut
  for (int i = 0; i < 330; ++i) sim.animate(dt), fresh.animate(dt);
  CHECK(springs_of(fresh).springs.size() < 144);
  CHECK(springs_of(sim).springs.size() == springs_of(fresh).springs.size());
  CHECK(std::memcmp(points_of(sim).data(),
                    points_of(fresh).data(),
                    points_of(sim).size() * sizeof(Eigen::Vector3d)) == 0);
}

TEST_CASE("springs that are cut under an assembled solver have their places in its matrix after a reset") {
  std::vector<Spring> springs;
  for (int i = 0; i < 20; ++i) springs.push_back({i, i + 1, 40. + i, 0.1, 0.1});
  for (int i = 0; i < 19; ++i) springs.push_back({i, i + 2, 20, 0, 0.2});
  Vec3d::VecCoord x;
  for (int i = 0; i <= 20; ++i) x.push_back({0.1 * i, 0, 0.02 * (i % 3)});
  Simulation fresh{node<"root">(Gravity{{0, 0, -9.81}},
                                EulerImplicitSolver{},
                                SparseLDLSolver<>{},
                                MechanicalObject<Vec3d>{.position = x},
                                UniformMass<Vec3d>{.vertexMass = 0.01},
                                FixedConstraint<Vec3d>{.indices = {0, 20}},
                                examples::CuttableSpringForceField<Vec3d>{.springs = springs})};
  auto sim = fresh;
  sim.init(), fresh.init();
  auto& cuttable = sim.root().get<examples::CuttableSpringForceField<Vec3d>>();
  for (auto const& points : {std::vector{3, 8}, {1, 2, 5, 6, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18}}) {
    for (int i = 0; i < 10; ++i) sim.animate(dt);
    cuttable.cut(points);
    CHECK(cuttable.springs.size() < springs.size());
    for (int i = 0; i < 10; ++i) sim.animate(dt);
    sim.reset();
  }
  for (int i = 0; i < 20; ++i) sim.animate(dt), fresh.animate(dt);
  auto const& expected = fresh.root().state().position;
  CHECK(std::memcmp(sim.root().state().position.data(), expected.data(), expected.size() * sizeof(x[0])) ==
        0);
}

TEST_CASE("vitrectomy: two runs have the same bits, one of them beside another scene") {
  const Eye eye = small_eye();
  auto a = examples::vitrectomy_scene(eye);
  a.init();
  auto other = examples::vitrectomy_scene(examples::make_eye({.sectors = 30}));
  other.init();
  for (int i = 0; i < 400; ++i) a.animate(dt);
  auto b = examples::vitrectomy_scene(eye);
  b.init();
  for (int i = 0; i < 400; ++i) b.animate(dt), i % 10 == 0 ? other.animate(dt) : void();
  CHECK(springs_of(a).springs.size() < 144);
  CHECK(springs_of(a).springs.size() == springs_of(b).springs.size());
  CHECK(std::memcmp(
            points_of(a).data(), points_of(b).data(), points_of(a).size() * sizeof(Eigen::Vector3d)) == 0);
}

TEST_CASE("vitrectomy: a blade is asked for by name, and the eye by a number of sectors that it can have") {
  CHECK_THROWS_WITH(examples::make_eye({.sectors = 25}), Catch::Contains("give a multiple of 3"));
  auto sim = examples::vitrectomy_scene(small_eye());
  sim.at<"tool/blade">().get<LineCollisionModel<Vec3d>>().contactResponse = "SpringRemoval";
  CHECK_THROWS_WITH(sim.init(), Catch::Contains("SpringRemovalContact"));
}

}  // namespace test_vitrectomy
