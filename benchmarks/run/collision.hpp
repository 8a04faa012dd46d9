// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

// What the libraries under comparison do, without a type of theirs: they are compiled apart, for the
// processor that their packages are compiled for. All coordinates are binary fractions short enough for
// floats, so that single and double precision must find the same pairs.
namespace bench {

/// Coordinates of points or centres, one after the other.
using Coordinates = std::vector<double>;

/// Two surfaces of the same triangles, or balls.
struct Bodies {
  std::vector<std::array<int, 3>> triangles{};
  Coordinates first{}, second{};
  double radius = 0;
};

struct Contender {
  std::function<void(Bodies const&)> take;  // new coordinates, in the types of the library; not timed
  std::function<void()> step;               // from the coordinates to the pairs
  std::function<std::size_t()> pairs;       // how many boxes overlap; not timed
};

// empty where the library is not there
Contender bullet_surfaces(Bodies const& start);
Contender bullet_balls(Bodies const& start);
Contender bullet_balls_on_surface(Bodies const& start);
Contender fcl_surfaces(Bodies const& start);
// FCL moves balls in two ways: by new boxes in the same tree, `refit`, or by taking each out and in
Contender fcl_balls(Bodies const& start, bool refit);

}  // namespace bench
