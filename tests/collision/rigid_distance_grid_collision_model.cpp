// SPDX-License-Identifier: BSL-1.0
// Contacts with grids of distances: where they are, what rests and slides on them, and what
// is refused.
#include <sinew/collision/rigid_distance_grid_collision_model.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/solver/euler_explicit.hpp>

#include "collision/contact_scene.hpp"
#include "one_component.hpp"

namespace test_rigid_distance_grid_collision_model {

using namespace sinew;
using V = Eigen::Vector3d;
using Grid = RigidDistanceGridCollisionModel<Rigid3d>;

namespace {

const V center(0.3, -0.2, 0.5);
const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.6, V(1, -1, 2).normalized()));

Rigid3d::Coord rigid_at(V const& x, Eigen::Quaterniond const& q = Eigen::Quaterniond::Identity()) {
  Rigid3d::Coord c;
  c.center = x, c.orientation = q;
  return c;
}
Grid grid_of(std::string const& shape, double scale, int n = 41) {
  Grid model{.filename = {shape}, .scale = scale};
  model.nx = model.ny = model.nz = n;
  return model;
}
auto held(Grid model, Rigid3d::Coord const& at = rigid_at(center, turn)) {
  model.moving = model.simulated = false;
  return node<"held">(MechanicalObject<Rigid3d>{.position = {at}}, model);
}
/// The contacts of a model over points x with a grid at `center`, turned.
template <class Model>
std::vector<Contact> contacts_of(Grid grid, std::vector<V> const& x, TopologyView const& topology,
                                 Model model, double alarm = 0.5) {
  grid = one::ready(grid, {rigid_at(center, turn)});
  model = one::ready(model, x, topology);
  update_vertices<Rigid3d>(
      grid.surface, Rigid3d::VecCoord{rigid_at(center, turn)}, Rigid3d::VecDeriv(1, Rigid3d::Deriv::Zero()));
  update_vertices<Vec3d>(model.surface, x, Vec3d::VecDeriv(x.size(), V::Zero()));
  for (CollisionSurface* s : {&grid.surface, &model.surface}) s->enclose(alarm, 0);
  GridSearch search;
  std::vector<Contact> found, mirrored;
  find_in_grid(grid.surface, model.surface, 0.01, alarm, true, search, found);
  find_in_grid(grid.surface, model.surface, 0.01, alarm, false, search, mirrored);
  REQUIRE(found.size() == mirrored.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    Contact const &c = found[i], &m = mirrored[i];
    CHECK((c.normal + m.normal).norm() + (c.start + m.start).norm() + std::abs(c.distance - m.distance) == 0);
    CHECK(c.a.vertices == m.b.vertices);
    // the places are apart along the normal: forces between them have no torque
    const V apart = position_of(c.b, model.surface) - position_of(c.a, grid.surface);
    CHECK((apart - c.start).norm() < 1e-13);
    CHECK(apart.cross(c.normal).norm() < 1e-13);
    CHECK(c.normal.dot(apart) - c.thickness == Approx(c.distance).margin(1e-13));
    CHECK(c.limit == 0.01);
  }
  return found;
}

V position_of_b(Contact const& c, std::vector<V> const& x) {
  V p(0, 0, 0);
  for (std::size_t k = 0; k < 3 && c.b.vertices[k] >= 0; ++k)
    p += c.b.weights[k] * x[std::size_t(c.b.vertices[k])];
  return p;
}

constexpr double g = 10, dt = 0.005, skin = 0.01, slope = 0.3;

/// A cube whose upper side is z = 0, with gravity as on a slope down along x.
template <class Body>
auto on_slope(double angle, double mu, Body body) {
  return Simulation{
      node<"root">(FreeMotionAnimationLoop{},
                   BlockGaussSeidelConstraintSolver{.maxIterations = 20000, .tolerance = 1e-12},
                   DefaultPipeline{},
                   BruteForceBroadPhase{},
                   BVHNarrowPhase{},
                   MinProximityIntersection{.alarmDistance = 0.1, .contactDistance = skin},
                   Contacts{.response = "FrictionContactConstraint", .responseParams = text("mu=", mu)},
                   Gravity{{g * std::sin(angle), 0, -g * std::cos(angle)}},
                   held(grid_of("#cube", 10), rigid_at({0, 0, -10})),
                   body)};
}
template <class Sim>
V force_on_slab(Sim& sim) {
  V sum(0, 0, 0);
  for (Contact const& c : sim.root().template get<Contacts>().contacts) sum += c.force;
  return sum;
}

}  // namespace

TEST_CASE("points and spheres have the distances and normals of a ball, of a body that is turned") {
  const std::vector<V> x{
      center + V(0, 0, 1.2), center + V(0.5, 0.3, -0.2), center + V(-0.9, -0.8, 0.1), center + V(4, 0, 0)};
  // error of the grid: h^2/4 over the distance from the centre
  const double h = 2.4 / 40;
  for (const double radius : {0., 0.1}) {
    const auto all =
        radius > 0 ? contacts_of(grid_of("#sphere", 1), x, {}, SphereCollisionModel<Vec3d>{.radius = radius})
                   : contacts_of(grid_of("#sphere", 1), x, {}, PointCollisionModel<Vec3d>{});
    REQUIRE(all.size() == 3);
    for (Contact const& c : all) {
      const V from = x[std::size_t(c.b.vertices[0])] - center;
      CHECK(c.distance == Approx(from.norm() - 1 - radius).margin(h * h / 4 / from.norm()));
      CHECK((c.normal - from.normalized()).norm() < h);
    }
  }
}

