// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// The mesh in `content`, the bytes of an STL file; `path` is for messages. See read_stl().
Mesh parse_stl(std::string_view path, std::string_view content);

/// Reads the triangles of a stereolithography file, ASCII or binary. Points in exactly one place become one;
/// triangles that use a point twice are left out, as are normals. Throws Error, with the line in ASCII files,
/// on anything else, on coordinates that are not finite, on an incomplete file.
Mesh read_stl(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>

#include <bit>
#include <map>
#include <vector>

namespace sinew::io::detail {

/// Stereolithography files as 3D Systems' "StereoLithography Interface Specification" (1989) describes them:
/// triangles, each with its own copy of its points, of which those in one place become one.
class StlParser {
 public:
  StlParser(std::string_view path, std::string_view content) : path_(path), content_(content) {}

  Mesh parse() {
    if (isBinary())
      binary();
    else
      ascii();
    if (mesh_.triangles.empty())
      throw Error(path_, "has no triangle of three different points; export the surface again");
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t header = 84, record = 50;  // bytes

  // by the size that a binary file announces, for the title of some begins with "solid" too
  bool isBinary() const {
    if (content_.size() >= header && content_.size() == header + record * std::size_t(count())) return true;
    TextReader in(path_, content_);
    return lower_case(in.word()) != "solid";
  }
  std::uint32_t count() const { return number<std::uint32_t>(80); }

  // files are little-endian
  template <class T>
  T number(std::size_t at) const {
    char bytes[sizeof(T)];
    std::memcpy(bytes, content_.data() + at, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  void binary() {
    if (content_.size() < header)
      throw Error(path_,
                  text("does not begin with \"solid\", and its ",
                       content_.size(),
                       " bytes are too few for a binary STL file; name an STL file"));
    if (content_.size() != header + record * std::size_t(count()))
      throw Error(path_,
                  text("announces ",
                       count(),
                       " triangles in ",
                       header + record * std::size_t(count()),
                       " bytes, but has ",
                       content_.size(),
                       "; get a complete file, or name an STL file"));
    for (std::size_t t = 0; t < count(); ++t) {
      const std::size_t at = header + record * t + 12;  // after the normal
      Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        Eigen::Vector3d p;
        for (std::size_t c = 0; c < 3; ++c) p[Eigen::Index(c)] = number<float>(at + 4 * (3 * k + c));
        if (!all_finite(p))
          throw Error(
              path_,
              text("triangle ", t, " has a coordinate that is not a finite number; export the file again"));
        triangle[k] = point(p);
      }
      add(triangle);
    }
  }

  // solid [name], then: facet normal x y z, outer loop, 3 vertex x y z, endloop, endfacet; then endsolid
  // [name]
  void ascii() {
    TextReader in(path_, content_);
    in.rejectBinary();
    while (in.more()) {
      keyword(in, "solid");
      in.restOfLine();
      // some programs write "end solid"
      for (std::string word = lower_case(in.word()); word != "endsolid" && word != "end";
           word = lower_case(in.word())) {
        if (word != "facet") throw in.expected("facet or endsolid");
        keyword(in, "normal");
        for (int c = 0; c < 3; ++c)
          if (in.word().empty()) throw in.expected("a normal");  // not read: some are nan
        keyword(in, "outer"), keyword(in, "loop");
        Triangle triangle;
        for (Index& i : triangle) {
          keyword(in, "vertex");
          i = point(in.point());
        }
        keyword(in, "endloop"), keyword(in, "endfacet");
        add(triangle);
      }
      in.restOfLine();
    }
  }
  static void keyword(TextReader& in, std::string_view expected) {
    if (lower_case(in.word()) != expected) throw in.expected(expected);
  }

  Index point(Eigen::Vector3d const& p) {
    // -0 and 0 are one place
    const auto [at, isNew] =
        numbers_.try_emplace({p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}, Index(mesh_.positions.size()));
    if (isNew) mesh_.positions.push_back(p);
    return at->second;
  }
  void add(Triangle const& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh_.triangles.push_back(t);
  }

  std::string path_;
  std::string_view content_;
  Mesh mesh_{};
  std::map<std::array<double, 3>, Index> numbers_{};
};

}  // namespace sinew::io::detail

namespace sinew::io {

SINEW_ONCE Mesh parse_stl(std::string_view path, std::string_view content) {
  Mesh mesh = detail::StlParser(path, content).parse();
  check_mesh(path, mesh);
  return mesh;
}

SINEW_ONCE Mesh read_stl(std::string const& path) { return parse_stl(path, read_file(path)); }

}  // namespace sinew::io
#endif
