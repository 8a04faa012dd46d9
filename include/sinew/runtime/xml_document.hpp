// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/io/text_reader.hpp>
#include <sinew/runtime/dialect.hpp>
#include <sinew/runtime/dialect_attributes.hpp>
#include <sinew/runtime/value_text.hpp>

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// The text of a scene file, for places in it.
struct XmlFile {
  std::string path, folder, content;
  std::vector<std::size_t> lines{};  // where each begins

  XmlFile(std::string p, std::string f, std::string c)
      : path(std::move(p)), folder(std::move(f)), content(std::move(c)), lines{0} {
    for (std::size_t i = 0; i < content.size(); ++i)
      if (content[i] == '\n') lines.push_back(i + 1);
  }

  /// "liver.scn:12:3".
  std::string place(std::size_t offset) const {
    offset = std::min(offset, content.size());
    const auto line = std::upper_bound(lines.begin(), lines.end(), offset) - 1;
    return text(path, ':', line - lines.begin() + 1, ':', offset - *line + 1);
  }
};

struct XmlAttribute {
  std::string name, value;
  std::size_t offset;
  std::shared_ptr<XmlFile const> file{};  // where it stands, if not in the file of its element
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
  std::string place(XmlAttribute const& a) const {
    return a.file ? a.file->place(a.offset) : file ? file->place(a.offset) : "";
  }
  void set(std::string_view name, std::string_view value, bool replace = true) {
    for (auto& a : attributes)
      if (a.name == name) return replace ? void(a.value = value) : void();
    attributes.push_back({std::string(name), std::string(value), offset});
  }
  /// The same, with the place of an attribute of another element; where it is new only if `add`. Says whether
  /// there is one now.
  bool take(XmlAttribute const& from, bool add) {
    for (auto& a : attributes)
      if (a.name == from.name) return a = from, true;
    if (add) attributes.push_back(from);
    return add;
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

/// A blank in front of each attribute that begins right behind the quote of the one before, as SOFA's scenes
/// have some and XML does not allow. Returns where the first was put, or npos.
inline std::size_t part_attributes(std::string& content) {
  std::string parted;
  std::size_t first = content.npos;
  auto upTo = [&](std::size_t from, std::string_view end) {
    const std::size_t at = content.find(end, from);
    return at == content.npos ? content.size() : at + end.size();
  };
  for (std::size_t i = 0; i < content.size();) {
    std::size_t next = upTo(i, "<");
    parted.append(content, i, next - i);
    i = next;
    if (content.compare(i, 3, "!--") == 0 || content.compare(i, 8, "![CDATA[") == 0) {
      next = upTo(i, content[i + 1] == '-' ? "-->" : "]]>");
      parted.append(content, i, next - i);
      i = next;
      continue;
    }
    while (i < content.size() && content[i] != '>') {
      next = content[i] == '"' || content[i] == '\'' ? upTo(i + 1, content.substr(i, 1)) : i + 1;
      parted.append(content, i, next - i);
      const bool value = next > i + 1;
      i = next;
      if (value && i < content.size() && (std::isalpha(static_cast<unsigned char>(content[i])) != 0)) {
        first = std::min(first, parted.size());
        parted += ' ';
      }
    }
  }
  content = std::move(parted);
  return first;
}

}  // namespace detail

/// Reads a scene file into elements. Entities are never expanded, and what a file may ask for is limited:
/// depth, number of elements, size, includes of includes. Throws Error with file, line and column.
class XmlReader {
 public:
  static constexpr std::size_t maxBytes = std::size_t(1) << 28, maxElements = 1000000, maxAttributes = 1000,
                               maxWarnings = 100;
  static constexpr int maxDepth = 200, maxIncludes = 16;

  /// Where files are looked for that do not stand beside the scene.
  explicit XmlReader(std::vector<std::string> dataPaths = {}, std::string missing = {})
      : dataPaths_(std::move(dataPaths)), missing_(std::move(missing)) {}

  XmlElement read(std::string const& path) { return parse(path, io::read_file(path)); }

  /// What the files say without effect, each with its place; no more than the first of them.
  std::vector<std::string> warnings{};

