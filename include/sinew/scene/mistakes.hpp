// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/checks.hpp>

namespace sinew::checks {

/// Reports one broken rule: the first in the scene, by component C (void: by the node) of this node. The
/// constructor of Simulation takes it as its last argument, so that the compiler comes here straight from the
/// user's line.
template <Rule R, class C, FixedString Node>
struct Wrong {
  static constexpr Rule rule = R;
#define SINEW_RULE(name, who, cause, remedy) \
  static_assert(R != Rule::name, "Sinew: " who " " cause "; " remedy ".");
#include <sinew/scene/rules.def>
};

template <class N>
struct NoScene {
  static_assert(is_node<N>, "Sinew: a Simulation is of a node; write Simulation sim{node<\"root\">(...)}.");
};

}  // namespace sinew::checks
