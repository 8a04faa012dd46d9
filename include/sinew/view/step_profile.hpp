// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/profile_report.hpp>
#include <sinew/view/plots.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace sinew::view {

/// The time that one component takes, or one phase of a step outside of components, wherever it is called:
/// without that of what it calls itself, so that the times of all add up to the whole.
struct TimeShare {
  std::string name{}, className{};  // "liver/fem", "TetrahedronFEMForceField<Vec3d>"; of a phase, no class
  double milliseconds = 0;          // in a step
  double share = 0;                 // of the whole, from 0 to 1
  double calls = 0;                 // in a step
};

/// Where the time of steps goes, the largest share first.
struct StepProfile {
  long steps = 0;
  std::vector<TimeShare> shares{};
};

inline StepProfile step_profile(Profile const& profile) {
  StepProfile made{.steps = profile.calls(Phase::step)};
  if (made.steps == 0) return made;
  double whole = 0;
  for (ProfileLine const& line : profile_lines(profile)) {
    if (line.seconds <= 0) continue;  // what is only counted
    auto found = std::find_if(made.shares.begin(), made.shares.end(), [&](TimeShare const& s) {
      return s.name == line.name && s.className == line.className;
    });
    if (found == made.shares.end())
      found = made.shares.insert(found, {.name = line.name, .className = line.className});
    found->milliseconds += 1e3 * std::max(line.own, 0.) / double(made.steps);
    found->calls += double(line.calls) / double(made.steps);
    whole += 1e3 * std::max(line.own, 0.) / double(made.steps);
  }
  for (TimeShare& one : made.shares) one.share = whole > 0 ? one.milliseconds / whole : 0;
  std::stable_sort(made.shares.begin(), made.shares.end(), [](TimeShare const& a, TimeShare const& b) {
    return a.milliseconds > b.milliseconds;
  });
  return made;
}

/// One line for each share, as comma separated values.
inline std::string csv_of(StepProfile const& profile) {
  std::string words = "component or phase,class,time in a step [ms],share [%],calls in a step\n";
  for (TimeShare const& one : profile.shares)
    words += text(detail::in_csv(one.name),
                  ',',
                  detail::in_csv(one.className),
                  ',',
                  write_value(one.milliseconds),
                  ',',
                  write_value(100 * one.share),
                  ',',
                  write_value(one.calls),
                  '\n');
  return words;
}

/// A picture of bars, one for each share.
inline std::string svg_of(StepProfile const& profile) {
  constexpr double width = 720, high = 22, left = 300, most = 330;
  std::string svg = text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"",
                         width,
                         "\" height=\"",
                         high * double(profile.shares.size() + 1),
                         "\" font-family=\"sans-serif\" font-size=\"12\">\n<text x=\"",
                         left,
                         "\" y=\"15\">time in a step, mean of ",
                         profile.steps,
                         " steps</text>\n");
  const double longest = profile.shares.empty() ? 1 : std::max(profile.shares.front().milliseconds, 1e-12);
  double y = high;
  for (TimeShare const& one : profile.shares) {
    const double bar = most * one.milliseconds / longest;
    svg += text("<text x=\"",
                left - 8,
                "\" y=\"",
                y + 15,
                "\" text-anchor=\"end\">",
                detail::in_xml(one.name),
                "<title>",
                detail::in_xml(one.className),
                "</title></text>\n<rect x=\"",
                left,
                "\" y=\"",
                y + 3,
                "\" width=\"",
                detail::short_number(bar),
                "\" height=\"",
                high - 6,
                "\" fill=\"#0072b2\"/>\n<text x=\"",
                detail::short_number(left + bar + 6),
                "\" y=\"",
                y + 15,
                "\">",
                detail::short_number(one.milliseconds),
                " ms</text>\n");
    y += high;
  }
  return svg + "</svg>\n";
}

}  // namespace sinew::view
