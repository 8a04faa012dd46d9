// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>
#include <sinew/core/follow.hpp>
#include <sinew/topology/shape_clusters.hpp>

#include <vector>

namespace sinew {

/// At the end of each step points move towards their goals X, and their velocity changes by as much (Mueller,
/// Heidelberger, Hennix, Ratcliff 2006):
///   d = stiffness (X - x),   x += d,   v += d / dt
/// Goals are positions that are given, or follow from where the points are by matching of shapes: in
/// clusters, which may overlap, all points go towards the rigid motion of their rest shape that is nearest to
/// them, or their affine map (Mueller, Heidelberger, Teschner, Gross 2005). Points weigh as much as their
/// masses, so that matching shapes keeps momentum and angular momentum, also where clusters overlap (Rivers,
/// James 2007). In SOFA a point weighs the same in all of its clusters.
/// Points that another constraint holds are moved, too: hold a cluster by fixed points.
///
/// In scene files position="@matching.targetPosition" takes the clusters of a ShapeMatching, and goals
/// follow.
template <class D>
struct PositionBasedDynamicsProjectiveConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "PositionBasedDynamicsProjectiveConstraint",
                                    aliases = "PositionBasedDynamicsConstraint";
  static constexpr bool actsBeforeStep = true, needsMasses = true;

  double stiffness = 1;
  VecCoord position{};
  std::vector<std::vector<int>> cluster{};
  int iterations = 1;
  double affineRatio = 0;
  double fixedweight = 1;
  std::vector<Eigen::Vector3d> fixedPosition0{}, fixedPosition{};

  static constexpr auto fields() {
    using C = PositionBasedDynamicsProjectiveConstraint;
    return field_list(
        field("stiffness", &C::stiffness, "", "part of the way to the goal", range::closed(0, 1)),
        field("position", &C::position, "m", "goals that are given, one for each point").oneEach(Of::points),
        field("cluster", &C::cluster, "", "points of each cluster whose shape is matched"),
        field("iterations", &C::iterations, "", "how often shapes are matched in a step", range::atLeast(1)),
        field("affineRatio",
              &C::affineRatio,
              "",
              "0: clusters move rigidly; 1: by an affine map; between, by a mean of both",
              range::closed(0, 1)),
        field("fixedweight",
              &C::fixedweight,
              "",
              "what a fixed point weighs, beside the mean of the points",
              range::positive),
        field("fixedPosition0",
              &C::fixedPosition0,
              "m",
              "fixed points at rest, in clusters numbered behind the points"),
        field("fixedPosition", &C::fixedPosition, "m", "where they are"));
  }

  ShapeClusters shapes{};
  std::vector<Eigen::Vector3d> goals{};
  VecDeriv moved{};  // d
  double dt = 0;     // of the step; 0 before the first one

  void init(InitContext<D> const& context) {
    const std::string where = place_of<PositionBasedDynamicsProjectiveConstraint>(context);
    const std::size_t n = context.rest.size();
    moved.assign(n, D::Deriv::Zero());
    dt = 0;
    if (position.empty() == cluster.empty())
      throw Error(where,
                  position.empty() ? "it has no goals; give position, one for each point, or cluster"
                                   : "position and cluster are both given; give one of them");
    if (!position.empty() && position.size() != n)
      throw Error(
          where, text("position has ", position.size(), " entries for ", n, " points; give a goal for each"));
    if (position.empty()) initShapes(where, context);
  }
  void reset() { dt = 0; }

  /// Points that go leave their clusters; one that comes is in those that have both points between which it
  /// is.
  void follow(Followed const& change) {
    Renumbering const& points = change.points;
    const std::size_t before = points.now.size();
    if (!points.changes()) return;
    std::vector<std::vector<int>> clusters;
    for (auto const& old : cluster) {
      std::vector<int> now;
      std::vector<bool> had(before + points.come.size(), false);
      for (const int i : old) {
        const bool held = std::size_t(i) >= before;
        if (!held) had[std::size_t(i)] = true;
        if (held)
          now.push_back(int(std::size_t(i) - before + points.size()));
        else if (points.stays(i))
          now.push_back(points.now[std::size_t(i)]);
      }
      for (std::size_t k = 0; k < points.come.size(); ++k)
        if (had[std::size_t(points.come[k].a)] && had[std::size_t(points.come[k].b)]) {
          had[before + k] = true;
          now.push_back(int(points.kept.size() + k));
        }
      if (!now.empty()) clusters.push_back(std::move(now));
    }
    cluster = std::move(clusters);
  }

  template <class State>
  void beforeStep(StepAhead const& ahead, State const&) {
    dt = ahead.dt;
  }

  void projectResponse(VecDeriv&) const {}
  template <class Sink>
  void projectMatrix(Sink const&) const {}

  void projectPosition(double /*time*/, VecCoord& x) {
    if (dt == 0) return;
    if constexpr (inSpace)
      if (position.empty()) {
        for (std::size_t i = 0; i < x.size(); ++i) goals[i] = x[i].template cast<double>();
        shapes.match(goals, iterations);
      }
    for (std::size_t i = 0; i < x.size(); ++i) {
      if constexpr (inSpace)
        moved[i] =
            Real(stiffness) *
            (position.empty() ? (goals[i] - x[i].template cast<double>()).eval().template cast<Real>().eval()
                              : D::difference(x[i], position[i]));
      else
        moved[i] = Real(stiffness) * D::difference(x[i], position[i]);
      D::increment(x[i], moved[i]);
    }
  }
  void projectVelocity(double /*time*/, VecDeriv& v) const {
    if (dt == 0) return;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += moved[i] / Real(dt);
  }

 private:
  static constexpr bool inSpace = !D::rigid && D::size == 3;

  void initShapes(std::string const& where, InitContext<D> const& context) {
    if constexpr (inSpace) {
      goals.clear();
      for (auto const& x : context.rest) goals.push_back(x.template cast<double>());
      shapes.init(
          where, cluster, goals, context.masses, {fixedPosition0, fixedPosition, fixedweight}, affineRatio);
    } else {
      throw Error(where, "shapes are matched over points in space only; give position");
    }
  }
};

}  // namespace sinew
