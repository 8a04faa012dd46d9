// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>
#include <sinew/topology/quadratic_elements.hpp>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace sinew {

/// The faces that one volume element only has: the surface of a body.
struct Border {
  std::vector<Triangle> triangles{};  // of tetrahedra, pyramids, prisms and quadratic hexahedra
  std::vector<Quad> quads{};          // of hexahedra, pyramids and prisms
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
/// order in which elements give them. Faces of elements of second order are cut between their nodes.
Border border_of(std::span<Tetrahedron const> tetrahedra, std::span<Hexahedron const> hexahedra,
                 std::span<Pyramid const> pyramids = {}, std::span<Prism const> prisms = {},
                 std::span<QuadraticTetrahedron const> quadraticTetrahedra = {},
                 std::span<QuadraticHexahedron const> quadraticHexahedra = {},
                 std::span<TriquadraticHexahedron const> triquadraticHexahedra = {});

/// The same of all elements of a mesh, or of what has lists of these names.
template <class Lists>
Border border_of(Lists const& lists) {
  return border_of(lists.tetrahedra,
                   lists.hexahedra,
                   lists.pyramids,
                   lists.prisms,
                   lists.quadraticTetrahedra,
                   lists.quadraticHexahedra,
                   lists.triquadraticHexahedra);
}

// corners of faces, counter-clockwise seen from outside
inline constexpr std::size_t tetrahedronFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
inline constexpr std::size_t pyramidQuads[1][4] = {{0, 3, 2, 1}},
                             pyramidTriangles[4][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
inline constexpr std::size_t prismQuads[3][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
                             prismTriangles[2][3] = {{0, 2, 1}, {3, 4, 5}};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew::detail {

/// The faces of elements, one kind behind the other, that one of them only has.
template <std::size_t N>
struct FacesOfElements {
  using Corners = std::array<Index, N>;
  std::vector<Corners> all{};

  template <class Elements, std::size_t Faces>
  FacesOfElements& add(Elements const& elements, std::size_t const (&corners)[Faces][N]) {
    all.reserve(all.size() + Faces * elements.size());
    for (auto const& element : elements)
      for (auto const& face : corners) {
        Corners f;
        for (std::size_t c = 0; c < N; ++c) f[c] = element[face[c]];
        all.push_back(f);
      }
    return *this;
  }
  std::vector<Corners> border() const {
    // faces at their lowest point, so that only a few at a time are to be sorted
    struct Keyed {
      Corners key;
      std::size_t number;
    };
    Index points = 0;
    for (Corners const& f : all) points = std::max(points, 1 + *std::max_element(f.begin(), f.end()));
    std::vector<std::size_t> first(std::size_t(points) + 1, 0);
    for (Corners const& f : all) ++first[std::size_t(sorted_corners(f)[0]) + 1];
    for (std::size_t p = 0; p < std::size_t(points); ++p) first[p + 1] += first[p];
    std::vector<Keyed> faces(all.size());
    auto next = first;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Corners key = sorted_corners(all[i]);
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
    for (const std::size_t number : once) border.push_back(all[number]);
    return border;
  }
};

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE Border border_of(std::span<Tetrahedron const> tetrahedra, std::span<Hexahedron const> hexahedra,
                            std::span<Pyramid const> pyramids, std::span<Prism const> prisms,
                            std::span<QuadraticTetrahedron const> quadraticTetrahedra,
                            std::span<QuadraticHexahedron const> quadraticHexahedra,
                            std::span<TriquadraticHexahedron const> triquadraticHexahedra) {
  constexpr std::size_t ofHexahedron[6][4] = {
      {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  detail::FacesOfElements<3> triangles;
  triangles.add(tetrahedra, tetrahedronFaces).add(pyramids, pyramidTriangles).add(prisms, prismTriangles);
  triangles.add(quadraticTetrahedra, quadraticFaces.tetrahedron)
      .add(quadraticHexahedra, quadraticFaces.hexahedronTriangles);
  detail::FacesOfElements<4> quads;
  quads.add(hexahedra, ofHexahedron).add(pyramids, pyramidQuads).add(prisms, prismQuads);
  quads.add(quadraticHexahedra, quadraticFaces.hexahedronQuads)
      .add(triquadraticHexahedra, quadraticFaces.triquadraticQuads);
  return {triangles.border(), quads.border()};
}

}  // namespace sinew
#endif
