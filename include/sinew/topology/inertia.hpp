// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <span>

namespace sinew {

/// What a body of density 1 weighs: its volume [m^3], the centre of it [m], and its inertia about the centre
/// in the axes of the mesh [m^5].
struct MassProperties {
  double volume = 0;
  Eigen::Vector3d center{0, 0, 0};
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// The properties of the body inside a closed surface of triangles and quads (each the triangles 012 and
/// 023), exact but for rounding: integrals of 1, x and x x' over the tetrahedra between the triangles and a
/// point, with the sign of their volume,
///   V = d/6,   int x = d/24 s,   int x x' = d/120 (s s' + a a' + b b' + c c'),
///   s = a + b + c,   d = a.(b x c)
/// which the divergence theorem gives too (Mirtich, "Fast and accurate computation of polyhedral mass
/// properties", 1996). The front of the surface may be inside as well as outside. Throws Error, naming
/// `where`, unless the surface is closed, its faces oriented alike, and there is a volume in it.
MassProperties mass_properties(std::string_view where, std::span<Eigen::Vector3d const> x,
                               std::span<Triangle const> triangles, std::span<Quad const> quads);

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <vector>

namespace sinew {

SINEW_ONCE MassProperties mass_properties(std::string_view where, std::span<Eigen::Vector3d const> x,
                                          std::span<Triangle const> triangles, std::span<Quad const> quads) {
  detail::check_indices(where, "triangle", triangles, x.size());
  detail::check_indices(where, "quad", quads, x.size());
  std::vector<Triangle> all(triangles.begin(), triangles.end());
  for (Quad const& q : quads) all.insert(all.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
  if (all.empty()) throw Error(where, "there is no triangle and no quad; give a closed surface");

  // closed: each edge is passed as often in one direction as in the other
  std::vector<Edge> there, back;
  for (Triangle const& t : all)
    for (std::size_t k = 0; k < 3; ++k) {
      there.push_back({t[k], t[(k + 1) % 3]});
      back.push_back({t[(k + 1) % 3], t[k]});
    }
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  if (const auto gap = std::mismatch(there.begin(), there.end(), back.begin()); gap.first != there.end()) {
    const Edge e = std::min(*gap.first, *gap.second);
    throw Error(
        where,
        text("the surface is not closed, or its faces are not oriented alike, at the edge from point ",
             e[0],
             " to ",
             e[1],
             "; merge points in one place, close the holes, and reverse the faces"));
  }

  // from the middle of the points, where rounding is least
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), first = Eigen::Vector3d::Zero();
  for (Triangle const& t : all)
    for (const Index i : t) origin += x[std::size_t(i)] / (3 * double(all.size()));
  double volume = 0, cover = 0;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (Triangle const& t : all) {
    const Eigen::Vector3d a = x[std::size_t(t[0])] - origin, b = x[std::size_t(t[1])] - origin,
                          c = x[std::size_t(t[2])] - origin, s = a + b + c;
    const double d = a.dot(b.cross(c));
    volume += d / 6;
    cover += std::abs(d) / 6;
    first += d / 24 * s;
    second += d / 120 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  if (!(std::abs(volume) > 1e-12 * cover))
    throw Error(where, "the surface holds no volume; give a surface with an inside");
  const Eigen::Vector3d center = first / volume;
  second -= volume * center * center.transpose();
  MassProperties body{std::abs(volume), origin + center, {}};
  body.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  if (volume < 0) body.inertia = -body.inertia;
  return body;
}

}  // namespace sinew
#endif
