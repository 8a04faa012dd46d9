// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cli {

/// What stands on top of the table of a sweep.
struct SweepHeader {
  std::string key{};  // another one of each scene, and of what is asked of it
  std::size_t runs = 0;
  std::string command{};  // which makes the table
  std::vector<std::string> columns{};

  std::string text() const;
};

/// The table of a sweep in a file (CSV): a line that begins with '#', names of columns, a line for each run
/// that has ended. The first column is the number of the run, from 1, the last one its error. Each line is
/// added by one write, so that a program that is killed leaves those before it, and one that starts again
/// goes on with what is missing. Functions throw Failure.
class SweepTable {
 public:
  /// Begins the file, or goes on with it; what is no table of this sweep is refused, and so is one in which
  /// another process writes. `again`: runs that had an error count as missing.
  SweepTable(std::string path, SweepHeader header, bool again = false);
  SweepTable(SweepTable const&) = delete;
  SweepTable& operator=(SweepTable const&) = delete;
  ~SweepTable();

  /// Whether a run, counted from 0, is there.
  bool has(std::size_t run) const { return there_[run]; }
  /// Adds the line of a run, without its end.
  void add(std::size_t run, std::string line);
  /// Puts the lines into the order of their runs.
  void sort();

 private:
  std::string path_;
  SweepHeader header_;
  int file_ = -1;
  std::vector<bool> there_;

  void open();
  void close();
  void append(std::string_view bytes);
};

/// What is in the table of a sweep.
struct SweepRows {
  SweepHeader header{};
  std::vector<std::pair<std::size_t, std::string>> rows{};  // runs from 0, and their lines
  std::size_t whole = 0;                                    // bytes up to the end of the last whole line
};
/// Reads a table that sweeps have written, from the content of a file; a last line without an end, of a
/// program that was killed, is left out. Throws Failure.
SweepRows read_sweep(std::string const& path, std::string const& content);

/// The same with each run once, in order; of several those without an error.
void sort_runs(SweepRows& table);
/// Whether the line of a run has an error.
bool has_error(std::string_view line);

}  // namespace cli
