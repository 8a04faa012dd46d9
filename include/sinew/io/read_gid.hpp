// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// The mesh in `content`, the text of a mesh of GiD; `path` is for messages. See read_gid().
Mesh parse_gid(std::string_view path, std::string_view content);

/// Reads a mesh of the preprocessor GiD as text: MESH dimension, ElemType, Nnode, then Coordinates and
/// Elements, whose numbers count from 1. Linear elements: Linear, Triangle, Quadrilateral, Tetrahedra and
/// Hexahedra; of quadratic ones the corners are read. Throws Error, with the line, on anything else, points
/// out of range, an incomplete file.
Mesh read_gid(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>

#include <algorithm>
#include <map>
#include <vector>

namespace sinew::io {

SINEW_ONCE Mesh parse_gid(std::string_view path, std::string_view content) {
  TextReader in(path, content);
  in.rejectBinary();
  auto word = [&] { return lower_case(in.word()); };
  auto keyword = [&](std::string_view wanted) {
    if (word() != wanted) throw in.expected(wanted);
  };
  keyword("mesh");
  // a name may stand before "dimension"
  std::string next = word();
  while (next != "dimension")
    if (next = word(); next.empty()) throw in.expected("dimension");
  const std::int64_t dimension = in.integer("the dimension");
  if (dimension < 1 || dimension > 3) throw in.error("the dimension must be 1, 2 or 3; correct it");
  keyword("elemtype");
  struct Kind {
    std::string_view name;
    std::size_t corners, more, evenMore;  // numbers of points of one element
  };
  static constexpr Kind kinds[] = {{"linear", 2, 3, 3},
                                   {"triangle", 3, 6, 6},
                                   {"quadrilateral", 4, 8, 9},
                                   {"tetrahedra", 4, 10, 10},
                                   {"hexahedra", 8, 20, 27}};
  const std::string named = word();
  auto const* kind =
      std::find_if(std::begin(kinds), std::end(kinds), [&](Kind const& k) { return k.name == named; });
  if (kind == std::end(kinds))
    throw in.error(text("elements of the type ",
                        in_quotes(named),
                        " are not read; take Linear, Triangle, Quadrilateral, Tetrahedra or Hexahedra"));
  keyword("nnode");
  const std::int64_t nodes = in.integer("the number of points of an element");
  const auto each = std::size_t(std::max<std::int64_t>(nodes, 0));
  if (each != kind->corners && each != kind->more && each != kind->evenMore)
    throw in.error(text("an element of this type has not ", nodes, " points; correct Nnode"));

  Mesh mesh;
  keyword("coordinates");
  std::map<std::int64_t, Index> number;  // of a point in the mesh
  for (TextReader ahead = in; lower_case(ahead.word()) != "end"; ahead = in) {
    const std::int64_t id = in.integer("the number of a point, or End Coordinates");
    if (!number.try_emplace(id, Index(mesh.positions.size())).second)
      throw in.error(text("point ", id, " is there twice; remove one"));
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (int c = 0; c < dimension; ++c) p[c] = in.real("a coordinate");
    in.restOfLine();
    mesh.positions.push_back(p);
  }
  keyword("end"), keyword("coordinates");
  keyword("elements");
  std::vector<Index> corners;
  for (TextReader ahead = in; lower_case(ahead.word()) != "end"; ahead = in) {
    in.integer("the number of an element, or End Elements");
    corners.clear();
    for (std::size_t k = 0; k < each; ++k) {
      const std::int64_t id = in.integer("the number of a point");
      const auto known = number.find(id);
      if (known == number.end())
        throw in.error(
            text("point ", id, " is not among the coordinates; correct the number or add the point"));
      corners.push_back(known->second);
    }
    in.restOfLine();  // a material
    auto add = [&]<class Element>(std::vector<Element>& list) {
      std::copy_n(corners.begin(), std::tuple_size_v<Element>, list.emplace_back().begin());
    };
    if (named == "linear") add(mesh.edges);
    if (named == "triangle") add(mesh.triangles);
    if (named == "quadrilateral") add(mesh.quads);
    if (named == "tetrahedra") add(mesh.tetrahedra);
    if (named == "hexahedra") add(mesh.hexahedra);
  }
  keyword("end"), keyword("elements");
  check_mesh(path, mesh);
  return mesh;
}

SINEW_ONCE Mesh read_gid(std::string const& path) { return parse_gid(path, read_file(path)); }

}  // namespace sinew::io
#endif
