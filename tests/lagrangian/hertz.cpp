// SPDX-License-Identifier: BSL-1.0
// Contact of an elastic cylinder with a rigid plane (Hertz 1882; Johnson, Contact Mechanics, 1985).
#include "lagrangian/hertz.hpp"
#include "lagrangian/contact_scenes.hpp"

#include <algorithm>

namespace test_hertz {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double radius = 1, young = 1e6, poisson = 0.3, thickness = 0.01;

/// The lower half of a quarter of a cylinder, x >= 0, in plane strain: prisms over a polar grid, whose angles
/// and radii are fine where it touches, down to a cell of `cell`, and grow by `growth` from one to the next.
/// What is on the axes of symmetry stays on them.
struct Quarter {
  std::vector<Vector3d> points{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<int> middle{}, axis{};
  int angles, radii;

  Quarter(double cell, double fine, double growth) {
    const auto turned = graded(cell, fine, growth, M_PI / 2), deep = graded(cell, fine, growth, radius);
    angles = int(turned.size());
    radii = int(deep.size()) - 1;  // and the centre
    for (const double y : {0., thickness}) {
      for (int r = 0; r < radii; ++r)
        for (int a = 0; a < angles; ++a) {
          const double at = radius - deep[std::size_t(r)], t = turned[std::size_t(a)];
          if (a == 0) axis.push_back(int(points.size()));
          if (a == angles - 1) middle.push_back(int(points.size()));
          points.push_back({a == 0 ? 0 : at * std::sin(t), y, a == angles - 1 ? 0 : -at * std::cos(t)});
        }
      axis.push_back(int(points.size()));
      middle.push_back(int(points.size()));
      points.push_back({0, y, 0});
    }
    const int centre = angles * radii, behind = centre + 1;
    // with the diagonals of its sides from the lower number, so that neighbours have the same
    auto prism = [&](int a, int b, int c) {
      if (b > c) std::swap(b, c);
      for (Tetrahedron t : {Tetrahedron{a, b, c, a + behind},
                            Tetrahedron{b, c, a + behind, b + behind},
                            Tetrahedron{c, a + behind, b + behind, c + behind}}) {
        auto x = [&](std::size_t k) -> Vector3d {
          return points[std::size_t(t[k])] - points[std::size_t(t[0])];
        };
        if (x(1).cross(x(2)).dot(x(3)) < 0) std::swap(t[2], t[3]);
        tetrahedra.push_back(t);
      }
    };
    for (int r = 0; r < radii; ++r)
      for (int a = 0; a + 1 < angles; ++a) {
        const int p = a + angles * r;
        if (r + 1 < radii) {
          prism(p, p + 1, p + angles + 1);
          prism(p, p + angles + 1, p + angles);
        } else {
          prism(p, p + 1, centre);
        }
      }
  }
};

// half the width of the contact, and how much nearer the middle has come, under a force of a length of 1 m
// (Johnson 5.57)
double half_width(double force) {
  return std::sqrt(4 * force * radius * (1 - poisson * poisson) / (M_PI * young));
}
double indentation(double force) {
  return force * (1 - poisson * poisson) / (M_PI * young) *
         (2 * std::log(4 * radius / half_width(force)) - 1);
}

struct Pressed {
  double force = 0;          // on the whole cylinder, of a length of 1 m [N/m]
  double furthest = 0;       // that touches
  double pressureError = 0;  // root mean square over 4/5 of what touches, over the highest pressure
};

/// The cylinder pressed by a plane that has come nearer by `depth`.
template <class Solver>
Pressed pressed(Solver solver, double depth, double cell, double fine, double growth) {
  const Quarter body(cell, fine, growth);
  MeshTopology floor;
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  const double z = depth - radius;
  std::vector<int> all;
  std::vector<int> skin;  // both ends of each angle
  for (int a = 0; a < body.angles; ++a) skin.push_back(a), skin.push_back(a + body.angles * body.radii + 1);
  auto sim = constrained_scene_by(
      solver,
      MinProximityIntersection{.alarmDistance = 2 * depth, .contactDistance = 0},
      0,
      node<"plane">(floor,
                    MechanicalObject<Vec3d>{.position = {{-9, -9, z}, {9, -9, z}, {9, 9, z}, {-9, 9, z}}},
                    TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .bothSide = false}),
      node<"cylinder">(StaticSolver{},
                       SparseLDLSolver<>{},
                       TetrahedronTopology{body.tetrahedra},
                       MechanicalObject<Vec3d>{.position = body.points},
                       UniformMass<Vec3d>{.totalMass = 1},
                       TetrahedronFEMForceField<Vec3d>{
                           .youngModulus = {young}, .poissonRatio = poisson, .method = RotationMethod::small},
                       PartialFixedConstraint<Vec3d>{.fixAll = true, .fixedDirections = {0, 1, 0}},
                       PartialFixedConstraint<Vec3d>{.indices = body.middle, .fixedDirections = {0, 0, 1}},
                       PartialFixedConstraint<Vec3d>{.indices = body.axis, .fixedDirections = {1, 0, 0}},
                       node<"skin">(MechanicalObject<Vec3d>{},
                                    SubsetMapping<Vec3d, Vec3d>{.indices = skin},
                                    PointCollisionModel<Vec3d>{})));
  sim.root().template get<Gravity>().gravity.setZero();
  sim.init();
  sim.animate(0.01);
  Pressed result;
  const std::vector<double> force =
      pressed_points(sim.root().template get<DefaultContactManager>().contacts, skin, body.points.size());
  // both ends of the length together; the point of the axis bears half of what it would in the whole cylinder
  auto x = [&](int a) { return body.points[std::size_t(a)][0]; };
  std::vector<double> line(std::size_t(body.angles), 0);
  const int behind = body.angles * body.radii + 1;
  for (int a = 0; a < body.angles; ++a) {
    line[std::size_t(a)] = (force[std::size_t(a)] + force[std::size_t(a + behind)]) / thickness;
    result.force += 2 * line[std::size_t(a)];
    if (line[std::size_t(a)] > 0) result.furthest = x(a);
  }
  const double width = half_width(result.force), highest = 2 * result.force / (M_PI * width);
  int count = 0;
  for (int a = 0; a + 1 < body.angles && x(a) < 0.8 * width; ++a, ++count) {
    const double share = (x(a + 1) - (a == 0 ? 0 : x(a - 1))) / 2;
    const double p = highest * std::sqrt(1 - std::pow(x(a) / width, 2));
    result.pressureError += std::pow(line[std::size_t(a)] / share / highest - p / highest, 2);
  }
  result.pressureError = std::sqrt(result.pressureError / count);
  return result;
}

}  // namespace

