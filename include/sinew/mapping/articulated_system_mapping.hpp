// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/mapping/articulated_bodies.hpp>
#include <sinew/mapping/geometric_stiffness.hpp>
#include <sinew/mapping/rigid_frame.hpp>

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace sinew {

/// What both articulated mappings are told.
template <class M, class... More>
constexpr auto articulated_fields(More... more) {
  return field_list(
      field("centers",
            &M::centers,
            "",
            "where bodies are joined, each by: the body that bears, the one that is borne, the place of the "
            "center in axes of the first, that in axes of the second, and to what its axes belong"),
      field("articulations",
            &M::articulations,
            "",
            "how they move there, each by: the center, the number of the value, whether that is an angle, "
            "whether it is a length, and the axis"),
      field("geometricStiffness",
            &M::geometricStiffness,
            "",
            "geometric stiffness: what axes and arms that turn add to the stiffness"),
      more...);
}

/// Rigid bodies that hinges and slides join, of which the parent state has the angles [rad] and lengths [m].
/// A center joins a body to one that bears it, with the same axes where nothing is turned; its articulations
/// follow one another. With R, c of a body, p for the one that bears it, and a_i the axis of an articulation
/// with value q_i,
///   R = R_p prod exp([a_i] q_i) over rotations,   d_i = R_p (prod of those before i) a_i
///   c = c_p + R_p posOnParent + sum d_i q_i over translations - R posOnChild
/// A value moves all bodies behind it: w = d_i q_i', c' = d_i x (c - center) q_i', or c' = d_i q_i'. Its
/// force is that of the bodies along this. With articulationProcess onParent all axes are those of the body
/// that bears, with onChild those of the body that is borne: translations come before the rotation, or behind
/// it, of which there is one then, since of several the angles would not say where the body is (SOFA adds up
/// their increments). Bodies that nothing bears stay where they are given. A child without positions gets as
/// many bodies as centers name.
///
/// The mass of the bodies moves the values by J' M J, and by the forces -J' M (dJ/dt) q', Coriolis' and
/// centrifugal ones, which SOFA leaves out: together with gyroscopic torques the equations are those of
/// Lagrange (Featherstone, Rigid Body Dynamics Algorithms, 2008). `geometricStiffness` adds, for i before j
/// and a rotation, with f and t of all bodies behind j,
///   K_g(i, j) = d_i.w_j,   w_j = sum (d_j.f) (x - p_j) - (f.(x - p_j)) d_j + 1/2 d_j x t,   or d_j x f
/// which leaves out the part that torques add to the one triangle and take from the other. SOFA has none.
template <class I, class O, class... Base>
struct ArticulatedSystemMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename Out::Real;
  static_assert(sizeof...(Base) == 0,
                "ArticulatedSystemMapping on a base is that over <Vec1d, Rigid3d, Rigid3d, Parents<...>>, or "
                "LinkedParents");
  static_assert(!In::rigid && In::size == 1 && Out::rigid && Out::spatial == 3,
                "ArticulatedSystemMapping makes rigid bodies in space of numbers");
  static constexpr std::string_view className = "ArticulatedSystemMapping";

  std::vector<ArticulationCenter> centers{};
  std::vector<Articulation> articulations{};
  RotationalStiffness geometricStiffness = RotationalStiffness::none;

  static constexpr auto fields() { return articulated_fields<ArticulatedSystemMapping>(); }

  ArticulatedBodies<In, Out> bodies{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    bodies.init(text(child.where, ": ", component_name<ArticulatedSystemMapping>()),
                centers,
                articulations,
                parent.rest.size(),
                parent.where,
                positions);
  }
  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) { bodies.apply(out, in); }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const { bodies.applyJ(out, in); }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) { bodies.applyJT(in, out); }
  template <class F>
  void forEachJacobianBlock(int body, F&& f) const {
    bodies.forEachColumn(body, f);
  }
  typename Out::VecDeriv const& velocityProducts(typename In::VecDeriv const& rates,
                                                 typename Out::VecDeriv const& v) {
    return bodies.velocityProducts(rates, v);
  }
  void updateK(typename Out::VecDeriv const& f) {
    if (geometricStiffness != RotationalStiffness::none) bodies.updateK(f);
  }
  void addKx(typename In::VecDeriv& df, typename In::VecDeriv const& dx, double k) const {
    if (geometricStiffness != RotationalStiffness::none) bodies.addKx(df, dx, k);
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    if (geometricStiffness != RotationalStiffness::none)
      bodies.addToMatrix(p.k, [&](int i, int j, auto const& block) { sink.add(i, j, block); });
  }
};

