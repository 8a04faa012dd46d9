// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/boundary_particles.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/solvers.hpp>

#include <string>
#include <type_traits>

namespace sinew {

/// What fluids and the bodies that they meet know of each other.
template <class RootScope>
struct FluidBoundaries {
  RootScope const& root;
  static constexpr bool any = holds<typename RootScope::NodeType, OfFluids>();

  /// Room for boundary particles. Throws Error where a body moves before a fluid, or with it.
  void init() const {
    if constexpr (any) {
      std::string body;  // the first that a solver moves
      for_each_solver(root, [&](auto&, auto const& scope) {
        bool fluid = false;
        traverse(scope, on<OfFluids>([&](auto& c, auto const& at) {
                   using C = std::decay_t<decltype(c)>;
                   if constexpr (MeetsBoundaries<C>) fluid = true;
                   if constexpr (BoundsFluids<C>)
                     if (body.empty()) body = at.path();
                 }));
        if (fluid && !body.empty())
          throw Error(
              scope.path(),
              text("the solver of a fluid moves it after the body with the boundary particles of ",
                   body,
                   ", or together with it; give the body a solver of its own, in a node behind that of the "
                   "fluid"));
      });
      gather();
      traverse(root, on<OfFluids>([&](auto& c, auto const&) {
                 if constexpr (requires { c.reserveForBoundary(); }) c.reserveForBoundary();
               }));
    }
  }
  /// Before the solvers of a step: boundary particles are where they are, and without forces.
  void gather() const {
    if constexpr (any)
      traverse(root, on<OfFluids>([&](auto& c, auto const&) {
                 using C = std::decay_t<decltype(c)>;
                 if constexpr (BoundsFluids<C>) c.reset();
                 if constexpr (MeetsBoundaries<C>) {
                   c.boundary.clear();
                   forEachBody([&](auto&, auto const& state) { add(c.boundary, state); });
                 }
               }));
  }
  /// After a solver: bodies have the forces of its fluids.
  template <class S>
  void giveForces(S const& solved) const {
    if constexpr (holds<typename S::NodeType, OfFluids>())
      traverse(solved, on<OfFluids>([&](auto& c, auto const&) {
                 using C = std::decay_t<decltype(c)>;
                 if constexpr (MeetsBoundaries<C>) {
                   std::size_t k = 0;
                   forEachBody([&](auto& body, auto const&) {
                     using Real = typename std::decay_t<decltype(body)>::DataTypes::Real;
                     for (auto& force : body.forces) force += c.boundary.forces[k++].template cast<Real>();
                   });
                 }
               }));
  }

 private:
  template <class F>
  void forEachBody(F&& f) const {
    traverse(root, on<OfFluids>([&](auto& c, auto const& scope) {
               using C = std::decay_t<decltype(c)>;
               if constexpr (BoundsFluids<C>) f(c, scope.template state<typename C::DataTypes>());
             }));
  }
  template <class State>
  static void add(BoundaryParticles& boundary, State const& s) {
    for (std::size_t i = 0; i < s.size(); ++i) {
      boundary.positions.push_back(s.position[i].template cast<double>());
      boundary.velocities.push_back(s.velocity[i].template cast<double>());
      boundary.forces.push_back(Eigen::Vector3d::Zero());
    }
  }
};

}  // namespace sinew
