// SPDX-License-Identifier: BSL-1.0
#include "eye.hpp"

#include <sinew/io/output_file.hpp>
#include <sinew/io/write_obj.hpp>

#include <cmath>
#include <numbers>

namespace examples {

using namespace sinew;
using std::numbers::pi;
using Point = Eigen::Vector3d;

namespace {

/// A tube of `n` sides around z, from z0 to z1, closed at both ends.
Mesh tube(double radius, double z0, double z1, int n = 12) {
  Mesh mesh;
  for (const double z : {z0, z1})
    for (int i = 0; i < n; ++i)
      mesh.positions.push_back({radius * std::cos(2 * pi * i / n), radius * std::sin(2 * pi * i / n), z});
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.quads.push_back({i, next, n + next, n + i});
    if (i > 1) mesh.triangles.push_back({0, i, i - 1}), mesh.triangles.push_back({n, n + i - 1, n + i});
  }
  return mesh;
}

/// The part of the membranes over some quads, as a surface with its own numbers.
Mesh surface_of(std::vector<Point> const& all, int begin, int end, std::vector<Quad> const& quads) {
  Mesh mesh;
  mesh.positions.assign(all.begin() + begin, all.begin() + end);
  for (Quad q : quads)
    if (q[0] >= begin && q[0] < end) {
      for (Index& i : q) i -= begin;
      mesh.quads.push_back(q);
    }
  return mesh;
}

double tension_of(Spring const& s, std::vector<Point> const& x) {
  return s.stiffness * ((x[std::size_t(s.second)] - x[std::size_t(s.first)]).norm() - *s.length);
}

}  // namespace

Eye make_eye(EyeOptions const& o) {
  if (o.sectors < 12 || o.sectors % 3 != 0)
    throw Error("the eye", text("has ", o.sectors, " sectors; give a multiple of 3, at least 12"));
  Eye eye;
  const int m = o.sectors, rows = m / 3;
  const double R = o.radius, step = (pi / 2 - o.nerve) / (rows - 1);
  auto direction = [&](double theta, double phi) {
    return Point(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta));
  };
  auto at = [m](int row, int sector) { return row * m + (sector + m) % m; };

  // retina, and the scar inside it, over two of its rows
  const int under = int(std::lround((0.9 - o.nerve) / step)), scar = rows;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < m; ++j) eye.position.push_back(R * direction(o.nerve + i * step, 2 * pi * j / m));
  eye.retinaPoints = int(eye.position.size());
  eye.sectors = m;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < m; ++j)
      eye.position.push_back((R - o.gap) * direction(o.nerve + (under + i) * step, 2 * pi * j / m));
  for (int i = 0; i < rows + 2; ++i)
    for (int j = 0; j < m; ++j) {
      if (i == 0 || i == rows - 1) eye.fixed.push_back(at(i, j));
      if (i != rows - 1 && i != rows + 1)
        eye.quads.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  const int points = int(eye.position.size());
  eye.retina = surface_of(eye.position, 0, eye.retinaPoints, eye.quads);
  eye.scar = surface_of(eye.position, eye.retinaPoints, points, eye.quads);
  eye.density = o.density;

  // the lengths of springs without force: of the scar those of a smaller ring
  std::vector<Point> natural = eye.position;
  for (int i = eye.retinaPoints; i < points; ++i) natural[std::size_t(i)].head<2>() *= 1 - o.shrinkage;
  auto spring = [&](std::vector<Spring>& to, int i, int j, double stiffness) {
    to.push_back({i, j, stiffness, 0, (natural[std::size_t(i)] - natural[std::size_t(j)]).norm()});
  };
  // kind by kind, so that springs which follow each other have no end in common
  auto band = [&](int first, int last, double k) {
    auto each = [&](int height, auto&& add) {
      for (int i = first; i + height <= last; ++i)
        for (int j = 0; j < m; ++j) add(i, j);
    };
    auto& to = eye.springs;
    each(0, [&](int i, int j) { spring(to, at(i, j), at(i, j + 1), k); });
    each(1, [&](int i, int j) { spring(to, at(i, j), at(i + 1, j), k); });
    each(1, [&](int i, int j) { spring(to, at(i, j), at(i + 1, j + 1), k); });
    each(1, [&](int i, int j) { spring(to, at(i, j + 1), at(i + 1, j), k); });
    // against bending
    each(0, [&](int i, int j) { spring(to, at(i, j), at(i, j + 2), k / 2); });
    each(2, [&](int i, int j) { spring(to, at(i, j), at(i + 2, j), k / 2); });
  };
  band(0, rows - 1, o.stiffness);
  band(scar, scar + 1, o.scarStiffness);
  natural = eye.position;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < m; ++j)
      for (const int side : {-1, 0, 1})
        spring(eye.cuttable, at(scar + i, j), at(under + i, j + side), o.cuttableStiffness);

  // the blade: a hook in a plane through the axis, as wide as the scar
  const double between = o.nerve + (under + 0.5) * step;  // of the rows
  const double inner = -0.24 * R, outer = 0.03 * R, half = std::min(step / 2, 0.1) * R;
  eye.blade.positions = {{outer, 0, -half}, {inner, 0, -half}, {inner, 0, half}, {outer, 0, half}};
  eye.blade.edges = {{0, 1}, {1, 2}, {2, 3}};
  eye.tip = tube(0.0004, half, 0.006);
  eye.handle = tube(0.002, 0.006, 0.03);
  for (Mesh* part : {&eye.tip, &eye.handle})
    for (Point& p : part->positions) p.x() += inner;

  // its way: from the middle of the eye to the scar, once around with some overlap, and back
  const double settle = 1, reach = 0.4, round = 4, overlap = 1.5 * 2 * pi / m;
  auto key = [&](double time, double distance, double phi) {
    // turned about z by phi, then z leaned to the middle of the eye
    const Eigen::Quaterniond q(Eigen::AngleAxisd(phi, Point::UnitZ()) *
                               Eigen::AngleAxisd(-(pi / 2 - between), Point::UnitY()).inverse());
    eye.times.push_back(time);
    eye.places.push_back({distance * direction(between, phi), {q.w(), q.x(), q.y(), q.z()}});
  };
  const double away = 0.4 * R, close = 0.93 * R;
  key(0, away, 0);
  key(settle, away, 0);
  const int keys = 2 * m;
  eye.cutBegins = settle + reach;
  eye.cutEnds = settle + reach + round;
  for (int i = 0; i <= keys; ++i) key(eye.cutBegins + round * i / keys, close, (2 * pi + overlap) * i / keys);
  key(eye.cutEnds + reach, away, overlap);
  return eye;
}

