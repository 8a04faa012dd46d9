// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/profile_report.hpp>

#include <map>
#include <string>
#include <vector>

// what a profile says, by where it was called: "step/root EulerImplicitSolver/force"
inline std::map<std::string, sinew::ProfileLine> lines_of(sinew::Profile const& profile) {
  std::map<std::string, sinew::ProfileLine> lines;
  std::vector<std::string> around;
  for (auto const& line : sinew::profile_lines(profile)) {
    around.resize(std::size_t(line.depth));
    std::string name =
        (around.empty() ? "" : around.back() + "/") + line.name + (line.isPhase ? "" : " " + line.className);
    while (lines.contains(name)) name += "'";  // two components of a class in one node
    around.push_back(name);
    lines.emplace(name, line);
  }
  return lines;
}
