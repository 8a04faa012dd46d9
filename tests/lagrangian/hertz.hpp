// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>

#include <cmath>
#include <vector>

// What the two problems of Hertz have in common: a mesh that is fine where it touches, and forces of its
// points.

/// Places from 0 to `end`, `cell` apart up to `fine`, and from there on each `growth` times as far apart as
/// the last; the last one ends where it should.
inline std::vector<double> graded(double cell, double fine, double growth, double end) {
  std::vector<double> at{0};
  while (at.back() < end) {
    if (at.back() >= fine) cell *= growth;
    at.push_back(at.back() + cell);
  }
  for (double& a : at) a *= end / at.back();
  return at;
}

/// |f_z| of each of `count` points, of those in `skin` by contacts of the skin with triangles across z [N].
inline std::vector<double> pressed_points(std::vector<sinew::Contact> const& contacts,
                                          std::vector<int> const& skin, std::size_t count) {
  std::vector<double> force(count, 0);
  for (sinew::Contact const& c : contacts) {
    const bool first = c.a.corners() == 1;
    force[std::size_t(skin[std::size_t((first ? c.a : c.b).vertices[0])])] += std::abs(c.force[2]);
  }
  return force;
}
