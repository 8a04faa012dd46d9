// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/drawn_marks.hpp>

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace sinew::view {

/// Words and coloured areas in front of a picture, as triangles in pixels from the upper left corner.
class Overlay {
 public:
  /// `scale`: pixels for each that a letter is wide or high by itself, which are about 6 and 8.
  Overlay(double scale, Eigen::Vector3d const& ink) : scale_(scale), ink_(ink) {}

  ColouredPlaces const& triangles() const { return triangles_; }

  void addArea(double x, double y, double width, double height, Eigen::Vector3d const& above,
               Eigen::Vector3d const& below) {
    auto add = [&](double px, double py) {
      triangles_.add({x + px * width, y + py * height, 0}, py > 0 ? below : above);
    };
    add(0, 0), add(0, 1), add(1, 1);
    add(0, 0), add(1, 1), add(1, 0);
  }
  /// From the upper left corner of its first letter on; what is no letter of ASCII is a question mark.
  void addText(double x, double y, std::string words) {
    for (char& c : words)
      if (c < ' ' || c > '~') c = '?';
    struct Corner {
      float x, y, z;
      unsigned char colour[4];
    };
    std::vector<char> buffer(1000 * words.size() + 1);
    const int quads = stb_easy_font_print(0, 0, words.data(), nullptr, buffer.data(), int(buffer.size()));
    for (std::size_t q = 0; q < std::size_t(quads); ++q) {
      Corner corners[4];
      std::memcpy(corners, buffer.data() + q * sizeof corners, sizeof corners);
      for (const int k : {0, 1, 2, 0, 2, 3})
        triangles_.add({x + scale_ * double(corners[k].x), y + scale_ * double(corners[k].y), 0}, ink_);
    }
  }
  double widthOf(std::string words) const { return scale_ * stb_easy_font_width(words.data()); }

  /// At the right edge.
  void addLegend(Legend const& legend, int width, int height) {
    constexpr int steps = 32, ticks = 5;
    const double bar = 14 * scale_, x = width - bar - 64 * scale_, top = 0.22 * height, high = 0.56 * height;
    for (int k = 0; k < steps; ++k)
      addArea(x,
              top + high * k / steps,
              bar,
              high / steps,
              colour_of_value(1 - double(k) / steps),
              colour_of_value(1 - double(k + 1) / steps));
    for (int k = 0; k < ticks; ++k) {
      const double share = double(k) / (ticks - 1), y = top + high * (1 - share);
      addArea(x + bar, y - scale_ / 2, 4 * scale_, scale_, ink_, ink_);
      addText(x + bar + 7 * scale_,
              y - 4 * scale_,
              detail::number_words(legend.low + share * (legend.high - legend.low)));
    }
    const std::string title = legend.unit.empty() ? legend.title : text(legend.title, " [", legend.unit, ']');
    addText(width - 8 * scale_ - widthOf(title), top - 20 * scale_, title);
  }
  /// One below the other, at the lower left corner.
  void addWords(std::vector<std::string> const& words, int height) {
    double y = height - 12 * scale_ * double(words.size()) - 4 * scale_;
    for (std::string const& line : words) {
      addText(8 * scale_, y, line);
      y += 12 * scale_;
    }
  }

 private:
  double scale_;
  Eigen::Vector3d ink_;
  ColouredPlaces triangles_{};
};

}  // namespace sinew::view
