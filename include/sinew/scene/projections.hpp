// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/vec_id.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/states_of.hpp>

namespace sinew {

/// The projective constraints at and below a scope, `root`: P, what they leave of a motion.
template <class Root>
struct Projections {
  Root const& root;

  /// dx = P dx
  void projectResponse(DerivId dx) const {
    [[maybe_unused]] const auto span = root.span(Phase::constraint);
    forEach([&](auto& c, auto&... s) { c.projectResponse(s[dx]...); });
  }
  /// Accelerations M^-1 f become those that are allowed.
  void projectAcceleration(DerivId a) const {
    forEach([&](auto& c, auto&... s) { accelerate(c, s[a]...); });
  }
  /// Puts constrained points where they have to be at time t, with the velocity they have there.
  void projectPositionAndVelocity(double t, CoordId x, DerivId v) const {
    [[maybe_unused]] const auto span = root.span(Phase::constraint);
    forEach([&](auto& c, auto&... s) {
      place(c, t, s[x]...);
      move(c, t, s[v]...);
    });
  }

  /// matrix = P matrix P + (I - P), and what its pattern needs for that
  template <class Matrix>
  void projectMatrix(Matrix& matrix) const {
    traverse(root, on<role::ProjectiveConstraint>([&](auto& c, auto const& scope) {
               c.projectMatrix(sink<AssemblyPhase::add>(matrix, c, scope));
             }));
  }
  template <class Matrix>
  void preallocate(Matrix& matrix) const {
    traverse(root, on<role::ProjectiveConstraint>([&](auto& c, auto const& scope) {
               const auto to = sink<AssemblyPhase::pattern>(matrix, c, scope);
               if constexpr (requires { c.preallocate(to); }) c.preallocate(to);
             }));
  }

 private:
  // f(constraint, state), or f(constraint, state, state) for one that joins two
  template <class F>
  void forEach(F&& f) const {
    traverse(root, on<role::ProjectiveConstraint>([&](auto& c, auto const& scope) {
               with_states_of(c, scope, [&](auto&... s) { f(c, s...); });
             }));
  }
  // what only some constraints have (functions, since nvcc looks at such names before it knows the class)
  template <class C, class... V>
  static void place(C& c, double t, V&... x) {
    if constexpr (requires { c.projectPosition(t, x...); }) c.projectPosition(t, x...);
  }
  template <class C, class... V>
  static void move(C& c, double t, V&... v) {
    if constexpr (requires { c.projectVelocity(t, v...); }) c.projectVelocity(t, v...);
  }
  template <class C, class... V>
  static void accelerate(C& c, V&... a) {
    if constexpr (requires { c.projectAcceleration(a...); })
      c.projectAcceleration(a...);
    else
      c.projectResponse(a...);
  }
  template <AssemblyPhase Phase, class Matrix, class C, class S>
  static auto sink(Matrix& matrix, C const& c, S const& scope) {
    using Dofs = DirectDofs<C::DataTypes::size>;
    Dofs first{0}, second{0};
    with_states_of(c, scope, [&](auto& a, auto&... b) {
      first.offset = second.offset = a.dofOffset;
      ((second.offset = b.dofOffset), ...);
    });
    return MatrixSink<Phase, Matrix, Dofs>{matrix, first, second};
  }
};

}  // namespace sinew
