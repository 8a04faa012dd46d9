// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

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
