// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace sinew {

/// The faces that one volume element only has: the surface of a body.
struct Border {
  std::vector<Triangle> triangles{};  // of tetrahedra
  std::vector<Quad> quads{};          // of hexahedra
};

/// The points of a face, whichever way it goes round.
template <std::size_t N>
std::array<Index, N> sorted_corners(std::array<Index, N> face) {
  // insertion: three or four numbers
  for (std::size_t i = 1; i < N; ++i)
    for (std::size_t j = i; j > 0 && face[j] < face[j - 1]; --j) std::swap(face[j], face[j - 1]);
  return face;
}

/// The border of volume elements, its faces oriented outwards where these are positively oriented, in the
/// order in which elements give them.
Border border_of(std::span<Tetrahedron const> tetrahedra, std::span<Hexahedron const> hexahedra);

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew::detail {

template <std::size_t N, std::size_t Faces, class Elements>
std::vector<std::array<Index, N>> border_faces(Elements const& elements,
                                               std::size_t const (&corners)[Faces][N]) {
  using Corners = std::array<Index, N>;
  const std::size_t count = Faces * elements.size();
  auto face = [&](std::size_t number) {
    Corners f;
    for (std::size_t c = 0; c < N; ++c) f[c] = elements[number / Faces][corners[number % Faces][c]];
    return f;
  };
  // faces at their lowest point, so that only a few at a time are to be sorted
  struct Keyed {
    Corners key;
    std::size_t number;  // Faces * element + face
  };
  Index points = 0;
  for (auto const& e : elements) points = std::max(points, 1 + *std::max_element(e.begin(), e.end()));
  std::vector<std::size_t> first(std::size_t(points) + 1, 0);
  for (std::size_t i = 0; i < count; ++i) ++first[std::size_t(sorted_corners(face(i))[0]) + 1];
  for (std::size_t p = 0; p < std::size_t(points); ++p) first[p + 1] += first[p];
  std::vector<Keyed> faces(count);
  auto next = first;
  for (std::size_t i = 0; i < count; ++i) {
    const Corners key = sorted_corners(face(i));
    faces[next[std::size_t(key[0])]++] = {key, i};
  }
  std::vector<std::size_t> once;
  for (std::size_t p = 0; p < std::size_t(points); ++p) {
    const auto begin = faces.begin() + std::ptrdiff_t(first[p]),
               end = faces.begin() + std::ptrdiff_t(first[p + 1]);
    std::sort(begin, end, [](Keyed const& a, Keyed const& b) { return a.key < b.key; });
    for (auto f = begin, behind = begin; f != end; f = behind) {
      for (behind = f + 1; behind != end && behind->key == f->key;) ++behind;
      if (behind == f + 1) once.push_back(f->number);
    }
  }
  std::sort(once.begin(), once.end());
  std::vector<Corners> border;
  border.reserve(once.size());
  for (const std::size_t number : once) border.push_back(face(number));
  return border;
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE Border border_of(std::span<Tetrahedron const> tetrahedra, std::span<Hexahedron const> hexahedra) {
  constexpr std::size_t ofTetrahedron[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  constexpr std::size_t ofHexahedron[6][4] = {
      {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  return {detail::border_faces(tetrahedra, ofTetrahedron), detail::border_faces(hexahedra, ofHexahedron)};
}

}  // namespace sinew
#endif
