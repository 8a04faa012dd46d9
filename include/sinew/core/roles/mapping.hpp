// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>
#include <sinew/core/roles/force_field.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

// Makes the state, or the visual model, of its node follow the state above. The shortest:
//
//   /// Its points are twice as far away.   J = 2 I
//   struct Doubled {
//     using Role = role::Mapping;
//     using In = Vec3d;
//     using Out = Vec3d;
//     static constexpr std::string_view className = "Doubled";
//     static constexpr auto fields() { return field_list(); }
//
//     void init(InitContext<Vec3d> const& parent, InitContext<Vec3d> const&, Vec3d::VecCoord& positions) {
//       positions.resize(parent.rest.size());
//     }
//     void apply(Vec3d::VecCoord& out, Vec3d::VecCoord const& in) const {
//       for (std::size_t i = 0; i < in.size(); ++i) out[i] = 2 * in[i];
//     }
//     void applyJ(Vec3d::VecDeriv& out, Vec3d::VecDeriv const& in) const { apply(out, in); }
//     void applyJT(Vec3d::VecDeriv& in, Vec3d::VecDeriv const& out) const {
//       for (std::size_t i = 0; i < in.size(); ++i) in[i] += 2 * out[i];
//     }
//   };

template <class C>
concept HasInAndOut = requires {
  typename C::In::VecCoord;
  typename C::In::VecDeriv;
  typename C::Out::VecCoord;
  typename C::Out::VecDeriv;
};
/// Out = what follows In at the last apply; `part` is a mapping, or what maps one parent of several.
template <class PartMapping, class C>
concept Applies = requires(PartMapping part, typename C::In::VecCoord const in,
                           typename C::Out::VecCoord out) { part.apply(out, in); };
template <class PartMapping, class C>
concept AppliesJ = requires(PartMapping part, typename C::In::VecDeriv const in,
                            typename C::Out::VecDeriv out) { part.applyJ(out, in); };
/// in += J' out.
template <class PartMapping, class C>
concept AppliesJT = requires(PartMapping part, typename C::In::VecDeriv in,
                             typename C::Out::VecDeriv const out) { part.applyJT(in, out); };
/// May fill an empty child.
template <class C>
concept HasInitOfChild =
    HasInAndOut<C> &&
    requires(C c, InitContext<typename C::In> const parent, InitContext<typename C::Out> const child,
             typename C::Out::VecCoord positions) { c.init(parent, child, positions); };

template <class C>
concept Mapping = HasRole<C, role::Mapping> && HasInAndOut<C> && HasInitOfChild<C> && Applies<C, C> &&
                  AppliesJ<C, C> && AppliesJT<C, C>;

/// A mapping with several parents, named by paths. part(k) is a mapping from parent k alone, to those points of
/// the child that follow it. Parts are applied in the order of the parents, all of them before applyJ of the
/// first: where a point follows several parents, the part of the first writes to it and the others go on
/// with what they find, and those of applyJT may do their work in any order.
template <class C>
concept HasParents = HasRole<C, role::Mapping> && requires { typename C::Parents; };
/// Its parents are two, and the second has the DataTypes `In2`. Numbers of parents are types then.
template <class C>
concept HasTwoKindsOfParents = HasParents<C> && requires { typename C::In2; };
template <std::size_t K>
using ParentNumber = std::integral_constant<std::size_t, K>;
namespace detail {
template <class C, class K>
struct KindOfParent {
  using type = typename C::In;
};
template <HasTwoKindsOfParents C>
struct KindOfParent<C, ParentNumber<1>> {
  using type = typename C::In2;
};
template <class C>
concept HasInitOfMany =
    HasInAndOut<C> && requires(C c, std::vector<InitContext<typename C::In>> const parents,
                               InitContext<typename C::Out> const child,
                               typename C::Out::VecCoord positions) { c.init(parents, child, positions); };
template <class C>
concept HasInitOfTwo =
    HasInAndOut<C> &&
    requires(C c, InitContext<typename C::In> const first, InitContext<typename C::In2> const second,
             InitContext<typename C::Out> const child,
             typename C::Out::VecCoord positions) { c.init(first, second, child, positions); };
}  // namespace detail
/// The DataTypes of the parent with a number of type K.
template <class C, class K>
using InOfParent = typename detail::KindOfParent<C, K>::type;
template <class C>
concept HasInitOfParents = detail::HasInitOfMany<C> || detail::HasInitOfTwo<C>;
template <class C>
concept HasParts = requires(C c) { c.part(ParentNumber<0>{}); };
template <class C>
using PartOf = std::decay_t<decltype(std::declval<C&>().part(ParentNumber<0>{}))>;
template <class C>
concept MultiMapping = HasParents<C> && HasInAndOut<C> && HasInitOfParents<C> && HasParts<C> &&
                       Applies<PartOf<C>, C> && AppliesJ<PartOf<C>, C> && AppliesJT<PartOf<C>, C>;

