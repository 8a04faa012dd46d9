// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs pugixml, which most of sinew/io/ does not.
#include <sinew/core/memory_limit.hpp>
#include <sinew/io/base64.hpp>
#include <sinew/io/text_reader.hpp>

#include <bit>
#include <cstring>
#include <pugixml.hpp>
#include <vector>

namespace sinew::io {

/// A VTK file in XML and the arrays in it, as "VTK File Formats" (Kitware) describes them: ascii, inline
/// base64, appended raw or base64, and where the program includes io/gzip.hpp compressed by zlib. Functions
/// throw Error at "path:line". `content` must outlive it.
class VtkXml {
 public:
  using Node = pugi::xml_node;

  /// `type` is the kind of data set that is wanted, "UnstructuredGrid", or none for any.
  VtkXml(std::string_view path, std::string_view content, std::string_view type)
      : path_(path), xml_(content) {
    separateAppended();
    TextReader(path_, xml_).rejectBinary();
    const auto result =
        document_.load_buffer(xml_.data(), xml_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result)
      throw Error(at(result.offset),
                  text("is not complete XML: ", result.description(), "; get a complete file"));
    header(type);
  }

  VtkXml(VtkXml const&) = delete;
  VtkXml& operator=(VtkXml const&) = delete;

  Node root() const { return document_.child("VTKFile"); }

  /// "path:line" of a node.
  std::string at(Node node) const { return at(node.offset_debug()); }

  /// An attribute that is a whole number.
  std::uint64_t number(Node node, char const* name) const {
    const std::string_view value = node.attribute(name).value();
    std::uint64_t n = 0;
    if (!parse_number(value, n))
      throw Error(at(node), text(name, " is ", in_quotes(value), "; expected a whole number"));
    return n;
  }

  /// The values of a <DataArray> of whatever type and encoding, of which there must be items * components.
  /// T is double, or std::int64_t for an array of whole numbers.
  template <class T>
  std::vector<T> values(Node array, std::uint64_t items, std::size_t components) {
    const std::vector<T> list = values<T>(array);
    if (list.size() % components != 0 || list.size() / components != items)
      throw Error(at(array),
                  text("the array has ",
                       list.size(),
                       " values, but ",
                       items,
                       " times ",
                       components,
                       " are announced; the file is incomplete or the number is wrong"));
    return list;
  }
  template <class T>
  std::vector<T> values(Node array) {
    const std::string_view format = array.attribute("format").value(), source = content(array);
    if (format == "ascii") return asciiValues<T>(source);
    if (!compressor_.empty() && (compressor_ != "vtkZLibDataCompressor" || !is_there(&unpack_zlib)))
      throw Error(at(array),
                  text("is compressed with ",
                       in_quotes(compressor_),
                       "; save it uncompressed (ParaView: Save Data, Compressor Type: None)"));
    if (format == "binary") return convert<T>(array, bytes(array, source, true).unpacked);
    if (format != "appended")
      throw Error(at(array),
                  text("format is ", in_quotes(format), R"(; expected "ascii", "binary" or "appended")"));
    const std::uint64_t offset = number(array, "offset");
    if (offset > appended_.size())
      throw Error(at(array),
                  text("the offset ",
                       offset,
                       " is beyond the ",
                       appended_.size(),
                       " bytes of <AppendedData>; get a complete file"));
    const std::string_view encoding = root().child("AppendedData").attribute("encoding").value();
    const Bytes own = bytes(array, appended_.substr(offset), encoding != "raw");
    // a thousand arrays at one place would make a small file a large mesh
    used_ += own.inFile;
    if (used_ > appended_.size())
      throw Error(at(array),
                  text("with this array the arrays have more than the ",
                       appended_.size(),
                       " bytes of <AppendedData>; write the file again, each array at an offset of its own"));
    return convert<T>(array, own.unpacked);
  }

 private:
  struct Bytes {
    std::string unpacked{};
    std::size_t inFile = 0;
  };

