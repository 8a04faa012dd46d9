// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <string>
#include <string_view>

namespace sinew {

/// The path of a node, from the path of another one: "tool/tip" is below that, "../tool" beside it, and
/// "/tool" and "@/tool" are below the root.
std::string path_from(std::string_view where, std::string_view path);

/// Whether a path is that of a node or of one below it.
inline bool is_below(std::string_view path, std::string_view node) {
  return path.starts_with(node) && (path.size() == node.size() || path[node.size()] == '/');
}

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE std::string path_from(std::string_view where, std::string_view path) {
  std::string at(where);
  if (path.starts_with('@')) path.remove_prefix(1);
  if (path.starts_with('/')) at = at.substr(0, at.find('/', 1));
  while (!path.empty()) {
    const std::size_t end = path.find('/');
    const std::string_view step = path.substr(0, end);
    path.remove_prefix(end == path.npos ? path.size() : end + 1);
    if (step == "..")
      at.resize(at.find_last_of('/') == at.npos ? 0 : at.find_last_of('/'));
    else if (!step.empty() && step != ".")
      at.append("/").append(step);
  }
  return at;
}

}  // namespace sinew
#endif
