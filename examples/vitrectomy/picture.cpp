// SPDX-License-Identifier: BSL-1.0
#include "picture.hpp"

#include <sinew/io/output_file.hpp>

#include <cstdio>

namespace examples {

void write_picture(Eye const& eye, std::vector<Panel> const& panels, double exaggeration,
                   std::string const& path) {
  constexpr int size = 300, title = 24;
  const double scale = 0.48 * size / eye.position[std::size_t(eye.retinaPoints - 1)].norm();
  std::string svg =
      sinew::text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"",
                  size * panels.size(),
                  "\" height=\"",
                  size + title,
                  "\" font-family=\"sans-serif\" font-size=\"14\">\n<rect width=\"100%\" height=\"100%\" "
                  "fill=\"white\"/>\n");
  for (std::size_t p = 0; p < panels.size(); ++p) {
    Panel const& panel = panels[p];
    auto at = [&](int i) {
      const Eigen::Vector3d natural = eye.position[std::size_t(i)],
                            x = natural + exaggeration * (panel.position[std::size_t(i)] - natural);
      char words[40];
      std::snprintf(words,
                    sizeof words,
                    "%.1f %.1f",
                    size * (double(p) + 0.5) + scale * x.x(),
                    title + size * 0.5 - scale * x.y());
      return std::string(words);
    };
    auto lines = [&](char const* color, double width, auto&& draw) {
      svg += sinew::text("<path fill=\"none\" stroke=\"", color, "\" stroke-width=\"", width, "\" d=\"");
      draw();
      svg += "\"/>\n";
    };
    auto edge = [&](int i, int j) { svg += sinew::text('M', at(i), 'L', at(j)); };
    // quads come row by row: their first two sides are all there is, but for the last row
    auto mesh = [&](bool scar) {
      for (auto const& q : eye.quads)
        if ((q[0] >= eye.retinaPoints) == scar)
          svg += sinew::text('M', at(q[1]), 'L', at(q[0]), 'L', at(q[3]));
    };
    svg += sinew::text("<text x=\"", size * p + 8, "\" y=\"17\">", panel.title, "</text>\n");
    lines("#009e73", 0.6, [&] { mesh(false); });
    lines("#d55e00", 1.2, [&] {
      for (auto const& s : panel.uncut) edge(s.first, s.second);
    });
    lines("#0072b2", 1.6, [&] {
      mesh(true);
      for (int j = 0; j < eye.sectors; ++j)
        edge(eye.retinaPoints + eye.sectors + j, eye.retinaPoints + eye.sectors + (j + 1) % eye.sectors);
    });
    lines("black\" stroke-linecap=\"round", 3, [&] {
      for (const int i : eye.fixed) svg += sinew::text('M', at(i), "h0");
    });
  }
  sinew::io::write_file(path, svg + "</svg>\n");
}

}  // namespace examples
