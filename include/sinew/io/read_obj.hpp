// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// The mesh in `content`, the text of an OBJ file; `path` is for messages. See read_obj().
Mesh parse_obj(std::string_view path, std::string_view content);

/// Reads the polygons of a Wavefront OBJ file: vertices (v), triangles, quads and larger polygons (f; the
/// latter as fans of triangles, which fits convex ones), lines (l, as edges). Texture coordinates, normals,
/// groups and materials are ignored. Throws Error with the line on other keywords, coordinates that are not
/// finite, unknown vertices.
Mesh read_obj(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/cells.hpp>
#include <sinew/io/text_reader.hpp>

#include <vector>

namespace sinew::io::detail {

/// Wavefront OBJ, as the appendix B1 of the Advanced Visualizer manual describes it.
class ObjParser {
 public:
  ObjParser(std::string_view path, std::string_view content) : in_(path, content) {}

  Mesh parse() {
    in_.rejectBinary();
    for (; !in_.atEnd(); in_.restOfLine()) {
      const std::string_view key = word();
      if (key == "v") {
        vertex();
      } else if (key == "f") {
        if (corners() < 3) throw in_.error("a face has fewer than three points; write lines as \"l\"");
        add_polygon(mesh_, corners_);
      } else if (key == "l") {
        if (corners() < 2) throw in_.error("a line has fewer than two points; add one or remove the line");
        add_polyline(mesh_, corners_);
      } else if (!key.empty() && !ignored(key)) {
        throw in_.expected("v, f, l or another keyword of polygonal OBJ files");
      }
    }
    if (mesh_.positions.empty()) throw in_.error("there are no vertices (lines \"v x y z\"); export a mesh");
    if (greatest_ >= std::int64_t(mesh_.positions.size()))
      throw in_.error(greatestLine_,
                      text("vertex ",
                           greatest_ + 1,
                           " does not exist: there are ",
                           mesh_.positions.size(),
                           " vertices, numbered from 1; correct the number or add the vertex"));
    return std::move(mesh_);
  }

 private:
  // looks, groups and points, of which a Mesh knows nothing
  static bool ignored(std::string_view key) {
    constexpr std::string_view keys =
        " vt vn vp o g s p mg usemtl mtllib usemap maplib bevel c_interp d_interp lod shadow_obj trace_obj ";
    return keys.find(text(' ', key, ' ')) != keys.npos;
  }

  // next word of the line, up to a comment
  std::string_view word() {
    const std::string_view w = in_.wordOnLine();
    return w.starts_with('#') ? std::string_view{} : w;
  }
  void vertex() {
    Eigen::Vector3d p;
    for (double& c : p) {
      const std::string_view w = word();
      if (w.empty() || !parse_number(w, c)) throw in_.expected("a coordinate");
      if (!std::isfinite(c))
        throw in_.error(text("the coordinate ", in_quotes(w), " is not a finite number; correct it"));
    }
    mesh_.positions.push_back(p);
  }
  // the points of a face or line: "7", "7/2", "7//3", "7/2/3"; a negative one counts back from the last
  // vertex
  std::size_t corners() {
    corners_.clear();
    for (std::string_view w = word(); !w.empty(); w = word()) {
      std::int64_t i = 0;
      if (!parse_number(w.substr(0, w.find('/')), i) || w.find_first_not_of("0123456789/+-") != w.npos)
        throw in_.expected("the number of a vertex, such as 7 or 7/2/3");
      const auto n = std::int64_t(mesh_.positions.size());
      if (i == 0 || i < -n)
        throw in_.error(text("vertex ",
                             i,
                             " does not exist: vertices are numbered from 1, or from -1 backwards; ",
                             "correct the number"));
      const std::int64_t index = i > 0 ? i - 1 : n + i;
      if (index > greatest_) greatest_ = index, greatestLine_ = in_.line();  // its vertex may come later
      corners_.push_back(Index(std::min<std::int64_t>(index, std::numeric_limits<Index>::max())));
    }
    return corners_.size();
  }

  TextReader in_;
  Mesh mesh_{};
  std::vector<Index> corners_{};
  std::int64_t greatest_ = -1;  // of all indices used
  std::size_t greatestLine_ = 0;
};

}  // namespace sinew::io::detail

namespace sinew::io {

SINEW_ONCE Mesh parse_obj(std::string_view path, std::string_view content) {
  Mesh mesh = detail::ObjParser(path, content).parse();
  check_mesh(path, mesh);
  return mesh;
}

SINEW_ONCE Mesh read_obj(std::string const& path) { return parse_obj(path, read_file(path)); }

}  // namespace sinew::io
#endif
