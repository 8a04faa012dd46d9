// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>
#include <sinew/io/base64.hpp>
#include <sinew/io/output_file.hpp>

#include <bit>
#include <vector>

namespace sinew::io {

/// A quantity at the points: `components` values a point, one point after the other.
struct PointArray {
  std::string name{};
  int components = 1;
  std::vector<double> values{};
};
using PointData = std::vector<PointArray>;

/// `word` as the value of an XML attribute. Throws Error, naming `where`, on an unprintable byte.
inline std::string xml_escaped(std::string_view where, std::string_view word) {
  std::string out;
  for (const char c : word) {
    if (static_cast<unsigned char>(c) < ' ')
      throw Error(where, text("a name has the unprintable byte ", int(c), "; choose another name"));
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

namespace detail {

/// A <DataArray>: base64 of the number of bytes and of the bytes.
template <class T>
void add_data_array(std::string& out, std::string_view type, std::string_view name, int components,
                    std::vector<T> const& values) {
  out += text("        <DataArray type=\"",
              type,
              "\" Name=\"",
              name,
              "\" NumberOfComponents=\"",
              components,
              "\" format=\"binary\">");
  const std::uint64_t size = values.size() * sizeof(T);
  Base64Encoder code(out);
  code.add(&size, sizeof size);
  code.add(values.data(), size);
  code.finish();
  out += "</DataArray>\n";
}

struct VtuCells {
  std::vector<Index> connectivity{};
  std::vector<std::int64_t> offsets{};
  std::vector<std::uint8_t> types{};

  template <class Elements>
  void add(Elements const& elements, std::uint8_t type) {
    for (auto const& e : elements) {
      connectivity.insert(connectivity.end(), e.begin(), e.end());
      offsets.push_back(std::int64_t(connectivity.size()));
      types.push_back(type);
    }
  }
};

inline void check_point_data(std::string const& path, Mesh const& mesh, PointData const& data) {
  for (std::size_t i = 0; i < data.size(); ++i) {
    PointArray const& a = data[i];
    if (a.name.empty()) throw Error(path, text("point data array ", i, " has no name; give it one"));
    if (a.components < 1 || a.values.size() != mesh.positions.size() * std::size_t(a.components))
      throw Error(path,
                  text("point data \"",
                       a.name,
                       "\" has ",
                       a.values.size(),
                       " values, but ",
                       mesh.positions.size(),
                       " points with ",
                       a.components,
                       " components are to have one each; correct its values or components"));
    for (std::size_t j = 0; j < i; ++j)
      if (data[j].name == a.name)
        throw Error(path, text("two point data arrays are named \"", a.name, "\"; rename one"));
  }
}

}  // namespace detail

/// Writes a mesh with quantities at its points for ParaView (VTK XML, unstructured grid), whole or not at
/// all. Values read back with the same bits. A mesh without elements gets a vertex a point, so that it can be
/// seen, unless `vertices` is false. Throws Error as check_mesh() and write_file() do, and if an array has no
/// name, that of another, or not components * points values.
inline void write_vtu(std::string const& path, Mesh const& mesh, PointData const& data = {},
                      bool vertices = true) {
  check_mesh(path, mesh);
  detail::check_point_data(path, mesh, data);
  // cells with the numbers of vtkCellType.h
  detail::VtuCells cells;
  cells.add(mesh.edges, 3);
  cells.add(mesh.triangles, 5);
  cells.add(mesh.quads, 9);
  cells.add(mesh.tetrahedra, 10);
  cells.add(mesh.hexahedra, 12);
  std::vector<Prism> wedges = mesh.prisms;  // VTK's first triangle is seen from outside
  for (Prism& p : wedges) std::swap_ranges(p.begin(), p.begin() + 3, p.begin() + 3);
  cells.add(wedges, 13);
  cells.add(mesh.pyramids, 14);
  cells.add(mesh.quadraticTetrahedra, 24);
  cells.add(mesh.quadraticHexahedra, 25);
  cells.add(mesh.triquadraticHexahedra, 29);
  if (vertices && cells.types.empty()) {
    std::vector<std::array<Index, 1>> points(mesh.positions.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i][0] = Index(i);
    cells.add(points, 1);
  }

  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  const std::string_view order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  std::string out =
      text("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"",
           order,
           "\" header_type=\"UInt64\">\n  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"",
           mesh.positions.size(),
           "\" NumberOfCells=\"",
           cells.types.size(),
           "\">\n");
  out += "      <Points>\n";
  detail::add_data_array(out, "Float64", "Points", 3, mesh.positions);
  out += "      </Points>\n      <Cells>\n";
  detail::add_data_array(out, "Int32", "connectivity", 1, cells.connectivity);
  detail::add_data_array(out, "Int64", "offsets", 1, cells.offsets);
  detail::add_data_array(out, "UInt8", "types", 1, cells.types);
  out += "      </Cells>\n      <PointData>\n";
  for (PointArray const& a : data)
    detail::add_data_array(out, "Float64", xml_escaped(path, a.name), a.components, a.values);
  out += "      </PointData>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
  write_file(path, out);
}

}  // namespace sinew::io
