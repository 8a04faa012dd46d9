// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/context.hpp>
#include <sinew/topology/blade.hpp>

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sinew {

/// How the stresses s of the elements around a point are weighed, of which each is at a distance d of its
/// middle from it and has an area or a volume A: s_p = sum w s / sum w with w = 1/d, 1 or A.
enum class PointStress { WeightedAverageInverseDistance, UnweightedAverage, WeightedAverageArea };
inline constexpr std::array<std::string_view, 3> enum_names(PointStress) {
  return {"WeightedAverageInverseDistance", "UnweightedAverage", "WeightedAverageArea"};
}

/// Where and how far a body tears.
struct TearRules {
  double threshold = 0;  // largest principal stress that it bears [Pa]
  double length = 0;     // how far a tear goes from the point where it begins [m]; one element at least
  PointStress ofPoints = PointStress::WeightedAverageInverseDistance;
};

/// The largest principal stress, and its direction.
struct PrincipalStress {
  double value;
  Eigen::Vector3d direction;
};
PrincipalStress principal_stress(Eigen::Matrix3d const& stress);

/// A tear: the element that does not bear its stress, the point from which it tears, and the surface along
/// which it does: what a blade would sweep.
struct Tear {
  Index element, point;
  double stress;
  SweptBlade surface;
};

/// Where tetrahedra at x, or triangles where there are none, tear under their stresses [Pa]:
///
///   1. It begins in the element with the largest principal stress of those that may begin, if that is not
///      below the threshold.
///   2. Of the points of this element, it begins in one on the border of the body, to which the ends of
///      earlier tears belong, where it has one; of several in that with the greatest stress around it
///      (PointStress).
///   3. It is plane, through that point and perpendicular to the direction of that stress (Rankine; O'Brien,
///      Hodgins 1999 tear in this way from points). From a point inside the body it goes through all elements
///      around that the plane passes through; from one on the border through that of these with the greatest
///      stress, since behind a tear nothing pulls any more.
///   4. From there it goes on into elements that do not bear their stress either, as far as `length`.
///
/// Nothing where no element tears.
std::optional<Tear> plan_tear(TopologyView const& body, std::vector<Eigen::Vector3d> const& x,
                              std::vector<Eigen::Matrix3d> const& stress, std::vector<bool> const& mayBegin,
                              TearRules const& rules);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/border.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew::detail {

/// The elements around the points of a body, and the stress of each.
template <std::size_t N>
class TornBody {
 public:
  using Element = std::array<Index, N>;

  TornBody(std::span<Element const> elements, std::vector<Eigen::Vector3d> const& x,
           std::vector<Eigen::Matrix3d> const& stress, TearRules const& rules)
      : elements_(elements), x_(x), rules_(rules), first_(x.size() + 1, 0) {
    for (auto const& s : stress) principal_.push_back(principal_stress(s));
    for (Element const& e : elements)
      for (const Index i : e) ++first_[std::size_t(i) + 1];
    for (std::size_t i = 0; i < x.size(); ++i) first_[i + 1] += first_[i];
    around_.resize(N * elements.size());
    std::vector<std::size_t> next(first_);
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (const Index i : elements[e]) around_[next[std::size_t(i)]++] = Index(e);
  }

  std::optional<Tear> tear(std::vector<bool> const& mayBegin) const {
    std::vector<std::pair<double, Index>> order;
    for (std::size_t e = 0; e < elements_.size(); ++e)
      if (mayBegin[e] && tears(Index(e))) order.emplace_back(-principal_[e].value, Index(e));
    std::sort(order.begin(), order.end());
    for (auto const& [negative, e] : order)
      for (const Index i : beginnings(e))
        if (auto surface = surfaceFrom(i, principal_[std::size_t(e)].direction); !surface.empty())
          return Tear{e, i, -negative, SweptBlade(surface)};
    return {};
  }

 private:
  std::span<Element const> elements_;
  std::vector<Eigen::Vector3d> const& x_;
  TearRules const& rules_;
  std::vector<PrincipalStress> principal_{};
  std::vector<std::size_t> first_;  // of each point in around_
  std::vector<Index> around_{};     // elements

  Eigen::Vector3d const& at(Index i) const { return x_[std::size_t(i)]; }
  Element const& element(Index e) const { return elements_[std::size_t(e)]; }
  bool tears(Index e) const { return principal_[std::size_t(e)].value >= rules_.threshold; }
  std::span<Index const> around(Index i) const {
    return std::span<Index const>(around_).subspan(first_[std::size_t(i)],
                                                   first_[std::size_t(i) + 1] - first_[std::size_t(i)]);
  }
  /// Of an element, the other one that has its face without corner k; -1: none.
  Index beyond(Index e, std::size_t k) const {
    Element const& mine = element(e);
    for (const Index other : around(mine[k == 0 ? 1 : 0])) {
      if (other == e) continue;
      bool all = true;
      for (std::size_t c = 0; c < N; ++c)
        all = all && (c == k || std::find(element(other).begin(), element(other).end(), mine[c]) !=
                                    element(other).end());
      if (all) return other;
    }
    return -1;
  }
  bool onBorder(Index i) const {
    for (const Index e : around(i))
      for (std::size_t k = 0; k < N; ++k)
        if (element(e)[k] != i && beyond(e, k) < 0) return true;
    return false;
  }

  double measure(Element const& e) const {
    const Eigen::Vector3d a = at(e[1]) - at(e[0]), b = at(e[2]) - at(e[0]), n = a.cross(b);
    if constexpr (N == 4) return std::abs(n.dot(at(e[3]) - at(e[0]))) / 6;
    return n.norm() / 2;
  }
  double stressAround(Index i) const {
    double sum = 0, weights = 0;
    for (const Index e : around(i)) {
      double weight = 1;
      if (rules_.ofPoints == PointStress::WeightedAverageArea) weight = measure(element(e));
      if (rules_.ofPoints == PointStress::WeightedAverageInverseDistance) {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (const Index j : element(e)) middle += at(j) / double(N);
        weight = 1 / std::max((middle - at(i)).norm(), 1e-300);
      }
      sum += weight * principal_[std::size_t(e)].value, weights += weight;
    }
    return weights > 0 ? sum / weights : 0;
  }
  Element beginnings(Index e) const {
    struct Ranked {
      bool inside;
      double negative;
      Index point;
    };
    std::array<Ranked, N> ranked;
    for (std::size_t k = 0; k < N; ++k)
      ranked[k] = {!onBorder(element(e)[k]), -stressAround(element(e)[k]), element(e)[k]};
    std::sort(ranked.begin(), ranked.end(), [](Ranked const& a, Ranked const& b) {
      return a.inside != b.inside       ? b.inside
             : a.negative != b.negative ? a.negative < b.negative
                                        : a.point < b.point;
    });
    Element points;
    for (std::size_t k = 0; k < N; ++k) points[k] = ranked[k].point;
    return points;
  }

  // how far points are in front of the plane; what is in it up to rounding is in front, as of a blade
  struct Plane {
    Eigen::Vector3d origin, normal;
    double distance(Eigen::Vector3d const& x) const { return normal.dot(x - origin); }
  };
  // of an element, the corners of what it has of the plane: two, three or four places; none where the plane
  // does not pass through it
  std::vector<Eigen::Vector3d> section(Index e, Plane const& plane) const {
    double distance[N], scale = 0;
    for (std::size_t k = 0; k < N; ++k) {
      distance[k] = plane.distance(at(element(e)[k]));
      scale = std::max(scale, (at(element(e)[k]) - at(element(e)[0])).norm());
    }
    std::vector<std::size_t> front, behind;
    bool strictly = false;
    for (std::size_t k = 0; k < N; ++k) {
      (distance[k] >= -1e-9 * scale ? front : behind).push_back(k);
      strictly = strictly || distance[k] > 1e-9 * scale;
    }
    std::vector<Eigen::Vector3d> corners;
    if (front.empty() || behind.empty()) return corners;
    // one that has nothing in front is passed through where it has an edge in the plane (a tetrahedron: a
    // face), beyond which there is another
    if (!strictly && (front.size() + 1 < N || beyond(e, behind[0]) < 0)) return corners;
    auto crossing = [&](std::size_t i, std::size_t j) {
      if (element(e)[i] > element(e)[j]) std::swap(i, j);
      const double weight = std::clamp(distance[i] / (distance[i] - distance[j]), 0.0, 1.0);
      corners.push_back((1 - weight) * at(element(e)[i]) + weight * at(element(e)[j]));
    };
    for (std::size_t f = 0; f < front.size(); ++f)
      for (std::size_t b = 0; b < behind.size(); ++b)
        crossing(front[f], behind[f % 2 == 0 ? b : behind.size() - 1 - b]);  // round about, of four
    return corners;
  }

  std::vector<std::array<Eigen::Vector3d, 3>> surfaceFrom(Index i, Eigen::Vector3d const& normal) const {
    const Plane plane{at(i), normal};
    std::vector<Index> all;
    std::vector<bool> taken(elements_.size(), false);
    std::vector<std::vector<Eigen::Vector3d>> sections;
    auto take = [&](Index e, std::vector<Eigen::Vector3d> corners) {
      all.push_back(e), sections.push_back(std::move(corners)), taken[std::size_t(e)] = true;
    };
    const bool fromBorder = onBorder(i);
    Index strongest = -1;
    for (const Index e : around(i)) {
      std::vector<Eigen::Vector3d> corners = section(e, plane);
      if (corners.empty()) continue;
      if (!fromBorder)
        take(e, std::move(corners));
      else if (strongest < 0 || principal_[std::size_t(e)].value > principal_[std::size_t(strongest)].value)
        strongest = e;
    }
    if (strongest >= 0) take(strongest, section(strongest, plane));
    for (std::size_t k = 0; k < all.size(); ++k)
      for (std::size_t corner = 0; corner < N; ++corner) {
        const Index next = passes(all[k], corner, plane) ? beyond(all[k], corner) : -1;
        if (next < 0 || !tears(next) || taken[std::size_t(next)]) continue;
        std::vector<Eigen::Vector3d> corners = section(next, plane);
        if (!corners.empty() && std::all_of(corners.begin(), corners.end(), [&](auto const& p) {
              return (p - plane.origin).norm() <= rules_.length;
            }))
          take(next, std::move(corners));
      }
    std::vector<std::array<Eigen::Vector3d, 3>> surface;
    for (std::size_t k = 0; k < all.size(); ++k) add(all[k], sections[k], plane, surface);
    return surface;
  }
  // whether the plane passes through the face without a corner
  bool passes(Index e, std::size_t without, Plane const& plane) const {
    bool front = false, behind = false;
    double scale = 0;
    for (const Index i : element(e)) scale = std::max(scale, (at(i) - at(element(e)[0])).norm());
    for (std::size_t k = 0; k < N; ++k)
      if (k != without) (plane.distance(at(element(e)[k])) >= -1e-9 * scale ? front : behind) = true;
    return front && behind;
  }
  // triangles of the section; through a sheet they go as far to both sides as half of its longest edge
  void add(Index e, std::vector<Eigen::Vector3d> const& corners, Plane const& plane,
           std::vector<std::array<Eigen::Vector3d, 3>>& surface) const {
    if constexpr (N == 4) {
      for (std::size_t k = 2; k < corners.size(); ++k)
        surface.push_back({corners[0], corners[k - 1], corners[k]});
    } else {
      double reach = 0;
      for (std::size_t k = 0; k < 3; ++k)
        reach = std::max(reach, (at(element(e)[(k + 1) % 3]) - at(element(e)[k])).norm() / 2);
      const Eigen::Vector3d across = reach * plane.normal.cross(corners[1] - corners[0]).normalized();
      const Eigen::Vector3d a = corners[0] - across, b = corners[1] - across, c = corners[1] + across,
                            d = corners[0] + across;
      surface.push_back({a, b, c});
      surface.push_back({a, c, d});
    }
  }
};

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE PrincipalStress principal_stress(Eigen::Matrix3d const& stress) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(stress);
  return {solver.eigenvalues()[2], solver.eigenvectors().col(2)};
}

SINEW_ONCE std::optional<Tear> plan_tear(TopologyView const& body, std::vector<Eigen::Vector3d> const& x,
                                         std::vector<Eigen::Matrix3d> const& stress,
                                         std::vector<bool> const& mayBegin, TearRules const& rules) {
  if (!body.tetrahedra.empty()) return detail::TornBody<4>(body.tetrahedra, x, stress, rules).tear(mayBegin);
  return detail::TornBody<3>(body.triangles, x, stress, rules).tear(mayBegin);
}

}  // namespace sinew
#endif
