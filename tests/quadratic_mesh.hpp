// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/quadratic_elements.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace one {

/// The tetrahedra or hexahedra of a mesh as elements of second order, with nodes in the middle of edges, and
/// where `Element` has them in that of faces and of all. Points are those of the mesh, then the new ones.
template <class Element>
sinew::Mesh quadratic(sinew::Mesh const& mesh) {
  using namespace sinew;
  constexpr bool simplex = std::tuple_size_v<Element> == 10;
  Mesh all{.positions = mesh.positions};
  std::map<std::vector<Index>, Index> middles;
  auto middle = [&](std::vector<Index> of) {
    std::sort(of.begin(), of.end());
    const auto [at, isNew] = middles.try_emplace(of, Index(all.positions.size()));
    if (isNew) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const Index i : of) sum += mesh.positions[std::size_t(i)];
      all.positions.push_back(sum / double(of.size()));
    }
    return at->second;
  };
  auto raise = [&](auto const& corners, auto const& edges) {
    Element e{};
    std::copy(corners.begin(), corners.end(), e.begin());
    for (auto const& [i, j, between] : edges) e[between] = middle({corners[i], corners[j]});
    if constexpr (std::tuple_size_v<Element> == 27) {
      for (std::size_t f = 0; f < 6; ++f) {
        auto const& c = sinew::detail::triquadraticFaces[f];
        e[20 + f] = middle({corners[c[0]], corners[c[1]], corners[c[2]], corners[c[3]]});
      }
      e[26] = middle({corners.begin(), corners.end()});
    }
    return e;
  };
  if constexpr (simplex)
    for (auto const& t : mesh.tetrahedra)
      all.quadraticTetrahedra.push_back(raise(t, sinew::detail::quadraticTetrahedronEdges));
  else if constexpr (std::tuple_size_v<Element> == 20)
    for (auto const& h : mesh.hexahedra)
      all.quadraticHexahedra.push_back(raise(h, sinew::detail::quadraticHexahedronEdges));
  else
    for (auto const& h : mesh.hexahedra)
      all.triquadraticHexahedra.push_back(raise(h, sinew::detail::quadraticHexahedronEdges));
  return all;
}

/// A box in cells of elements of second order.
template <class Element>
sinew::Mesh quadratic_box(int nx, int ny, int nz, Eigen::Vector3d const& low, Eigen::Vector3d const& high) {
  sinew::Mesh mesh = sinew::regular_grid(nx + 1, ny + 1, nz + 1, low, high);
  mesh.tetrahedra = sinew::hexahedra_to_tetrahedra(mesh.hexahedra);
  return quadratic<Element>(mesh);
}

template <class Element>
std::vector<Element> const& elements_of(sinew::Mesh const& mesh) {
  if constexpr (std::tuple_size_v<Element> == 10)
    return mesh.quadraticTetrahedra;
  else if constexpr (std::tuple_size_v<Element> == 20)
    return mesh.quadraticHexahedra;
  else
    return mesh.triquadraticHexahedra;
}

}  // namespace one
