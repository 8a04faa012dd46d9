// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/immersed_body.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/solvers.hpp>
#include <sinew/scene/states_of.hpp>

#include <type_traits>

namespace sinew {

/// What fluids on grids and the solids in them know of each other. A fluid goes before the bodies do, and has
/// to know their motion at the end of the step but for its own forces: that now, and their acceleration by
/// all else, which is what was left of that of the steps before. Of two steps the smaller one, or none where
/// they differ in sign, so that an impact does not come a second time.
template <class RootScope>
struct ImmersedBodies {
  RootScope const& root;
  static constexpr bool any = holds<typename RootScope::NodeType, OfImmersion>();

  /// Finds what carries each solid, and how it answers to forces.
  void init() const {
    if constexpr (any) {
      bool some = false;
      forEachBody([&](auto& c, auto const& scope) {
        some = true;
        c.body.path = scope.path();
        c.carrier = {};
        findCarrier(c, scope);
      });
      if (!some) return;
      for_each_solver(root, [](auto&, auto const& solved) {
        traverse(solved, on<OfImmersion>([](auto& c, auto const&) {
                   if constexpr (ImmersesBody<std::decay_t<decltype(c)>>) c.carrier.moved = true;
                 }));
      });
      forEachBody([&](auto& c, auto const& scope) { place(c, scope); });
      giveBodies();
      traverse(root, on<OfImmersion>([&](auto& c, auto const&) {
                 if constexpr (MeetsBodies<std::decay_t<decltype(c)>>) c.reserveForBodies();
               }));
    }
  }
  /// Before the fluids of a step: solids are where they are, and without forces.
  void gather(double dt) const {
    if constexpr (any) {
      forEachBody([&](auto& c, auto const& scope) {
        place(c, scope);
        if (c.carrier.moved && c.body.rigid) c.foresee(scope.gravity(), dt);
      });
      giveBodies();
    }
  }
  /// After a fluid: solids have its forces.
  template <class Model>
  void giveForces(Model& model) const {
    if constexpr (MeetsBodies<Model>) {
      std::size_t k = 0;
      forEachBody([&](auto& c, auto const&) {
        if (c.body.dimension != Model::Grid::dimension) return;
        ImmersedBody const& pushed = model.bodies[k++];
        for (std::size_t i = 0; i < c.body.forces.size(); ++i) c.body.forces[i] += pushed.forces[i];
        c.body.load += pushed.load;
        c.remember();
      });
    }
  }

 private:
  template <class F>
  void forEachBody(F&& f) const {
    traverse(root, on<OfImmersion>([&](auto& c, auto const& scope) {
               if constexpr (ImmersesBody<std::decay_t<decltype(c)>>) f(c, scope);
             }));
  }
  void giveBodies() const {
    traverse(root, on<OfImmersion>([&](auto& fluid, auto const&) {
               using C = std::decay_t<decltype(fluid)>;
               if constexpr (MeetsBodies<C>) {
                 std::size_t k = 0;
                 forEachBody([&](auto& c, auto const&) {
                   if (c.body.dimension != C::Grid::dimension) return;
                   if (k == fluid.bodies.size()) fluid.bodies.emplace_back();
                   fluid.bodies[k++] = c.body;
                 });
                 fluid.bodies.resize(k);
               }
             }));
  }

  // f(mapping, state, scope) of the rigid bodies that a mapping lets a state follow
  template <class S, class F>
  static void withRigid(S const& scope, F&& f) {
    auto const& owner = scope.stateScope();
    using Owner = std::decay_t<decltype(owner)>;
    constexpr bool neverMapped = requires { requires !Owner::isMapped; };
    if constexpr (!neverMapped)
      with_first<role::Mapping>(owner, [&](auto& mapping) {
        using M = std::decay_t<decltype(mapping)>;
        if constexpr (!HasParents<M>)
          if constexpr (M::In::rigid) {
            auto const& above = owner.parentScope();
            if (!above.mapped()) f(mapping, above.template state<typename M::In>(), above);
          }
      });
  }

