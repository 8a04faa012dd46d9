// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>
#include <sinew/core/vec_id.hpp>

#include <string>

namespace sinew {

// The degrees of freedom of a body, or of many particles: MechanicalObject is the one that there is. Solvers
// and initialisation ask more of a state than its concept, which is what other components may rely on.

template <class C>
concept HasCoordVectors = HasDataTypes<C> && requires(C s, CoordId x) {
  { s[x] } -> std::same_as<typename C::DataTypes::VecCoord&>;
};
template <class C>
concept HasDerivVectors = HasDataTypes<C> && requires(C s, DerivId v) {
  { s[v] } -> std::same_as<typename C::DataTypes::VecDeriv&>;
};
template <class C>
concept HasInitAndReset = requires(C s) {
  s.init(std::string{});
  s.reset();
};

/// A state vector of particles [m], or of rigids, and all that solvers do with it.
template <class C>
concept State = HasRole<C, role::State> && HasCoordVectors<C> && HasDerivVectors<C> && HasInitAndReset<C>;

template <>
struct Promise<role::State> : NoPromise {
  template <class C>
  static constexpr bool kept = State<C>;
  template <class C>
  struct Broken {
    static_assert(HasDataTypes<C>,
                  "Sinew: a state has no DataTypes; write 'using DataTypes = D;', such as Vec3d.");
    static_assert(!HasDataTypes<C> || HasCoordVectors<C>,
                  "Sinew: a state has no 'VecCoord& operator[](CoordId id)', its positions by their ids.");
    static_assert(
        !HasDataTypes<C> || HasDerivVectors<C>,
        "Sinew: a state has no 'VecDeriv& operator[](DerivId id)', its velocities and forces by their "
        "ids.");
    static_assert(HasInitAndReset<C>,
                  "Sinew: a state has no 'void init(std::string const& where)' or no 'void reset()'.");
  };
};

}  // namespace sinew
