// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/element_driver.hpp>
#include <sinew/force/spring_law.hpp>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

namespace sinew {

/// Springs along the lines of a mesh, at most one between two points: the first one added stays. A stiffness
/// is that of the material of a spring, its force per relative extension [N]; a spring of length L has the
/// stiffness / L [N/m], and its damping [N s] alike, as in SOFA.
template <class D>
class SpringNetwork {
 public:
  using Driver = ElementDriver<SpringLaw, D>;
  using Real = typename D::Real;

  explicit SpringNetwork(typename D::VecCoord const& rest) : rest_(rest) {}

  void add(int i, int j, double stiffness, double damping) {
    if (i != j) links_.push_back({i, j, stiffness, damping});  // degenerate cells have corners in one point
  }

  /// Springs between all pairs of points of each element.
  template <class Elements>
  void addAll(Elements const& elements, double stiffness, double damping) {
    if (stiffness == 0 && damping == 0) return;
    for (auto const& e : elements)
      for (std::size_t i = 0; i < e.size(); ++i)
        for (std::size_t j = i + 1; j < e.size(); ++j) add(e[i], e[j], stiffness, damping);
  }
  /// Springs between some pairs of corners of each element.
  template <class Elements, std::size_t N>
  void addSome(Elements const& elements, int const (&corners)[N][2], double stiffness, double damping) {
    if (stiffness == 0 && damping == 0) return;
    for (auto const& e : elements)
      for (auto const& [i, j] : corners) add(e[std::size_t(i)], e[std::size_t(j)], stiffness, damping);
  }

  bool empty() const { return links_.empty(); }

  /// With elongationOnly all springs are strings, which pull and never push.
  void init(Driver& driver, bool elongationOnly) const {
    // a stable sort keeps the first of equal links in front; the order in which they came is restored
    struct Key {
      int low, high;
      std::size_t order;
      auto operator<=>(Key const&) const = default;
    };
    std::vector<Key> keys;
    keys.reserve(links_.size());
    for (std::size_t k = 0; k < links_.size(); ++k)
      keys.push_back({std::min(links_[k].i, links_[k].j), std::max(links_[k].i, links_[k].j), k});
    std::sort(keys.begin(), keys.end());
    const auto same = [](Key const& a, Key const& b) { return a.low == b.low && a.high == b.high; };
    keys.erase(std::unique(keys.begin(), keys.end(), same), keys.end());
    std::sort(keys.begin(), keys.end(), [](Key const& a, Key const& b) { return a.order < b.order; });

    std::vector<typename Driver::Indices> ends;
    std::vector<typename Driver::Rest> springs;
    for (Key const& key : keys) {
      Link const& link = links_[key.order];
      const Real length = (rest_[std::size_t(link.j)] - rest_[std::size_t(link.i)]).norm();
      const Real divisor = length > Real(0) ? length : Real(1);
      ends.push_back({link.i, link.j});
      springs.push_back(
          {Real(link.stiffness) / divisor, Real(link.damping) / divisor, elongationOnly ? -length : length});
    }
    driver.init(ends, springs);
  }

 private:
  struct Link {
    int i, j;
    double stiffness, damping;
  };
  typename D::VecCoord const& rest_;
  std::vector<Link> links_;
};

// corners of a cell in VTK's order
inline constexpr int quad_edges[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
inline constexpr int hexahedron_edges[12][2] = {
    {0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
inline constexpr int hexahedron_face_diagonals[12][2] = {
    {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 5}, {1, 4}, {3, 6}, {2, 7}, {0, 7}, {3, 4}, {1, 6}, {2, 5}};
inline constexpr int pyramid_edges[8][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
inline constexpr int pyramid_face_diagonals[2][2] = {{0, 2}, {1, 3}};
inline constexpr int prism_edges[9][2] = {
    {0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
inline constexpr int prism_face_diagonals[6][2] = {{0, 4}, {1, 3}, {1, 5}, {2, 4}, {2, 3}, {0, 5}};
inline constexpr int hexahedron_diagonals[4][2] = {{0, 6}, {1, 7}, {2, 4}, {3, 5}};
inline constexpr int hexahedron_faces[6][4] = {
    {0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 3, 7, 4}, {1, 2, 6, 5}};

}  // namespace sinew
