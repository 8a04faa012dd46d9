// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/io/text_reader.hpp>
#include <sinew/runtime/value_text.hpp>

#include <algorithm>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// The text of a scene file, for places in it.
struct XmlFile {
  std::string path, folder, content;

  /// "liver.scn:12:3".
  std::string place(std::size_t offset) const {
    offset = std::min(offset, content.size());
    const auto begin = content.begin(), at = begin + std::ptrdiff_t(offset);
    const auto line = std::count(begin, at, '\n') + 1;
    const std::size_t start = content.rfind('\n', offset == 0 ? 0 : offset - 1);
    const std::size_t column = offset == 0 ? 1 : start == content.npos ? offset + 1 : offset - start;
    return text(path, ':', line, ':', column);
  }
};

struct XmlAttribute {
  std::string name, value;
  std::size_t offset;
};

/// One element of a scene file, after its includes are put in.
struct XmlElement {
  std::string tag;
  std::vector<XmlAttribute> attributes{};
  std::vector<XmlElement> children{};
  std::shared_ptr<XmlFile const> file{};
  std::size_t offset = 0;

  XmlAttribute const* attribute(std::string_view name) const {
    for (auto const& a : attributes)
      if (a.name == name) return &a;
    return nullptr;
  }
  std::string place() const { return file ? file->place(offset) : ""; }
  std::string place(XmlAttribute const& a) const { return file ? file->place(a.offset) : ""; }
  void set(std::string_view name, std::string_view value) {
    for (auto& a : attributes)
      if (a.name == name) return void(a.value = value);
    attributes.push_back({std::string(name), std::string(value), offset});
  }
};

namespace detail {

inline std::string folder_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == path.npos ? "" : std::string(path.substr(0, slash + 1));
}

/// Offset of the first byte that is not UTF-8 (RFC 3629), or npos.
inline std::size_t find_not_utf8(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const auto lead = static_cast<unsigned char>(bytes[i]);
    const std::size_t more = lead < 0x80   ? 0
                             : lead < 0xC2 ? 9
                             : lead < 0xE0 ? 1
                             : lead < 0xF0 ? 2
                             : lead < 0xF5 ? 3
                                           : 9;
    if (lead == 0 || more == 9 || i + more >= bytes.size() + (more == 0)) return i;
    for (std::size_t k = 1; k <= more; ++k)
      if ((static_cast<unsigned char>(bytes[i + k]) & 0xC0) != 0x80) return i;
    i += more + 1;
  }
  return bytes.npos;
}

}  // namespace detail

/// Reads a scene file into elements. Entities are never expanded, and what a file may ask for is limited:
/// depth, number of elements, size, includes of includes. Throws Error with file, line and column.
class XmlReader {
 public:
  static constexpr std::size_t mostBytes = std::size_t(1) << 28, mostElements = 1000000;
  static constexpr int mostDepth = 200, mostIncludes = 16;

  /// Where files are looked for that do not stand beside the scene.
  explicit XmlReader(std::vector<std::string> dataPaths = {}) : dataPaths_(std::move(dataPaths)) {}

  XmlElement read(std::string const& path) { return parse(path, io::read_file(path)); }

  XmlElement parse(std::string const& path, std::string content) {
    if (content.size() > mostBytes)
      throw Error(path,
                  text("has ",
                       content.size(),
                       " bytes; a scene file may have ",
                       mostBytes,
                       "; keep meshes in files of their own"));
    auto file = std::make_shared<XmlFile>(XmlFile{path, detail::folder_of(path), std::move(content)});
    if (const std::size_t bad = detail::find_not_utf8(file->content); bad != std::string::npos)
      throw Error(file->place(bad), "is no UTF-8 text; save the file in UTF-8");
    std::string buffer = file->content;
    pugi::xml_document document;
    const auto result =
        document.load_buffer_inplace(buffer.data(), buffer.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result)
      throw Error(file->place(std::size_t(result.offset)),
                  text("is no well-formed XML: ", result.description(), "; correct the file"));
    including_.push_back(path);
    XmlElement root;
    convert(document.document_element(), buffer.data(), file, root, 0);
    including_.pop_back();
    return root;
  }

