// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/core/mesh.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace examples {

/// A panel of an SVG picture: surfaces and lines in parallel projection, drawn from far to near.
class Drawing {
 public:
  using Point = Eigen::Vector3d;

  /// `above`: what is drawn upwards; `middle`: what is drawn in the middle of a panel of `width` x `height`
  /// pixels; `scale`: pixels a metre.
  Drawing(int width, int height, Point const& toEye, Point const& above, Point const& middle, double scale)
      : width_(width),
        height_(height),
        scale_(scale),
        toEye_(toEye.normalized()),
        right_(above.cross(toEye_).normalized()),
        up_(toEye_.cross(right_)),
        middle_(middle) {}

  /// Triangles whose corners are now at `p`; the farther they are from where `atRest` has them, the whiter,
  /// and white from `farthest` metres on.
  void skin(std::vector<Point> const& p, sinew::Mesh const& atRest, Point const& colour, double farthest) {
    for (auto const& t : atRest.triangles) {
      Point const &a = p[std::size_t(t[0])], &b = p[std::size_t(t[1])], &c = p[std::size_t(t[2])];
      const Point normal = (b - a).cross(c - a).normalized();
      if (!(normal.dot(toEye_) > 0)) continue;
      double moved = 0;
      for (const int i : t)
        moved += (p[std::size_t(i)] - atRest.positions[std::size_t(i)]).norm() / (3 * farthest);
      const Point paint = colour + std::min(1.0, moved) * (Point(255, 255, 255) - colour);
      const Point lit = paint * (0.35 + 0.65 * std::max(0.0, normal.dot((toEye_ + up_).normalized())));
      char fill[16];
      std::snprintf(fill, sizeof fill, "#%02x%02x%02x", int(lit.x()), int(lit.y()), int(lit.z()));
      strokes_.push_back(
          {toEye_.dot(Point(a + b + c)) / 3,
           sinew::text("<path fill=\"", fill, "\" d=\"M", at(a), 'L', at(b), 'L', at(c), "z\"/>\n")});
    }
  }
  /// A line of a class of the picture's style, in pieces, which may be in front of and behind other things.
  void line(Point const& a, Point const& b, char const* kind) {
    constexpr int pieces = 4;
    for (int i = 0; i < pieces; ++i) {
      const Point from = a + (b - a) * i / pieces, to = a + (b - a) * (i + 1) / pieces;
      strokes_.push_back({toEye_.dot(Point(from + to)) / 2,
                          sinew::text("<path class=\"", kind, "\" d=\"M", at(from), 'L', at(to), "\"/>\n")});
    }
  }

  /// The panel below a title, `left` pixels from the left of the picture.
  std::string svg(std::string const& title, int left) {
    std::stable_sort(
        strokes_.begin(), strokes_.end(), [](Stroke const& a, Stroke const& b) { return a.depth < b.depth; });
    std::string all = sinew::text("<text x=\"", left + 8, "\" y=\"17\">", title, "</text>\n<svg x=\"", left);
    all += sinew::text("\" y=\"", titleHeight, "\" width=\"", width_, "\" height=\"", height_);
    all += sinew::text("\" viewBox=\"0 0 ", 10 * width_, ' ', 10 * height_);
    all += "\" shape-rendering=\"crispEdges\">\n";
    for (auto const& s : strokes_) all += s.svg;
    return all + "</svg>\n";
  }

  /// A picture of panels of width x height pixels side by side. `style`: of the classes of lines.
  static std::string picture(int width, int height, std::size_t count, std::string const& style,
                             std::string const& panels) {
    return sinew::text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"",
                       std::size_t(width) * count,
                       "\" height=\"",
                       height + titleHeight,
                       "\" font-family=\"sans-serif\" font-size=\"14\">\n<style>",
                       style,
                       "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                       panels,
                       "</svg>\n");
  }

 private:
  struct Stroke {
    double depth;
    std::string svg;
  };
  static constexpr int titleHeight = 24;
  int width_, height_;
  double scale_;
  Point toEye_, right_, up_, middle_;
  std::vector<Stroke> strokes_;

  std::string at(Point const& p) const {
    const Point d = p - middle_;
    char words[32];
    std::snprintf(words,
                  sizeof words,
                  "%.0f %.0f",
                  10 * (width_ / 2 + scale_ * right_.dot(d)),
                  10 * (height_ / 2 - scale_ * up_.dot(d)));
    return words;
  }
};

}  // namespace examples
