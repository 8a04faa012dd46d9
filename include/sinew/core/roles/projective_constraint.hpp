// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

// Takes motions away from the state of its node, or of the nearest above, which is not mapped. The shortest:
//
//   /// The first point stays where it is.
//   struct Nail {
//     using Role = role::ProjectiveConstraint;
//     using DataTypes = Vec3d;
//     static constexpr std::string_view className = "Nail";
//     static constexpr auto fields() { return field_list(); }
//
//     void init(InitContext<Vec3d> const&) {}
//     void projectResponse(Vec3d::VecDeriv& dx) const { dx[0].setZero(); }
//   };

/// dx without its forbidden part.
template <class C>
concept HasProjectResponse =
    HasDataTypes<C> && requires(C c, typename C::DataTypes::VecDeriv dx) { c.projectResponse(dx); };
template <class C>
concept HasProjectResponseOfTwo =
    HasDataTypes<C> && requires(C c, typename C::DataTypes::VecDeriv dx) { c.projectResponse(dx, dx); };

template <class C>
concept ProjectiveConstraint =
    HasRole<C, role::ProjectiveConstraint> && !JoinsTwo<C> && HasInit<C> && HasProjectResponse<C>;
/// The same between two states: each function has both vectors.
template <class C>
concept InteractionConstraint =
    HasRole<C, role::ProjectiveConstraint> && JoinsTwo<C> && HasInitOfTwo<C> && HasProjectResponseOfTwo<C>;

// Hooks, what a constraint may have beside these, and with two vectors where it joins two states:

/// Points that move on a prescribed path or stay on a surface, at the time t at the end of a step.
template <class C>
concept HasProjectPosition =
    HasDataTypes<C> && ((JoinsTwo<C> && requires(C c, double t, typename C::DataTypes::VecCoord x) {
                          c.projectPosition(t, x, x);
                        }) || (!JoinsTwo<C> && requires(C c, double t, typename C::DataTypes::VecCoord x) {
                          c.projectPosition(t, x);
                        }));
template <class C>
concept HasProjectVelocity =
    HasDataTypes<C> && ((JoinsTwo<C> && requires(C c, double t, typename C::DataTypes::VecDeriv v) {
                          c.projectVelocity(t, v, v);
                        }) || (!JoinsTwo<C> && requires(C c, double t, typename C::DataTypes::VecDeriv v) {
                          c.projectVelocity(t, v);
                        }));
/// Accelerations M^-1 f that it allows, where these are others than their projection.
template <class C>
concept HasProjectAcceleration =
    HasDataTypes<C> &&
    ((JoinsTwo<C> && requires(C c, typename C::DataTypes::VecDeriv a) { c.projectAcceleration(a, a); }) ||
     (!JoinsTwo<C> && requires(C c, typename C::DataTypes::VecDeriv a) { c.projectAcceleration(a); }));
template <class C>
concept ProjectsAsSaid = is_called(named::projectPosition<C>, HasProjectPosition<C>) &&
                         is_called(named::projectVelocity<C>, HasProjectVelocity<C>) &&
                         is_called(named::projectAcceleration<C>, HasProjectAcceleration<C>);
/// A = P A P + (I - P), by sink.fix(point) or sink.project(point, P): what solvers need that assemble a
/// matrix.
template <class C>
concept ProjectsMatrix = requires(C c, AnySink const sink) { c.projectMatrix(sink); };

template <>
struct Promise<role::ProjectiveConstraint> : NoPromise {
  template <class C>
  static constexpr bool kept = (ProjectiveConstraint<C> || InteractionConstraint<C>)&&ProjectsAsSaid<C>;
  template <class C>
  static constexpr bool assembled = ProjectsMatrix<C>;

  template <class C>
  struct Broken {
    static constexpr bool one = HasDataTypes<C> && !JoinsTwo<C>, two = HasDataTypes<C> && JoinsTwo<C>;
    static_assert(
        HasDataTypes<C>,
        "Sinew: a projective constraint has no DataTypes; write 'using DataTypes = D;' with those of "
        "the state on which it acts, such as Vec3d.");
    static_assert(
        !one || HasInit<C>,
        "Sinew: a projective constraint has no 'void init(InitContext<DataTypes> const& context)'.");
    static_assert(!one || HasProjectResponse<C>,
                  "Sinew: a projective constraint has no 'void projectResponse(VecDeriv& dx)', which takes "
                  "forbidden motions out of dx.");
    static_assert(
        !two || HasInitOfTwo<C>,
        "Sinew: a constraint between two states has no 'void init(InitContext<DataTypes> const& first, "
        "InitContext<DataTypes> const& second)'.");
    static_assert(
        !two || HasProjectResponseOfTwo<C>,
        "Sinew: a constraint between two states has no 'void projectResponse(VecDeriv& dx1, VecDeriv& "
        "dx2)', which takes forbidden motions out of both.");
    static_assert(is_called(named::projectPosition<C>, HasProjectPosition<C>),
                  "Sinew: a constraint has a projectPosition that nothing calls; write 'void "
                  "projectPosition(double t, VecCoord& x)', with two vectors where it joins two states.");
    static_assert(is_called(named::projectVelocity<C>, HasProjectVelocity<C>),
                  "Sinew: a constraint has a projectVelocity that nothing calls; write 'void "
                  "projectVelocity(double t, VecDeriv& v)', with two vectors where it joins two states.");
    static_assert(is_called(named::projectAcceleration<C>, HasProjectAcceleration<C>),
                  "Sinew: a constraint has a projectAcceleration that nothing calls; write 'void "
                  "projectAcceleration(VecDeriv& a)', with two vectors where it joins two states.");
  };
  template <class C>
  struct NotAssembled {
    static_assert(
        ProjectsMatrix<C>,
        "Sinew: a constraint is under a linear solver that assembles a matrix, and has no 'template "
        "<class Sink> void projectMatrix(Sink const& sink)', which fixes points by sink.fix(point) or "
        "sink.project(point, projector); add it, or take CGLinearSolver<> without a matrix.");
  };
};

}  // namespace sinew
