// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact.hpp>
#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>

#include <string_view>
#include <vector>

namespace sinew {

/// Throws Error for a step that finds more contacts than its manager may keep: bodies that were meant to
/// touch lie in each other, or far too much touches. It names the two models that have most of them.
[[noreturn]] void refuse_contacts(std::string_view manager, int maximum, std::vector<Contact> const& found,
                                  std::vector<CollisionSurface*> const& surfaces);

}  // namespace sinew

#if SINEW_DEFINES
#include <map>
#include <string>
#include <utility>

namespace sinew {

SINEW_ONCE void refuse_contacts(std::string_view manager, int maximum, std::vector<Contact> const& found,
                                std::vector<CollisionSurface*> const& surfaces) {
  std::map<std::pair<int, int>, long> numbers;
  std::pair<int, int> most{found.front().a.surface, found.front().b.surface};
  for (Contact const& c : found) {
    const std::pair pair(c.a.surface, c.b.surface);
    if (++numbers[pair] > numbers[most]) most = pair;
  }
  std::string const &a = surfaces[std::size_t(most.first)]->path,
                    &b = surfaces[std::size_t(most.second)]->path;
  throw Error(manager,
              text("a step has more than ",
                   maximum,
                   " contacts; of those found first ",
                   numbers[most],
                   " are of ",
                   a == b ? text("parts of ", a) : text(a, " and ", b),
                   ". Move apart what lies in each other, take coarser collision models or a shorter "
                   "alarmDistance, or raise maximumContacts"));
}

}  // namespace sinew
#endif
