// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include <sinew/io/streamed_file.hpp>

namespace cli {

/// The forces of each step as a table, one force on a body a line.
class ForcesFile {
 public:
  explicit ForcesFile(std::string path);
  /// Those of the step that has ended.
  void add(sinew::StandardSimulation& simulation);
  /// Completes the file.
  void finish() { file_.finish(); }

 private:
  sinew::io::StreamedFile file_;
};

}  // namespace cli