  // where coordinates of a rigid body stand among those of one in space
  template <class In>
  static int row(int k) {
    return In::spatial == 2 && k == 2 ? 5 : k;
  }
  template <class In>
  static ImmersedBody::Matrix6 turn(typename In::Coord const& x) {
    ImmersedBody::Matrix6 r = ImmersedBody::Matrix6::Identity();
    if constexpr (In::spatial == 3) {
      const Eigen::Matrix3d rotation = x.orientation.template cast<double>().toRotationMatrix();
      r.topLeftCorner<3, 3>() = r.bottomRightCorner<3, 3>() = rotation;
    }
    return r;
  }

  template <class C, class S>
  static void findCarrier(C& c, S const& scope) {
    const std::size_t points = scope.template state<typename C::DataTypes>().size();
    withRigid(scope, [&](auto& mapping, auto const& rigid, auto const& above) {
      using In = typename std::decay_t<decltype(mapping)>::In;
      int body = -1;
      bool one = points > 0;
      for (std::size_t i = 0; i < points; ++i)
        mapping.forEachJacobianBlock(int(i), [&](int b, auto const&) {
          one = one && (body < 0 || b == body);
          body = b;
        });
      if (!one) return;
      c.carrier.body = body;
      // columns of M^-1, in axes of the body, and of what constraints leave of a motion
      const auto at = std::size_t(body);
      typename In::VecDeriv unit(rigid.size(), In::Deriv::Zero()), column = unit;
      auto& inverse = c.carrier.inverseMass;
      auto& free = c.carrier.free;
      free.setZero();
      for (int k = 0; k < In::size; ++k) {
        unit[at] = In::Deriv::Unit(k);
        above.withMass([&](auto& mass) {
          if constexpr (std::is_same_v<typename std::decay_t<decltype(mass)>::DataTypes, In>) {
            mass.accFromF(column, rigid.position, unit);
            for (int l = 0; l < In::size; ++l) inverse(row<In>(l), row<In>(k)) = double(column[at][l]);
          }
        });
        column = unit;
        above.forEachComponent(on<role::ProjectiveConstraint>([&](auto& constraint) {
          using P = std::decay_t<decltype(constraint)>;
          if constexpr (!JoinsTwo<P>)
            if constexpr (std::is_same_v<typename P::DataTypes, In>) constraint.projectResponse(column);
        }));
        for (int l = 0; l < In::size; ++l) free(row<In>(l), row<In>(k)) = double(column[at][l]);
        unit[at].setZero();
      }
      const ImmersedBody::Matrix6 r = turn<In>(rigid.position[at]);
      inverse = (r.transpose() * inverse * r).eval();
    });
  }

  template <class C, class S>
  static void place(C& c, S const& scope) {
    using D = typename C::DataTypes;
    auto const& s = scope.template state<D>();
    ImmersedBody& body = c.body;
    for (auto* list : {&body.positions, &body.velocities, &body.forces})
      list->assign(s.size(), Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < s.size(); ++i) {
      body.positions[i].template head<D::spatial>() = s.position[i].template cast<double>();
      body.velocities[i].template head<D::spatial>() = s.velocity[i].template cast<double>();
    }
    body.load.setZero();
    body.rigid = c.carrier.body >= 0;
    if (!body.rigid) return;
    withRigid(scope, [&](auto& mapping, auto const& rigid, auto const&) {
      using In = typename std::decay_t<decltype(mapping)>::In;
      const auto at = std::size_t(c.carrier.body);
      body.centre.setZero();
      body.centre.template head<In::spatial>() = rigid.position[at].center.template cast<double>();
      body.motion.setZero();
      for (int k = 0; k < In::size; ++k) body.motion[row<In>(k)] = double(rigid.velocity[at][k]);
      const ImmersedBody::Matrix6 r = turn<In>(rigid.position[at]);
      body.response.setZero();
      if (c.carrier.moved)
        body.response =
            c.carrier.free * r * c.carrier.inverseMass * r.transpose() * c.carrier.free.transpose();
    });
  }
};

}  // namespace sinew
