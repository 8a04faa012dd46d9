// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/reaction.hpp>
#include <sinew/topology/element_checks.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sinew {

/// Reaction of what the state has a value u of for each point of a body: growth, or the electric potential of
/// nerves and heart muscle,
///   c du/dt = div(K grad u) + c R(u, w),   dw/dt = g(u, w)
/// beside a TetrahedronDiffusionFEMForceField, which has the first term, and a DiagonalMass or
/// MeshMatrixMass, whose massDensity c is. The force on point i is c V_i R(u_i, w_i), V_i a quarter of the
/// volumes of the tetrahedra around it, over the undeformed body. The variable w of each point goes on before
/// each step, exactly for the u that the step starts with (Rush, Larsen 1978), and stays during the step; so
/// a step has an error of order dt. An implicit step needs dt < 1 over the largest dR/du, such as r or k/4,
/// for its matrix to stay positive definite.
template <class D>
struct TetrahedronReactionFEMForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static_assert(!D::rigid && D::size == 1,
                "Sinew: TetrahedronReactionFEMForceField is over one value for each point; take Vec1d.");
  static constexpr bool overBody = true, actsBeforeStep = true;
  static constexpr std::string_view className = "TetrahedronReactionFEMForceField";

  Reaction reaction = Reaction::FisherKPP;
  std::vector<double> parameterSet{};
  double massDensity = 1;
  std::vector<double> recovery{};

  static constexpr auto fields() {
    using F = TetrahedronReactionFEMForceField;
    return field_list(
        field("reaction", &F::reaction, "", "how values react"),
        field("ParameterSet",
              &F::parameterSet,
              "1/s, s, or without unit",
              "its parameters: r of FisherKPP; k a epsilon b of FitzHughNagumo; tauIn tauOut tauOpen "
              "tauClose gate of "
              "MitchellSchaeffer"),
        field("massDensity", &F::massDensity, "", "c, that of the mass beside it", range::positive),
        field("recovery",
              &F::recovery,
              "",
              "w at the start, one value for all points or one for each; none: that of rest, 1 of "
              "MitchellSchaeffer, 0 "
              "else")
            .oneEach(Of::points));
  }

  static constexpr ForceProperties properties() { return {.internal = false, .objective = false}; }

  ReactionLaw reacts{};
  std::vector<double> share{}, slope{};  // c V of each point, and dR/du at the last force
  std::vector<double> remembered{};      // w of each point

  /// What the next step depends on, besides positions and velocities.
  static constexpr auto state() {
    return field_list(
        field("remembered", &TetrahedronReactionFEMForceField::remembered, "", "w of all points"));
  }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<TetrahedronReactionFEMForceField>());
    check_reaction(where, reaction, parameterSet);
    auto const& tetrahedra = context.topology.tetrahedra;
    if (context.body.empty())
      throw Error(where,
                  "its values lie on no body; put their node, without a topology, below a node with a "
                  "MechanicalObject over Vec3d and a topology with tetrahedra");
    if (tetrahedra.empty())
      throw Error(where,
                  "the topology of the body has no tetrahedron; give it some (a Hexa2TetraTopologicalMapping "
                  "makes them of hexahedra)");
    check_values_of_body(where, context);
    const std::size_t n = context.rest.size();
    detail::check_indices(where, "tetrahedron", tetrahedra, n);
    if (!recovery.empty()) check_one_or_each(where, "recovery", recovery.size(), n, "points");
    reacts.reaction = reaction;
    std::copy(parameterSet.begin(), parameterSet.end(), reacts.p.begin());
    share.assign(n, 0);
    for (std::size_t e = 0; e < tetrahedra.size(); ++e) {
      Tetrahedron const& t = tetrahedra[e];
      Eigen::Matrix3d sides;
      for (int c = 0; c < 3; ++c) sides.col(c) = context.place(t[std::size_t(c) + 1]) - context.place(t[0]);
      const double volume = std::abs(sides.determinant()) / 6, longest = sides.colwise().norm().maxCoeff();
      if (!(volume > 1e-14 * longest * longest * longest))
        throw Error(where, text("tetrahedron ", e, " has no volume; move or merge its points"));
      for (const Index i : t) share[std::size_t(i)] += massDensity * volume / 4;
    }
    slope.assign(n, 0);
    if (remembered.size() != n) reset();
  }

  void reset() {
    remembered.assign(share.size(), recovery_at_rest(reaction));
    for (std::size_t i = 0; i < remembered.size() && !recovery.empty(); ++i)
      remembered[i] = one_or_each(recovery, i);
  }

  template <class State>
  void beforeStep(StepAhead const& ahead, State const& state) {
    if (reaction == Reaction::FisherKPP) return;
    auto const& x = state.position;
    for (std::size_t i = 0; i < remembered.size() && i < x.size(); ++i)
      remembered[i] = reacts.recovered(double(x[i][0]), remembered[i], ahead.dt);
  }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const& x, VecDeriv const&) {
    for (std::size_t i = 0; i < share.size(); ++i) {
      const auto rate = reacts.at(double(x[i][0]), remembered[i]);
      f[i][0] += Real(share[i] * rate.value);
      slope[i] = rate.slope;
    }
  }
  void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) const {
    for (std::size_t i = 0; i < share.size(); ++i) df[i][0] += Real(p.k * share[i] * slope[i]) * dx[i][0];
  }
  double potentialEnergy(VecCoord const& x) const {
    double sum = 0;
    for (std::size_t i = 0; i < share.size(); ++i)
      sum -= share[i] * reacts.at(double(x[i][0]), remembered[i]).integral;
    return sum;
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    for (std::size_t i = 0; i < share.size(); ++i) {
      Mat<Real, 1> block;
      block(0, 0) = Real(p.k * share[i] * slope[i]);
      sink.add(int(i), int(i), block);
    }
  }
};

}  // namespace sinew