// Hooks, what a mapping may have beside these:

/// A mapping that is not linear may say what that adds to the stiffness of its parent,
/// K_g = (dJ'/dx) f, at the force f on its child that updateK was given last. It also adds K_g to a matrix
/// over the parent's degrees of freedom (AddsToMatrix). K_g is symmetric.
template <class C>
concept HasGeometricStiffness =
    HasInAndOut<C> && requires(C m, typename C::In::VecDeriv vi, typename C::Out::VecDeriv const vo) {
      m.updateK(vo);
      m.addKx(vi, vi, 1.0);  // df += k K_g dx
    };
/// The same of a part, where points follow several parents, so that K_g has a block for each pair of them: all
/// parts are given their dx by gather(dx) before addKx of the first, and the mapping, which has
/// addToMatrix(params, a, b, sink), adds the rows of parent a and the columns of parent b by
/// sink.add<0, 1>(i, j, block).
template <class PartMapping>
concept GathersParents =
    HasGeometricStiffness<PartMapping> &&
    requires(PartMapping m, typename PartMapping::In::VecDeriv const dx) { m.gather(dx); };
/// A mapping may say what the change of J adds to the acceleration of its child: velocityProducts(v of its
/// parent, v of its child) is (dJ/dt) v at the last apply, by which the mass in the node of the child makes
/// the inertial forces -M (dJ/dt) v.
template <class PartMapping>
concept HasVelocityProducts =
    HasInAndOut<PartMapping> && requires(PartMapping m, typename PartMapping::In::VecDeriv const vi,
                                         typename PartMapping::Out::VecDeriv const vo) {
      { m.velocityProducts(vi, vo) } -> std::convertible_to<typename PartMapping::Out::VecDeriv const&>;
    };
/// A mapping for which the elements of the topology in its node are over the points of its parent. Its points
/// are elements of that topology, or of the parent's where the node has none: pointsThatStay(before, change)
/// says which stay when elements are removed.
template <class C>
inline constexpr bool over_parent = requires { C::overParent; };
/// A mapping for which they are over entries of a list of its own, which name points of its parents.
template <class C>
inline constexpr bool over_entries = requires { C::overEntries; };
/// A mapping that makes the faces of its visual model, too, whose points have no fixed number: faces() are
/// those of the last apply. A state cannot follow it.
template <class C>
concept MakesFaces = requires(C const c) {
  { c.faces() } -> std::same_as<std::vector<Quad> const&>;
};
/// A mapping by which each point of the child goes with an element of the parent (`carriesPoints`), found
/// from where it is given, or where it rests (`useRestPosition`): where the parent is cut, a surface of such
/// points is cut with it, by the same blade.
template <class C>
inline constexpr bool carries_points = requires { C::carriesPoints; } && !C::Out::rigid;
/// f(point of the parent, block of J) for each block in the rows of a point: what solvers need that assemble
/// a matrix.
template <class PartMapping>
concept HasJacobianBlocks =
    requires(PartMapping const part, void (*f)(int, AnySink)) { part.forEachJacobianBlock(0, f); };