TEST_CASE("an elastic cylinder on a plane: force, width and pressure converge to those of Hertz", "[long]") {
  // of a contact 0.1 m wide on each side; the formulas are those of a half space there, with errors of the
  // order of the square of that over the radius
  const double width = 0.1,
               depth = indentation(young * M_PI / 4 * width * width / radius / (1 - poisson * poisson));
  double lastPressure = 1;
  for (const int cells : {4, 8, 16}) {
    const Pressed p = pressed(BlockGaussSeidelConstraintSolver{.maxIterations = 100000, .tolerance = 1e-12},
                              depth,
                              width / cells,
                              1.3 * width,
                              1 + 1.0 / cells);
    CAPTURE(cells, p.force, p.furthest, p.pressureError);
    const double error = std::abs(indentation(p.force) / depth - 1);
    // the last point that touches is the last but one or two before the end of the contact
    CHECK(p.furthest <= half_width(p.force) * (1 + 1e-3));
    CHECK(p.furthest >= half_width(p.force) - 2 * width / cells);
    // stresses of linear elements have errors of the order of a cell, energies, and so forces, of its square,
    // beside a tenth of the square of the width over the radius of the formulas
    CHECK(p.pressureError < 0.6 * lastPressure);
    CHECK(error < 0.08 / (cells * cells) + 1e-3);
    lastPressure = p.pressureError;
  }
  CHECK(lastPressure < 0.02);
}

TEST_CASE("the convex solver presses the cylinder with the same force") {
  const double width = 0.1, depth = 0.016;
  const double one = pressed(BlockGaussSeidelConstraintSolver{.maxIterations = 100000, .tolerance = 1e-12},
                             depth,
                             width / 4,
                             1.3 * width,
                             1.25)
                         .force,
               other = pressed(
                           ConvexConstraintSolver{
                               .tolerance = 1e-10, .momentumTolerance = 1e-10, .maxUpdates = 500},
                           depth,
                           width / 4,
                           1.3 * width,
                           1.25)
                           .force;
  CHECK(other == Approx(one).epsilon(1e-6));
}

}  // namespace test_hertz
