// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/runtime/value_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace sinew::view {

/// A number over time.
struct Series {
  std::string name{}, unit{};
  std::vector<double> values{};
};

/// What is measured of a simulation after each step.
struct Measures {
  std::vector<double> times{};  // [s]
  std::vector<Series> series{};

  static constexpr std::size_t most = 20000;  // steps; of more, the older half goes
  void drop() {
    if (times.size() < most) return;
    auto halve = [](std::vector<double>& list) { list.erase(list.begin(), list.begin() + most / 2); };
    halve(times);
    for (Series& one : series) halve(one.values);
  }
};

namespace detail {
// what a table has in one column
inline std::string in_csv(std::string name) {
  for (char& c : name)
    if (c == ',' || c == '"' || c == '\n' || c == '\r') c = ' ';
  return name;
}
}  // namespace detail

/// One line for each step, with the time and all series, as comma separated values.
inline std::string csv_of(Measures const& measures) {
  std::string words = "time [s]";
  for (Series const& one : measures.series)
    words +=
        text(',', detail::in_csv(one.name), one.unit.empty() ? std::string() : text(" [", one.unit, ']'));
  words += '\n';
  for (std::size_t i = 0; i < measures.times.size(); ++i) {
    words += write_value(measures.times[i]);
    for (Series const& one : measures.series)
      words += text(',', i < one.values.size() ? write_value(one.values[i]) : std::string());
    words += '\n';
  }
  return words;
}

namespace detail {
inline std::string in_xml(std::string_view words) {
  std::string safe;
  for (const char c : words)
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else
      safe += c;
  return safe;
}
inline std::string short_number(double value) {
  char words[32];
  std::snprintf(words, sizeof words, "%.4g", value);
  return words;
}
}  // namespace detail

/// A picture of all series, one below the other, over time.
inline std::string svg_of(Measures const& measures) {
  constexpr double width = 720, height = 150, left = 80, right = 20, top = 26, bottom = 24;
  const double inner = width - left - right, high = height - top - bottom;
  std::string svg = text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"",
                         width,
                         "\" height=\"",
                         height * double(measures.series.size()),
                         "\" font-family=\"sans-serif\" font-size=\"12\">\n");
  const double first = measures.times.empty() ? 0 : measures.times.front(),
               last = measures.times.empty() ? 1 : measures.times.back(),
               span = last > first ? last - first : 1;
  double y0 = 0;
  for (Series const& one : measures.series) {
    double low = 0, high0 = 0;
    bool any = false;
    for (const double v : one.values)
      if (std::isfinite(v)) {
        low = any ? std::min(low, v) : v;
        high0 = any ? std::max(high0, v) : v;
        any = true;
      }
    const double range = high0 > low ? high0 - low : 1;
    auto say = [&](double x, double y, char const* anchor, std::string const& words) {
      svg += text("<text x=\"",
                  x,
                  "\" y=\"",
                  y,
                  "\" text-anchor=\"",
                  anchor,
                  "\">",
                  detail::in_xml(words),
                  "</text>\n");
    };
    svg += text("<rect x=\"",
                left,
                "\" y=\"",
                y0 + top,
                "\" width=\"",
                inner,
                "\" height=\"",
                high,
                "\" fill=\"none\" stroke=\"#999\"/>\n");
    say(left, y0 + top - 8, "start", one.unit.empty() ? one.name : text(one.name, " [", one.unit, ']'));
    say(left - 6, y0 + top + 10, "end", detail::short_number(low + range));
    say(left - 6, y0 + top + high, "end", detail::short_number(low));
    say(left, y0 + height - 8, "start", text(detail::short_number(first), " s"));
    say(left + inner, y0 + height - 8, "end", text(detail::short_number(last), " s"));
    svg += "<polyline fill=\"none\" stroke=\"#0072b2\" points=\"";
    for (std::size_t i = 0; i < one.values.size() && i < measures.times.size(); ++i)
      if (std::isfinite(one.values[i]))
        svg += text(detail::short_number(left + inner * (measures.times[i] - first) / span),
                    ',',
                    detail::short_number(y0 + top + high * (1 - (one.values[i] - low) / range)),
                    ' ');
    svg += "\"/>\n";
    y0 += height;
  }
  return svg + "</svg>\n";
}

}  // namespace sinew::view