TEST_CASE("lines and triangles meet a ball where they are deepest, and at their corners") {
  const double h = 2.4 / 40;
  const std::vector<Triangle> triangle{{0, 1, 2}};
  // the plane z = 0.8 over the centre; the deepest place is in its middle
  const std::vector<V> x{center + V(-3, -3, 0.8), center + V(4, -3, 0.8), center + V(0, 5, 0.8)};
  const auto all =
      contacts_of(grid_of("#sphere", 1), x, {.triangles = triangle}, TriangleCollisionModel<Vec3d>{});
  REQUIRE(all.size() == 1);
  CHECK(all[0].distance == Approx(-0.2).margin(h * h / 3));
  CHECK((all[0].normal - V(0, 0, 1)).norm() < h);
  CHECK((position_of_b(all[0], x) - center - V(0, 0, 0.8)).norm() < h);

  // two triangles whose common edge is nearest: it is met once, by the lines where there are any
  const std::vector<Triangle> roof{{0, 1, 2}, {1, 0, 3}};
  const std::vector<V> y{
      center + V(-3, 0.1, 1.1), center + V(4, 0.1, 1.1), center + V(0, 3, 3), center + V(0, -3, 3)};
  const auto edge =
      contacts_of(grid_of("#sphere", 1), y, {.triangles = roof}, TriangleCollisionModel<Vec3d>{});
  REQUIRE(edge.size() == 1);
  CHECK(edge[0].b.corners() == 2);
  CHECK(edge[0].distance == Approx(std::hypot(0.1, 1.1) - 1).margin(h * h / 3));
  const std::vector<Edge> line{{0, 1}};
  const auto ofLine =
      contacts_of(grid_of("#sphere", 1), {y[0], y[1]}, {.edges = line}, LineCollisionModel<Vec3d>{});
  REQUIRE(ofLine.size() == 1);
  CHECK(ofLine[0].distance == Approx(edge[0].distance).margin(1e-9));

  // corners in the ball have contacts of their own, each once
  const std::vector<V> z{
      center + V(0.9, 0, 0), center + V(0.9, 0.3, 0), center + V(0.9, 0, 0.3), center + V(0.9, 0.3, 0.3)};
  const std::vector<Triangle> two{{0, 1, 2}, {1, 3, 2}};
  int corners = 0;
  for (Contact const& c :
       contacts_of(grid_of("#sphere", 1), z, {.triangles = two}, TriangleCollisionModel<Vec3d>{}))
    corners += c.b.corners() == 1;
  CHECK(corners == 4);
}

TEST_CASE("points stick to a slope below the angle of friction, and slide above it, by multipliers") {
  for (const double mu : {0.5, 0.1}) {
    INFO(mu);
    auto sim = on_slope(slope,
                        mu,
                        node<"body">(EulerExplicitSolver{},
                                     MechanicalObject<Vec3d>{.position = {{0, 0, skin}, {0.5, 0.1, skin}}},
                                     UniformMass<Vec3d>{.vertexMass = 2},
                                     PointCollisionModel<Vec3d>{}));
    sim.init();
    for (int i = 0; i < 100; ++i) sim.animate(dt);
    auto const& s = sim.template at<"body">().state();
    const double a = mu < std::tan(slope) ? g * (std::sin(slope) - mu * std::cos(slope)) : 0;
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(s.velocity[i][0] == Approx(a * 100 * dt).margin(1e-6));
      CHECK(s.position[i][2] == Approx(skin).margin(1e-6));
    }
    CHECK(std::abs(force_on_slab(sim)[2]) == Approx(4 * g * std::cos(slope)).epsilon(1e-6));
  }
}

TEST_CASE("one grid stands on another by its points, and bears its weight") {
  Grid cube = grid_of("#cube", 0.25, 21);
  auto sim = on_slope(
      0,
      0.5,
      node<"body">(
          EulerExplicitSolver{},
          MechanicalObject<Rigid3d>{.position = {rigid_at({0.1, 0.2, 0.25 + skin})}},
          UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, 0.1 * Eigen::Matrix3d::Identity()}},
          cube));
  sim.init();
  for (int i = 0; i < 50; ++i) sim.animate(dt);
  auto const& s = sim.template at<"body">().state();
  CHECK(s.position[0].center[2] == Approx(0.25 + skin).margin(1e-6));
  CHECK(s.velocity[0].norm() < 1e-6);
  CHECK(std::abs(force_on_slab(sim)[2]) == Approx(2 * g).epsilon(1e-6));
}

TEST_CASE("bodies around grids that cannot be are refused") {
  auto refused = [](Grid const& model, std::initializer_list<std::string_view> words) {
    one::refuses(model, {rigid_at({0, 0, 0})}, {}, words);
  };
  refused({}, {"RigidDistanceGridCollisionModel", "no surface", "#cube"});
  refused(grid_of("#torus", 1), {"'#torus'", "#sphere"});
  refused(grid_of("missing.obj", 1), {"missing.obj"});
  refused(grid_of("#cube", -1), {"scale is -1"});
  refused(grid_of("#cube", 1, 1), {"nx is 1"});
  Grid box = grid_of("#cube", 1);
  box.box = {{0, 0, 0}};
  refused(box, {"box has 1 corners"});
  box.box = {{1, 0, 0}, {0, 1, 1}};
  refused(box, {"lowest corner beyond"});
}

}  // namespace test_rigid_distance_grid_collision_model
