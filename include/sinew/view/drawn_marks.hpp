// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/shaded_mesh.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

namespace sinew::view {

/// What is drawn beside bodies: arrows, springs, points that are held, axes and a grid, and what they mean in
/// words.
struct DrawnMarks {
  ShadedMesh mesh{};
  std::vector<std::string> words{};
  std::vector<std::pair<Eigen::Vector3d, std::string>> labels{};  // at places of the scene
};

/// Colours of the kinds of arrows.
inline Eigen::Vector3d colour_of(ArrowKind kind) {
  constexpr std::array<std::array<double, 3>, 5> all{
      {{0.0, 0.45, 0.70}, {0.0, 0.50, 0.36}, {0.70, 0.30, 0.55}, {0.78, 0.12, 0.0}, {0.1, 0.1, 0.1}}};
  return Eigen::Vector3d(all[std::size_t(kind)].data());
}

namespace detail {

inline std::string number_words(double value) {
  char words[32];
  const double size = std::abs(value);
  std::snprintf(words, sizeof words, size >= 1000 && size < 1e6 ? "%.0f" : "%.3g", value);
  return words;
}

inline void add_arrow(ShadedMesh& mesh, Eigen::Vector3d const& from, Eigen::Vector3d const& along,
                      double thickness, Eigen::Vector3d const& colour) {
  constexpr int sides = 8;
  const double length = along.norm();
  if (!(length > 0)) return;
  const Eigen::Vector3d u = along / length, a = u.unitOrthogonal(), b = u.cross(a);
  const double head = std::min(4 * thickness, length / 2);
  const Eigen::Vector3d neck = from + (length - head) * u, tip = from + along;
  for (int k = 0; k < sides; ++k) {
    auto round = [&](int i) -> Eigen::Vector3d {
      const double angle = 2 * std::numbers::pi * i / sides;
      return std::cos(angle) * a + std::sin(angle) * b;
    };
    const Eigen::Vector3d r = round(k), s = round(k + 1);
    auto face = [&](Eigen::Vector3d const& p,
                    Eigen::Vector3d const& pn,
                    Eigen::Vector3d const& q,
                    Eigen::Vector3d const& qn,
                    Eigen::Vector3d const& t,
                    Eigen::Vector3d const& tn) {
      mesh.addCorner(p, pn, colour);
      mesh.addCorner(q, qn, colour);
      mesh.addCorner(t, tn, colour);
    };
    const double thin = 0.4 * thickness;
    face(from + thin * r, r, from + thin * s, s, neck + thin * s, s);
    face(from + thin * r, r, neck + thin * s, s, neck + thin * r, r);
    face(neck + thickness * r, r, neck + thickness * s, s, tip, (r + s).normalized());
    face(neck + thickness * s, -u, neck + thickness * r, -u, neck, -u);
  }
}

/// The largest of 1, 2, 5, 10, ... that is not above a length.
inline double round_length(double length) {
  const double ten = std::pow(10., std::floor(std::log10(length)));
  for (const double of : {5., 2.})
    if (of * ten <= length) return of * ten;
  return ten;
}

}  // namespace detail

/// `radius`: of the ball around all bodies.
inline DrawnMarks drawn_marks(SeenScene const& scene, double radius) {
  DrawnMarks drawn;
  // the longest arrow of a kind is as long as a part of the scene; forces have one scale
  std::array<double, 5> longest{};
  std::array<std::size_t, 5> count{};
  for (SeenArrow const& arrow : scene.arrows) {
    auto& most = longest[std::size_t(arrow.kind)];
    most = std::max(most, arrow.vector.norm());
    ++count[std::size_t(arrow.kind)];
  }
  const double force = *std::max_element(longest.begin() + 1, longest.end());
  std::array<std::size_t, 5> seen{};
  constexpr std::size_t enough = 2000;
  for (SeenArrow const& arrow : scene.arrows) {
    const auto k = std::size_t(arrow.kind);
    if (seen[k]++ % (count[k] / enough + 1) != 0) continue;
    const double scale = 0.35 * radius / (arrow.kind == ArrowKind::velocity ? longest[0] : force);
    detail::add_arrow(drawn.mesh, arrow.from, scale * arrow.vector, 0.012 * radius, colour_of(arrow.kind));
  }
  for (std::size_t k = 0; k < longest.size(); ++k)
    if (scene.settings.arrows[k])
      drawn.words.push_back(
          text(enum_names(ArrowKind{})[k],
               ": ",
               count[k],
               count[k] == 0 ? std::string()
                             : text(", longest ", detail::number_words(longest[k]), k == 0 ? " m/s" : " N")));
  const double low = scene.legend ? scene.legend->low : 0,
               span = scene.legend && scene.legend->high > low ? scene.legend->high - low : 1;
  for (SeenLine const& spring : scene.springs) {
    const Eigen::Vector3d colour = scene.settings.colour == Quantity::stretch
                                       ? colour_of_value((spring.value - low) / span)
                                       : Eigen::Vector3d(0.35, 0.35, 0.35);
    drawn.mesh.lines.add(spring.from, colour);
    drawn.mesh.lines.add(spring.to, colour);
  }
  for (Eigen::Vector3d const& p : scene.constrained) drawn.mesh.points.add(p, {0.55, 0.0, 0.4});
  if (scene.settings.constraints) drawn.words.push_back(text("held points: ", scene.constrained.size()));
  int levels = 1;
  for (SeenBox const& box : scene.boxes) levels = std::max(levels, box.level);
  for (auto const& [lowest, highest, level] : scene.boxes) {
    // the deeper, the lighter
    const Eigen::Vector3d colour =
        Eigen::Vector3d(0.45, 0.35, 0.05) + double(level) / levels * Eigen::Vector3d(0.4, 0.4, 0.45);
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 4; ++side) {
        // an edge along the axis, at one of the four sides
        Eigen::Vector3d from = lowest, to;
        if (side & 1) from[(axis + 1) % 3] = highest[(axis + 1) % 3];
        if (side & 2) from[(axis + 2) % 3] = highest[(axis + 2) % 3];
        to = from;
        to[axis] = highest[axis];
        drawn.mesh.lines.add(from, colour);
        drawn.mesh.lines.add(to, colour);
      }
  }
  if (scene.settings.boxes) drawn.words.push_back(text("boxes: ", scene.boxes.size()));
  auto const [least, most] = scene.box();
  if (scene.settings.axes)
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d axis = 0.5 * radius * Eigen::Vector3d::Unit(c);
      constexpr std::array<std::array<double, 3>, 3> colours{
          {{0.84, 0.37, 0.0}, {0.0, 0.62, 0.45}, {0.0, 0.45, 0.70}}};
      detail::add_arrow(
          drawn.mesh, {0, 0, 0}, axis, 0.012 * radius, Eigen::Vector3d(colours[std::size_t(c)].data()));
      drawn.labels.emplace_back(1.08 * axis, std::string(1, char('x' + c)));
    }
  if (scene.settings.grid) {
    // below everything, across what is upwards
    const Eigen::Vector3d a = scene.up.unitOrthogonal(), b = scene.up.cross(a), middle = (least + most) / 2;
    double down = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d p(corner & 1 ? most.x() : least.x(),
                              corner & 2 ? most.y() : least.y(),
                              corner & 4 ? most.z() : least.z());
      down = std::max(down, (middle - p).dot(scene.up));
    }
    const double cell = detail::round_length(radius / 4);
    constexpr int cells = 8;
    const Eigen::Vector3d background = scene.settings.background.value_or(Eigen::Vector3d(1, 1, 1)),
                          ink = Eigen::Vector3d::Constant(background.mean() > 0.5 ? 0 : 1),
                          colour = 0.72 * background + 0.28 * ink;
    const Eigen::Vector3d origin = middle - down * scene.up;
    for (int k = -cells; k <= cells; ++k)
      for (const bool turned : {false, true}) {
        Eigen::Vector3d const &along = turned ? a : b, &aside = turned ? b : a;
        for (const int end : {-cells, cells})
          drawn.mesh.lines.add(origin + k * cell * aside + end * cell * along, colour);
      }
    drawn.words.push_back(text("grid: ", detail::number_words(cell), " m"));
  }
  return drawn;
}

}  // namespace sinew::view
