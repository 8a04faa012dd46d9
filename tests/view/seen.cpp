// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/collision/contact_responses.hpp>
#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/view/picture.hpp>

#include <algorithm>
#include <numeric>

namespace test_seen {

using namespace sinew;
using view::Quantity;
using view::SeenBody;
using view::SeenScene;

SeenBody const& body_of(SeenScene const& scene, std::string_view path,
                        SeenBody::Kind kind = SeenBody::Kind::state) {
  for (SeenBody const& body : scene.bodies)
    if (body.path == path && body.kind == kind) return body;
  throw Error("test", "no such body");
}

TEST_CASE("stress, energy, displacement and speed of a body that is stretched, and of what follows it") {
  const double young = 3000, poisson = 0.3, stretched = 1e-4;
  const double mu = young / 2 / (1 + poisson), lambda = young * poisson / (1 + poisson) / (1 - 2 * poisson);
  Mesh mesh = regular_grid_tetrahedra(3, 3, 3, {0, 0, 0}, {1, 1, 1});
  auto box = regular_grid(3, 3, 3, {0, 0, 0}, {1, 1, 1});
  const Mesh skin{.positions = {{0.2, 0.3, 0.4}, {0.7, 0.3, 0.4}, {0.3, 0.6, 0.4}}, .triangles = {{0, 1, 2}}};
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      CGLinearSolver<>{},
      node<"tetrahedra">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                         MechanicalObject<Vec3d>{},
                         UniformMass<Vec3d>{},
                         TetrahedronFEMForceField<Vec3d>{.youngModulus = {young}, .poissonRatio = poisson},
                         node<"skin">(VisualModel{.mesh = skin}, BarycentricMapping<Vec3d, Vec3f>{})),
      node<"hexahedra">(MeshTopology{.position = box.positions, .hexahedra = box.hexahedra},
                        MechanicalObject<Vec3d>{},
                        UniformMass<Vec3d>{},
                        HexahedronFEMForceField<Vec3d>{.youngModulus = {young}, .poissonRatio = poisson}))};
  sim.init();
  auto stretch = [&](auto& state) {
    for (auto& x : state.position) x[0] *= 1 + stretched;
    for (auto& v : state.velocity) v = {0, 3, 4};
  };
  stretch(sim.at<"tetrahedra">().state());
  stretch(sim.at<"hexahedra">().state());
  auto check_values = [&](Quantity quantity, double expected, double tolerance) {
    const SeenScene scene = view::seen_scene(sim, {.colour = quantity, .states = true});
    for (auto const* path : {"/root/tetrahedra", "/root/hexahedra"}) {
      SeenBody const& body = body_of(scene, path);
      REQUIRE(body.values.size() == 27);
      for (const double value : body.values) CHECK(value == Approx(expected).epsilon(tolerance));
    }
    SeenBody const& visual = body_of(scene, "/root/tetrahedra/skin", SeenBody::Kind::visual);
    REQUIRE(visual.values.size() == 3);
    for (const double value : visual.values) CHECK(value == Approx(expected).epsilon(tolerance));
    REQUIRE(scene.legend);
    CHECK(scene.legend->high == Approx(expected).epsilon(tolerance));
  };
  // s = diag(2 mu e + lambda e, lambda e, lambda e)
  check_values(Quantity::vonMises, 2 * mu * stretched, 1e-3);
  check_values(Quantity::strainEnergy, (mu + lambda / 2) * stretched * stretched, 1e-3);
  check_values(Quantity::speed, 5, 1e-6);
  const SeenScene scene = view::seen_scene(sim, {.colour = Quantity::displacement, .states = true});
  CHECK(scene.legend->unit == "m");
  CHECK(scene.legend->low == 0);
  CHECK(scene.legend->high == Approx(stretched));
  SeenBody const& visual = body_of(scene, "/root/tetrahedra/skin", SeenBody::Kind::visual);
  CHECK(visual.values[1] == Approx(0.7 * stretched).epsilon(0.01));  // in single precision
  // nothing is computed that nobody asks for
  CHECK(body_of(view::seen_scene(sim), "/root/hexahedra").values.empty());
}

