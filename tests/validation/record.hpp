// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>

#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>

/// What a test measures, for the plots and tables of docs/validation.md: rows of NAME.csv in the folder that
/// the environment variable SINEW_VALIDATION_DIR names, and nothing where it is not set. A cell is a number
/// or words; `./dev validation` makes the page.
class Record {
 public:
  Record(std::string_view name, std::initializer_list<std::string_view> columns) {
    if (!wanted()) return;
    const std::string path = sinew::text(std::getenv("SINEW_VALIDATION_DIR"), '/', name, ".csv");
    file.open(path);
    if (!file) throw sinew::Error("Record", sinew::text("cannot write ", path));
    std::string_view separator = "";
    for (std::string_view column : columns) file << separator << column, separator = ",";
    file << '\n';
  }
  template <class First, class... Cells>
  void row(First const& first, Cells const&... cells) {
    if (!file.is_open()) return;
    file << cell(first);
    ((file << ',' << cell(cells)), ...);
    file << '\n';
  }
  /// Whether anyone reads: what only the plots need is not worth computing else.
  static bool wanted() { return std::getenv("SINEW_VALIDATION_DIR") != nullptr; }

 private:
  template <class T>
  static std::string cell(T const& value) {
    const std::string words = sinew::text(value);
    return words.find(',') == std::string::npos ? words : '"' + words + '"';
  }
  std::ofstream file{};
};
