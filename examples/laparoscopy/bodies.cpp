// SPDX-License-Identifier: BSL-1.0
#include "bodies.hpp"

#include <sinew/topology/implicit_surface.hpp>
#include <sinew/topology/isosurface_stuffing.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/surface_mesh.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace examples {

using namespace sinew;
using Point = Eigen::Vector3d;

namespace {

constexpr double pi = std::numbers::pi;

/// The middle of the intestines: rows from side to side, joined by half circles, as a place and a direction
/// at a length from its begin.
struct Winding {
  static constexpr int rows = 4;
  static constexpr double straight = 0.14, turn = 0.024, first = -0.082, depth = -0.01;
  static constexpr double length = rows * straight + (rows - 1) * pi * turn;

  struct At {
    Point place, along;
  };
  At operator()(double s) const {
    const double period = straight + pi * turn;
    const int row = std::min(int(s / period), rows - 1);
    const double side = row % 2 == 0 ? 1 : -1, in = s - row * period, y = first - 2 * turn * row;
    if (in <= straight) return {{side * (in - straight / 2), y, depth}, {side, 0, 0}};
    const double angle = (in - straight) / turn;
    return {{side * (straight / 2 + turn * std::sin(angle)), y - turn * (1 - std::cos(angle)), depth},
            {side * std::cos(angle), -std::sin(angle), 0}};
  }
};

constexpr double tubeRadius = 0.015;

// a grid of 3 x 3 points across and the others along the winding
std::vector<Point> swept_points(int stations, double halfWidth) {
  std::vector<Point> all;
  const Point up(0, 0, 1);
  for (int k = 0; k < stations; ++k) {
    const auto [place, along] = Winding{}(Winding::length * k / (stations - 1));
    const Point side = up.cross(along);
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) all.push_back(place + halfWidth * (i * side + j * up));
  }
  return all;
}

// rings around the winding, closed by rounded ends
Mesh tube_skin(int stations, int around) {
  Mesh skin;
  const Point up(0, 0, 1);
  auto ring = [&](Point const& center, Point const& along, double radius) {
    const Point side = up.cross(along);
    for (int i = 0; i < around; ++i) {
      const double a = 2 * pi * i / around;
      skin.positions.push_back(center + radius * (std::cos(a) * side + std::sin(a) * up));
    }
  };
  const auto begin = Winding{}(0), end = Winding{}(Winding::length);
  const double half = tubeRadius * std::sqrt(0.5);
  ring(begin.place - half * begin.along, begin.along, half);
  for (int k = 0; k < stations; ++k) {
    const auto [place, along] = Winding{}(Winding::length * k / (stations - 1));
    ring(place, along, tubeRadius);
  }
  ring(end.place + half * end.along, end.along, half);
  const int rings = stations + 2;
  for (int k = 0; k + 1 < rings; ++k)
    for (int i = 0; i < around; ++i) {
      const int a = k * around + i, b = k * around + (i + 1) % around;
      skin.triangles.push_back({a, b, b + around});
      skin.triangles.push_back({a, b + around, a + around});
    }
  const int first = int(skin.positions.size()), last = first + 1, top = (rings - 1) * around;
  skin.positions.push_back(begin.place - tubeRadius * begin.along);
  skin.positions.push_back(end.place + tubeRadius * end.along);
  for (int i = 0; i < around; ++i) {
    const int j = (i + 1) % around;
    skin.triangles.push_back({first, j, i});
    skin.triangles.push_back({last, top + i, top + j});
  }
  return skin;
}

