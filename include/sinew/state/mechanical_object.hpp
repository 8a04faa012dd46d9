// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/placement.hpp>
#include <sinew/core/point_change.hpp>
#include <sinew/state/vector_operations.hpp>

#include <algorithm>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace sinew {

/// Degrees of freedom of one body: its state vectors, found by their ids. Sized by `position`, or by the
/// mapping of the node when `position` is empty.
template <class D>
struct MechanicalObject {
  using Role = role::State;
  using DataTypes = D;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "MechanicalObject";

  VecCoord position{};      // current positions [m]; those given are the initial ones
  VecDeriv velocity{};      // current velocities [m/s]; zero when not given, the last for all when fewer
  VecCoord restPosition{};  // undeformed positions [m]; the initial ones when not given
  // where reset() goes; the start when not given
  VecCoord resetPosition{};
  VecDeriv resetVelocity{};
  // moves the positions given, at init: scaled first, then rotated by Euler angles about x, y, z, then
  // shifted
  Eigen::Vector3d translation{0, 0, 0}, rotation{0, 0, 0}, scale3d{1, 1, 1};

  // of a checkpoint: what solvers keep from step to step, one auxiliary vector after the other
  VecDeriv history{};
  VecDeriv lastSolution{};  // the last dx, of solvers that start from it
  // position has the points of the node's topology, moved as the fields above say
  bool pointsOfTopology = false;
  // a reset leaves no points: all came while the scene ran
  bool startsEmpty = false;

  static constexpr auto fields() {
    using M = MechanicalObject;
    return field_list(
        field("position",
              &M::position,
              "m",
              "positions at the start; where there is one at most, those of the node's topology")
            .whileRunning(),
        field("velocity",
              &M::velocity,
              "m/s",
              "velocities at the start; where they are fewer than points, the others have the last")
            .whileRunning(),
        field("rest_position", &M::restPosition, "m", "undeformed positions"),
        field("reset_position",
              &M::resetPosition,
              "m",
              "positions to which a reset goes; those at the start when not given"),
        field("reset_velocity",
              &M::resetVelocity,
              "m/s",
              "velocities to which a reset goes; those at the start when not given"),
        field("translation", &M::translation, "m", "moves all positions at the start"),
        field("rotation",
              &M::rotation,
              "degree",
              "rotates all positions at the start, about x, then y, then z"),
        field("scale3d", &M::scale3d, "", "stretches all positions at the start").also("scale"),
        field("history", &M::history, "", "what solvers keep from step to step, in a checkpoint"),
        field("last_solution",
              &M::lastSolution,
              "",
              "solution of the last system, from which a solver with warmStart goes on, in a checkpoint"),
        field("points_of_topology",
              &M::pointsOfTopology,
              "",
              "whether positions are those of the node's topology, moved; found out at the start"),
        field("starts_empty",
              &M::startsEmpty,
              "",
              "whether a reset leaves no points, in a checkpoint of one whose points come and go"));
  }

  // after init
  VecDeriv force{}, dx{};
  VecCoord freePosition{};
  VecDeriv externalForce{};  // of interactions with bodies under other solvers, at the start of the step [N];
                             // empty where there are none
  VecDeriv multiplierForce{};  // on a mapped state, of the multipliers that constraints have from the last
                               // step [N], from which the mapping has its geometric stiffness; empty where
                               // there are none
  // of Simulation::keepForces, empty without it: what acted over the last step, as impulse over dt, without
  // and of constraints [N]; and what its balance needs
  VecDeriv applied{}, reaction{}, startVelocity{}, marked{};
  std::vector<VecCoord> auxiliaryCoords{};
  std::vector<VecDeriv> auxiliaryDerivs{};
  // what a mapped state was given: positions, for its mapping, and rest positions
  std::optional<VecCoord> given{}, givenRest{};
  SolverWorkspace<D> solverWorkspace{};
  std::size_t capacity = 0;      // how many points there may be, where they come and go; 0: they do not
  PointChange<D> pointChange{};  // before a step
  int dofOffset = -1;            // first scalar of this state in the assembled system of its solver
  // of a distributed scene: points at the end that other processes own, and what is known of them
  std::size_t ghosts = 0;
  int halo = -1;
  int solver = -1;  // which of the ODE solvers of the scene moves it, in their order; -1: none

  std::size_t size() const { return position.size(); }
  /// Points that are not ghosts: the first ones.
  std::size_t owned() const { return position.size() - ghosts; }

