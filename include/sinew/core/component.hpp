// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/fields.hpp>
#include <sinew/core/mesh.hpp>
#include <sinew/core/part.hpp>
#include <sinew/core/renumbering.hpp>
#include <sinew/core/vec_id.hpp>

#include <array>
#include <concepts>
#include <span>
#include <string>

namespace sinew {

/// What a component is in its node. A component names its role (`using Role = role::Mass;`) and fulfils the
/// concept of the same name below; it has no base class and knows no other component.
namespace role {
struct Context;      // a value inherited by the subtree, such as Gravity
struct Topology;     // elements over the points of the node's state
struct State;        // degrees of freedom
struct VisualModel;  // positions that follow by a mapping and take no part in mechanics
struct Mass;
struct ForceField;
struct InteractionForceField;
struct ProjectiveConstraint;
struct Mapping;
struct OdeSolver;
struct LinearSolver;
struct StepCallback;  // called before and after each step
struct Engine;        // makes its outputs from its fields before the scene starts: loaders, selections
// the stages of collision detection and response, in one node
struct CollisionPipeline;  // composes them
struct BroadPhase;         // which models are near each other
struct NarrowPhase;        // which of their primitives are
struct Intersection;       // where two primitives meet
struct ContactManager;     // what answers it
struct CollisionModel;     // primitives over the points of a state
struct Carving;            // which elements go where something touches
struct Execution;          // by which threads the solvers of the subtree work
}  // namespace role

template <class C, class R>
concept HasRole = std::same_as<typename C::Role, R>;

/// A component between two states, at the paths that its `ends` name.
template <class C>
concept JoinsTwo = HasRole<C, role::InteractionForceField> || requires {
  typename C::Ends;
  requires C::between;
};

/// Elements over the points of one node, as components see them at init. Empty where there is no topology. A
/// topology that has to be made first offers generate(where), which init calls before all else. One whose
/// elements may be removed while the scene runs offers edit(), its ElementLists.
struct TopologyView {
  std::span<Eigen::Vector3d const> positions{};  // for a state that is given none
  std::span<Edge const> edges{};
  std::span<Triangle const> triangles{};
  std::span<Quad const> quads{};
  std::span<Tetrahedron const> tetrahedra{};
  std::span<Hexahedron const> hexahedra{};
  std::array<int, 3> grid{0, 0, 0};  // points of a regular grid along x, y, z; zeros where there is none
  // of a grid of cells whose points are those of the state: where they lie before the state is moved
  std::span<Eigen::Vector3d const> places{};
  // of a grid of cells over a surface: the part of each hexahedron that counts as filled; empty where all are
  std::span<double const> fill{};
};

/// What a component of a node is given at init: where it stands (for messages), the rest positions of the
/// node's state, and the nearest topology.
template <class D>
struct InitContext {
  std::string where;
  typename D::VecCoord const& rest;
  TopologyView topology;
  /// Of the points [kg], for a component that asks for them by `needsMasses`; empty where there is no mass.
  std::span<double const> masses{};
};

/// Arguments of the mechanical operations. The product with a vector is (m M + b B + k K) dx, where
/// K = df/dx and B = df/dv, so an implicit step has negative b and k.
struct MechanicalParams {
  double time = 0, dt = 0;
  Eigen::Vector3d gravity{0, 0, 0};
  double m = 0, b = 0, k = 0;
  Part part{};  // for a component that takes_parts
  // not 0: forces are for a step v += turning M^-1 f, x += turning v, and gyroscopic ones those at its end
  double turning = 0;
};

/// What a force field claims of itself (as `properties()`), and the law suite proves. The defaults are those
/// of an elastic force between points of one body; a field that says nothing claims them all.
struct ForceProperties {
  bool internal = true;      // moving the body as a whole changes nothing, and the forces sum to zero
  bool objective = true;     // the same for turning it, and torques
  bool conservative = true;  // f = -dE/dx
  bool exactTangent =
      true;  // addDForce is the derivative of addForce everywhere, not only in the undeformed body
};
template <class C>
ForceProperties properties_of(C const& c) {
  if constexpr (requires { c.properties(); })
    return c.properties();
  else
    return {};
}

/// The step that has just ended.
struct StepInfo {
  long step;
  double time, dt;
};

/// The step that is about to be made.
struct StepAhead {
  long step;              // its number, from 1
  double begin, end, dt;  // [s]
  bool solved;            // an ODE solver moves the state
};

/// A component that acts on its state before a step, whatever its role (`actsBeforeStep`): a recorder, a
/// replay, a controller, a haptic device. It has one of these, called with the state on which it acts before
/// any solver works; first all beforeStep of a scene, from the root to the leaves, then all beginStep.
///   beforeStep(ahead, state)   looks at the state as the last step has left it;
///   beginStep(ahead, state)    may move it, and returns whether it did: what is mapped from it then follows.
template <class C>
concept ActsBeforeStep = requires {
  requires C::actsBeforeStep;
  typename C::DataTypes;
};

/// Force fields whose forces do not depend on positions and velocities: no matrix has anything of them.
template <class C>
concept Load = requires {
  requires C::isLoad;
};

/// A component that watches the state on which it acts: init(context), as force fields have it, and
/// endStep(step, state, kineticEnergy) after each step, where kineticEnergy() is that of the state's mass. It
/// may have finish(), which Simulation::finish() calls.
template <class C>
concept WatchesState = HasRole<C, role::StepCallback> && requires {
  typename C::DataTypes;
};

/// A component, whatever its role, that a step leaves other than init did, in more than what the next step
/// computes anew: reset() makes it what it was, at time 0. It may return a bool: true says that elements are
/// there again whose places in a matrix have to be found.
template <class C>
concept Resettable = requires(C c) {
  c.reset();
};

/// What an assembled or matrix-free system is made of: m M + b B + k K.
struct MatrixFactors {
  double m = 0, b = 0, k = 0;
};

/// A state vector of particles [m], or of rigids, and all that solvers do with it.
template <class C>
concept State = HasRole<C, role::State> && requires(C s, CoordId x, DerivId v) {
  typename C::DataTypes;
  { s[x] } -> std::same_as<typename C::DataTypes::VecCoord&>;
  { s[v] } -> std::same_as<typename C::DataTypes::VecDeriv&>;
  s.init(std::string{});
  s.reset();
};

template <class C, class D = typename C::DataTypes>
concept Mass = HasRole<C, role::Mass> &&
    requires(C m, InitContext<D> c, MechanicalParams p, typename D::VecDeriv f, typename D::VecCoord x) {
  m.init(c);
  m.addForce(p, f, x, f);  // weight, and gyroscopic forces of rigids
  m.addMDx(f, x, f, 1.0);  // f += factor M dx
  m.accFromF(f, x, f);     // a = M^-1 f
  { m.kineticEnergy(x, f) } -> std::convertible_to<double>;
};

/// A force that is its fields, a list of elements and their law: `driver`, an ElementDriver made by init.
/// law() is the law with its settings, where it has any; law<L>() where it may be asked for lanes or one
/// element at a time. What forces do is in core/element_force.hpp; the functions that other forces have are
/// left to it.
template <class C>
concept ElementForce = requires {
  typename C::Driver::Law;
  requires std::same_as<decltype(C::driver), typename C::Driver>;
};

template <class C, class D = typename C::DataTypes>
concept ForceField = HasRole<C, role::ForceField> &&
    requires(C ff, InitContext<D> c, MechanicalParams p, typename D::VecDeriv f, typename D::VecCoord x) {
  ff.init(c);
  requires ElementForce<C> || requires {
    ff.addForce(p, f, x, f);
    ff.addDForce(p, f, f);  // df += (k K + b B) dx at the last addForce
    { ff.potentialEnergy(x) } -> std::convertible_to<double>;
  };
};

template <class C, class D = typename C::DataTypes>
concept InteractionForceField = HasRole<C, role::InteractionForceField> &&
    requires(C ff, InitContext<D> c, MechanicalParams p, typename D::VecDeriv f, typename D::VecCoord x) {
  typename C::Ends;
  ff.init(c, c);
  requires ElementForce<C> || requires {
    ff.addForce(p, f, f, x, x, f, f);
    ff.addDForce(p, f, f, f, f);
    { ff.potentialEnergy(x, x) } -> std::convertible_to<double>;
  };
};

template <class C, class D = typename C::DataTypes>
concept ProjectiveConstraint = HasRole<C, role::ProjectiveConstraint> &&
    requires(C pc, InitContext<D> c, typename D::VecDeriv dx) {
  requires !JoinsTwo<C>;
  pc.init(c);
  pc.projectResponse(dx);  // remove forbidden displacements
  // and, where points move on a prescribed path or stay on a surface, at the time t at the end of a step:
  //   pc.projectPosition(t, x);  pc.projectVelocity(t, v);
  // and, where the accelerations M^-1 f that it allows are others than their projection:
  //   pc.projectAcceleration(a);
};
/// The same between two states: each function has both vectors.
template <class C, class D = typename C::DataTypes>
concept InteractionConstraint = HasRole<C, role::ProjectiveConstraint> && JoinsTwo<C> &&
    requires(C pc, InitContext<D> c, typename D::VecDeriv dx) {
  pc.init(c, c);
  pc.projectResponse(dx, dx);
};

template <class C, class In = typename C::In, class Out = typename C::Out>
concept Mapping = HasRole<C, role::Mapping> &&
    requires(C m, InitContext<In> parent, InitContext<Out> child, typename In::VecCoord xi,
             typename In::VecDeriv vi, typename Out::VecCoord xo, typename Out::VecDeriv vo) {
  m.init(parent, child, xo);  // may fill an empty child
  m.apply(xo, xi);
  m.applyJ(vo, vi);   // vo = J vi at the last apply
  m.applyJT(vi, vo);  // vi += J' vo
};

/// A mapping with several parents, named by paths. It has a part for each, a mapping from that parent alone
/// to those points of the child that follow it.
template <class C>
concept HasParents = HasRole<C, role::Mapping> && requires {
  typename C::Parents;
};
template <class C, class In = typename C::In, class Out = typename C::Out>
concept MultiMapping = HasParents<C> &&
    requires(C m, std::vector<InitContext<In>> parents, InitContext<Out> child, typename In::VecCoord xi,
             typename In::VecDeriv vi, typename Out::VecCoord xo, typename Out::VecDeriv vo) {
  m.init(parents, child, xo);  // as many parts as parents
  m.parts[0].apply(xo, xi);
  m.parts[0].applyJ(vo, vi);
  m.parts[0].applyJT(vi, vo);
};

/// A mapping that is not linear may say what that adds to the stiffness of its parent,
/// K_g = (dJ'/dx) f, at the force f on its child that updateK was given last. It also adds K_g to a matrix
/// over the parent's degrees of freedom: addToMatrix(params, sink). K_g is symmetric.
template <class C>
concept HasGeometricStiffness = requires(C m, typename C::In::VecDeriv vi,
                                         typename C::Out::VecDeriv const vo) {
  m.updateK(vo);
  m.addKx(vi, vi, 1.0);  // df += k K_g dx
};

/// A component that is given the masses of the points at init: those of its parent, where it is a mapping.
template <class C>
inline constexpr bool needs_masses = requires {
  C::needsMasses;
};
/// A mapping for which the elements of the topology in its node are over the points of its parent. Its points
/// are elements of that topology, or of the parent's where the node has none: pointsThatStay(before, change)
/// says which stay when elements are removed.
template <class C>
inline constexpr bool over_parent = requires {
  C::overParent;
};

/// Files to read and points to select, turned into data of other components before the scene starts:
/// update(where) makes what outputs() lists, as fields() does, from the fields.
template <class C>
concept Engine = HasRole<C, role::Engine> && requires(C e, std::string where) {
  C::outputs();
  e.update(where);
};

template <class C>
concept OdeSolver = HasRole<C, role::OdeSolver> && requires {
  { C::implicit } -> std::convertible_to<bool>;
  { C::auxiliary } -> std::convertible_to<Auxiliary>;
};

/// An ODE solver that does not integrate but changes the state after the solver that stands before it in its
/// node.
template <class C>
inline constexpr bool stands_beside = requires {
  requires C::beside;
};

template <class C>
concept LinearSolver = HasRole<C, role::LinearSolver> && requires {
  { C::auxiliary } -> std::convertible_to<Auxiliary>;
};

/// A linear solver that keeps a matrix, whose pattern is fixed at init and when contacts join other points;
/// one that does not says so.
template <class C>
inline constexpr bool needs_pattern = !requires {
  requires !C::needsPattern;
};

/// Primitives over the points of a state, at init; the rest is done with its `surface` (collision/).
template <class C, class D = typename C::DataTypes>
concept CollisionModel = HasRole<C, role::CollisionModel> && requires(C m, InitContext<D> c) {
  { C::corners } -> std::convertible_to<int>;
  m.init(c);
  m.surface.elements;
};

}  // namespace sinew