RetinaState examine(Eye const& eye, std::vector<Point> const& now, std::vector<Spring> const& uncut) {
  RetinaState s;
  for (Spring const& spring : eye.springs) {
    if (spring.first >= eye.retinaPoints) continue;
    const double force = tension_of(spring, now);
    s.tension += std::abs(force);
    s.energy += force * force / (2 * spring.stiffness);
  }
  for (Spring const& spring : uncut) s.traction += std::abs(tension_of(spring, now));
  for (int i = 0; i < eye.retinaPoints; ++i) {
    const double d = (now[std::size_t(i)] - eye.position[std::size_t(i)]).norm();
    s.rms += d * d;
    s.maximum = std::max(s.maximum, d);
  }
  s.rms = std::sqrt(s.rms / eye.retinaPoints);
  return s;
}

void write_scene_data(Eye const& eye, std::string const& folder) {
  auto in = [&](char const* name) { return text(folder, '/', name); };
  io::make_folders(folder);
  io::write_obj(in("membranes.obj"), {.positions = eye.position, .quads = eye.quads});
  io::write_obj(in("retina.obj"), eye.retina);
  io::write_obj(in("scar.obj"), eye.scar);
  io::write_obj(in("handle.obj"), eye.handle);
  io::write_obj(in("tip.obj"), eye.tip);
  io::write_obj(in("blade.obj"), eye.blade);

  std::string xml = "<Node name=\"Group\">\n";
  auto springs = [&](std::string_view tag, std::string_view name, std::vector<Spring> const& list) {
    xml += text("  <", tag, " name=\"", name, "\" spring=\"");
    for (Spring const& s : list) {
      xml += text('\n', s.first, ' ', s.second, ' ');
      for (const double number : {s.stiffness, s.damping, *s.length})
        io::append_number(xml, number), xml += ' ';
    }
    xml += "\"/>\n";
  };
  springs("StiffSpringForceField", "Retina", eye.springs);
  springs("CuttableSpringForceField", "Cuttable", eye.cuttable);
  io::write_file(in("springs.xml"), xml + "</Node>\n");

  std::string tool;
  for (std::size_t k = 0; k < eye.times.size(); ++k) {
    tool += "T= ";
    io::append_number(tool, eye.times[k]);
    tool += "\n  X=";
    auto const& [c, q] = eye.places[k];
    for (const double number : {c.x(), c.y(), c.z(), q.x(), q.y(), q.z(), q.w()})
      tool += ' ', io::append_number(tool, number);
    tool += '\n';
  }
  io::write_file(in("tool.txt"), tool);
}

}  // namespace examples