TEST_CASE("the range of a legend, looks of bodies, and the colours of viridis") {
  Mesh mesh = regular_grid_tetrahedra(2, 2, 2, {0, 0, 0}, {1, 1, 1});
  Simulation sim{
      node<"root">(EulerExplicitSolver{},
                   node<"a">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                             MechanicalObject<Vec3d>{},
                             UniformMass<Vec3d>{}),
                   node<"b">(MechanicalObject<Vec3d>{.position = {{3, 0, 0}}}, UniformMass<Vec3d>{}))};
  sim.init();
  view::SeenSettings settings{.colour = Quantity::speed, .range = std::pair(0., 10.)};
  settings.looks = {{.path = "/root/b", .visible = false},
                    {.path = "/root/a", .colour = Eigen::Vector3d(0, 1, 0)}};
  for (auto& v : sim.at<"a">().state().velocity) v = {0, 0, 10};
  SeenScene scene = view::seen_scene(sim, settings);
  CHECK(scene.legend->high == 10);
  CHECK_FALSE(body_of(scene, "/root/b").visible);
  CHECK(body_of(scene, "/root/a").colour == Eigen::Vector3d(0, 1, 0));
  // the body has the last colour of the map, which the legend ends with
  view::Painter painter({.width = 320, .height = 240});
  auto pixel_near = [](view::Image const& image, Eigen::Vector3d const& colour) {
    int found = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const auto p = image.at(x, y);
        found += (Eigen::Vector3d(p[0], p[1], p[2]) / 255 - colour).norm() < 0.06;
      }
    return found;
  };
  const Eigen::Vector3d first = view::colour_of_value(0), last = view::colour_of_value(1);
  CHECK(last.isApprox(Eigen::Vector3d(253, 231, 37) / 255));
  CHECK(view::colour_of_value(std::nan("")).x() == view::colour_of_value(std::nan("")).y());
  const view::Image valued = painter.paint(scene);
  CHECK(pixel_near(valued, first) > 10);  // the lower end of the legend
  // yellow, in its shades
  auto yellow = [](view::Image const& image) {
    int found = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width * 2 / 3; ++x) {
        const auto p = image.at(x, y);
        found += p[0] > p[2] + 60 && p[1] > p[2] + 60;
      }
    return found;
  };
  CHECK(yellow(valued) > 1000);
  settings.colour = Quantity::none;
  const view::Image plain = painter.paint(view::seen_scene(sim, settings));
  CHECK(yellow(plain) == 0);
  CHECK(pixel_near(plain, first) == 0);
  // cut open, half of it is left; as wires, hardly anything
  auto covered = [&](view::SeenSettings const& asked) {
    const view::Image image = painter.paint(view::seen_scene(sim, asked));
    int found = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        found += image.at(x, y) != std::array<unsigned char, 3>{255, 255, 255};
    return found;
  };
  const int whole = covered(settings);
  settings.clip = view::ClipPlane{{0, 1, 0}, 0.3};
  const int half = covered(settings);
  CHECK(half > whole / 10);
  CHECK(half < whole * 3 / 4);
  settings.clip = view::ClipPlane{{0, 1, 0}, -1};
  CHECK(covered(settings) == 0);
  settings.clip.reset();
  settings.wireframe = true;
  CHECK(covered(settings) < whole / 2);
  settings.axes = settings.grid = true;
  settings.wireframe = false;
  CHECK(covered(settings) > whole);
}

TEST_CASE("springs by their stretch, and points that are held") {
  Simulation sim{node<"root">(
      EulerExplicitSolver{},
      StiffSpringForceField<Vec3d, Between<"a", "b">>{
          .springs = {{.first = 0, .second = 1, .stiffness = 1, .damping = 0, .length = 2}}},
      node<"a">(
          MechanicalObject<Vec3d>{.position = {{0, 0, 0}}}, UniformMass<Vec3d>{}, FixedConstraint<Vec3d>{}),
      node<"b">(MechanicalObject<Vec3d>{.position = {{0, 0, 1}, {3, 0, 0}}}, UniformMass<Vec3d>{}))};
  sim.init();
  CHECK(view::seen_scene(sim).springs.empty());
  const SeenScene scene = view::seen_scene(sim, {.colour = Quantity::stretch, .constraints = true});
  REQUIRE(scene.springs.size() == 1);
  CHECK(scene.springs[0].to == Eigen::Vector3d(3, 0, 0));
  CHECK(scene.springs[0].value == Approx(1.5));
  CHECK(scene.legend->low == Approx(1.5));
  REQUIRE(scene.constrained.size() == 1);
  CHECK(scene.constrained[0] == Eigen::Vector3d(0, 0, 0));
}

TEST_CASE("capsules are shown as what is within their radius") {
  MeshTopology edge;
  edge.edges = {{0, 1}};
  const Eigen::Vector3d start(0.2, 0, 0), end(0.5, 1, -0.3);
  Simulation sim{node<"root">(DefaultPipeline{},
                              BruteForceBroadPhase{},
                              BVHNarrowPhase{},
                              MinProximityIntersection{},
                              DefaultContactManager{},
                              node<"rod">(edge,
                                          MechanicalObject<Vec3d>{.position = {start, end}},
                                          CapsuleCollisionModel<Vec3d>{.defaultRadius = 0.1}))};
  sim.init();
  const SeenScene scene = view::seen_scene(sim, {.collisionModels = true});
  SeenBody const& rod = body_of(scene, "/root/rod", SeenBody::Kind::collision);
  const Eigen::Vector3d axis = end - start;
  auto nearest = [&](Eigen::Vector3d const& x) -> Eigen::Vector3d {
    return start + std::clamp((x - start).dot(axis) / axis.squaredNorm(), 0.0, 1.0) * axis;
  };
  double area = 0;
  for (Eigen::Vector3d const& x : rod.points) CHECK((x - nearest(x)).norm() == Approx(0.1));
  for (auto const& [a, b, c] : rod.triangles) {
    auto at = [&](Index i) { return rod.points[std::size_t(i)]; };
    const Eigen::Vector3d normal = (at(b) - at(a)).cross(at(c) - at(a)), middle = (at(a) + at(b) + at(c)) / 3;
    CHECK(normal.dot(middle - nearest(middle)) > 0);  // outwards
    area += normal.norm() / 2;
  }
  // 16 sides of the tube, and a ball of 128 faces: smaller by some percent
  const double whole = 2 * 3.14159265 * 0.1 * axis.norm() + 4 * 3.14159265 * 0.01;
  CHECK(area < whole);
  CHECK(area > 0.95 * whole);
}

