// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew::io {

/// Elements that go at a time [s].
struct TopologicalRemoval {
  double time = 0;
  std::vector<int> elements{};
};

/// The changes in `content`; `path` is for messages. See read_topological_changes().
std::vector<TopologicalRemoval> parse_topological_changes(std::string_view path, std::string_view content);

/// Reads SOFA's text format of topological changes: "T= seconds", then "REMOVE= count" and as many numbers of
/// elements, any number of times. Throws Error with the line on anything else, times that fall, changes of
/// other kinds (ADD, INCISE), and a file without any.
std::vector<TopologicalRemoval> read_topological_changes(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>

namespace sinew::io {

SINEW_ONCE std::vector<TopologicalRemoval> parse_topological_changes(std::string_view path,
                                                                     std::string_view content) {
  TextReader in(path, content);
  in.rejectBinary();
  std::vector<TopologicalRemoval> changes;
  double time = 0;
  bool timed = false;
  while (in.more()) {
    const std::string_view key = in.word();
    if (key == "T=") {
      const double next = in.real("a time");
      if (timed && next < time)
        throw in.error(text("the time ", next, " s follows ", time, " s; times rise"));
      time = next;
      timed = true;
    } else if (key == "REMOVE=") {
      if (!timed) throw in.error("a change has no time; put \"T= seconds\" before it");
      TopologicalRemoval change{time, {}};
      change.elements.resize(in.count("numbers of elements", 1));
      for (int& e : change.elements) {
        if (!parse_number(in.word(), e) || e < 0)
          throw in.expected(
              text("the number of an element, from 0 on (", change.elements.size(), " follow REMOVE=)"));
      }
      changes.push_back(std::move(change));
    } else if (key == "ADD=" || key == "INCISE=") {
      throw in.error(text(key.substr(0, key.size() - 1),
                          " is not simulated: elements may be removed only; leave it out"));
    } else {
      throw in.expected("T= or REMOVE=");
    }
  }
  if (changes.empty()) throw Error(path, "there is no change (\"T= seconds\", \"REMOVE= count\"); add one");
  return changes;
}

SINEW_ONCE std::vector<TopologicalRemoval> read_topological_changes(std::string const& path) {
  return parse_topological_changes(path, read_file(path));
}

}  // namespace sinew::io
#endif