  XmlElement parse(std::string const& path, std::string content) {
    if (content.size() > maxBytes)
      throw Error(path,
                  text("has ",
                       content.size(),
                       " bytes; a scene file may have ",
                       maxBytes,
                       "; keep meshes in files of their own"));
    const std::size_t parted = detail::part_attributes(content);
    auto file = std::make_shared<XmlFile const>(path, detail::folder_of(path), std::move(content));
    if (parted != std::string::npos)
      warn(text(file->place(parted),
                ": an attribute begins right behind the one before; it is read as if a blank stood between "
                "them, which XML asks for"));
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

  /// As SOFA does, puts the file Objects/TAG.xml, of a data folder or beside the scene, in the place of each
  /// element in and below one for which isClass(element) is false, where there is such a file; it is an
  /// include with the attributes of the element. Throws Error.
  template <class F>
  void expandObjects(XmlElement& in, F const& isClass, int depth = 0) {
    std::vector<XmlElement> children = std::exchange(in.children, {});
    for (XmlElement& child : children) {
      const std::string href = isClass(child) ? "" : text("Objects/", child.tag, ".xml");
      std::string path;
      try {
        if (!href.empty()) path = find(href, child.file->folder);
      } catch (Error const&) {
        // it stays what it is
      }
      if (path.empty()) {
        in.children.push_back(std::move(child));
        expandObjects(in.children.back(), isClass, depth + 1);
        continue;
      }
      for (XmlAttribute& a : child.attributes)
        if (!a.file) a.file = child.file;
      include(child, href, path, child.attributes, in, depth, [&](XmlElement& root) {
        expandObjects(root, isClass, depth + 1);
      });
    }
  }

  /// Another folder for find(), which goes before those that there are.
  void addDataPath(std::string path) { dataPaths_.insert(dataPaths_.begin(), std::move(path)); }

  /// The path of a file named in a scene: beside the scene file, or below a data path. Throws Error.
  std::string find(std::string const& name, std::string const& folder) const {
    auto exists = [](std::string const& path) {
      struct stat info;
      return ::stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode);
    };
    if (name.starts_with('/')) {
      if (exists(name)) return name;
      if (!missing_.empty()) throw Error("", text("there is no file ", detail::shown(name), "; ", missing_));
      throw Error("", text("there is no file ", detail::shown(name), "; correct the path"));
    }
    std::string looked = folder.empty() ? "the working folder" : folder;
    if (exists(folder + name)) return folder + name;
    for (auto const& data : dataPaths_) {
      const std::string path = data.empty() || data.ends_with('/') ? data + name : text(data, '/', name);
      if (exists(path)) return path;
      looked += text(", ", data);
    }
    if (!missing_.empty()) throw Error("", text("there is no file ", detail::shown(name), "; ", missing_));
    throw Error("",
                text("there is no file ",
                     detail::shown(name),
                     " in ",
                     looked,
                     "; correct the name, or give the folder with --data"));
  }

 private:
  std::vector<std::string> dataPaths_, including_{};
  std::string missing_;  // what to do about a file that is not there
  std::size_t elements_ = 0;

  void convert(pugi::xml_node const& node, char const* buffer, std::shared_ptr<XmlFile const> const& file,
               XmlElement& to, int depth) {
    to.tag = node.name();
    to.file = file;
    to.offset = std::size_t(node.name() - buffer) - 1;
    if (depth > maxDepth)
      throw Error(to.place(), text("is nested more than ", maxDepth, " deep; flatten the scene"));
    if (++elements_ > maxElements)
      throw Error(to.place(), text("is one element too many; a scene may have ", maxElements));
    for (auto const& a : node.attributes())
      addAttribute(to, {a.name(), a.value(), std::size_t(a.name() - buffer)}, *file);
    for (auto const& child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      const std::string_view tag = child.name();
      if (tag == "include")
        includeNode(child, buffer, file, to, depth);
      else if (tag == "Attribute")
        attribute(child, buffer, file, to);
      else
        convert(child, buffer, file, to.children.emplace_back(), depth + 1);
    }
  }

  // <Attribute type="velocity"><Data value="0 1 0"/></Attribute>: an attribute of the element around it
  void attribute(pugi::xml_node const& node, char const* buffer, std::shared_ptr<XmlFile const> const& file,
                 XmlElement& to) {
    const std::string place = file->place(std::size_t(node.name() - buffer) - 1);
    const std::string name = node.attribute("type").value();
    if (name.empty()) throw Error(place, "<Attribute>: has no type; give the name of the attribute");
    std::vector<pugi::xml_node> data;
    for (auto const& child : node.children())
      if (child.type() == pugi::node_element) data.push_back(child);
    if (data.size() != 1 || std::string_view(data[0].name()) != "Data" || !data[0].attribute("value"))
      throw Error(place, "<Attribute>: has its value in one element below it: <Data value=\"...\"/>");
    const auto value = data[0].attribute("value");
    addAttribute(to, {name, value.value(), std::size_t(value.name() - buffer)}, *file);
  }
  void warn(std::string warning) {
    if (warnings.size() < maxWarnings) warnings.push_back(std::move(warning));
  }
  // given twice, the last counts, as in SOFA
  void addAttribute(XmlElement& to, XmlAttribute added, XmlFile const& file) {
    if (to.attributes.size() == maxAttributes)
      throw Error(file.place(added.offset),
                  text("is one attribute too many; an element may have ", maxAttributes));
    if (to.attribute(added.name))
      warn(text(file.place(added.offset),
                ": <",
                to.tag,
                ">: attribute ",
                detail::shown(added.name),
                " is given twice; the last counts"));
    to.take(added, true);
  }

