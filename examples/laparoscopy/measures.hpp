// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "bodies.hpp"

#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace examples {

/// Bounds of a run of the laparoscopy: whether it stayed sound.
struct LaparoscopyMeasures {
  double fastest = 0;                                          // of the points of organs [m/s]
  double kinetic = 0, potential = 0;                           // most energy [J]
  double deepest = -std::numeric_limits<double>::infinity();   // penetration of two bodies [m]
  double farthest = -std::numeric_limits<double>::infinity();  // of a skin from inside the wall [m]
  double smallest = 1, largest = 1;                            // volume of a skin, over that at rest
  std::string where{};                                         // of that penetration
  double lowest = 1;             // volume of a tetrahedron or cell, over that at rest
  std::size_t contacts = 0;      // most at a time
  int within = 0;                // places of ribs and tool seen inside organs
  int maximum = 0, longest = 0;  // inverted elements at a time, and looks in a row at which one was inverted
  std::vector<int> inRow[2]{};

  /// After a step; `closely` also measures what takes long.
  template <class Manager, class Sim>
  void look(Sim& sim, LaparoscopyBodies const& b, bool closely) {
    auto const& manager = sim.root().template get<Manager>();
    contacts = std::max(contacts, manager.contacts.size());
    const double gap = sim.root().template get<sinew::MinProximityIntersection>().contactDistance;
    for (auto const& c : manager.contacts)
      if (const double depth = c.limit - gap - c.distance;
          depth > deepest) {  // limit - gap: of lines, radius
        deepest = depth;
        auto path = [&](sinew::ContactSide const& side) {
          return manager.surfaces[std::size_t(side.surface)]->path;
        };
        where = path(c.a) + " and " + path(c.b);
      }
    for (auto const* v : {&sim.template at<"organs/liver">().state().velocity,
                          &sim.template at<"organs/intestines">().state().velocity})
      for (auto const& u : *v) fastest = std::max(fastest, u.norm());
    if (!closely) return;
    kinetic = std::max(kinetic, sim.kineticEnergy());
    potential = std::max(potential, sim.potentialEnergy());
    organ(sim.template at<"organs/liver">().state().position,
          sim.template at<"organs/liver/skin">().state().position,
          sim.template at<"tool/shaft">().state().position,
          b.liver,
          b,
          0);
    organ(sim.template at<"organs/intestines">().state().position,
          sim.template at<"organs/intestines/skin">().state().position,
          sim.template at<"tool/shaft">().state().position,
          b.intestines,
          b,
          1);
  }

 private:
  using Points = std::vector<Eigen::Vector3d>;

  void organ(Points const& points, Points const& skin, Points const& shaft, Organ const& o,
             LaparoscopyBodies const& b, std::size_t number) {
    for (auto const& p : skin) farthest = std::max(farthest, b.room(p));
    const double volume = enclosed_volume(skin, o.skin.triangles) / o.volumeOfSkin;
    smallest = std::min(smallest, volume);
    largest = std::max(largest, volume);
    for (auto const* list : {&b.ribs.positions, &shaft})
      for (auto const& p : *list) within += is_inside(p, skin, o.skin.triangles);
    inverted(points, o, inRow[number]);
  }

  void inverted(Points const& x, Organ const& o, std::vector<int>& row) {
    int now = 0;
    std::size_t element = 0;
    auto see = [&](auto&& volume) {
      if (element == row.size()) row.push_back(0);
      const double ratio = volume(x) / volume(o.volume.positions);
      int& r = row[element++];
      r = ratio > 0 ? 0 : r + 1;
      now += r > 0;
      longest = std::max(longest, r);
      lowest = std::min(lowest, ratio);
    };
    for (auto const& t : o.volume.tetrahedra)
      see([&](Points const& p) {
        auto edge = [&](std::size_t k) -> Eigen::Vector3d {
          return p[std::size_t(t[k])] - p[std::size_t(t[0])];
        };
        return edge(1).cross(edge(2)).dot(edge(3));
      });
    // of cells, by the mean edges
    auto const& n = o.grid;
    for (int k = 0; k + 1 < n[2]; ++k)
      for (int j = 0; j + 1 < n[1]; ++j)
        for (int i = 0; i + 1 < n[0]; ++i)
          see([&](Points const& p) {
            Eigen::Vector3d e[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
            for (int c = 0; c < 8; ++c) {
              const int corner = i + (c & 1) + n[0] * (j + (c >> 1 & 1) + n[1] * (k + (c >> 2)));
              for (int a = 0; a < 3; ++a) e[a] += (c >> a & 1 ? 1 : -1) * p[std::size_t(corner)];
            }
            return e[0].cross(e[1]).dot(e[2]);
          });
    maximum = std::max(maximum, now);
  }
};

}  // namespace examples