  /// Takes the points of a topology where no positions are given, or, as in SOFA, one only, and moves them as
  /// the fields say, once.
  void place(std::string const& where, std::span<Eigen::Vector3d const> points) {
    if (position.size() == 1 && velocity.size() <= 1 && points.size() > 1) position.clear();
    auto center_of = [](Eigen::Vector3d const& p) -> Vec<typename D::Real, D::spatial> {
      return p.template head<D::spatial>().template cast<typename D::Real>();
    };
    if (position.empty())
      for (auto const& p : points) {
        position.push_back(D::zero());
        D::setCenter(position.back(), center_of(p));
      }
    auto same = [&](auto const& x, Eigen::Vector3d const& p) { return D::center(x) == center_of(p); };
    if (!points.empty() && std::equal(position.begin(), position.end(), points.begin(), points.end(), same))
      pointsOfTopology = true;
    const Eigen::Vector3d none = Eigen::Vector3d::Zero(), whole = Eigen::Vector3d::Ones();
    if (translation == none && rotation == none && scale3d == whole) return;
    const Eigen::Quaterniond rotate = rotation_of_degrees(rotation);
    for (VecCoord* all : {&position, &restPosition})
      for (auto& x : *all) {
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        p.template head<D::spatial>() = D::center(x).template cast<double>();
        const double before = p.norm();
        p = rotate * scale3d.cwiseProduct(p) + translation;
        if (p.template tail<3 - D::spatial>().norm() > 1e-9 * (p.norm() + before))
          throw Error(where,
                      text(component_name<MechanicalObject>(),
                           ": translation, rotation and scale3d take a point to (",
                           p[0],
                           ", ",
                           p[1],
                           ", ",
                           p[2],
                           "), out of its ",
                           D::spatial == 2 ? "plane; move and rotate it within" : "line; move it along"));
        D::setCenter(x, center_of(p));
        if constexpr (D::rigid && D::spatial == 3)
          x.orientation = rotate.template cast<typename D::Real>() * x.orientation;
        if constexpr (D::rigid && D::spatial == 2)
          x.orientation += typename D::Real(rotation[2] * std::numbers::pi / 180);
      }
    translation = rotation = none;
    scale3d = whole;
  }

  /// A mapped state starts from what it was given, however often it is initialised.
  void takeGiven() {
    if (!given) {
      given = position;
      givenRest = restPosition;
      return;
    }
    position = *given;
    restPosition = *givenRest;
    velocity.clear();
    resetPosition.clear();
    resetVelocity.clear();
  }

  void init(std::string const& where) {
    const std::size_t n = position.size();
    auto same = [&](std::size_t entries, std::string_view name) {
      if (entries != 0 && entries != n)
        throw Error(where,
                    text(component_name<MechanicalObject>(),
                         ": ",
                         name,
                         " has ",
                         entries,
                         " entries, position has ",
                         n,
                         "; give one for each, or none"));
    };
    if (velocity.size() > n) same(velocity.size(), "velocity");
    same(restPosition.size(), "rest_position");
    if (capacity == 0) {
      same(resetPosition.size(), "reset_position");
      same(resetVelocity.size(), "reset_velocity");
    } else if (!resetVelocity.empty() && resetVelocity.size() != resetPosition.size()) {
      throw Error(where,
                  text(component_name<MechanicalObject>(),
                       ": reset_velocity has ",
                       resetVelocity.size(),
                       " entries, reset_position has ",
                       resetPosition.size(),
                       "; give as many of both"));
    }
    if constexpr (D::rigid && D::spatial == 3)
      for (std::size_t i = 0; i < n; ++i) {
        const auto norm = position[i].orientation.norm();
        if (!(norm > 1e-6))
          throw Error(where,
                      text(component_name<MechanicalObject>(),
                           ": the orientation of position ",
                           i,
                           " is zero; give a quaternion of length 1"));
        // one that a simulation has left unit stays bit by bit what it was
        if (std::abs(norm - 1) > 4 * std::numeric_limits<typename D::Real>::epsilon())
          position[i].orientation.coeffs() /= norm;
      }
    velocity.resize(n, velocity.empty() ? typename D::Deriv(D::Deriv::Zero()) : velocity.back());
    if (restPosition.empty()) restPosition = position;
    force.assign(n, D::Deriv::Zero());
    dx.assign(n, D::Deriv::Zero());
    if (lastSolution.size() == n) dx = lastSolution;
    lastSolution.clear();
    freePosition = position;
    // a mapping that takes the place of another may have given it other points
    if (std::any_of(auxiliaryCoords.begin(), auxiliaryCoords.end(), [n](auto& v) { return v.size() != n; }) ||
        std::any_of(auxiliaryDerivs.begin(), auxiliaryDerivs.end(), [n](auto& v) { return v.size() != n; })) {
      auxiliaryCoords.clear();
      auxiliaryDerivs.clear();
      history.clear();
    }
    if (multiplierForce.size() != n) multiplierForce.clear();
    startsEmpty = capacity > 0 && (startsEmpty || n == 0) && resetPosition.empty();
    if (resetPosition.empty() && !startsEmpty) resetPosition = position;
    if (resetVelocity.empty() && !startsEmpty) {
      resetVelocity = velocity;
      resetVelocity.resize(resetPosition.size(), D::Deriv::Zero());
    }
  }