Organ make_intestines(bool asGrid) {
  Organ o;
  const int stations = 1 + int(std::lround(Winding::length / 0.0125));
  o.skin = tube_skin(stations, 8);
  if (asGrid) {
    o.grid = {3, 3, stations};
    o.volume.positions = swept_points(stations, tubeRadius);
    o.cell = 0.0125;
  } else {
    // a square of the area of the circle
    const double halfWidth = tubeRadius * std::sqrt(pi) / 2;
    o.volume = regular_grid_tetrahedra(3, 3, stations, {0, 0, 0}, {1, 1, 1});
    o.volume.positions = swept_points(stations, halfWidth);
  }
  // the ends go on into what is not simulated; the mesentery holds the back
  for (int i = 0; i < 9; ++i) {
    o.fixed.push_back(i);
    o.fixed.push_back(9 * (stations - 1) + i);
  }
  for (int k = 1; k < stations - 1; ++k) o.tethered.push_back(9 * k + 1);
  o.volumeOfSkin = enclosed_volume(o.skin.positions, o.skin.triangles);
  return o;
}

// the liver hangs from the diaphragm: the points on the upper back of the right lobe
bool is_held(Point const& p) { return p.y() > 0.035 && p.z() < 0; }

void finish_liver(Organ& o) {
  const LiverShape shape;
  o.skin = surface(shape, shape.box_min(), shape.box_max(), 0.014);
  for (std::size_t i = 0; i < o.volume.positions.size(); ++i)
    if (is_held(o.volume.positions[i])) o.fixed.push_back(int(i));
  o.volumeOfSkin = enclosed_volume(o.skin.positions, o.skin.triangles);
}

void make_surroundings(LaparoscopyBodies& b) {
  const Point around = b.room.radii + Point::Constant(0.02);
  b.wall = surface(b.room, b.room.center - around, b.room.center + around, 0.03);
  for (auto& t : b.wall.triangles) std::swap(t[1], t[2]);  // it is seen from within
  // three pairs of ribs, in front of the liver
  for (const double y : {0.05, 0.02, -0.01})
    for (const double side : {-1.0, 1.0}) {
      const double high = (y - b.room.center.y()) / b.room.radii.y(),
                   scale = 0.9 * std::sqrt(1 - high * high);
      for (int k = 0; k <= 10; ++k) {
        const double angle = (-30 + 10 * k) * pi / 180;
        if (k > 0) b.ribs.edges.push_back({int(b.ribs.positions.size()) - 1, int(b.ribs.positions.size())});
        b.ribs.positions.push_back({side * scale * b.room.radii.x() * std::cos(angle),
                                    y,
                                    scale * b.room.radii.z() * std::sin(angle)});
      }
    }
}

}  // namespace

double AbdominalWall::operator()(Point const& p) const { return EllipsoidShape{center, radii}(p); }

double enclosed_volume(std::vector<Point> const& p, std::vector<Triangle> const& triangles) {
  double sum = 0;
  for (auto const& [a, b, c] : triangles)
    sum += p[std::size_t(a)].dot(p[std::size_t(b)].cross(p[std::size_t(c)]));
  return sum / 6;
}

bool is_inside(Point const& place, std::vector<Point> const& p, std::vector<Triangle> const& triangles) {
  double sum = 0;
  for (auto const& [i, j, k] : triangles) {
    const Point a = p[std::size_t(i)] - place, b = p[std::size_t(j)] - place, c = p[std::size_t(k)] - place;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum > 2 * pi;
}

LaparoscopyBodies make_bodies(int tetrahedra) {
  LaparoscopyBodies b;
  const LiverShape shape;
  b.liver.volume = tetrahedralize_count(shape, shape.box_min(), shape.box_max(), tetrahedra);
  finish_liver(b.liver);
  b.intestines = make_intestines(false);
  make_surroundings(b);
  return b;
}

LaparoscopyBodies make_bodies(std::array<int, 3> const& grid) {
  LaparoscopyBodies b;
  const LiverShape shape;
  b.liver.grid = grid;
  const Point size = shape.box_max() - shape.box_min();
  b.liver.volume.positions =
      regular_grid(grid[0], grid[1], grid[2], shape.box_min(), shape.box_max()).positions;
  b.liver.cell = std::cbrt(size.prod() / ((grid[0] - 1) * (grid[1] - 1) * (grid[2] - 1)));
  finish_liver(b.liver);
  b.intestines = make_intestines(true);
  make_surroundings(b);
  return b;
}

}  // namespace examples