/// The same on a moving base: the first body is one of a second parent, by number, and moves the others with
/// it. In scene files it is an ArticulatedSystemMapping with an input2. Both parents stand before the node of
/// the mapping in the tree; they are named by paths from it (`P` = Parents<"..", "../../base">), or at run
/// time (`P` = LinkedParents).
///   J of the base: c' + w x (x - c), w      K_g: w_j between the angle of the base and value j
template <class I, class R, class O, class P>
struct ArticulatedSystemMapping<I, R, O, P> {
  using Role = role::Mapping;
  using In = I;
  using In2 = R;
  using Out = O;
  using Parents = P;
  template <class Other>
  using WithParents = ArticulatedSystemMapping<I, R, O, Other>;
  using Real = typename Out::Real;
  using Frame = RigidFrame<In2, Out>;
  static_assert(!In::rigid && In::size == 1 && Out::rigid && Out::spatial == 3 && In2::rigid &&
                    In2::spatial == 3,
                "ArticulatedSystemMapping makes rigid bodies in space of numbers and of a rigid body");
  static constexpr std::string_view className = "ArticulatedSystemMapping";

  std::vector<ArticulationCenter> centers{};
  std::vector<Articulation> articulations{};
  RotationalStiffness geometricStiffness = RotationalStiffness::none;
  std::optional<int> indexInput2{};
  [[no_unique_address]] P parents{};

  static constexpr auto fields() {
    return articulated_fields<ArticulatedSystemMapping>(
        field("indexInput2",
              &ArticulatedSystemMapping::indexInput2,
              "",
              "the rigid body of the second parent that is the base; none: the last one",
              range::nonNegative));
  }

  ArticulatedBodies<In, Out> bodies{};
  int root = 0;                              // of the second parent
  std::vector<int> carried{};                // bodies that the base moves, itself the first
  typename In::VecCoord values{};            // at the last apply of the first part
  Vec<Real, 3> turn = Vec<Real, 3>::Zero();  // those of the last gather
  typename In::VecDeriv motions{};

  /// What concerns the values, of a mapping `M`, which may be constant.
  template <class M>
  struct Values {
    using In = typename M::In;
    using Out = typename M::Out;
    M& of;

