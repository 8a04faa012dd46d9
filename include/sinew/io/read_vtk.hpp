// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// The mesh in `content`, the text of a legacy VTK file; `path` is for messages. See read_vtk().
Mesh parse_vtk(std::string_view path, std::string_view content);

/// Reads an unstructured grid or polygonal data from a legacy VTK file (.vtk), ASCII or binary, any version.
/// Linear cells are read, vertices ignored, polygons with more than four corners cut into fans of triangles;
/// data at points and cells are ignored. Throws Error on other cells, coordinates that are not finite, points
/// out of range, an incomplete file; its line is that of the text, without what stands in binary numbers.
Mesh read_vtk(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/cells.hpp>
#include <sinew/io/text_reader.hpp>

#include <cmath>
#include <cstring>
#include <vector>

namespace sinew::io::detail {

/// Numbers of a binary file, highest byte first, one after the other.
class VtkNumbers {
 public:
  /// A type by VTK's name, in lower case; `size` bytes, 0 where it is none.
  struct Type {
    std::string_view name{};
    std::size_t size = 0;
    enum { whole, unsignedWhole, real } kind = whole;
  };
  static Type type_named(std::string_view name) {
    for (Type const& t : {Type{"float", 4, Type::real},
                          Type{"double", 8, Type::real},
                          Type{"int", 4},
                          Type{"vtkidtype", 4},  // written as an int
                          Type{"vtktypeint64", 8},
                          Type{"vtktypeint32", 4},
                          Type{"long", 8},
                          Type{"short", 2},
                          Type{"char", 1},
                          Type{"unsigned_char", 1, Type::unsignedWhole},
                          Type{"unsigned_short", 2, Type::unsignedWhole},
                          Type{"unsigned_int", 4, Type::unsignedWhole},
                          Type{"unsigned_long", 8, Type::unsignedWhole}})
      if (t.name == name) return t;
    return {};
  }

  VtkNumbers() = default;
  VtkNumbers(std::string_view bytes, Type type) : bytes_(bytes), type_(type) {}

  std::int64_t integer() {
    const std::uint64_t b = bits();
    const std::size_t unused = 64 - 8 * type_.size;
    return type_.kind == Type::whole ? std::int64_t(b << unused) >> unused : std::int64_t(b);
  }
  double real() {
    if (type_.kind != Type::real) return double(integer());
    return type_.size == 4 ? double(of_bits<float>(std::uint32_t(bits()))) : of_bits<double>(bits());
  }

 private:
  std::string_view bytes_{};
  Type type_{};

  std::uint64_t bits() {
    std::uint64_t b = 0;
    for (std::size_t k = 0; k < type_.size; ++k) b = b << 8 | static_cast<unsigned char>(bytes_[k]);
    bytes_.remove_prefix(type_.size);
    return b;
  }
  template <class T, class Bits>
  static T of_bits(Bits b) {
    static_assert(sizeof(T) == sizeof(Bits));
    T value;
    std::memcpy(&value, &b, sizeof value);
    return value;
  }
};

/// The legacy format of "VTK File Formats" (Kitware): versions 1 to 4, and 5 with its offsets.
class VtkParser {
 public:
  VtkParser(std::string_view path, std::string_view content) : in_(path, content) {}

  Mesh parse() {
    header();
    for (std::string key = next(); !key.empty(); key = next()) {
      if (key == "points") {
        points();
      } else if (key == "cells" && grid_) {
        if (!cells_.offsets.empty()) throw in_.error("is a second list of cells; keep one");
        cells_ = cells();
      } else if (key == "cell_types" && grid_) {
        cellTypes();
      } else if (key == "vertices" && !grid_) {
        add(cells(), vtk_cell::polyVertex);
      } else if (key == "lines" && !grid_) {
        add(cells(), vtk_cell::polyLine);
      } else if (key == "polygons" && !grid_) {
        add(cells(), vtk_cell::polygon);
      } else if (key == "triangle_strips" && !grid_) {
        add(cells(), vtk_cell::triangleStrip);
      } else if (key == "field") {
        skipField();
      } else if (key == "metadata") {
        skipMetadata();
      } else if (key == "point_data" || key == "cell_data") {
        break;  // nothing of the mesh comes after it
      } else {
        throw in_.expected(grid_ ? "POINTS, CELLS or CELL_TYPES"
                                 : "POINTS, VERTICES, LINES, POLYGONS or TRIANGLE_STRIPS");
      }
    }
    if (mesh_.positions.empty()) throw in_.error("there are no POINTS; get a complete file");
    if (grid_ && !hasTypes_)
      throw in_.error(
          "an unstructured grid needs CELLS and CELL_TYPES, but a list is missing; get a complete file");
    return std::move(mesh_);
  }

 private:
  struct Cells {
    std::vector<std::size_t> offsets{};  // one more than there are cells
    std::vector<Index> points{};
  };

  // keywords do not depend on case
  std::string next() { return lower_case(in_.word()); }

  void header() {
    if (!in_.restOfLine().starts_with("# vtk DataFile Version"))
      throw in_.error("does not begin with \"# vtk DataFile Version\"; name a legacy VTK file (.vtk)");
    in_.restOfLine();  // title
    const std::string encoding = next();
    binary_ = encoding == "binary";
    if (!binary_ && encoding != "ascii") throw in_.expected("ASCII or BINARY");
    if (!binary_) in_.rejectBinary();
    if (next() != "dataset") throw in_.expected("DATASET");
    const std::string kind = next();
    grid_ = kind == "unstructured_grid";
    if (!grid_ && kind != "polydata") throw in_.expected("UNSTRUCTURED_GRID or POLYDATA");
  }

  void points() {
    if (!mesh_.positions.empty()) throw in_.error("is a second list of points; keep one");
    const std::size_t n = in_.count("the number of points", 3);
    begin(3 * n, next());
    for (std::size_t i = 0; i < n; ++i) {
      Eigen::Vector3d p;
      for (double& c : p) c = coordinate();
      mesh_.positions.push_back(p);
    }
  }

  // `n` numbers of a type come next: words, or bytes after the end of the line
  void begin(std::size_t n, std::string_view type) {
    if (!binary_) return;
    const auto t = VtkNumbers::type_named(type);
    if (t.size == 0)
      throw in_.error(text("has binary numbers of a type ", in_quotes(type), "; export it as ASCII"));
    numbers_ = VtkNumbers(in_.bytesAfterLine(n, t.size), t);
  }
  std::int64_t integer(std::string_view what) { return binary_ ? numbers_.integer() : in_.integer(what); }
  double coordinate() {
    const double c = binary_ ? numbers_.real() : in_.real("a coordinate");
    if (!std::isfinite(c))
      throw in_.error(text(
          "point ", mesh_.positions.size(), " has a coordinate that is not a finite number; correct it"));
    return c;
  }

  // "n size", then for each cell the number of its points and they; or "n + 1, size", OFFSETS, CONNECTIVITY
  Cells cells() {
    Cells list;
    const std::size_t n = in_.count("the number of cells", 1);
    const std::size_t size = in_.count("the size of the list of cells", 1);
    TextReader ahead = in_;
    if (lower_case(ahead.word()) == "offsets") {
      in_.word();  // OFFSETS
      begin(n, next());
      for (std::size_t c = 0; c < n; ++c) {
        const std::int64_t offset = integer("an offset into CONNECTIVITY");
        if (offset < (c == 0 ? 0 : std::int64_t(list.offsets.back())) || std::size_t(offset) > size ||
            (c == 0 && offset))
          throw in_.error(text("offsets rise from 0 to the ",
                               size,
                               " entries of CONNECTIVITY, found ",
                               offset,
                               "; correct it"));
        list.offsets.push_back(std::size_t(offset));
      }
      if (list.offsets.empty()) list.offsets.push_back(0);
      if (list.offsets.back() != size)
        throw in_.error(text("the last offset is ",
                             list.offsets.back(),
                             ", but CONNECTIVITY has ",
                             size,
                             " entries; correct the file"));
      if (next() != "connectivity") throw in_.expected("CONNECTIVITY");
      begin(size, next());
      for (std::size_t k = 0; k < size; ++k) list.points.push_back(point());
    } else {
      begin(size, "int");
      list.offsets.push_back(0);
      for (std::size_t c = 0; c < n; ++c) {
        const std::size_t k = binary_ ? corners(c, size - std::min(size, c + list.points.size()))
                                      : in_.count("the number of points of a cell", 1);
        for (std::size_t i = 0; i < k; ++i) list.points.push_back(point());
        list.offsets.push_back(list.points.size());
      }
      if (n + list.points.size() != size)
        throw in_.error(text("the list of cells has ",
                             n + list.points.size(),
                             " numbers, but ",
                             size,
                             " are announced; correct the number, or get a complete file"));
    }
    return list;
  }
  Index point() { return in_.checkedIndex(integer("the number of a point"), mesh_.positions.size()); }
  // of a cell in a binary list that has so many numbers left
  std::size_t corners(std::size_t cell, std::size_t left) {
    const std::int64_t k = left > 0 ? numbers_.integer() : 0;
    if (left == 0 || k < 0 || std::size_t(k) >= left)
      throw in_.error(text("cell ", cell, " goes beyond the end of the list of cells; get a complete file"));
    return std::size_t(k);
  }

  void cellTypes() {
    const std::size_t n = in_.count("the number of cell types", 1);
    if (hasTypes_ || cells_.offsets.size() != n + 1)
      throw in_.error(text("there are ",
                           n,
                           " cell types, but the CELLS before them are ",
                           cells_.offsets.size() - !cells_.offsets.empty(),
                           "; correct the file"));
    hasTypes_ = true;
    begin(n, "int");
    for (std::size_t c = 0; c < n; ++c) add(cells_, c, integer("a cell type"));
  }
  void add(Cells const& list, std::size_t c, std::int64_t type) {
    const std::span<Index const> p{list.points.data() + list.offsets[c],
                                   list.offsets[c + 1] - list.offsets[c]};
    if (const std::string wrong = add_vtk_cell(mesh_, type, p); !wrong.empty())
      throw in_.error(text("cell ", c, ' ', wrong));
  }
  void add(Cells const& list, std::int64_t type) {
    for (std::size_t c = 0; c + 1 < list.offsets.size(); ++c) add(list, c, type);
  }

  // FIELD name n, then n arrays "name components tuples type" with their values
  void skipField() {
    in_.word();
    const std::size_t arrays = in_.count("the number of arrays", 4);
    for (std::size_t a = 0; a < arrays; ++a) {
      if (next() == "metadata") skipMetadata(), in_.word();
      const std::size_t components = in_.count("the number of components", 1);
      const std::size_t tuples = in_.count("the number of tuples", 1);
      const std::string type = next();
      if (tuples > 0 && components > std::numeric_limits<std::size_t>::max() / tuples)
        throw in_.error("the numbers of components and tuples are impossible; correct them");
      if (binary_) {
        skipBinary(components * tuples, type);
        continue;
      }
      const bool lines = type == "string";  // each value is a line
      if (lines) in_.restOfLine();
      for (std::size_t k = 0; k < components; ++k)
        for (std::size_t t = 0; t < tuples; ++t) {
          if (!lines && in_.word().empty()) throw in_.expected("a value of a field");
          if (lines && in_.atEnd()) throw in_.error("the data end inside a FIELD; get a complete file");
          if (lines) in_.restOfLine();
        }
    }
  }
  void skipBinary(std::size_t n, std::string_view type) {
    if (type == "bit") {
      in_.bytesAfterLine((n + 7) / 8, 1);
    } else if (type != "string") {
      begin(n, type);
    } else {
      // before each string its length: the first two bits say in how many bytes, 8, 4, 2 or 1
      in_.bytesAfterLine(0, 1);
      for (std::size_t i = 0; i < n; ++i) {
        const auto first = static_cast<unsigned char>(in_.bytes(1, 1)[0]);
        std::size_t length = first & 0x3f;
        for (const char c : in_.bytes((std::size_t(8) >> (first >> 6)) - 1, 1))
          length = length << 8 | static_cast<unsigned char>(c);
        in_.bytes(length, 1);
      }
    }
  }
  // up to an empty line
  void skipMetadata() {
    in_.restOfLine();
    while (!in_.atEnd() && !in_.restOfLine().empty()) {
    }
  }

  TextReader in_;
  Mesh mesh_{};
  Cells cells_{};
  VtkNumbers numbers_{};
  bool grid_ = false, hasTypes_ = false, binary_ = false;
};

}  // namespace sinew::io::detail

namespace sinew::io {

SINEW_ONCE Mesh parse_vtk(std::string_view path, std::string_view content) {
  Mesh mesh = detail::VtkParser(path, content).parse();
  check_mesh(path, mesh);
  orient_wedges(mesh);
  return mesh;
}

SINEW_ONCE Mesh read_vtk(std::string const& path) { return parse_vtk(path, read_file(path)); }

}  // namespace sinew::io
#endif