TEST_CASE("arrows of velocities, reactions and contacts, and the collision models that touch") {
  TriangleCollisionModel<Vec3d> floor;
  floor.moving = floor.simulated = false;
  SphereCollisionModel<Vec3d> balls;
  balls.radius = 0.1;
  Simulation sim{
      node<"root">(Gravity{{0, -10, 0}},
                   DefaultPipeline{},
                   BruteForceBroadPhase{},
                   BVHNarrowPhase{},
                   MinProximityIntersection{.alarmDistance = 0.05, .contactDistance = 0.02},
                   DefaultContactManager{},
                   EulerImplicitSolver{.rayleighMass = 5},
                   CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
                   node<"ball">(MechanicalObject<Vec3d>{.position = {{0, 0.12, 0}, {1, 3, 1}}},
                                UniformMass<Vec3d>{.vertexMass = 2},
                                FixedConstraint<Vec3d>{.indices = {1}},
                                balls),
                   node<"floor">(MeshTopology{.position = {{-1, 0, -1}, {2, 0, -1}, {2, 0, 2}, {-1, 0, 2}},
                                              .triangles = {{0, 2, 1}, {0, 3, 2}}},
                                 MechanicalObject<Vec3d>{},
                                 floor))};
  sim.init();
  sim.keepForces(true);
  for (int i = 0; i < 600; ++i) sim.animate(0.01);
  view::SeenSettings settings{.collisionModels = true};
  settings.arrows.fill(true);
  const SeenScene scene = view::seen_scene(sim, settings);
  auto sum_of = [&](view::ArrowKind kind) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (auto const& arrow : scene.arrows)
      if (arrow.kind == kind) sum += arrow.vector;
    return sum;
  };
  CHECK((sum_of(view::ArrowKind::reaction) - Eigen::Vector3d(0, 20, 0)).norm() < 1e-6);
  CHECK(sum_of(view::ArrowKind::contact).norm() < 1e-9);  // on both bodies
  double up = 0;
  for (auto const& arrow : scene.arrows)
    if (arrow.kind == view::ArrowKind::contact) {
      CHECK(std::abs(arrow.from.y()) < 0.1);
      up += std::max(arrow.vector.y(), 0.);
    }
  CHECK(up == Approx(20).epsilon(0.01));
  SeenBody const& models = body_of(scene, "/root/ball", SeenBody::Kind::collision);
  CHECK(models.triangles.size() == 2 * 8 * 16);
  for (std::size_t i = 0; i < models.points.size(); ++i) {
    const Eigen::Vector3d centre = sim.at<"ball">().state().position[i < models.points.size() / 2 ? 0 : 1];
    CHECK((models.points[i] - centre).norm() == Approx(0.1));
  }
  // outwards
  for (auto const& [a, b, c] : models.triangles) {
    auto at = [&](Index i) { return models.points[std::size_t(i)]; };
    const Eigen::Vector3d centre =
        sim.at<"ball">().state().position[std::size_t(a) < models.points.size() / 2 ? 0 : 1];
    CHECK((at(b) - at(a)).cross(at(c) - at(a)).dot(at(a) - centre) > 0);
  }
  CHECK(body_of(scene, "/root/floor", SeenBody::Kind::collision).triangles.size() == 2);
  view::Painter({.width = 64, .height = 48}).paint(scene);
  CHECK(view::seen_scene(sim).arrows.empty());
  // the boxes by which they were found: of both balls and around them, of both triangles and around them
  CHECK(scene.boxes.empty());
  settings.boxes = true;
  const SeenScene boxed = view::seen_scene(sim, settings);
  REQUIRE(boxed.boxes.size() == 6);
  int around = 0;
  for (auto const& [low, high, level] : boxed.boxes)
    for (std::size_t i = 0; i < 2; ++i) {
      const Eigen::Vector3d ball = sim.at<"ball">().state().position[i];
      around += (low.array() <= ball.array() - 0.1).all() && (high.array() >= ball.array() + 0.1).all();
    }
  CHECK(around == 4);  // each by its own, and by that of the model
  CHECK(view::drawn_marks(boxed, 1).mesh.lines.at.size() == 6 * 12 * 2);
  settings.boxLevel = 0;
  CHECK(view::seen_scene(sim, settings).boxes.size() == 2);
  settings.boxLevel = 1;  // trees of so few have no boxes between
  CHECK(view::seen_scene(sim, settings).boxes.size() == 4);
  settings.boxLevel = 2;
  CHECK(view::seen_scene(sim, settings).boxes.empty());
}

}  // namespace test_seen
