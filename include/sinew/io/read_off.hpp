// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// The mesh in `content`, the text of an OFF file; `path` is for messages. See read_off().
Mesh parse_off(std::string_view path, std::string_view content);

/// Reads a surface from a file of the Geometry Center's Object File Format (.off): triangles and quads;
/// polygons with more corners are cut into fans of triangles, and colours are left out. Lines that begin with
/// # are skipped. Throws Error, with the line, on anything else, points out of range, an incomplete file.
Mesh read_off(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/cells.hpp>
#include <sinew/io/text_reader.hpp>

#include <vector>

namespace sinew::io {

SINEW_ONCE Mesh parse_off(std::string_view path, std::string_view content) {
  TextReader in(path, content);
  in.rejectBinary();
  auto skipComments = [&] {
    for (TextReader ahead = in; ahead.more() && ahead.word().starts_with('#'); ahead = in) {
      in.more();
      in.restOfLine();
    }
  };
  skipComments();
  if (in.word() != "OFF") throw in.expected("OFF, with which an OFF file begins");
  skipComments();
  const std::size_t points = in.count("the number of points", 3), faces = in.count("the number of faces", 1);
  in.restOfLine();  // the number of edges, which may be missing
  Mesh mesh;
  for (std::size_t i = 0; i < points; ++i) {
    skipComments();
    mesh.positions.push_back(in.point());
    in.restOfLine();
  }
  std::vector<Index> corners;
  for (std::size_t f = 0; f < faces; ++f) {
    skipComments();
    const std::size_t n = in.count("the number of corners of a face", 1);
    corners.clear();
    for (std::size_t k = 0; k < n; ++k) corners.push_back(in.index(points));
    if (n == 2) add_polyline(mesh, corners);
    if (n > 2) add_polygon(mesh, corners);
    in.restOfLine();  // its colour
  }
  check_mesh(path, mesh);
  return mesh;
}

SINEW_ONCE Mesh read_off(std::string const& path) { return parse_off(path, read_file(path)); }

}  // namespace sinew::io
#endif
