// SPDX-License-Identifier: BSL-1.0
#include "picture.hpp"

#include <sinew/core/error.hpp>
#include <sinew/io/output_file.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>

namespace examples {

namespace {

using Point = Eigen::Vector3d;

constexpr int width = 330, height = 330, title = 24;
constexpr double scale = 880;      // pixels a metre
constexpr double farthest = 0.02;  // displacement that is drawn in white [m]

/// What is drawn from far to near.
struct Stroke {
  double depth;
  std::string svg;
};

struct View {
  Point toEye = Point(0.45, -0.6, 0.8).normalized(), right = Point(0, 0, 1).cross(toEye).normalized(),
        up = toEye.cross(right), middle{-0.005, -0.07, 0.0};
  int left = 0;

  std::string at(Point const& p) const {
    const Point d = p - middle;
    char words[32];
    std::snprintf(words,
                  sizeof words,
                  "%.0f %.0f",
                  10 * (left + width / 2 + scale * right.dot(d)),
                  10 * (title + height / 2 - scale * up.dot(d)));
    return words;
  }
  void skin(std::vector<Point> const& p, sinew::Mesh const& atRest, Point const& colour,
            std::vector<Stroke>& strokes) const {
    for (auto const& t : atRest.triangles) {
      Point const &a = p[std::size_t(t[0])], &b = p[std::size_t(t[1])], &c = p[std::size_t(t[2])];
      const Point normal = (b - a).cross(c - a).normalized();
      if (!(normal.dot(toEye) > 0)) continue;
      double moved = 0;
      for (const int i : t)
        moved += (p[std::size_t(i)] - atRest.positions[std::size_t(i)]).norm() / (3 * farthest);
      const Point paint = colour + std::min(1.0, moved) * (Point(255, 255, 255) - colour);
      const Point lit = paint * (0.35 + 0.65 * std::max(0.0, normal.dot((toEye + up).normalized())));
      char fill[16];
      std::snprintf(fill, sizeof fill, "#%02x%02x%02x", int(lit.x()), int(lit.y()), int(lit.z()));
      strokes.push_back(
          {toEye.dot(Point(a + b + c)) / 3,
           sinew::text("<path fill=\"", fill, "\" d=\"M", at(a), 'L', at(b), 'L', at(c), "z\"/>\n")});
    }
  }
  // in pieces, which may be in front of and behind other things
  void line(Point const& a, Point const& b, char const* kind, std::vector<Stroke>& strokes) const {
    constexpr int pieces = 4;
    for (int i = 0; i < pieces; ++i) {
      const Point from = a + (b - a) * i / pieces, to = a + (b - a) * (i + 1) / pieces;
      strokes.push_back({toEye.dot(Point(from + to)) / 2,
                         sinew::text("<path class=\"", kind, "\" d=\"M", at(from), 'L', at(to), "\"/>\n")});
    }
  }
};

}  // namespace

void write_picture(LaparoscopyBodies const& bodies, std::vector<LaparoscopyPanel> const& panels,
                   std::string const& path) {
  std::string svg =
      sinew::text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"",
                  width * panels.size(),
                  "\" height=\"",
                  height + title,
                  "\" font-family=\"sans-serif\" font-size=\"14\">\n<style>.rib,.tool{fill:none;"
                  "stroke-linecap:round}.rib{stroke:#999;stroke-width:",
                  20 * 0.005 * scale,
                  "}.tool{stroke:#0072b2;stroke-width:",
                  20 * 0.004 * scale,
                  "}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n");
  View view;
  for (auto const& panel : panels) {
    std::vector<Stroke> strokes;
    view.skin(panel.liver, bodies.liver.skin, {190, 60, 45}, strokes);
    view.skin(panel.intestines, bodies.intestines.skin, {215, 155, 60}, strokes);
    for (auto const& e : bodies.ribs.edges)
      view.line(
          bodies.ribs.positions[std::size_t(e[0])], bodies.ribs.positions[std::size_t(e[1])], "rib", strokes);
    for (std::size_t i = 1; i < panel.shaft.size(); ++i)
      view.line(panel.shaft[i - 1], panel.shaft[i], "tool", strokes);
    std::stable_sort(
        strokes.begin(), strokes.end(), [](Stroke const& a, Stroke const& b) { return a.depth < b.depth; });
    svg += sinew::text("<text x=\"",
                       view.left + 8,
                       "\" y=\"17\">",
                       panel.title,
                       "</text>\n<svg x=\"",
                       view.left,
                       "\" y=\"",
                       title,
                       "\" width=\"",
                       width,
                       "\" height=\"",
                       height,
                       "\" viewBox=\"",
                       10 * view.left,
                       ' ',
                       10 * title,
                       ' ',
                       10 * width,
                       ' ',
                       10 * height,
                       "\" shape-rendering=\"crispEdges\">\n");
    for (auto const& s : strokes) svg += s.svg;
    svg += "</svg>\n";
    view.left += width;
  }
  sinew::io::write_file(path, svg + "</svg>\n");
}

}  // namespace examples