  std::string at(std::ptrdiff_t offset) const {
    return text(path_, ':', lineOf(std::size_t(std::max<std::ptrdiff_t>(offset, 0))));
  }
  std::size_t lineOf(std::size_t offset) const {
    const std::string_view before = xml_.substr(0, offset);
    return std::size_t(1 + std::count(before.begin(), before.end(), '\n'));
  }

  // appended data begin with '_' and need not be XML; what is around them is
  void separateAppended() {
    const std::size_t begin = xml_.find("<AppendedData");
    if (begin == xml_.npos) return;
    const std::size_t data = xml_.find('_', std::min(xml_.find('>', begin), xml_.size()));
    const std::size_t end = xml_.rfind("</AppendedData");
    if (data == xml_.npos || end == xml_.npos || end < data)
      throw Error(path_, "the data end inside <AppendedData>; the file is incomplete: get a complete one");
    appended_ = xml_.substr(data + 1, end - data - 1);
    around_ = text(xml_.substr(0, data), xml_.substr(end));
    xml_ = around_;
  }

  void header(std::string_view type) {
    if (!root()) throw Error(at(document_.first_child()), "has no <VTKFile>; name a VTK file in XML");
    const std::string_view held = root().attribute("type").value(),
                           order = root().attribute("byte_order").value(),
                           header = root().attribute("header_type").as_string("UInt32"),
                           compressor = root().attribute("compressor").value();
    auto wrong = [&](auto const&... parts) { return Error(at(root()), text(parts...)); };
    if (!type.empty() && held != type)
      throw wrong("holds ", in_quotes(held), "; name a file that holds ", in_quotes(type));
    compressor_ = compressor;
    if (order != "LittleEndian" && order != "BigEndian")
      throw wrong("byte_order is ", in_quotes(order), R"(; expected "LittleEndian" or "BigEndian")");
    if (header != "UInt32" && header != "UInt64")
      throw wrong("header_type is ", in_quotes(header), R"(; expected "UInt32" or "UInt64")");
    headerSize_ = header == "UInt64" ? 8 : 4;
    swap_ = (order == "BigEndian") != (std::endian::native == std::endian::big);
  }

  // the characters inside an array, from the text that was parsed
  std::string_view content(Node array) const {
    Node inside = array.first_child();
    while (inside && inside.type() != pugi::node_pcdata) inside = inside.next_sibling();
    if (!inside || inside.offset_debug() < 0) return {};
    const auto from = std::size_t(inside.offset_debug());
    return xml_.substr(from, std::min(xml_.find('<', from), xml_.size()) - from);
  }

  template <class T>
  std::vector<T> asciiValues(std::string_view source) const {
    std::vector<T> list;
    const std::size_t line = source.empty() ? 1 : lineOf(std::size_t(source.data() - xml_.data()));
    for (TextReader in(path_, source, line); in.more();) {
      if constexpr (std::is_floating_point_v<T>)
        list.push_back(in.real("a number"));
      else
        list.push_back(in.integer("a number"));
    }
    return list;
  }

