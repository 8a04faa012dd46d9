// SPDX-License-Identifier: BSL-1.0
#include "picture.hpp"

#include "support/drawing.hpp"

#include <sinew/io/output_file.hpp>

namespace examples {

void write_picture(LaparoscopyBodies const& bodies, std::vector<LaparoscopyPanel> const& panels,
                   std::string const& path) {
  constexpr int width = 330, height = 330;
  constexpr double scale = 880;      // pixels a metre
  constexpr double farthest = 0.02;  // displacement that is drawn in white [m]
  std::string svg;
  int left = 0;
  for (auto const& panel : panels) {
    Drawing drawing(width, height, {0.45, -0.6, 0.8}, {0, 0, 1}, {-0.005, -0.07, 0.0}, scale);
    drawing.skin(panel.liver, bodies.liver.skin, {190, 60, 45}, farthest);
    drawing.skin(panel.intestines, bodies.intestines.skin, {215, 155, 60}, farthest);
    for (auto const& e : bodies.ribs.edges)
      drawing.line(bodies.ribs.positions[std::size_t(e[0])], bodies.ribs.positions[std::size_t(e[1])], "rib");
    for (std::size_t i = 1; i < panel.shaft.size(); ++i)
      drawing.line(panel.shaft[i - 1], panel.shaft[i], "tool");
    svg += drawing.svg(panel.title, left);
    left += width;
  }
  const std::string style =
      sinew::text(".rib,.tool{fill:none;stroke-linecap:round}.rib{stroke:#999;stroke-width:",
                  20 * 0.005 * scale,
                  "}.tool{stroke:#0072b2;stroke-width:",
                  20 * 0.004 * scale,
                  '}');
  sinew::io::write_file(path, Drawing::picture(width, height, panels.size(), style, svg));
}

}  // namespace examples
