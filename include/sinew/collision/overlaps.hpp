// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact.hpp>

#include <utility>
#include <vector>

namespace sinew {

/// Two models whose bodies are in each other, and how deep, as far as their contacts say [m].
struct Overlap {
  int a, b;  // surfaces
  double depth;
};

/// The pairs of models that are in each other by more than 1e-4 of the diagonal of the smaller one, each two
/// nodes once: with contacts at negative distances (spheres, hulls, one-sided triangles), or, of two states,
/// with an edge of a triangle that passes through a triangle of the other, whichever side is its outside.
/// `near`: the pairs whose boxes overlap; boxes and trees are those of where the surfaces are. What is whole
/// inside of two-sided triangles is not seen, and a body whose own edges join the two places is not asked.
/// Allocates only for what it finds, and for what a body has with itself.
std::vector<Overlap> overlaps(std::vector<CollisionSurface*> const& surfaces,
                              std::vector<std::pair<int, int>> const& near,
                              std::vector<Contact> const& contacts);

/// The pairs with contacts by multipliers that are new, and deeper than their limit by more than 1e-3 of that
/// diagonal: what moves farther in a step than contacts are looked for.
std::vector<Overlap> unseen_overlaps(std::vector<CollisionSurface*> const& surfaces,
                                     std::vector<Contact> const& contacts);

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <cmath>

namespace sinew {
namespace detail {

// whether an edge of one triangle passes through the other, its ends farther than `least` from its plane
inline bool passes_through(std::array<Eigen::Vector3d, 3> const& of, std::array<Eigen::Vector3d, 3> const& t,
                           double least) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double twiceArea = normal.norm();
  if (!(twiceArea > 0)) return false;
  const Eigen::Vector3d n = normal / twiceArea;
  for (std::size_t c = 0; c < 3; ++c) {
    Eigen::Vector3d const &p = of[c], &q = of[(c + 1) % 3];
    const double hp = n.dot(p - t[0]), hq = n.dot(q - t[0]);
    if (!(std::min(hp, hq) < -least && std::max(hp, hq) > least)) continue;
    const Eigen::Vector3d x = p + hp / (hp - hq) * (q - p);
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d edge = t[(k + 1) % 3] - t[k];
      inside = inside && n.dot(edge.cross(x - t[k])) > least * edge.norm();
    }
    if (inside) return true;
  }
  return false;
}

// Whether edges of two surfaces on one state join two of its points.
inline bool are_joined(CollisionSurface const& a, CollisionSurface const& b, int from, int to) {
  std::vector<char> reached(a.position.size(), 0);
  std::vector<int> next{from};
  while (!next.empty()) {
    const auto v = std::size_t(next.back());
    next.pop_back();
    if (int(v) == to) return true;
    for (CollisionSurface const* s : {&a, &b})
      for (int k = s->firstAround[v]; k < s->firstAround[v + 1]; ++k)
        if (const int other = s->around[std::size_t(k)]; !reached[std::size_t(other)]) {
          reached[std::size_t(other)] = 1;
          next.push_back(other);
        }
  }
  return false;
}

struct OverlapList {
  std::vector<CollisionSurface*> const& surfaces;
  std::vector<Overlap> all{};

  CollisionSurface const& at(int i) const { return *surfaces[std::size_t(i)]; }
  // of the smaller one
  double diagonal(int i, int j) const {
    auto of = [](AxisBox const& box) { return (box.max - box.min).norm(); };
    return std::min(of(at(i).box), of(at(j).box));
  }
  void add(int i, int j, double depth) {
    for (Overlap& o : all)
      if (at(o.a).path == at(i).path && at(o.b).path == at(j).path) {
        o.depth = std::max(o.depth, depth);
        return;
      }
    all.push_back({i, j, depth});
  }
  void addDeeper(Contact const& c, double least) {
    CollisionSurface const &a = at(c.a.surface), &b = at(c.b.surface);
    if (-c.distance > least && !(a.state == b.state && are_joined(a, b, c.a.vertices[0], c.b.vertices[0])))
      add(c.a.surface, c.b.surface, -c.distance);
  }
};

}  // namespace detail

SINEW_ONCE std::vector<Overlap> overlaps(std::vector<CollisionSurface*> const& surfaces,
                                         std::vector<std::pair<int, int>> const& near,
                                         std::vector<Contact> const& contacts) {
  detail::OverlapList list{surfaces};
  for (Contact const& c : contacts) list.addDeeper(c, 1e-4 * list.diagonal(c.a.surface, c.b.surface));
  for (auto [i, j] : near) {
    CollisionSurface const &a = list.at(i), &b = list.at(j);
    if (a.shape != Shape::triangle || b.shape != Shape::triangle || a.state == b.state) continue;
    bool found = false;
    const double least = 1e-4 * list.diagonal(i, j);
    a.tree.pairs(b.tree, 0, [&](int m, int n) {
      if (found || a.isOneWith(m, b, n)) return;
      const auto s = a.corner<3>(a.position, m), t = b.corner<3>(b.position, n);
      found = detail::passes_through(s, t, least) || detail::passes_through(t, s, least);
    });
    if (found) list.add(i, j, 0);
  }
  return std::move(list.all);
}

SINEW_ONCE std::vector<Overlap> unseen_overlaps(std::vector<CollisionSurface*> const& surfaces,
                                                std::vector<Contact> const& contacts) {
  detail::OverlapList list{surfaces};
  for (Contact const& c : contacts)
    if (c.isNew && -c.distance > 0)
      list.addDeeper(c, c.limit + 1e-3 * list.diagonal(c.a.surface, c.b.surface));
  return std::move(list.all);
}

}  // namespace sinew
#endif
