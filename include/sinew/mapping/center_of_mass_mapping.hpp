// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// The one point of the child is the centre of mass of its parent, x = sum_i m_i x_i / sum_i m_i, with the
/// masses of the parent's node; that of rigid bodies is of their centres. A force on it is spread by mass.
template <class I, class O>
struct CenterOfMassMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  static constexpr int N = In::spatial;
  static_assert(!Out::rigid && Out::size == N,
                "CenterOfMassMapping maps to points in the space of its parent");
  static constexpr std::string_view className = "CenterOfMassMapping";
  static constexpr bool needsMasses = true;

  static constexpr auto fields() { return field_list(); }

  std::vector<Real> weights{};  // m_i / sum_i m_i

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<CenterOfMassMapping>());
    if (parent.masses.empty())
      throw Error(where, text("there is no mass in the node ", parent.where, " of its parent; add one"));
    double sum = 0;
    for (const double m : parent.masses) sum += m;
    weights.clear();
    for (const double m : parent.masses) weights.push_back(Real(m / sum));
    if (positions.empty()) positions.resize(1);
    if (positions.size() != 1)
      throw Error(where, text("the child has ", positions.size(), " points; give it one, or none"));
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const {
    Vec<Real, N> sum = Vec<Real, N>::Zero();
    for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * In::center(in[i]);
    out[0] = sum.template cast<typename Out::Real>();
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    Vec<Real, N> sum = Vec<Real, N>::Zero();
    for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * in[i].template head<N>();
    out[0] = sum.template cast<typename Out::Real>();
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    for (std::size_t i = 0; i < weights.size(); ++i)
      in[i].template head<N>() += weights[i] * out[0].template cast<Real>();
  }
  template <class F>
  void forEachJacobianBlock(int, F&& f) const {
    using J = Mat<typename Out::Real, N, In::size>;
    for (std::size_t i = 0; i < weights.size(); ++i)
      f(int(i), J(J::Identity() * typename Out::Real(weights[i])));
  }
};

}  // namespace sinew
