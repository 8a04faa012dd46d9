// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/record.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace cli {

/// Distance between the positions of one body in both, over points and times [m].
struct Distance {
  std::size_t points = 0, count = 0;
  double sum = 0;  // of squares
  double largest = 0, largestAt = 0, lastRms = 0;
  std::string problem{};  // why it is not compared

  double rms() const { return count > 0 ? std::sqrt(sum / double(count)) : 0; }

  void add(sinew::RecordedState const& a, sinew::RecordedState const& b, double time) {
    if (!problem.empty()) return;
    const auto la = *sinew::record_layout(a.dataTypes), lb = *sinew::record_layout(b.dataTypes);
    if (a.points != b.points || la.place != lb.place) {
      problem = sinew::text(a.points, " points over ", a.dataTypes, " and ", b.points, " over ", b.dataTypes);
      return;
    }
    points = a.points;
    double now = 0;
    for (std::size_t p = 0; p < points; ++p) {
      double squares = 0;
      for (std::size_t i = 0; i < la.place; ++i) {
        const double d = a.positions[p * la.position + i] - b.positions[p * lb.position + i];
        squares += d * d;
      }
      now += squares;
      if (std::sqrt(squares) > largest) largest = std::sqrt(squares), largestAt = time;
    }
    sum += now;
    count += points;
    lastRms = points > 0 ? std::sqrt(now / double(points)) : 0;
  }
};

/// The bodies of two scenes that have the same path.
struct Comparison {
  std::map<std::string, Distance> bodies{};
  std::vector<std::string> onlyA{}, onlyB{};
  std::size_t frames = 0;

  void add(sinew::RecordedFrame const& a, sinew::RecordedFrame const& b) {
    auto missing = [](auto const& state, auto const& other) {
      return std::none_of(
          other.states.begin(), other.states.end(), [&](auto const& o) { return o.path == state.path; });
    };
    if (frames++ == 0) {
      for (auto const& s : a.states)
        if (missing(s, b)) onlyA.push_back(s.path);
      for (auto const& s : b.states)
        if (missing(s, a)) onlyB.push_back(s.path);
    }
    for (auto const& s : a.states)
      for (auto const& o : b.states)
        if (s.path == o.path) bodies[s.path].add(s, o, a.time);
  }
};

}  // namespace cli
