// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "combinations.hpp"
#include "measures.hpp"
#include "sweep_table.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

/// What a sweep is asked for, as all of its runs know it, and what each of them does. Nothing is read of the
/// scene before probe().
class SweepPlan {
 public:
  SweepOptions const& options;
  Combinations combinations;
  std::string output;  // the table
  SweepHeader header{};

  /// Throws Failure where the command line is wrong.
  explicit SweepPlan(SweepOptions const& asked);

  /// Processes that run at a time.
  int jobs() const;
  /// The runs of this part, from 0.
  std::vector<std::size_t> ofPart() const;

  /// Reads the scene, measures it before its first step, and returns what is known then, a line each: the key
  /// of the table, then the columns of what --measure asks for. Throws Failure where the scene is wrong, and
  /// where a path leads nowhere.
  std::string probe() const;
  /// What probe() has returned.
  void know(std::vector<std::string> const& lines);

  /// Simulates a run, and returns its line.
  std::string run(std::size_t run) const;
  /// The line of one that did not come so far.
  std::string failed(std::size_t run, std::string const& error) const;

 private:
  std::vector<Measure> measures_{};

  std::string line(std::size_t run, std::vector<std::string> const& measured, std::string const& error) const;
  std::string command() const;
  template <class F>
  void addResults(F&& f) const;
  SceneOptions sceneOf(std::optional<std::size_t> run) const;
  void blameAttribute(Failure const& failure) const;
  std::string probe(std::optional<std::size_t> run) const;
  std::string key(std::vector<std::string> const& files) const;
  void giveFiles(Node& node, std::optional<std::size_t> run) const;
  std::string folderOf(std::size_t run) const;
  std::string simulate(std::size_t run, std::vector<std::string>& measured) const;
  std::string simulate(Scene& scene, std::vector<std::string>& measured) const;
  std::string addMeasures(Scene& scene, sinew::RecordedFrame const& start,
                          std::vector<std::string>& measured) const;
  std::size_t measuredColumns() const { return header.columns.size() - combinations.paths().size() - 2; }
};

}  // namespace cli