  /// The path of a file named in a scene: beside the scene file, or below a data path. Throws Error.
  std::string find(std::string const& name, std::string const& folder) const {
    auto exists = [](std::string const& path) {
      struct stat info;
      return ::stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode);
    };
    if (name.starts_with('/')) {
      if (exists(name)) return name;
      throw Error("", text("there is no file ", detail::shown(name), "; correct the path"));
    }
    std::string looked = folder.empty() ? "the working folder" : folder;
    if (exists(folder + name)) return folder + name;
    for (auto const& data : dataPaths_) {
      const std::string path = data.empty() || data.ends_with('/') ? data + name : text(data, '/', name);
      if (exists(path)) return path;
      looked += text(", ", data);
    }
    throw Error("",
                text("there is no file ",
                     detail::shown(name),
                     " in ",
                     looked,
                     "; correct the name, or give the folder with --data"));
  }

 private:
  std::vector<std::string> dataPaths_, including_{};
  std::size_t elements_ = 0;

  void convert(pugi::xml_node const& node, char const* buffer, std::shared_ptr<XmlFile const> const& file,
               XmlElement& to, int depth) {
    to.tag = node.name();
    to.file = file;
    to.offset = std::size_t(node.name() - buffer) - 1;
    if (depth > mostDepth)
      throw Error(to.place(), text("is nested more than ", mostDepth, " deep; flatten the scene"));
    if (++elements_ > mostElements)
      throw Error(to.place(), text("is one element too many; a scene may have ", mostElements));
    for (auto const& a : node.attributes()) {
      const std::size_t offset = std::size_t(a.name() - buffer);
      if (to.attribute(a.name()))
        throw Error(file->place(offset),
                    text("attribute ", detail::shown(a.name()), " is given twice; remove one"));
      to.attributes.push_back({a.name(), a.value(), offset});
    }
    for (auto const& child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      if (std::string_view(child.name()) == "include")
        include(child, buffer, file, to, depth);
      else
        convert(child, buffer, file, to.children.emplace_back(), depth + 1);
    }
  }

  // the root of the other file stands in the place of the include; of a <Group>, its children
  void include(pugi::xml_node const& node, char const* buffer, std::shared_ptr<XmlFile const> const& file,
               XmlElement& to, int depth) {
    XmlElement here{.tag = "include", .file = file, .offset = std::size_t(node.name() - buffer) - 1};
    const std::string href = node.attribute("href").value();
    std::string path;
    try {
      if (href.empty()) throw Error("", "has no href; name the file to include");
      path = find(href, file->folder);
      if (std::find(including_.begin(), including_.end(), path) != including_.end())
        throw Error("", text(detail::shown(href), " includes itself; break the circle"));
      if (int(including_.size()) > mostIncludes)
        throw Error("", text("is an include more than ", mostIncludes, " deep; flatten the files"));
    } catch (Error const& error) {
      throw Error(here.place(), text("<include>: ", error.what()));
    }
    XmlElement root = read(path);
    if (depth_of(root) + depth > mostDepth)
      throw Error(here.place(), text("nests the scene more than ", mostDepth, " deep; flatten it"));
    for (auto const& a : node.attributes())
      if (std::string_view(a.name()) != "href") root.set(a.name(), a.value());
    if (root.tag == "Group")
      std::move(root.children.begin(), root.children.end(), std::back_inserter(to.children));
    else
      to.children.push_back(std::move(root));
  }
  static int depth_of(XmlElement const& element) {
    int most = 0;
    for (auto const& child : element.children) most = std::max(most, depth_of(child));
    return most + 1;
  }
};

}  // namespace sinew
