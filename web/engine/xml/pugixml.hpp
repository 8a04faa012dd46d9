// SPDX-License-Identifier: BSL-1.0
#pragma once

// What the reader of scene files asks of pugixml, by RapidXML of Boost: Debian has pugixml as a library for
// the processors of its machines, and so none for WebAssembly.
#include <algorithm>
#include <boost/property_tree/detail/rapidxml.hpp>
#include <cstddef>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace pugi {

namespace rapid = boost::property_tree::detail::rapidxml;

inline constexpr unsigned parse_default = 0;
inline constexpr int encoding_utf8 = 0;
enum xml_node_type { node_null, node_element, node_other };

/// All that follow one of a list, as T.
template <class T, class Pointer>
struct Siblings {
  Pointer first;
  struct Iterator {
    Pointer at;
    T operator*() const { return {at}; }
    Iterator& operator++() {
      at = T{at}.next();
      return *this;
    }
    bool operator!=(Iterator const& other) const { return at != other.at; }
  };
  Iterator begin() const { return {first}; }
  Iterator end() const { return {nullptr}; }
};

/// Nothing where there is no such attribute, as those of pugixml.
struct xml_attribute {
  rapid::xml_attribute<char>* at = nullptr;
  explicit operator bool() const { return at; }
  char const* name() const { return at ? at->name() : ""; }
  char const* value() const { return at ? at->value() : ""; }
  rapid::xml_attribute<char>* next() const { return at->next_attribute(); }
};

struct xml_node {
  rapid::xml_node<char>* at = nullptr;
  char const* name() const { return at ? at->name() : ""; }
  xml_node_type type() const {
    return !at ? node_null : at->type() == rapid::node_element ? node_element : node_other;
  }
  xml_attribute attribute(char const* name) const { return {at ? at->first_attribute(name) : nullptr}; }
  Siblings<xml_attribute, rapid::xml_attribute<char>*> attributes() const {
    return {at ? at->first_attribute() : nullptr};
  }
  Siblings<xml_node, rapid::xml_node<char>*> children() const { return {at ? at->first_node() : nullptr}; }
  rapid::xml_node<char>* next() const { return at->next_sibling(); }
};

struct xml_parse_result {
  std::ptrdiff_t offset = 0;
  std::string what{};
  explicit operator bool() const { return what.empty(); }
  char const* description() const { return what.c_str(); }
};

struct xml_document {
  std::unique_ptr<rapid::xml_document<char>> tree = std::make_unique<rapid::xml_document<char>>();

  /// Of a text that ends with 0 and stays as long as the document; changes it.
  xml_parse_result load_buffer_inplace(char* text, std::size_t size, unsigned, int) {
    if (const std::size_t deep = too_deep({text, size}); deep < size)
      return {std::ptrdiff_t(deep), "elements are nested too deep"};
    try {
      tree->parse<rapid::parse_validate_closing_tags>(text);
    } catch (rapid::parse_error const& error) {
      return {error.where<char>() - text, error.what()};
    }
    for (xml_node const& node : xml_node{tree.get()}.children())
      if (node.type() == node_element) return {};
    return {0, "it has no element"};
  }
  xml_node document_element() const {
    for (xml_node const& node : xml_node{tree.get()}.children())
      if (node.type() == node_element) return node;
    return {};
  }

 private:
  // RapidXML calls itself for each element in another; where these are deeper than its stack is, or the size
  static std::size_t too_deep(std::string_view text) {
    constexpr int deepest = 2000;
    constexpr std::pair<std::string_view, std::string_view> skipped[] = {
        {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"</", ">"}};
    int depth = 0;
    for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
      const std::size_t begin = at;
      auto const* skip = std::find_if(std::begin(skipped), std::end(skipped), [&](auto const& s) {
        return text.substr(begin).starts_with(s.first);
      });
      if (skip != std::end(skipped)) {
        if (skip->first == "</" && depth > 0) --depth;
        at = std::min(text.find(skip->second, begin), text.size());
        continue;
      }
      // to the end of the tag, which is not in quotes
      for (char quote = 0; at < text.size() && (quote || text[at] != '>'); ++at)
        if (quote ? text[at] == quote : text[at] == '"' || text[at] == '\'') quote = quote ? '\0' : text[at];
      if (at < text.size() && text[at - 1] != '/' && ++depth > deepest) return begin;
    }
    return text.size();
  }
};

}  // namespace pugi
