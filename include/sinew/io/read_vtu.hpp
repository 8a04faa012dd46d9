// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs pugixml, as vtk_xml.hpp does.
#include <sinew/io/cells.hpp>
#include <sinew/io/vtk_xml.hpp>

namespace sinew::io {

namespace detail {

class VtuParser {
 public:
  VtuParser(std::string_view path, std::string_view content, std::string_view type)
      : file_(path, content, type) {}

  Mesh parse() {
    const std::string_view held = file_.root().attribute("type").value();
    if (held != "UnstructuredGrid" && held != "PolyData")
      throw Error(file_.at(file_.root()),
                  text("holds ", in_quotes(held), "; name a file that holds UnstructuredGrid or PolyData"));
    for (const auto piece : file_.root().child(held.data()).children("Piece")) {
      const std::size_t first = mesh_.positions.size();
      points(piece);
      if (held == "UnstructuredGrid") {
        cells(piece, Index(first));
        continue;
      }
      cells(piece, Index(first), "Lines", "NumberOfLines", vtk_cell::polyLine);
      cells(piece, Index(first), "Polys", "NumberOfPolys", vtk_cell::polygon);
      cells(piece, Index(first), "Strips", "NumberOfStrips", vtk_cell::triangleStrip);
    }
    if (mesh_.positions.empty()) throw Error(file_.at(file_.root()), "holds no points; export a mesh");
    return std::move(mesh_);
  }

 private:
  using Node = pugi::xml_node;

  void points(Node piece) {
    const std::uint64_t n = file_.number(piece, "NumberOfPoints");
    if (n == 0) return;
    const Node array = existing(piece.child("Points").child("DataArray"), piece, "<Points>");
    const auto x = file_.values<double>(array, n, 3);
    if (mesh_.positions.size() + x.size() / 3 > std::size_t(std::numeric_limits<Index>::max()))
      throw Error(file_.at(piece), "has more points than can be numbered; split the mesh");
    for (std::size_t i = 0; i < x.size(); i += 3) {
      mesh_.positions.emplace_back(x[i], x[i + 1], x[i + 2]);
      if (!all_finite(mesh_.positions.back()))
        throw Error(file_.at(array),
                    text("point ", i / 3, " has a coordinate that is not a finite number; correct it"));
    }
  }

  // offsets[c] is where cell c ends in the connectivity; `type`: of all, or none where the file has them
  void cells(Node piece, Index first, char const* list = "Cells", char const* count = "NumberOfCells",
             std::int64_t type = vtk_cell::empty) {
    if (type != vtk_cell::empty && !piece.attribute(count)) return;
    const std::uint64_t n = file_.number(piece, count), points = mesh_.positions.size() - std::size_t(first);
    if (n == 0) return;
    auto array = [&](char const* name) {
      return existing(piece.child(list).find_child_by_attribute("DataArray", "Name", name), piece, name);
    };
    const Node cornerArray = array("connectivity"), offsetArray = array("offsets"),
               typeArray = type == vtk_cell::empty ? array("types") : offsetArray;
    const auto connectivity = file_.values<std::int64_t>(cornerArray);
    const auto offsets = file_.values<std::int64_t>(offsetArray, n, 1);
    const auto types = type == vtk_cell::empty ? file_.values<std::int64_t>(typeArray, n, 1)
                                               : std::vector<std::int64_t>(offsets.size(), type);

    std::vector<Index> corners;
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < offsets.size(); begin = offsets[c++]) {
      const bool last = c + 1 == offsets.size();
      if (offsets[c] < begin || std::uint64_t(offsets[c]) > connectivity.size() ||
          (last && std::uint64_t(offsets[c]) != connectivity.size()))
        throw Error(file_.at(offsetArray),
                    text("cell ",
                         c,
                         " of ",
                         n,
                         " begins at ",
                         begin,
                         " and ends at ",
                         offsets[c],
                         " of the ",
                         connectivity.size(),
                         " numbers in connectivity; correct the file"));
      corners.clear();
      for (std::int64_t k = begin; k < offsets[c]; ++k) {
        const std::int64_t i = connectivity[std::size_t(k)];
        if (i < 0 || std::uint64_t(i) >= points)
          throw Error(file_.at(cornerArray),
                      text("cell ",
                           c,
                           " refers to point ",
                           i,
                           ", but there are ",
                           points,
                           " points, numbered from 0; correct the file"));
        corners.push_back(first + Index(i));
      }
      if (const std::string wrong = add_vtk_cell(mesh_, types[c], corners); !wrong.empty())
        throw Error(file_.at(typeArray), text("cell ", c, ' ', wrong));
    }
  }

  Node existing(Node array, Node piece, std::string_view what) const {
    if (!array) throw Error(file_.at(piece), text("has no DataArray for ", what, "; get a complete file"));
    return array;
  }

  VtkXml file_;
  Mesh mesh_{};
};

}  // namespace detail

/// The mesh in `content`, the bytes of a VTU file; `path` is for messages. See read_vtu().
inline Mesh parse_vtu(std::string_view path, std::string_view content) {
  Mesh mesh = detail::VtuParser(path, content, "UnstructuredGrid").parse();
  check_mesh(path, mesh);
  orient_wedges(mesh);
  return mesh;
}
/// The same of an unstructured grid or of polygonal data (.vtp).
inline Mesh parse_vtk_xml(std::string_view path, std::string_view content) {
  Mesh mesh = detail::VtuParser(path, content, "").parse();
  check_mesh(path, mesh);
  orient_wedges(mesh);
  return mesh;
}

/// Reads an unstructured grid in VTK's XML format (.vtu): ascii, inline base64 and appended (raw or base64)
/// data, uncompressed, all pieces one after the other. Linear cells, tetrahedra of 10 points and
/// hexahedra of 20 or 27 are read, faces of second order cut between their points, vertices ignored; polygons
/// with more than four corners become fans of triangles; data at points and cells are ignored. Throws Error
/// with the line on compressed arrays, other cells, coordinates that are not finite, points out of range, an
/// incomplete file.
inline Mesh read_vtu(std::string const& path) { return parse_vtu(path, read_file(path)); }

}  // namespace sinew::io
