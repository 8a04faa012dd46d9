// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// What a scene file says of how its scene is looked at: an element that has no part in what is simulated (a
/// camera, a light, a style), or what a visual model says of its colours. Pictures and windows ask for them
/// (view/view_settings.hpp).
struct ViewElement {
  std::string path{};    // of its node: "/root/liver"
  std::string tag{};     // its class in SOFA: "VisualStyle", "OglModel"
  std::string origin{};  // where it was written, for messages: "liver.scn:12:3"
  std::string folder{};  // of the file, from which files are looked for
  std::vector<std::pair<std::string, std::string>> attributes{};

  /// Null where there is none of the name.
  std::string const* find(std::string_view name) const {
    for (auto const& [known, value] : attributes)
      if (known == name) return &value;
    return nullptr;
  }
};

/// The attributes of a visual model that say how it looks.
inline constexpr std::array looks_of_visuals =
    std::to_array<std::string_view>({"color", "material", "texturename"});

}  // namespace sinew