namespace detail {
template <class C>
constexpr bool maps_in_matrix() {
  if constexpr (HasGeometricStiffness<C> && !AddsToMatrix<C>)
    return false;
  else if constexpr (HasParents<C>)
    return HasJacobianBlocks<PartOf<C>>;
  else
    return HasJacobianBlocks<C>;
}
template <class C>
constexpr auto part_of() {
  if constexpr (HasParents<C> && HasParts<C>)
    return std::type_identity<PartOf<C>>{};
  else
    return std::type_identity<C>{};
}
template <class C>
inline constexpr bool says_stiffness = named::updateK<C> || named::addKx<C>;
}  // namespace detail

template <>
struct Promise<role::Mapping> : NoPromise {
  template <class C>
  static constexpr bool kept = ((!HasParents<C> && Mapping<C>) || MultiMapping<C>)&&is_called(
      detail::says_stiffness<C>, HasGeometricStiffness<C>);
  template <class C>
  static constexpr bool assembled = detail::maps_in_matrix<C>();

  template <class C>
  struct Broken {
    using PartMapping = typename decltype(detail::part_of<C>())::type;
    static constexpr bool maps = HasInAndOut<C> && (!HasParents<C> || HasParts<C>);
    static_assert(
        HasInAndOut<C>,
        "Sinew: a mapping has no In and Out; write 'using In = Vec3d; using Out = Vec3f;', the DataTypes "
        "of its parent and of its child.");
    static_assert(!HasInAndOut<C> || HasParents<C> || HasInitOfChild<C>,
                  "Sinew: a mapping has no 'void init(InitContext<In> const& parent, InitContext<Out> const& "
                  "child, Out::VecCoord& positions)', which sizes the positions of its child.");
    static_assert(
        !HasInAndOut<C> || !HasParents<C> || HasInitOfParents<C>,
        "Sinew: a mapping with several parents has no 'void init(std::vector<InitContext<In>> const& "
        "parents, InitContext<Out> const& child, Out::VecCoord& positions)', or, where it has In2, 'void "
        "init(InitContext<In> const& first, InitContext<In2> const& second, InitContext<Out> const& child, "
        "Out::VecCoord& positions)'.");
    static_assert(!HasParents<C> || HasParts<C>,
                  "Sinew: a mapping with several parents has no 'part(std::size_t k)', the mapping from "
                  "parent k alone.");
    static_assert(
        !maps || Applies<PartMapping, C>,
        "Sinew: a mapping has no 'void apply(Out::VecCoord& out, In::VecCoord const& in)', which makes "
        "the positions of its child.");
    static_assert(!maps || AppliesJ<PartMapping, C>,
                  "Sinew: a mapping has no 'void applyJ(Out::VecDeriv& out, In::VecDeriv const& in) const', "
                  "which makes out = J in, the velocities of its child.");
    static_assert(!maps || AppliesJT<PartMapping, C>,
                  "Sinew: a mapping has no 'void applyJT(In::VecDeriv& in, Out::VecDeriv const& out) const', "
                  "which adds J' out, the forces on its child, to in.");
    static_assert(
        is_called(detail::says_stiffness<C>, HasGeometricStiffness<C>),
        "Sinew: a mapping has an updateK or addKx that nothing calls; write both 'void "
        "updateK(Out::VecDeriv const& f)' and 'void addKx(In::VecDeriv& df, In::VecDeriv const& dx, "
        "double k) const'.");
  };
  template <class C>
  struct NotAssembled {
    static_assert(
        !HasGeometricStiffness<C> || AddsToMatrix<C>,
        "Sinew: a mapping with updateK is under a linear solver that assembles a matrix, and has no "
        "'template <class Sink> void addToMatrix(MechanicalParams const& p, Sink const& sink) const', "
        "which adds p.k K_g by sink.add(i, j, block); add it, or take CGLinearSolver<> without a matrix.");
    static_assert(
        HasJacobianBlocks<typename decltype(detail::part_of<C>())::type>,
        "Sinew: a mapping is under a linear solver that assembles a matrix, and has no 'template <class "
        "F> void forEachJacobianBlock(int point, F&& f) const', which calls f(point of the parent, block "
        "of J); add it, or take CGLinearSolver<> without a matrix.");
  };
};

}  // namespace sinew
