// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace cli {

namespace {

// values that are out of their ranges, in all components
void check_values(Node& node, std::string const& scene, std::vector<std::string>& messages) {
  for (auto& entry : node.components())
    entry.component.visit<sinew::AnyRole>([&](auto& component) {
      try {
        sinew::check_fields(component, node.path());
      } catch (sinew::Error const& error) {
        messages.push_back(entry.origin.empty() ? located(scene, error.what())
                                                : sinew::text(entry.origin, ": ", error.what()));
      }
    });
  for (auto const& child : node.children()) check_values(*child, scene, messages);
}

}  // namespace

int check(CheckOptions const& options) {
  std::optional<sinew::ReadScene<sinew::Standard>> scene;
  std::vector<std::string> messages;
  try {
    scene = read(options.scene);
    check_values(scene->root, options.scene.path, messages);
  } catch (Failure const& failure) {
    if (failure.status != badScene || options.scene.lenient) throw;
    messages = failure.messages;
    // what is wrong besides unknown components
    std::vector<std::string> further;
    SceneOptions lenient = options.scene;
    lenient.lenient = true;
    try {
      scene = read(lenient);
      check_values(scene->root, options.scene.path, further);
    } catch (Failure const& second) {
      further = second.messages;
    }
    std::erase_if(further, [&](auto const& message) {
      return std::find(messages.begin(), messages.end(), message) != messages.end();
    });
    if (!further.empty()) messages.push_back("and where unknown components are left out:");
    messages.insert(messages.end(), further.begin(), further.end());
  }
  if (!messages.empty()) throw Failure{badScene, messages};

  Scene ready = start(std::move(*scene), options.scene);
  if (options.quiet) return ok;
  print_notes(ready.ignored, ready.warnings);
  std::printf("%s: ok: %s\n", options.scene.path.c_str(), count(ready.simulation.root()).words().c_str());
  return ok;
}

}  // namespace cli
