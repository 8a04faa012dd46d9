// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/overlaps.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/step_warnings.hpp>

#include <string>
#include <string_view>

namespace sinew {

/// Warns of bodies that start in each other, or come there before a contact is seen, behind the detection of
/// a step.
template <class Pipeline, class Manager>
void warn_of_overlaps(StepNotes const& notes, Pipeline const& pipeline, Manager const& manager) {
  auto const& surfaces = pipeline.surfaces;
  auto warn = [&](Overlap const& o, std::string_view what, std::string_view advice) {
    std::string const &a = surfaces[std::size_t(o.a)]->path, &b = surfaces[std::size_t(o.b)]->path;
    notes.warn(a == b ? text("parts of ", a) : text(a, " and ", b), what, [&] {
      return text(what, o.depth > 0 ? text(", by ", o.depth, " m") : std::string(), advice);
    });
  };
  if (notes.step == 1)
    for (Overlap const& o : overlaps(surfaces, pipeline.near, manager.contacts))
      warn(o, "they start in each other", ", and will be driven apart at once; move one of them away");
  else
    for (Overlap const& o : unseen_overlaps(surfaces, manager.contacts))
      warn(o,
           "they come into each other before a contact is seen",
           "; make alarmDistance longer than what they move in a step, or take smaller steps, or a "
           "ContinuousIntersection");
}

}  // namespace sinew
