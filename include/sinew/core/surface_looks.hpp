// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/core/mesh.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// How the faces of a mesh look: where their corners are in a texture, and of which material they are.
struct SurfaceLooks {
  std::vector<Eigen::Vector2d> texcoords{};  // from the lower left corner of the texture, whose sizes are 1
  std::vector<Triangle> triangles{};         // texcoords of the corners of each; -1: none
  std::vector<Quad> quads{};
  std::vector<std::string> materials{};  // names in the library
  std::vector<Index> faceMaterials{};    // of the triangles, then of the quads; -1: none
  std::string library{};                 // a file MTL

  bool operator==(SurfaceLooks const&) const = default;
};

/// Names of materials, which have no blanks in them, as words and apart.
inline std::string words_of_names(std::vector<std::string> const& names) {
  std::string words;
  for (std::string const& name : names) words += text(words.empty() ? "" : " ", name);
  return words;
}
inline std::vector<std::string> names_of_words(std::string_view words) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<std::string> names;
  while (true) {
    words.remove_prefix(std::min(words.find_first_not_of(blanks), words.size()));
    if (words.empty()) return names;
    names.emplace_back(words.substr(0, words.find_first_of(blanks)));
    words.remove_prefix(names.back().size());
  }
}

namespace detail {

/// What is wrong with numbers of `kind` that belong to `faces` faces, as a sentence; empty where nothing is.
/// Without numbers nothing is.
template <class Faces>
std::string looks_mismatch(std::string_view kind, Faces const& numbers, std::size_t faces,
                           std::size_t texcoords) {
  if (numbers.empty()) return {};
  if (numbers.size() != faces)
    return text(kind, " has ", numbers.size(), " entries for ", faces, " faces; give one for each");
  for (auto const& corners : numbers)
    for (const Index i : corners)
      if (i < -1 || i >= Index(texcoords))
        return text(kind,
                    " has the number ",
                    i,
                    ", and there are ",
                    texcoords,
                    " texcoords, numbered from 0; correct it, or give -1 for none");
  return {};
}

}  // namespace detail

}  // namespace sinew