  // The root of the other file stands in the place of the include, or its children where the name of either
  // is Group or _Group_, or the tag of the root is Group; named _Merge_, it is merged into the element
  // around. Attributes of the include replace those that elements of the other file have.
  void includeNode(pugi::xml_node const& node, char const* buffer, std::shared_ptr<XmlFile const> const& file,
                   XmlElement& to, int depth) {
    const XmlElement here{.tag = "include", .file = file, .offset = std::size_t(node.name() - buffer) - 1};
    std::vector<XmlAttribute> attributes;
    for (auto const& a : node.attributes())
      if (std::string_view(a.name()) != "href")
        attributes.push_back({a.name(), a.value(), std::size_t(a.name() - buffer), file});
    const std::string href = node.attribute("href").value();
    if (href.empty()) refuse(here, "has no href; name the file to include");
    std::string path;
    try {
      path = find(href, file->folder);
    } catch (Error const& error) {
      refuse(here, error.what());
    }
    include(here, href, path, attributes, to, depth, [](XmlElement&) {});
  }
  [[noreturn]] static void refuse(XmlElement const& here, std::string_view why) {
    throw Error(here.place(), text('<', here.tag, ">: ", why));
  }
  // The file at `path`, which `href` names; `with(root)` is what is done to its elements first.
  template <class F>
  void include(XmlElement const& here, std::string const& href, std::string const& path,
               std::vector<XmlAttribute> const& attributes, XmlElement& to, int depth, F&& with) {
    if (std::find(including_.begin(), including_.end(), path) != including_.end())
      refuse(here, text(detail::shown(href), " includes itself; break the circle"));
    if (int(including_.size()) > maxIncludes)
      refuse(here, text("is an include more than ", maxIncludes, " deep; flatten the files"));
    XmlElement root = read(path);
    including_.push_back(path);
    with(root);
    including_.pop_back();
    if (depth_of(root) + depth > maxDepth)
      throw Error(here.place(), text("nests the scene more than ", maxDepth, " deep; flatten it"));
    bool group = root.tag == "Group", merge = false;
    auto named = [&] {
      auto const* name = root.attribute("name");
      if (!name) return;
      group = group || name->value == "Group" || name->value == "_Group_";
      merge = merge || name->value == "_Merge_";
    };
    named();
    for (XmlAttribute const& given : attributes) {
      if (given.name == "name") {
        root.take(given, true);
        named();
      } else if (!replace(root, given) && !dialect::without_effect(given.name)) {
        warn(text(given.file->place(given.offset),
                  ": <",
                  here.tag,
                  ">: no element of ",
                  detail::shown(href),
                  " has the attribute ",
                  detail::shown(given.name),
                  " that could be replaced; it has no effect"));
      }
    }
    if (merge)
      mergeInto(to, root);
    else if (group)
      std::move(root.children.begin(), root.children.end(), std::back_inserter(to.children));
    else
      to.children.push_back(std::move(root));
  }

  // in all elements that have the attribute; "fem__youngModulus" in those named fem only
  static bool replace(XmlElement& in, XmlAttribute const& by) {
    const std::size_t sep = by.name.find("__");
    if (sep == std::string::npos) return replace(in, by, nullptr);
    XmlAttribute attribute = by;
    attribute.name = by.name.substr(sep + 2);
    const std::string element = by.name.substr(0, sep);
    return replace(in, attribute, &element);
  }
  static bool replace(XmlElement& in, XmlAttribute const& by, std::string const* named) {
    auto const* name = in.attribute("name");
    bool found = (!named || (name && name->value == *named)) && in.take(by, false);
    for (auto& child : in.children) found = replace(child, by, named) || found;
    return found;
  }

  // attributes and children of an element are added to another; children of one tag and name are merged too
  static void mergeInto(XmlElement& to, XmlElement& from) {
    for (auto& a : from.attributes) {
      if (!a.file) a.file = from.file;
      if (a.name != "name") to.take(a, true);
    }
    std::map<std::pair<std::string, std::string>, std::size_t> known;
    auto known_as = [&](XmlElement const& child, std::size_t place) {
      auto const* name = child.attribute("name");
      return name && !name->value.empty()
                 ? known.emplace(std::pair(child.tag, name->value), place).first->second
                 : place;
    };
    for (std::size_t i = 0; i < to.children.size(); ++i) known_as(to.children[i], i);
    for (auto& child : from.children) {
      const std::size_t place = known_as(child, to.children.size());
      if (place == to.children.size())
        to.children.push_back(std::move(child));
      else
        mergeInto(to.children[place], child);
    }
  }
  static int depth_of(XmlElement const& element) {
    int maximum = 0;
    for (auto const& child : element.children) maximum = std::max(maximum, depth_of(child));
    return maximum + 1;
  }
};

}  // namespace sinew
