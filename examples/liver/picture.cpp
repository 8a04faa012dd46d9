// SPDX-License-Identifier: BSL-1.0
#include "picture.hpp"

#include "support/drawing.hpp"

#include <sinew/io/output_file.hpp>

#include <Eigen/Geometry>

namespace examples {

void write_picture(sinew::Mesh const& atRest, sinew::Mesh const& now, double time, std::string const& path) {
  // both states in the same frame
  Eigen::AlignedBox3d box;
  for (auto const* mesh : {&atRest, &now})
    for (auto const& p : mesh->positions) box.extend(p);
  double farthest = 0;
  for (std::size_t i = 0; i < now.positions.size(); ++i)
    farthest = std::max(farthest, (now.positions[i] - atRest.positions[i]).norm());
  constexpr int width = 480, height = 400;
  const double scale = 0.9 * height / std::max(box.diagonal().norm(), 1e-12);
  std::string svg;
  int left = 0;
  for (auto const* mesh : {&atRest, &now}) {
    Drawing drawing(width, height, {0.3, 0.35, 1}, {0, 1, 0}, box.center(), scale);
    // twice as far as anything went is white, so that the shape is seen everywhere
    drawing.skin(mesh->positions, atRest, {165, 50, 40}, std::max(2 * farthest, 1e-12));
    svg += drawing.svg(left == 0 ? "at rest" : sinew::text("under gravity, after ", time, " s"), left);
    left += width;
  }
  sinew::io::write_file(path, Drawing::picture(width, height, 2, "", svg));
}

}  // namespace examples
