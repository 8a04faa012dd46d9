// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>
#include <sinew/core/surface_looks.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// What an OBJ file has: a mesh, and how its faces look.
struct ObjFile {
  Mesh mesh{};
  SurfaceLooks looks{};  // empty where no face has coordinates in a texture, or a material
};

/// What `content` has, the text of an OBJ file; `path` is for messages. See read_obj_file().
ObjFile parse_obj_file(std::string_view path, std::string_view content);
Mesh parse_obj(std::string_view path, std::string_view content);

/// Reads the polygons of a Wavefront OBJ file: vertices (v), triangles, quads and larger polygons (f; the
/// latter as fans of triangles, which fits convex ones), lines (l, as edges); coordinates in a texture (vt),
/// the names of materials (usemtl) and the last of the files that have them (mtllib), which are not read.
/// Normals and groups are ignored. A file may have values, vertices with one coordinate all (v x), which have
/// 0 for y and z. Throws Error with the line on other keywords, coordinates that are not
/// finite, unknown vertices, and unknown coordinates in a texture, where the file has any.
ObjFile read_obj_file(std::string const& path);
/// The mesh alone.
Mesh read_obj(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/cells.hpp>
#include <sinew/io/text_reader.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace sinew::io::detail {

/// Wavefront OBJ, as the appendix B1 of the Advanced Visualizer manual describes it.
class ObjParser {
 public:
  ObjParser(std::string_view path, std::string_view content) : in_(path, content), path_(path) {}

  ObjFile parse() {
    in_.rejectBinary();
    for (; !in_.atEnd(); in_.restOfLine()) {
      const std::string_view key = word();
      if (key == "v") {
        vertex();
      } else if (key == "vt") {
        looks().texcoords.push_back(coordinates<2>());
      } else if (key == "f") {
        if (corners() < 3) throw in_.error("a face has fewer than three points; write lines as \"l\"");
        face();
      } else if (key == "l") {
        if (corners() < 2) throw in_.error("a line has fewer than two points; add one or remove the line");
        add_polyline(mesh(), corners_);
      } else if (key == "usemtl") {
        use(word());
      } else if (key == "mtllib") {
        if (const std::string_view name = word(); !name.empty()) looks().library = besides(name);
      } else if (!key.empty() && !ignored(key)) {
        throw in_.expected("v, f, l or another keyword of polygonal OBJ files");
      }
    }
    if (mesh().positions.empty()) throw in_.error("there are no vertices (lines \"v x y z\"); export a mesh");
    vertices_.check(in_, "vertex", "vertices", mesh().positions.size());
    finishLooks();
    return std::move(file_);
  }

 private:
  // the greatest number of a kind that is used, where the thing itself may come later
  struct Greatest {
    std::int64_t index = -1;
    std::size_t line = 0;

    void take(std::int64_t used, std::size_t at) {
      if (used > index) index = used, line = at;
    }
    void check(TextReader const& in, char const* one, char const* many, std::size_t count) const {
      if (index >= std::int64_t(count))
        throw in.error(line,
                       text(one,
                            ' ',
                            index + 1,
                            " does not exist: there are ",
                            count,
                            ' ',
                            many,
                            ", numbered from 1; correct the number or add the ",
                            one));
    }
  };

  // groups and points, of which a Mesh knows nothing, and looks beside textures and materials
  static bool ignored(std::string_view key) {
    constexpr std::string_view keys =
        " vn vp o g s p mg usemap maplib bevel c_interp d_interp lod shadow_obj trace_obj ";
    return keys.find(text(' ', key, ' ')) != keys.npos;
  }
  Mesh& mesh() { return file_.mesh; }
  SurfaceLooks& looks() { return file_.looks; }

  // next word of the line, up to a comment
  std::string_view word() {
    const std::string_view w = in_.wordOnLine();
    return w.starts_with('#') ? std::string_view{} : w;
  }
  // vertices with one coordinate are values, and all of a file are then
  void vertex() {
    bool value = false;
    const Eigen::Vector3d p = coordinates<3>(&value);
    if (mesh().positions.empty()) values_ = value;
    if (value && !values_) throw in_.expected("a coordinate");
    if (!value && values_)
      throw in_.error(
          "a vertex has three coordinates, but those before have one (values, \"v x\"); give all "
          "the same number");
    mesh().positions.push_back(p);
  }
  // those of a texture may be fewer than two, and are 0 then, as those of a vertex behind a single one
  template <int N>
  Eigen::Matrix<double, N, 1> coordinates(bool* single = nullptr) {
    Eigen::Matrix<double, N, 1> p;
    p.setZero();
    for (int k = 0; k < N; ++k) {
      const std::string_view w = word();
      if (w.empty() && k == 1 && (N == 2 || single)) {
        if (single) *single = true;
        break;
      }
      if (w.empty() || !parse_number(w, p[k])) throw in_.expected("a coordinate");
      if (!std::isfinite(p[k]))
        throw in_.error(text("the coordinate ", in_quotes(w), " is not a finite number; correct it"));
    }
    return p;
  }
  // the points of a face or line: "7", "7/2", "7//3", "7/2/3"; a negative one counts back from the last
  // vertex
  std::size_t corners() {
    corners_.clear(), textured_.clear();
    for (std::string_view w = word(); !w.empty(); w = word()) {
      if (w.find_first_not_of("0123456789/+-") != w.npos) throw badCorner();
      const std::size_t slash = std::min(w.find('/'), w.size());
      corners_.push_back(
          indexOf(w.substr(0, slash), "vertex", "vertices are", mesh().positions.size(), vertices_));
      w.remove_prefix(std::min(slash + 1, w.size()));
      w = w.substr(0, w.find('/'));
      textured_.push_back(w.empty() ? -1
                                    : indexOf(w,
                                              "texture coordinate",
                                              "texture coordinates are",
                                              looks().texcoords.size(),
                                              texcoords_));
    }
    return corners_.size();
  }
  Error badCorner() const { return in_.expected("the number of a vertex, such as 7 or 7/2/3"); }
  Index indexOf(std::string_view w, char const* one, char const* many, std::size_t count,
                Greatest& greatest) {
    std::int64_t i = 0;
    if (!parse_number(w, i)) throw badCorner();
    const auto n = std::int64_t(count);
    if (i == 0 || i < -n)
      throw in_.error(text(one,
                           ' ',
                           i,
                           " does not exist: ",
                           many,
                           " numbered from 1, or from -1 backwards; correct the number"));
    const std::int64_t index = i > 0 ? i - 1 : n + i;
    greatest.take(index, in_.line());
    return Index(std::min<std::int64_t>(index, std::numeric_limits<Index>::max()));
  }
  // numbers of texcoords are those of a mesh, too, with the same elements
  void face() {
    const std::size_t triangles = mesh().triangles.size(), quads = mesh().quads.size();
    add_polygon(mesh(), corners_);
    add_polygon(inTexture_, textured_);
    ofTriangles_.resize(ofTriangles_.size() + mesh().triangles.size() - triangles, material_);
    ofQuads_.resize(ofQuads_.size() + mesh().quads.size() - quads, material_);
  }
  void use(std::string_view name) {
    auto& names = looks().materials;
    const auto found = std::find(names.begin(), names.end(), name);
    material_ = name.empty() ? -1 : Index(found - names.begin());
    if (material_ >= 0 && found == names.end()) names.emplace_back(name);
  }
  std::string besides(std::string_view name) const {
    const std::size_t folder = name.starts_with('/') ? 0 : path_.rfind('/') + 1;  // npos + 1 is 0
    return text(path_.substr(0, folder), name);
  }
  // what no face uses is left out
  void finishLooks() {
    SurfaceLooks& of = looks();
    if (!of.texcoords.empty() && texcoords_.index >= 0) {
      texcoords_.check(in_, "texture coordinate", "texture coordinates", of.texcoords.size());
      of.triangles = std::move(inTexture_.triangles);
      of.quads = std::move(inTexture_.quads);
    } else {
      of.texcoords.clear();
    }
    of.faceMaterials = std::move(ofTriangles_);
    of.faceMaterials.insert(of.faceMaterials.end(), ofQuads_.begin(), ofQuads_.end());
    if (std::all_of(of.faceMaterials.begin(), of.faceMaterials.end(), [](Index i) { return i < 0; })) {
      of.faceMaterials.clear(), of.materials.clear(), of.library.clear();
    }
  }

  TextReader in_;
  std::string_view path_;
  ObjFile file_{};
  Mesh inTexture_{};
  std::vector<Index> corners_{}, textured_{}, ofTriangles_{}, ofQuads_{};
  Index material_ = -1;
  Greatest vertices_{}, texcoords_{};
  bool values_ = false;
};

}  // namespace sinew::io::detail

namespace sinew::io {

SINEW_ONCE ObjFile parse_obj_file(std::string_view path, std::string_view content) {
  ObjFile file = detail::ObjParser(path, content).parse();
  check_mesh(path, file.mesh);
  return file;
}
SINEW_ONCE Mesh parse_obj(std::string_view path, std::string_view content) {
  return parse_obj_file(path, content).mesh;
}

SINEW_ONCE ObjFile read_obj_file(std::string const& path) { return parse_obj_file(path, read_file(path)); }
SINEW_ONCE Mesh read_obj(std::string const& path) { return read_obj_file(path).mesh; }

}  // namespace sinew::io
#endif
