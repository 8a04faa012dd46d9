// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// The mesh in `content`, the text of a TRIAN file; `path` is for messages. See read_trian().
Mesh parse_trian(std::string_view path, std::string_view content);

/// Reads a surface from a TRIAN file (.trian): the number of points and their coordinates, then the number of
/// triangles and of each its points, counted from 0, and behind them its neighbours, which are left out.
/// Throws Error, with the line, on anything else, points out of range, an incomplete file.
Mesh read_trian(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>

namespace sinew::io {

SINEW_ONCE Mesh parse_trian(std::string_view path, std::string_view content) {
  TextReader in(path, content);
  in.rejectBinary();
  Mesh mesh;
  const std::size_t points = in.count("the number of points", 3);
  for (std::size_t i = 0; i < points; ++i) {
    mesh.positions.push_back(in.point());
    in.restOfLine();
  }
  const std::size_t triangles = in.count("the number of triangles", 3);
  for (std::size_t t = 0; t < triangles; ++t) {
    for (Index& i : mesh.triangles.emplace_back()) i = in.index(points);
    in.restOfLine();
  }
  check_mesh(path, mesh);
  return mesh;
}

SINEW_ONCE Mesh read_trian(std::string const& path) { return parse_trian(path, read_file(path)); }

}  // namespace sinew::io
#endif