  // encoded data are the number of bytes, then the bytes; compressed ones the number of blocks, their size,
  // that of the last one, if it is smaller, and the size of each when it is compressed, then the blocks
  Bytes bytes(Node array, std::string_view source, bool base64) const {
    if (source.find_first_not_of(" \t\r\n") == source.npos) return {};
    auto first = [&](std::uint64_t n) {
      if (n > source.size()) return std::string();
      return base64 ? decode_base64(source, std::size_t(n)).bytes
                    : std::string(source.substr(0, std::size_t(n)));
    };
    auto entry = [&](std::string const& header, std::size_t i) -> std::uint64_t {
      char const* const from = header.data() + i * headerSize_;
      return headerSize_ == 8 ? load<std::uint64_t>(from) : load<std::uint32_t>(from);
    };
    const std::string head = first(headerSize_);
    const std::uint64_t n = head.size() == headerSize_ ? entry(head, 0) : source.size() + 1;
    if (n <= source.size() && compressor_.empty()) {
      if (const std::string all = first(headerSize_ + n); all.size() == headerSize_ + n)
        return {all.substr(headerSize_), std::size_t(n)};
    } else if (n <= source.size()) {
      const std::uint64_t size = headerSize_ * (n == 0 ? 1 : 3 + n);
      const std::string header = first(size);
      std::uint64_t packed = 0;
      if (header.size() == size) {
        for (std::size_t i = 0; i < n; ++i)
          packed += std::min<std::uint64_t>(entry(header, 3 + i), source.size());
        if (const std::string all = first(size + packed); all.size() == size + packed)
          return {
              unpack(array, header, std::string_view(all).substr(std::size_t(size)), std::size_t(n), entry),
              std::size_t(size + packed)};
      }
    }
    throw Error(at(array),
                text("the data are ",
                     base64 ? "not base64, or " : "",
                     "fewer bytes than they announce; get a complete file"));
  }

  template <class Entry>
  std::string unpack(Node array, std::string const& header, std::string_view packed, std::size_t blocks,
                     Entry const& entry) const {
    std::string all;
    for (std::size_t i = 0; i < blocks; ++i) {
      const auto size = std::size_t(entry(header, 3 + i));
      const std::uint64_t last = entry(header, 2),
                          whole = i + 1 == blocks && last > 0 ? last : entry(header, 1);
      if (whole > memory_limit || all.size() + whole > memory_limit)
        throw Error(at(array),
                    text("unpacks to more than ",
                         memory_text(double(memory_limit)),
                         "; name a smaller file, or raise memory_limit"));
      all += unpack_zlib(at(array), packed.substr(0, size), std::size_t(whole));
      packed.remove_prefix(size);
    }
    return all;
  }

  template <class S>
  S load(char const* from) const {
    char copy[sizeof(S)];
    std::memcpy(copy, from, sizeof(S));
    if (swap_) std::reverse(copy, copy + sizeof(S));
    S value;
    std::memcpy(&value, copy, sizeof(S));
    return value;
  }
  template <class S, class T>
  std::vector<T> convert(Node array, std::string const& all) const {
    if (all.size() % sizeof(S) != 0)
      throw Error(
          at(array),
          text("has ", all.size(), " bytes, which are not a whole number of values; correct its type"));
    std::vector<T> list(all.size() / sizeof(S));
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = T(load<S>(all.data() + i * sizeof(S)));
    return list;
  }
  template <class T>
  std::vector<T> convert(Node array, std::string const& all) const {
    const std::string_view type = array.attribute("type").value();
    if constexpr (std::is_floating_point_v<T>) {
      if (type == "Float64") return convert<double, T>(array, all);
      if (type == "Float32") return convert<float, T>(array, all);
    }
    if (type == "Int64") return convert<std::int64_t, T>(array, all);
    if (type == "UInt64") return convert<std::uint64_t, T>(array, all);
    if (type == "Int32") return convert<std::int32_t, T>(array, all);
    if (type == "UInt32") return convert<std::uint32_t, T>(array, all);
    if (type == "Int16") return convert<std::int16_t, T>(array, all);
    if (type == "UInt16") return convert<std::uint16_t, T>(array, all);
    if (type == "Int8") return convert<std::int8_t, T>(array, all);
    if (type == "UInt8") return convert<std::uint8_t, T>(array, all);
    throw Error(
        at(array),
        text("type is ",
             in_quotes(type),
             "; expected ",
             std::is_floating_point_v<T> ? "a type such as \"Float64\"" : "a type such as \"Int32\""));
  }

  std::string path_, around_{}, compressor_{};
  std::string_view xml_, appended_{};
  pugi::xml_document document_{};
  std::size_t headerSize_ = 4;
  std::size_t used_ = 0;  // bytes of the appended data that arrays have
  bool swap_ = false;
};

}  // namespace sinew::io