  void reserve(Auxiliary needed) {
    while (auxiliaryCoords.size() < std::size_t(needed.coords)) {
      auxiliaryCoords.push_back(position);
      if (capacity > 0) auxiliaryCoords.back().reserve(capacity);
    }
    while (auxiliaryDerivs.size() < std::size_t(needed.derivs)) {
      const std::size_t n = position.size(), first = auxiliaryDerivs.size() * n;
      auxiliaryDerivs.emplace_back(n, D::Deriv::Zero());
      if (capacity > 0) auxiliaryDerivs.back().reserve(capacity);
      if (first + n <= history.size())
        std::copy_n(history.begin() + std::ptrdiff_t(first), n, auxiliaryDerivs.back().begin());
    }
  }

  /// Points that go leave all vectors.
  void follow(Renumbering const& points) {
    for (VecCoord* v : {&position, &restPosition, &resetPosition, &freePosition}) points.filter(*v);
    for (VecDeriv* v :
         {&velocity, &resetVelocity, &force, &dx, &externalForce, &multiplierForce, &applied, &reaction})
      points.filter(*v);
    for (VecCoord& v : auxiliaryCoords) points.filter(v);
    for (VecDeriv& v : auxiliaryDerivs) points.filter(v);
    for (auto* v : {&given, &givenRest})
      if (*v) points.filter(**v);
    history.clear();
  }

  /// Room for `capacity` points in all that has an entry for each, but in forces that are kept.
  void reserveCapacity() {
    pointChange.reserve(std::max(size(), capacity));
    for (VecCoord* v : {&position, &restPosition, &freePosition}) v->reserve(capacity);
    for (VecDeriv* v : {&velocity, &force, &dx}) v->reserve(capacity);
    for (VecCoord& v : auxiliaryCoords) v.reserve(capacity);
    for (VecDeriv& v : auxiliaryDerivs) v.reserve(capacity);
  }
  /// Points go and come, as pointChange has it. The rest position of one that comes is that at which it
  /// comes, and what solvers keep of it from step to step is zero.
  void changePoints() {
    auto change = [this](auto& list, auto const& added) {
      pointChange.points.filter(list);
      list.insert(list.end(), added.begin(), added.end());
    };
    for (VecCoord* v : {&position, &restPosition, &freePosition}) change(*v, pointChange.positions);
    for (VecCoord& v : auxiliaryCoords) change(v, pointChange.positions);
    change(velocity, pointChange.velocities);
    const std::size_t n = position.size();
    auto changeToZero = [&](VecDeriv& list) {
      pointChange.points.filter(list);
      list.resize(n, D::Deriv::Zero());
    };
    for (VecDeriv* v : {&force, &dx}) changeToZero(*v);
    for (VecDeriv& v : auxiliaryDerivs) changeToZero(v);
  }

  void reset() {
    position = resetPosition;
    velocity = resetVelocity;
    if (capacity > 0) {
      restPosition = freePosition = position;
      for (VecCoord& v : auxiliaryCoords) v = position;
      for (VecDeriv* v : {&force, &dx}) v->resize(position.size(), D::Deriv::Zero());
      for (VecDeriv& v : auxiliaryDerivs) v.resize(position.size(), D::Deriv::Zero());
    }
    for (VecDeriv* v : {&force, &dx, &applied, &reaction}) v->assign(v->size(), D::Deriv::Zero());
    for (VecDeriv& v : auxiliaryDerivs) v.assign(v.size(), D::Deriv::Zero());
  }

  VecCoord& operator[](CoordId id) {
    switch (id.index) {
      case vec_id::position.index:
        return position;
      case vec_id::restPosition.index:
        return restPosition;
      case vec_id::freePosition.index:
        return freePosition;
      default:
        return auxiliaryCoords[std::size_t(id.index - CoordId::reserved)];
    }
  }
  VecDeriv& operator[](DerivId id) {
    switch (id.index) {
      case vec_id::velocity.index:
        return velocity;
      case vec_id::force.index:
        return force;
      case vec_id::dx.index:
        return dx;
      case vec_id::externalForce.index:
        return externalForce;
      case vec_id::applied.index:
        return applied;
      case vec_id::reaction.index:
        return reaction;
      case vec_id::startVelocity.index:
        return startVelocity;
      case vec_id::marked.index:
        return marked;
      default:
        return auxiliaryDerivs[std::size_t(id.index - DerivId::reserved)];
    }
  }
};

/// What says that DataTypes are missing, or are none.
template <class D>
requires(!IsDataTypes<D>)
struct MechanicalObject<D> {
  static_assert(
      !std::is_same_v<D, D>,
      "Sinew: a MechanicalObject is over DataTypes; write MechanicalObject<Vec3d>{...}, or others of "
      "core/data_types.hpp.");
  template <class... Values>
  explicit MechanicalObject(Values const&...) {}
};
template <class... Values>
MechanicalObject(Values const&...) -> MechanicalObject<void>;

}  // namespace sinew
