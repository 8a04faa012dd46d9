// SPDX-License-Identifier: BSL-1.0
#include "script.hpp"

#include <array>

namespace examples {

namespace {

sinew::Rigid3d::Coord frame(Eigen::Vector3d const& tip) {
  const Eigen::Vector3d hole(0.02, -0.13, 0.0955);
  sinew::Rigid3d::Coord c;
  c.center = tip;
  c.orientation = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), hole - tip);
  return c;
}

}  // namespace

LaparoscopyScript::Movement LaparoscopyScript::trajectory(double length) {
  struct Way {
    double time;
    Eigen::Vector3d tip;
  };
  static const std::array<Way, 18> ways{{
      {0, {0.02, -0.09, 0.07}},  // hovers
      {2, {-0.03, -0.01, 0.072}},
      {3.5, {-0.03, -0.01, 0.046}},  // pushes the liver
      {4.5, {-0.02, -0.02, 0.045}},  // slides over it
      {6, {-0.03, -0.03, 0.072}},
      {7.5, {0.06, -0.14, 0.03}},
      {8.5, {0.06, -0.13, 0}},    // pushes the intestines
      {10.5, {-0.06, -0.13, 0}},  // slides over them
      {11.4, {-0.02, -0.135, 0.03}},
      {12, {0.0, -0.106, 0.012}},
      {12.4, {0.0, -0.106, -0.035}},  // goes down between two loops
      {13.6, {0.0, -0.088, -0.035}},  // pushes one towards the liver
      {14.4, {-0.02, -0.105, 0.035}},
      {15.3, {0.05, -0.021, 0.02}},  // grasps the lower edge of the left lobe
      {17.4, {0.04, -0.03, 0.05}},   // lifts it
      {18.2, {0.04, -0.03, 0.05}},
      {18.6, {0.04, -0.045, 0.06}},  // has let go
      {20, {0.02, -0.09, 0.07}},
  }};
  Movement m;
  constexpr int keys = 200;
  for (int k = 0; k <= keys; ++k) {
    const double t = period * k / keys;
    std::size_t w = 0;
    while (w + 2 < ways.size() && t >= ways[w + 1].time) ++w;
    const double u = (t - ways[w].time) / (ways[w + 1].time - ways[w].time);
    const double eased = u * u * (3 - 2 * u);
    m.times.push_back(length * k / keys);
    m.positions.push_back(frame(ways[w].tip + eased * (ways[w + 1].tip - ways[w].tip)));
  }
  return m;
}

}  // namespace examples
