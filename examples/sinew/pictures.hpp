// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include <sinew/io/pvd_series.hpp>

namespace cli {

/// One series for ParaView of each visual model, and of each body that has none: its elements, or its points.
class Pictures {
 public:
  Pictures(std::string folder, Node& top);
  /// Writes the scene as it is now.
  void add(sinew::StandardSimulation& simulation);
  /// The .pvd files.
  std::vector<std::string> paths() const;

 private:
  struct Series {
    Node* node;
    bool visual;
    sinew::io::PvdSeries files;
  };
  std::string folder_;
  std::vector<Series> series_{};

  bool collect(Node& node);
  void include(Node& node, bool visual);
};

}  // namespace cli
