// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/blade_crossings.hpp>
#include <sinew/topology/tear_plan.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Tears the tetrahedra of the topology of its node (where it has none, the triangles) while the scene runs:
/// where the largest principal stress is stressThreshold or more, a plane tear opens across the direction of
/// that stress, from the point of the element with the greatest stress around it, of those on the border and
/// at the ends of tears before others (plan_tear). It is made as a cut is: mass, momentum and strain stay
/// what they are. Stresses are those of all force fields of the node that have some (TriangleFEMForceField,
/// TetrahedronFEMForceField), in tension only: what is pressed does not tear.
///
/// A tear goes on into elements that do not bear their stress, no farther than fractureMaxLength, and through
/// one element at least; the next one, `step` steps later, may go on where it ends.
template <class D>
struct TearingEngine {
  using Role = role::TopologicalChange;
  using DataTypes = D;
  static_assert(!D::rigid && D::spatial == 3 && D::size == 3,
                "Sinew: bodies of points in space tear; take Vec3d or Vec3f.");
  static constexpr std::string_view className = "TearingEngine";

  double stressThreshold = 55, fractureMaxLength = 0;
  int step = 20, nbFractureMax = 15;
  bool ignoreTriangles = true;
  std::vector<int> trianglesToIgnore{};
  PointStress computeVertexStressMethod = PointStress::WeightedAverageInverseDistance;
  double snapping = CutRules{}.snapping, quality = CutRules{}.quality;

  static constexpr auto fields() {
    using E = TearingEngine;
    return field_list(
        field("stressThreshold",
              &E::stressThreshold,
              "Pa",
              "an element tears where its largest principal stress is this or more",
              range::positive),
        field("fractureMaxLength",
              &E::fractureMaxLength,
              "m",
              "how far a tear goes at once from the point where it begins; it goes through one element at "
              "least",
              range::nonNegative),
        field("step",
              &E::step,
              "",
              "steps that pass before the first tear, and between two",
              range::nonNegative),
        field("nbFractureMax", &E::nbFractureMax, "", "how many tears there may be", range::nonNegative),
        field("ignoreTriangles",
              &E::ignoreTriangles,
              "",
              "no tear begins in an element that has a point which a constraint holds")
            .also("ignoreTriangleAtStart ignoreTetraAtStart"),
        field("trianglesToIgnore",
              &E::trianglesToIgnore,
              "",
              "elements in which no tear begins: triangles, or tetrahedra where the topology has these",
              range::nonNegative),
        field(
            "computeVertexStressMethod",
            &E::computeVertexStressMethod,
            "",
            "how the stresses of the elements around a point are averaged: weighed by the distance of their "
            "middles, all alike, or weighed by area or volume"),
        field(
            "snapping",
            &E::snapping,
            "",
            "a tear passes through a point that is nearer to it than this part of an edge, which it does not "
            "split then",
            range::closed(0, 0.5)),
        field(
            "quality",
            &E::quality,
            "",
            "no element that comes is worse, unless the one is of which it is a part: volume over the cubed "
            "mean edge, 1 for a regular tetrahedron",
            range::closed(0, 1)));
  }

  // of the steps
  int fractures = 0, waited = 0;  // tears so far, and steps since the last
  double maxStress = 0;           // the largest principal stress where it looked last [Pa]
  std::vector<Eigen::Matrix3d> stress{};
  CutFront front{};
  std::vector<int> whole{};  // elements of which a tear has changed nothing
  int torn = -1;             // in which the one begins that is made

  static constexpr auto state() {
    using E = TearingEngine;
    return field_list(field("fractures", &E::fractures, "", "tears so far", range::nonNegative),
                      field("waited", &E::waited, "", "steps since the last", range::nonNegative));
  }
  /// What is torn stays so.
  void reset() {
    waited = 0;
    maxStress = 0;
  }

  void prepare(std::string const& where, TopologyView const& topology) {
    const std::size_t n = elements(topology);
    if (n == 0)
      throw Error(where,
                  "the topology of its node has neither tetrahedra nor triangles, and nothing else tears; "
                  "give it some");
    for (const int e : trianglesToIgnore)
      if (e < 0 || std::size_t(e) >= n)
        throw Error(where,
                    text("trianglesToIgnore has ",
                         e,
                         ", but the topology has ",
                         n,
                         " elements, numbered from 0; correct it"));
    stress.reserve(n);
  }
  CutRules rules() const { return {.snapping = snapping, .quality = quality}; }

  bool looks(TopologyView const& topology) {
    if (fractures >= nbFractureMax) return false;
    if (waited < step) {
      ++waited;
      return false;
    }
    stress.assign(elements(topology), Eigen::Matrix3d::Zero());
    return true;
  }
  bool overloaded() {
    maxStress = 0;
    for (auto const& s : stress) maxStress = std::max(maxStress, principal_stress(s).value);
    return maxStress >= stressThreshold;
  }
  /// Of what an earlier tear has left, faces stay that open where this one goes on, and what is carried.
  std::optional<BladeStroke> tear(TopologyView const& topology, std::vector<Eigen::Vector3d> const& x,
                                  std::vector<bool> const& held) {
    std::vector<bool> mayBegin(stress.size(), true);
    for (auto const* list : {&trianglesToIgnore, &whole})
      for (const int e : *list)
        if (std::size_t(e) < mayBegin.size()) mayBegin[std::size_t(e)] = false;
    auto leave = [&](auto const& list) {
      for (std::size_t e = 0; e < list.size(); ++e)
        for (const Index i : list[e])
          if (held[std::size_t(i)]) mayBegin[e] = false;
    };
    if (ignoreTriangles) topology.tetrahedra.empty() ? leave(topology.triangles) : leave(topology.tetrahedra);
    auto tear = plan_tear(
        topology,
        x,
        stress,
        mayBegin,
        {.threshold = stressThreshold, .length = fractureMaxLength, .ofPoints = computeVertexStressMethod});
    torn = tear ? tear->element : -1;
    front = {.faces = front.faces, .carried = front.carried};
    if (!tear) return {};
    return BladeStroke{std::move(tear->surface), fractures};
  }
  void changeMade(bool changes) {
    if (!changes) return whole.push_back(torn);
    ++fractures;
    waited = 0;
  }

  void followElements(TopologyChange const& change) {
    front = {};
    whole.clear();
    Renumbering const& tetrahedra = change.of(ElementKind::tetrahedron);
    Renumbering const& r = tetrahedra.now.empty() ? change.of(ElementKind::triangle) : tetrahedra;
    std::vector<int> ignored;
    for (const int e : trianglesToIgnore)
      if (std::size_t(e) < r.now.size() && r.stays(e)) ignored.push_back(r.now[std::size_t(e)]);
    for (std::size_t k = 0; k < r.come.size(); ++k)
      if (std::find(trianglesToIgnore.begin(), trianglesToIgnore.end(), r.come[k].a) !=
          trianglesToIgnore.end())
        ignored.push_back(int(r.kept.size() + k));
    trianglesToIgnore = std::move(ignored);
  }

 private:
  static std::size_t elements(TopologyView const& t) {
    return t.tetrahedra.empty() ? t.triangles.size() : t.tetrahedra.size();
  }
};

}  // namespace sinew
