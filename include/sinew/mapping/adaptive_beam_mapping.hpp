// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/follow.hpp>
#include <sinew/mapping/beam_carriers.hpp>
#include <sinew/topology/rod_beams.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace sinew {

/// Points along a rod, by the cubic that its beams have: those of the edges of the parent's topology, or
/// where it has none, from frame to frame. A point is (s, y, z): s is how far along the rod it is, y and z
/// are across, in the axes of the frames. With c_k, T_k the centre and the axes of the frames of its beam of
/// the length L, at the part t of it,
///   x = (1 - f) c_0 + f c_1 + L ((t - 2t^2 + t^3) T_0 e_x + (t^3 - t^2) T_1 e_x) + R (0, y, z),   f = 3t^2 -
///   2t^3
/// where R is the mean of T_0 and T_1 as quaternions with weights 1 - t and t. (In SOFA the offsets have the
/// weights 1 - f and f, and twist makes them shorter.)
template <class I, class O>
struct AdaptiveBeamMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  static_assert(In::rigid && In::spatial == 3 && !Out::rigid && Out::size == 3,
                "AdaptiveBeamMapping carries points by frames in space");
  static constexpr std::string_view className = "AdaptiveBeamMapping";

  std::vector<RodBeam> interpolation{};
  std::vector<Eigen::Vector3d> points{};
  bool useCurvAbs = true;
  int nbPointsPerBeam = 0;

  static constexpr auto fields() {
    using M = AdaptiveBeamMapping;
    return field_list(
        field("interpolation", &M::interpolation, "", "the beams, those of the interpolation of the rod"),
        field("points", &M::points, "m", "points along the rod; those of the child where none are given"),
        field("useCurvAbs",
              &M::useCurvAbs,
              "",
              "the first number of a point is how far along the rod it is [m]; else the number of its beam "
              "plus the "
              "part of its length"),
        field("nbPointsPerBeam",
              &M::nbPointsPerBeam,
              "",
              "so many points at equal distances along each beam, and one at the end, instead of those given",
              range::nonNegative));
  }

  /// Throws Error: points count the beams, which would have to change.
  void follow(Followed const&) const {
    throw Error(component_name<AdaptiveBeamMapping>(),
                "its points count along the beams, and none of these can be removed; take BeamLinearMapping");
  }

  BeamCarriers<In, Out> carried{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<AdaptiveBeamMapping>());
    const std::vector<Edge> edges =
        rod_edges(where, parent.topology.edges, parent.rest.size(), interpolation);
    const std::vector<double> ends = rod_abscissas(interpolation);
    std::vector<Eigen::Vector3d> along = points;
    if (nbPointsPerBeam > 0) {
      along.clear();
      for (std::size_t b = 0; b < edges.size(); ++b)
        for (int k = 0; k < nbPointsPerBeam; ++k)
          along.emplace_back(ends[b] + interpolation[b].length * k / nbPointsPerBeam, 0, 0);
      along.emplace_back(ends.back(), 0, 0);
    } else if (along.empty()) {
      for (auto const& x : positions) along.push_back(x.template cast<double>());
    }
    if (positions.empty()) positions.resize(along.size(), Out::zero());
    if (positions.size() != along.size())
      throw Error(where,
                  text("there are ",
                       along.size(),
                       " points along the rod, but the child has ",
                       positions.size(),
                       "; give the child as many, or none"));
    const bool byLength = useCurvAbs || nbPointsPerBeam > 0;
    const double whole = byLength ? ends.back() : double(edges.size());
    carried.carriers.clear();
    for (std::size_t i = 0; i < along.size(); ++i) {
      const double s = along[i][0];
      // an end that sums of lengths miss by rounding is the end
      if (!(s >= -1e-9 * whole) || !(s <= (1 + 1e-9) * whole))
        throw Error(where,
                    text("point ",
                         i,
                         " is at ",
                         s,
                         byLength ? " m along a rod of " : " beams along a rod of ",
                         whole,
                         byLength ? " m" : " beams",
                         "; correct it"));
      std::size_t beam = 0;
      double part = 0;
      if (byLength) {
        beam = std::size_t(std::upper_bound(ends.begin(), ends.end(), s) - ends.begin());
        beam = std::min(beam > 0 ? beam - 1 : 0, edges.size() - 1);
        part = (s - ends[beam]) / interpolation[beam].length;
      } else {
        beam = std::min(std::size_t(std::max(s, 0.0)), edges.size() - 1);
        part = s - double(beam);
      }
      carried.carriers.push_back({.frames = edges[beam],
                                  .place = Real(std::clamp(part, 0.0, 1.0)),
                                  .length = Real(interpolation[beam].length),
                                  .toBeam = {Quat<Real>::Identity(), Quat<Real>::Identity()},
                                  .offset = Vec<Real, 3>(Real(0), Real(along[i][1]), Real(along[i][2]))});
    }
    carried.prepare();
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) { carried.apply(out, in); }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const { carried.applyJ(out, in); }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    carried.applyJT(in, out);
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    carried.forEachJacobianBlock(point, std::forward<F>(f));
  }
};

}  // namespace sinew
