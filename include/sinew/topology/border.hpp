// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>

#include <algorithm>
#include <array>
#include <span>
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

namespace detail {

template <std::size_t N, std::size_t Faces, class Elements>
std::vector<std::array<Index, N>> border_faces(Elements const& elements,
                                               std::size_t const (&corners)[Faces][N]) {
  struct Face {
    std::array<Index, N> key;
    std::size_t number;  // Faces * element + face
  };
  std::vector<Face> faces;
  faces.reserve(Faces * elements.size());
  auto face = [&](std::size_t number) {
    std::array<Index, N> f;
    for (std::size_t c = 0; c < N; ++c) f[c] = elements[number / Faces][corners[number % Faces][c]];
    return f;
  };
  for (std::size_t i = 0; i < Faces * elements.size(); ++i) faces.push_back({sorted_corners(face(i)), i});
  std::sort(faces.begin(), faces.end(), [](Face const& a, Face const& b) {
    return a.key != b.key ? a.key < b.key : a.number < b.number;
  });
  std::vector<std::size_t> once;
  for (std::size_t i = 0, next; i < faces.size(); i = next) {
    for (next = i + 1; next < faces.size() && faces[next].key == faces[i].key;) ++next;
    if (next == i + 1) once.push_back(faces[i].number);
  }
  std::sort(once.begin(), once.end());
  std::vector<std::array<Index, N>> border;
  border.reserve(once.size());
  for (const std::size_t number : once) border.push_back(face(number));
  return border;
}

}  // namespace detail

/// The border of volume elements, its faces turned outwards where these are positively oriented, in the order
/// in which elements give them.
inline Border border_of(std::span<Tetrahedron const> tetrahedra, std::span<Hexahedron const> hexahedra) {
  constexpr std::size_t ofTetrahedron[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  constexpr std::size_t ofHexahedron[6][4] = {
      {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  return {detail::border_faces(tetrahedra, ofTetrahedron), detail::border_faces(hexahedra, ofHexahedron)};
}

}  // namespace sinew
