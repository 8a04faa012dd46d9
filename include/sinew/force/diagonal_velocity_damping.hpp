// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

namespace sinew {

/// Damping with a coefficient for each degree of freedom, f = -C v with C diagonal, as part of implicit
/// steps, B = -C. Points behind the last in the list have the coefficients of that.
template <class D>
struct DiagonalVelocityDampingForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "DiagonalVelocityDampingForceField";

  std::vector<Deriv> dampingCoefficient{};

  static constexpr auto fields() {
    return field_list(field("dampingCoefficient",
                            &DiagonalVelocityDampingForceField::dampingCoefficient,
                            "N s/m",
                            "force per speed of each degree of freedom, [N m s] of rotations; for each point",
                            range::nonNegative)
                          .oneEach(Of::points));
  }

  static constexpr ForceProperties properties() { return {.internal = false, .objective = false}; }

  std::size_t size = 0;

  void init(InitContext<D> const& context) { size = context.rest.size(); }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const&, VecDeriv const& v) const {
    forEach([&](std::size_t i, Deriv const& c) { f[i] -= c.cwiseProduct(v[i]); });
  }
  void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) const {
    if (p.b == 0) return;
    forEach([&](std::size_t i, Deriv const& c) { df[i] -= Real(p.b) * c.cwiseProduct(dx[i]); });
  }
  double potentialEnergy(VecCoord const&) const { return 0; }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    forEach([&](std::size_t i, Deriv const& c) {
      const Mat<Real, D::size> block = (Real(-p.b) * c).asDiagonal();
      sink.add(int(i), int(i), block);
    });
  }

 private:
  // f(point, its coefficients)
  template <class F>
  void forEach(F const& f) const {
    if (dampingCoefficient.empty()) return;
    for (std::size_t i = 0; i < size; ++i)
      f(i, dampingCoefficient[std::min(i, dampingCoefficient.size() - 1)]);
  }
};

}  // namespace sinew
