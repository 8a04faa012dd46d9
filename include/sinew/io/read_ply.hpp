// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// The mesh in `content`, the bytes of a PLY file; `path` is for messages. See read_ply().
Mesh parse_ply(std::string_view path, std::string_view content);

/// Reads a mesh from a polygon file of Stanford (.ply; Turk 1994), ASCII or binary of either byte order:
/// points of its element `vertex` (x, y, z), triangles, quads and polygons of `face` (vertex_indices or
/// vertex_index), strips of triangles of `tristrips`, and edges of `edge` (vertex1, vertex2). Polygons with
/// more than four corners are cut into fans of triangles; other elements and properties, as colours and
/// normals, are left out. Throws Error, with the line of text or the byte of binary data, on anything else,
/// coordinates that are not finite, points out of range, an incomplete file.
Mesh read_ply(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/cells.hpp>
#include <sinew/io/text_reader.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sinew::io::detail {

class PlyParser {
 public:
  PlyParser(std::string_view path, std::string_view content) : path_(path), content_(content) {}

  Mesh parse() {
    header();
    bool hasPoints = false;
    for (Element const& element : elements_)
      if (element.name == "vertex") {
        points(element);
        hasPoints = true;
      } else if (element.name == "face" || element.name == "tristrips") {
        corners(element, hasPoints);
      } else if (element.name == "edge") {
        edges(element, hasPoints);
      } else {
        for (std::size_t i = 0; i < element.count; ++i) item(element);
      }
    if (!hasPoints) throw Error(path_, "has no element vertex; export a mesh with its points");
    checkEnd();
    return std::move(mesh_);
  }

 private:
  struct Type {
    std::array<std::string_view, 2> names{};
    std::size_t size = 0;
    enum { whole, unsignedWhole, real } kind = whole;
  };
  static constexpr std::array<Type, 8> types{{{{"char", "int8"}, 1, Type::whole},
                                              {{"uchar", "uint8"}, 1, Type::unsignedWhole},
                                              {{"short", "int16"}, 2, Type::whole},
                                              {{"ushort", "uint16"}, 2, Type::unsignedWhole},
                                              {{"int", "int32"}, 4, Type::whole},
                                              {{"uint", "uint32"}, 4, Type::unsignedWhole},
                                              {{"float", "float32"}, 4, Type::real},
                                              {{"double", "float64"}, 8, Type::real}}};
  struct Property {
    std::string name{};
    Type type{};
    std::optional<Type> count{};  // of a list
  };
  struct Element {
    std::string name{};
    std::size_t count = 0, line = 0;
    std::vector<Property> properties{};

    /// Place of a property; -1: there is none.
    int find(std::string_view wanted, bool list) const {
      for (std::size_t i = 0; i < properties.size(); ++i)
        if (properties[i].name == wanted && properties[i].count.has_value() == list) return int(i);
      return -1;
    }
  };
  enum class Format { ascii, little, big };

  std::string path_;
  std::string_view content_;
  Format format_ = Format::ascii;
  std::vector<Element> elements_{};
  std::size_t at_ = 0;  // the next byte of binary data
  std::optional<TextReader> text_{};
  // of the item that was read: one value of each property, that of a list the number of its entries
  std::vector<double> values_{};
  std::vector<std::vector<double>> lists_{};
  Mesh mesh_{};

  // the line of the header that begins at a byte, without its end
  std::string_view lineAt(std::size_t begin) const {
    const std::size_t end = std::min(content_.find_first_of("\r\n", begin), content_.size());
    return content_.substr(begin, end - begin);
  }
  std::size_t behindLine(std::size_t begin) const {
    std::size_t end = begin + lineAt(begin).size();
    if (content_.substr(end, 2) == "\r\n") return end + 2;
    return std::min(end + 1, content_.size());
  }

  void header() {
    std::size_t line = 1, at = 0;
    if (lineAt(0) != "ply")
      throw Error(text(path_, ":1"), "does not begin with a line \"ply\"; name a PLY file");
    bool formatted = false, ended = false;
    for (at = behindLine(0); at < content_.size() && !ended; at = behindLine(at)) {
      TextReader in(path_, lineAt(at), ++line);
      in.rejectBinary();
      const std::string word(in.word());
      if (word == "comment" || word == "obj_info" || word.empty()) continue;
      if (word == "format") {
        format(in);
        formatted = true;
      } else if (word == "element") {
        Element element;
        element.name = in.word();
        element.line = line;
        const std::int64_t n = in.integer(text("the number of items of element ", in_quotes(element.name)));
        // an item has a byte at least
        if (n < 0 || std::uint64_t(n) > content_.size())
          throw in.error(text("element ",
                              in_quotes(element.name),
                              " is given ",
                              n,
                              " items, but the file has ",
                              content_.size(),
                              " bytes; correct the number, or get a complete file"));
        element.count = std::size_t(n);
        elements_.push_back(std::move(element));
      } else if (word == "property") {
        if (elements_.empty()) throw in.error("the property stands before any element; put it behind one");
        elements_.back().properties.push_back(property(in));
      } else if (word == "end_header") {
        ended = true;
      } else {
        throw in.expected("format, element, property, comment or end_header");
      }
      if (in.more()) {
        in.word();
        throw in.expected("the end of the line");
      }
    }
    if (!ended) throw Error(text(path_, ':', line), "the header has no end_header; get a complete file");
    if (!formatted)
      throw Error(path_, "the header has no format; add \"format ascii 1.0\", or export it again");
    for (Element const& e : elements_)
      if (e.count > 0 && e.properties.empty())
        throw Error(text(path_, ':', e.line),
                    text("element ", in_quotes(e.name), " has no property; add one, or remove it"));
    at_ = at;
    if (format_ != Format::ascii) return;
    text_.emplace(path_, content_.substr(at), line + 1);
    text_->rejectBinary();
  }
  void format(TextReader& in) {
    const std::string name(in.word());
    if (name == "ascii")
      format_ = Format::ascii;
    else if (name == "binary_little_endian")
      format_ = Format::little;
    else if (name == "binary_big_endian")
      format_ = Format::big;
    else
      throw in.expected("ascii, binary_little_endian or binary_big_endian");
    if (in.word() != "1.0") throw in.expected("1.0, the version of the format");
  }
  static Property property(TextReader& in) {
    auto type = [&](std::string_view name) {
      for (Type const& t : types)
        if (t.names[0] == name || t.names[1] == name) return t;
      throw in.expected("a type (char, uchar, short, ushort, int, uint, float, double)");
    };
    Property p;
    std::string_view word = in.word();
    if (word == "list") {
      p.count = type(in.word());
      if (p.count->kind == Type::real)
        throw in.error("the number of entries of a list is of a real type; make it uchar");
      word = in.word();
    }
    p.type = type(word);
    p.name = in.word();
    if (p.name.empty()) throw in.expected("the name of the property");
    return p;
  }

  // "path:line", or in binary data the byte
  Error error(std::string_view message) const {
    if (text_) return text_->error(message);
    return Error(text(path_, ": byte ", at_), message);
  }
  double number(Type const& type, std::string_view what) {
    if (text_) {
      if (type.kind != Type::real) return double(text_->integer(what));
      double value = 0;
      if (!parse_number(text_->word(), value)) throw text_->expected(what);
      return value;
    }
    if (content_.size() - at_ < type.size)
      throw error(text("the data end where ", what, " is expected; get a complete file"));
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < type.size; ++k) {
      const std::size_t from = format_ == Format::big ? k : type.size - 1 - k;
      bits = bits << 8 | static_cast<unsigned char>(content_[at_ + from]);
    }
    at_ += type.size;
    if (type.kind == Type::real)
      return type.size == 8 ? std::bit_cast<double>(bits) : double(std::bit_cast<float>(std::uint32_t(bits)));
    if (type.kind == Type::unsignedWhole) return double(bits);
    const std::size_t unused = 64 - 8 * type.size;
    return double(std::int64_t(bits << unused) >> unused);
  }
  std::size_t room() const { return content_.size() - (text_ ? 0 : at_); }

  // reads an item
  void item(Element const& element) {
    values_.resize(element.properties.size());
    lists_.resize(std::max(lists_.size(), element.properties.size()));
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      Property const& p = element.properties[i];
      if (!p.count) {
        values_[i] = number(p.type, text("the property ", p.name, " of element ", element.name));
        continue;
      }
      const double n = number(*p.count, text("the number of entries of ", p.name));
      if (!(n >= 0) || n * double(text_ ? 1 : p.type.size) > double(room()))
        throw error(text("the list ",
                         p.name,
                         " of element ",
                         element.name,
                         " is given ",
                         n,
                         " entries, but ",
                         room(),
                         " bytes are there; correct the number, or get a complete file"));
      lists_[i].clear();
      for (double k = 0; k < n; ++k) lists_[i].push_back(number(p.type, text("an entry of ", p.name)));
      values_[i] = n;
    }
  }
  [[noreturn]] void lacks(Element const& element, std::string_view what) const {
    throw Error(text(path_, ':', element.line),
                text("element ", element.name, " has no ", what, "; export the mesh again"));
  }

  void points(Element const& element) {
    if (!mesh_.positions.empty())
      throw Error(text(path_, ':', element.line), "there is another element vertex before; remove one");
    std::array<std::size_t, 3> at;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::string_view name = std::array{"x", "y", "z"}[c];
      const int found = element.find(name, false);
      if (found < 0) lacks(element, text("property ", name));
      at[c] = std::size_t(found);
    }
    for (std::size_t i = 0; i < element.count; ++i) {
      item(element);
      const Eigen::Vector3d p(values_[at[0]], values_[at[1]], values_[at[2]]);
      if (!all_finite(p))
        throw error(
            text("point ", i, " has a coordinate that is not a finite number; export the file again"));
      mesh_.positions.push_back(p);
    }
  }
  Index index(double value) const {
    if (!(value >= 0 && value < double(mesh_.positions.size())) || value != std::floor(value))
      throw error(text("point ",
                       value,
                       " is not among the ",
                       mesh_.positions.size(),
                       " points, numbered from 0; correct the number or add the point"));
    return Index(value);
  }
  void needPoints(Element const& element, bool there) const {
    if (element.count > 0 && !there)
      throw Error(text(path_, ':', element.line),
                  text("element ", element.name, " stands before element vertex; put the points first"));
  }
  void corners(Element const& element, bool hasPoints) {
    needPoints(element, hasPoints);
    int at = element.find("vertex_indices", true);
    if (at < 0) at = element.find("vertex_index", true);
    if (at < 0 && element.count > 0) lacks(element, "list vertex_indices");
    std::vector<Index> all;
    for (std::size_t i = 0; i < element.count; ++i) {
      item(element);
      auto const& list = lists_[std::size_t(at)];
      all.clear();
      if (element.name == "face") {
        for (const double v : list) all.push_back(index(v));
        if (all.size() == 2) add_polyline(mesh_, all);
        if (all.size() > 2) add_polygon(mesh_, all);
        continue;
      }
      // -1 begins another strip
      for (const double v : list) {
        if (v == -1) {
          all.clear();
          continue;
        }
        all.push_back(index(v));
        const std::size_t n = all.size();
        if (n < 3) continue;
        Triangle t{all[n - 3], all[n - 2], all[n - 1]};
        if (n % 2 == 0) std::swap(t[0], t[1]);
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh_.triangles.push_back(t);
      }
    }
  }
  void edges(Element const& element, bool hasPoints) {
    needPoints(element, hasPoints);
    const int first = element.find("vertex1", false), second = element.find("vertex2", false);
    if (element.count > 0 && (first < 0 || second < 0)) lacks(element, "properties vertex1 and vertex2");
    for (std::size_t i = 0; i < element.count; ++i) {
      item(element);
      mesh_.edges.push_back({index(values_[std::size_t(first)]), index(values_[std::size_t(second)])});
    }
  }
  void checkEnd() {
    if (text_ ? text_->more() : at_ < content_.size()) {
      if (text_) text_->word();
      throw error(
          "more follows behind the last element; correct the numbers of items, or get the file again");
    }
  }
};

}  // namespace sinew::io::detail

namespace sinew::io {

SINEW_ONCE Mesh parse_ply(std::string_view path, std::string_view content) {
  Mesh mesh = detail::PlyParser(path, content).parse();
  check_mesh(path, mesh);
  return mesh;
}

SINEW_ONCE Mesh read_ply(std::string const& path) { return parse_ply(path, read_file(path)); }

}  // namespace sinew::io
#endif