    void apply(typename Out::VecCoord&, typename In::VecCoord const& in) const { of.values = in; }
    void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
      of.bodies.applyJ(out, in);
    }
    void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
      of.bodies.applyJT(in, out);
    }
    template <class F>
    void forEachJacobianBlock(int body, F&& f) const {
      of.bodies.forEachColumn(body, f);
    }
    typename Out::VecDeriv const& velocityProducts(typename In::VecDeriv const& rates,
                                                   typename Out::VecDeriv const& v) const {
      return of.bodies.velocityProducts(rates, v);
    }
    void updateK(typename Out::VecDeriv const& f) const {
      if (of.hasStiffness()) of.bodies.updateK(f);
    }
    void gather(typename In::VecDeriv const& dx) const {
      if (of.hasStiffness()) of.motions = dx;
    }
    void addKx(typename In::VecDeriv& df, typename In::VecDeriv const& dx, double k) const {
      if (!of.hasStiffness()) return;
      of.bodies.addKx(df, dx, k);
      of.bodies.forEachTurned(0, [&](int value, auto const& turned) {
        df[std::size_t(value)][0] += typename In::Real(Real(k) * turned.dot(of.turn));
      });
    }
    std::vector<bool> pointsThatStay(Renumbering const&) const {
      return std::vector<bool>(of.bodies.bodies.size(), true);
    }
  };
  /// What concerns the base.
  template <class M>
  struct Base {
    using In = typename M::In2;
    using Out = typename M::Out;
    M& of;

    void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const {
      auto const& base = in[std::size_t(of.root)];
      of.bodies.bodies[0].center = base.center.template cast<Real>();
      of.bodies.bodies[0].orientation = base.orientation.template cast<Real>();
      of.bodies.apply(out, of.values);
    }
    void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
      const auto v = in[std::size_t(of.root)].template cast<Real>().eval();
      for (const int b : of.carried) out[std::size_t(b)] += of.jacobian(b) * v;
    }
    void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
      for (const int b : of.carried)
        in[std::size_t(of.root)] +=
            (of.jacobian(b).transpose() * out[std::size_t(b)]).template cast<typename In::Real>();
    }
    template <class F>
    void forEachJacobianBlock(int body, F&& f) const {
      if (of.bodies.tree.base[std::size_t(body)] == 0) f(of.root, of.jacobian(body));
    }
    void updateK(typename Out::VecDeriv const&) const {}
    void gather(typename In::VecDeriv const& dx) const {
      if (of.hasStiffness()) of.turn = dx[std::size_t(of.root)].template tail<3>().template cast<Real>();
    }
    void addKx(typename In::VecDeriv& df, typename In::VecDeriv const&, double k) const {
      if (!of.hasStiffness()) return;
      Vec<Real, 3> sum = of.bodies.turning(0) * of.turn;
      of.bodies.forEachTurned(
          0, [&](int value, auto const& turned) { sum += turned * Real(of.motions[std::size_t(value)][0]); });
      df[std::size_t(of.root)].template tail<3>() += (Real(k) * sum).template cast<typename In::Real>();
    }
    std::vector<bool> pointsThatStay(Renumbering const&) const {
      return std::vector<bool>(of.bodies.bodies.size(), true);
    }
  };
  using Self = ArticulatedSystemMapping;
  Values<Self> part(ParentNumber<0>) { return {*this}; }
  Base<Self> part(ParentNumber<1>) { return {*this}; }
  Values<Self const> part(ParentNumber<0>) const { return {*this}; }
  Base<Self const> part(ParentNumber<1>) const { return {*this}; }

  void init(InitContext<In> const& above, InitContext<In2> const& bases, InitContext<Out> const& child,
            typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<Self>());
    const std::size_t count = bases.rest.size();
    if (count == 0) throw Error(where, text(bases.where, " has no rigid body; give it one, the base"));
    root = indexInput2.value_or(int(count) - 1);
    check_numbers(where, "indexInput2", std::vector<int>{root}, count, "rigid bodies", bases.where);
    bodies.init(where, centers, articulations, above.rest.size(), above.where, positions);
    for (std::size_t c = 0; c < centers.size(); ++c)
      if (centers[c].childIndex == 0)
        throw Error(where,
                    text("centers[", c, "] bears body 0, which is the base (input2); let it bear another"));
    carried.clear();
    for (std::size_t b = 0; b < positions.size(); ++b)
      if (bodies.tree.base[b] == 0) carried.push_back(int(b));
    values = above.rest;
    motions.assign(above.rest.size(), In::Deriv::Zero());
    turn.setZero();
  }

  template <class Sink>
  void addToMatrix(MechanicalParams const& p, std::size_t a, std::size_t b, Sink const& sink) const {
    if (!hasStiffness()) return;
    const Real k = Real(p.k);
    if (a == 0 && b == 0)
      return bodies.addToMatrix(
          p.k, [&](int i, int j, auto const& block) { sink.template add<0, 1>(i, j, block); });
    using Row = Mat<typename In2::Real, 1, In2::size>;
    if (a == 1 && b == 1) {
      Mat<typename In2::Real, In2::size> block = Mat<typename In2::Real, In2::size>::Zero();
      block.template bottomRightCorner<3, 3>() = (k * bodies.turning(0)).template cast<typename In2::Real>();
      sink.template add<0, 1>(root, root, block);
      return;
    }
    bodies.forEachTurned(0, [&](int value, Vec<Real, 3> const& turned) {
      Row row = Row::Zero();
      row.template tail<3>() = (k * turned.transpose()).template cast<typename In2::Real>();
      if (a == 0)
        sink.template add<0, 1>(value, root, row);
      else
        sink.template add<0, 1>(root, value, Mat<typename In2::Real, In2::size, 1>(row.transpose()));
    });
  }

  /// Values and base are numbered anew. Throws Error where one of them goes.
  void follow(Renumbering const&, std::vector<Renumbering const*> const& above) {
    auto renumber = [&](std::size_t parent, int& number, std::string_view what) {
      if (!above[parent]->stays(number))
        throw Error(component_name<Self>(),
                    text(what, " ", number, " is to go, which moves articulated bodies; leave it there"));
      above[parent]->renumber(number);
    };
    for (Articulation& a : articulations) renumber(0, a.articulationIndex, "value");
    renumber(1, root, "base");
    indexInput2 = root;
  }

  bool hasStiffness() const { return geometricStiffness != RotationalStiffness::none; }
  Mat<Real, 6> jacobian(int body) const {
    return Frame::jacobian(bodies.bodies[std::size_t(body)].center - bodies.bodies[0].center);
  }
};

}  // namespace sinew
