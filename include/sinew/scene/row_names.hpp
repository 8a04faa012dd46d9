// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/step_warnings.hpp>
#include <sinew/lagrangian/constrained_motion.hpp>
#include <sinew/scene/scope.hpp>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace sinew {

/// Says in errors which components the equations of a constrained step are of. `root` is the scope of the
/// scene.
template <class RootScope>
struct RowNames {
  RootScope const& root;
  ConstrainedMotion const& m;

  /// Where a row is from, a component or the two bodies of a contact, and which of its equations it is.
  struct Name {
    std::string where{};
    int equation = 0;
  };
  Name of(int row) const {
    Name name;
    int begin = 0;
    std::size_t number = 0;
    traverse(root, on<role::LagrangianConstraint>([&](auto& c, auto const& scope) {
               const int end = begin + m.rowsOf[number++];
               if (row >= begin && row < end)
                 name = {text(scope.path(), ": ", scope.node.labelOf(c)), row - begin};
               begin = end;
             }));
    traverse(root, on<role::ContactManager>([&](auto& manager, auto const&) {
               manager.forEachConstrained([&](auto const&, auto& c) {
                 if (c.row >= 0 && row >= c.row && row < c.row + c.rows)
                   name = {text("the contact of ",
                                manager.surfaces[std::size_t(c.a.surface)]->path,
                                " and ",
                                manager.surfaces[std::size_t(c.b.surface)]->path),
                           row - c.row};
               });
             }));
    return name;
  }

  /// Throws Error for the row of a constraint along which nothing can move.
  [[noreturn]] void refuseFixed(int row) const {
    const Name name = of(row);
    throw Error(
        name.where,
        text("nothing that its equation ",
             name.equation,
             " holds can move: its points are fixed, or no solver moves them, or its direction is zero; "
             "leave it out, or free a point"));
  }
  /// Throws Error for a row whose violation after the motion without multipliers, or compliance, is not
  /// finite.
  [[noreturn]] void refuseNotFinite(int row) const {
    const Name name = of(row);
    throw Error(
        name.where,
        text("its equation ",
             name.equation,
             " is not finite after the motion without multipliers: the simulation diverged, or what it holds "
             "has no mass; take a smaller dt, an implicit solver or a softer material, or give it mass"));
  }
  /// What is known of the rows of a problem that is not solved; -1: there is none.
  std::string unsolved(int furthest, Contradiction const& contradiction) const {
    auto of = [&](int row) {
      const Name name = this->of(row);
      return text("equation ", name.equation, " of ", name.where);
    };
    return text(furthest < 0 ? std::string() : text("; furthest from its condition is ", of(furthest)),
                contradiction.row < 0 ? std::string()
                                      : text("; ",
                                             of(contradiction.row),
                                             " contradicts other equalities by ",
                                             contradiction.by,
                                             " m, and cannot be fulfilled"));
  }
  /// Throws what a constraint solver has thrown over the rows, with what it is about.
  [[noreturn]] void explain(Error const& error, std::string_view what, int row) const {
    if (row < 0) throw;
    const Name name = of(row);
    throw Error({}, text(error.what(), "; ", what, " is equation ", name.equation, " of ", name.where));
  }
};

/// Warns of equalities of constraints that depend on others, which look(row behind the last) finds where
/// their number is a new one: they hold, but how they share a force is open.
template <class RootScope, class Look>
void warn_of_dependent(RootScope const& root, ConstrainedMotion& m, StepNotes const& notes,
                       std::string_view where, Look&& look) {
  constexpr int most = 1000;  // which take a tenth of a second
  const int end = m.contactRows, before = std::exchange(m.lookedThrough, end);
  if ((end == before && notes.step > 1) || end < 2 || end > most) return;
  const DependentEqualities found = look(end);
  if (found.count > 0)
    notes.warn(where, "equalities depend on each other", [&] {
      const auto first = RowNames<RootScope>{root, m}.of(found.first);
      return text(found.count,
                  " of the equalities of constraints depend on others, so that their forces are not "
                  "determined, only what these do together; the first is equation ",
                  first.equation,
                  " of ",
                  first.where,
                  "; leave it out, or let one of them give way");
    });
}

}  // namespace sinew
