// SPDX-License-Identifier: BSL-1.0
// Contact of an elastic sphere with a rigid plane (Hertz 1882; Johnson, Contact Mechanics, 1985).
#include "lagrangian/contact_scenes.hpp"
#include "lagrangian/hertz.hpp"

#include <algorithm>
#include <array>

namespace test_hertz_sphere {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double radius = 1, young = 1e6, poisson = 0.3, wedge = 0.1;  // m, Pa, 1, rad
constexpr double reduced = young / (1 - poisson * poisson);

/// The lower half of a wedge of a sphere between the planes at the angles 0 and `wedge` about z: a polar grid
/// of radii and angles from the axis, which is fine where it touches, carried from one plane to the other.
/// Points of the axis are on both.
struct Wedge {
  std::vector<Vector3d> points{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<int> equator{}, axis{}, first{}, second{};  // off the axis: on either plane
  std::vector<std::array<int, 2>> skin{};                 // of each angle on the surface: its points on both

  Wedge(double cell, double fine, double growth) {
    const auto turned = graded(cell, fine, growth, M_PI / 2), deep = graded(cell, fine, growth, radius);
    const int angles = int(turned.size()), radii = int(deep.size());
    std::vector<std::array<int, 2>> at;  // of a place of the grid: its points on both planes
    for (int r = 0; r < radii; ++r)
      for (int a = 0; a < angles; ++a) {
        const double from = radius - deep[std::size_t(r)], t = turned[std::size_t(a)];
        const bool isCentre = r + 1 == radii, isEquator = a + 1 == angles;
        if (isCentre && a > 0) {
          at.push_back(at.back());
          continue;
        }
        const double x = a == 0 ? 0 : from * std::sin(t), z = isEquator || isCentre ? 0 : -from * std::cos(t);
        std::array<int, 2> both{};
        for (std::size_t side = 0; side < 2; ++side) {
          const bool same = side == 1 && (a == 0 || isCentre);
          if (!same) {
            if (z == 0) equator.push_back(int(points.size()));
            (a == 0 || isCentre ? axis : side == 0 ? first : second).push_back(int(points.size()));
            points.push_back({x * (side == 0 ? 1 : std::cos(wedge)), side == 0 ? 0 : x * std::sin(wedge), z});
          }
          both[side] = same ? both[0] : int(points.size()) - 1;
        }
        at.push_back(both);
        if (r == 0) skin.push_back(both);
      }
    for (int r = 0; r + 1 < radii; ++r)
      for (int a = 0; a + 1 < angles; ++a) {
        const int p = a + angles * r;
        prism(at, p, p + 1, p + angles + 1);
        prism(at, p, p + angles + 1, p + angles);
      }
  }

 private:
  // with the diagonals of its sides from the lower number, so that neighbours have the same; what is flat on
  // the axis is left out
  void prism(std::vector<std::array<int, 2>> const& at, int a, int b, int c) {
    std::array<int, 3> of{a, b, c};
    std::sort(of.begin(), of.end());
    auto p = [&](std::size_t k, std::size_t side) { return at[std::size_t(of[k])][side]; };
    for (Tetrahedron t : {Tetrahedron{p(0, 0), p(1, 0), p(2, 0), p(0, 1)},
                          Tetrahedron{p(1, 0), p(2, 0), p(0, 1), p(1, 1)},
                          Tetrahedron{p(2, 0), p(0, 1), p(1, 1), p(2, 1)}}) {
      auto sorted = t;
      std::sort(sorted.begin(), sorted.end());
      if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) continue;
      auto x = [&](std::size_t k) -> Vector3d {
        return points[std::size_t(t[k])] - points[std::size_t(t[0])];
      };
      if (x(1).cross(x(2)).dot(x(3)) < 0) std::swap(t[2], t[3]);
      tetrahedra.push_back(t);
    }
  }
};

// half the width of the contact under a force on the whole sphere (Johnson 4.22)
double contact_radius(double force) { return std::cbrt(3 * force * radius / (4 * reduced)); }
// how much nearer a plane has come to the middle of a sphere between two of them: Hertz's a^2 / R less what
// the force on the other side does to the middle (Tatara 1991), which is a / R of it
double indentation(double force) {
  const double a = contact_radius(force), far = std::sqrt(a * a + 4 * radius * radius);
  const double other =
      2 * (1 + poisson) * radius * radius / (far * far * far) + (1 - poisson * poisson) / far;
  return a * a / radius - force * other / (M_PI * young);
}

struct Pressed {
  double force = 0;          // on the whole sphere [N]
  double furthest = 0;       // that touches
  double pressureError = 0;  // root mean square over 4/5 of what touches, over the highest pressure
};

/// The sphere pressed by a plane that has come nearer by `depth`.
Pressed pressed(double depth, double cell, double fine, double growth) {
  const Wedge body(cell, fine, growth);
  MeshTopology floor;
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  const double z = depth - radius;
  std::vector<int> skin;
  for (auto const& both : body.skin) {
    skin.push_back(both[0]);
    if (both[1] != both[0]) skin.push_back(both[1]);
  }
  const Vector3d across(-std::sin(wedge), std::cos(wedge), 0);
  auto sim = constrained_scene_by(
      BlockGaussSeidelConstraintSolver{.maxIterations = 100000, .tolerance = 1e-12},
      MinProximityIntersection{.alarmDistance = 2 * depth, .contactDistance = 0},
      0,
      node<"plane">(floor,
                    MechanicalObject<Vec3d>{.position = {{-9, -9, z}, {9, -9, z}, {9, 9, z}, {-9, 9, z}}},
                    TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .bothSide = false}),
      node<"sphere">(
          StaticSolver{},
          SparseLDLSolver<>{},
          TetrahedronTopology{body.tetrahedra},
          MechanicalObject<Vec3d>{.position = body.points},
          UniformMass<Vec3d>{.totalMass = 1},
          TetrahedronFEMForceField<Vec3d>{
              .youngModulus = {young}, .poissonRatio = poisson, .method = RotationMethod::small},
          PartialFixedConstraint<Vec3d>{.indices = body.first, .fixedDirections = {0, 1, 0}},
          ProjectToPlaneConstraint<Vec3d>{.indices = body.second, .origin = {0, 0, 0}, .normal = across},
          PartialFixedConstraint<Vec3d>{.indices = body.axis, .fixedDirections = {1, 1, 0}},
          PartialFixedConstraint<Vec3d>{.indices = body.equator, .fixedDirections = {0, 0, 1}},
          node<"skin">(MechanicalObject<Vec3d>{},
                       SubsetMapping<Vec3d, Vec3d>{.indices = skin},
                       PointCollisionModel<Vec3d>{})));
  sim.root().template get<Gravity>().gravity.setZero();
  sim.init();
  sim.animate(0.01);
  const std::vector<double> force =
      pressed_points(sim.root().template get<DefaultContactManager>().contacts, skin, body.points.size());
  // rings of the surface, each with the area that its two triangles give its points; between the planes they
  // are flat, so that all of them are 2 pi / sin(wedge) of one
  Pressed result;
  const std::size_t rings = body.skin.size();
  auto x = [&](std::size_t a) { return body.points[std::size_t(body.skin[a][0])][0]; };
  std::vector<double> line(rings, 0), area(rings, 0);
  for (std::size_t a = 0; a < rings; ++a) {
    line[a] = force[std::size_t(body.skin[a][0])];
    if (a > 0) line[a] += force[std::size_t(body.skin[a][1])];
    result.force += 2 * M_PI / std::sin(wedge) * line[a];
    if (line[a] > 0) result.furthest = x(a);
  }
  // the integral of the hat function of a ring over the wedge
  for (std::size_t a = 0; a + 1 < rings; ++a) {
    const double from = x(a), to = x(a + 1), length = (to - from) * std::sin(wedge);
    area[a] += length * (2 * from + to) / 6;
    area[a + 1] += length * (from + 2 * to) / 6;
  }
  const double width = contact_radius(result.force), highest = 3 * result.force / (2 * M_PI * width * width);
  int count = 0;
  // the point of the axis has the area of half a cell, and an error of its own
  for (std::size_t a = 1; a + 1 < rings && x(a) < 0.8 * width; ++a, ++count) {
    const double p = std::sqrt(1 - std::pow(x(a) / width, 2));
    result.pressureError += std::pow(line[a] / area[a] / highest - p, 2);
  }
  result.pressureError = std::sqrt(result.pressureError / count);
  return result;
}

}  // namespace

TEST_CASE("an elastic sphere on a plane: force, radius and pressure converge to those of Hertz", "[long]") {
  // of a contact with a radius of 0.1 m
  const double width = 0.1, load = 4. / 3 * reduced * width * width * width / radius,
               depth = indentation(load);
  double lastPressure = 1;
  for (const int cells : {4, 8, 16}) {
    const Pressed p = pressed(depth, width / cells, 1.3 * width, 1 + 1.0 / cells);
    CAPTURE(cells, p.force / load, p.furthest, p.pressureError);
    // it ends in the cell where the last point touches, or the next one
    CHECK(std::abs(p.furthest - contact_radius(p.force)) < 2 * width / cells);
    // stresses of linear elements have errors of the order of a cell, energies, and so forces, of its square,
    // beside a tenth of the square of the contact over the radius of the formulas
    CHECK(p.pressureError < 0.6 * lastPressure);
    CHECK(std::abs(p.force / load - 1) < 0.4 / (cells * cells) + 1e-3);
    CHECK(std::abs(indentation(p.force) / depth - 1) < 0.3 / (cells * cells) + 1e-3);
    lastPressure = p.pressureError;
  }
  CHECK(lastPressure < 0.01);
}

}  // namespace test_hertz_sphere
