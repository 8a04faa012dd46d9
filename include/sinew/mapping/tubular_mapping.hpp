// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace sinew {

/// Circles of N points around frames, in their planes of y and z: the skin of a catheter, a wire, a beam.
///   x_ij = c_i + r_ij,   r_ij = rho_i R_i (0, cos phi_j, sin phi_j),   phi_j = 2 pi j/N
///   v = c' + w x r,   torque += r x f
/// With `peak` the radius falls to 0 over the first frames, or the last, where that is negative. An
/// Edge2QuadTopologicalMapping makes the faces between the circles.
template <class I, class O>
struct TubularMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename Out::Real;
  using Arm = Vec<Real, 3>;
  static_assert(In::rigid && In::spatial == 3 && !Out::rigid && Out::size == 3,
                "TubularMapping puts points around frames in space");
  static constexpr std::string_view className = "TubularMapping";

  int nbPointsOnEachCircle = 0;
  double radius = 0;
  int peak = 0;

  static constexpr auto fields() {
    using M = TubularMapping;
    return field_list(
        field("nbPointsOnEachCircle",
              &M::nbPointsOnEachCircle,
              "",
              "points around each frame",
              range::nonNegative),
        field("radius", &M::radius, "m", "distance of the points from the frame", range::nonNegative),
        field("peak",
              &M::peak,
              "",
              "over how many frames the radius grows from 0 at the first, or, negative, falls to "
              "0 at the last; 0: over none"));
  }

  std::vector<Arm> arms{};     // r in the axes of the frames, for each point
  std::vector<Arm> rotated{};  // at the last apply

  /// Throws Error where there is no circle, or the child has another number of points.
  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<TubularMapping>());
    const std::size_t frames = parent.rest.size(), n = std::size_t(nbPointsOnEachCircle);
    if (n == 0 || !(radius > 0))
      throw Error(where,
                  text("nbPointsOnEachCircle is ",
                       nbPointsOnEachCircle,
                       " and radius ",
                       radius,
                       " m; give both, above 0"));
    if (positions.empty()) positions.resize(frames * n);
    if (positions.size() != frames * n)
      throw Error(where,
                  text("the child has ",
                       positions.size(),
                       " points, but there are ",
                       n,
                       " around each of ",
                       frames,
                       " frames; give it as many, or none"));
    arms.clear();
    for (std::size_t i = 0; i < frames; ++i) {
      // how far from the end that is peaked
      const double steps = double(peak > 0 ? i : frames - 1 - i), whole = std::abs(double(peak));
      const double rho = radius * (steps < whole ? steps / whole : 1.0);
      for (std::size_t j = 0; j < n; ++j) {
        const double phi = 2 * std::numbers::pi * double(j) / double(n);
        arms.push_back({0, Real(rho * std::cos(phi)), Real(rho * std::sin(phi))});
      }
    }
    rotated.resize(arms.size());
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    for (std::size_t i = 0; i < in.size(); ++i) {
      const Mat<Real, 3> axes = in[i].orientation.toRotationMatrix().template cast<Real>();
      const Arm center = in[i].center.template cast<Real>();
      forCircle(i, [&](std::size_t p) {
        rotated[p] = axes * arms[p];
        out[p] = center + rotated[p];
      });
    }
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t i = 0; i < in.size(); ++i) {
      const Arm v = in[i].template head<3>().template cast<Real>(),
                w = in[i].template tail<3>().template cast<Real>();
      forCircle(i, [&](std::size_t p) { out[p] = v + w.cross(rotated[p]); });
    }
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    using InReal = typename In::Real;
    for (std::size_t i = 0; i < in.size(); ++i)
      forCircle(i, [&](std::size_t p) {
        in[i].template head<3>() += out[p].template cast<InReal>();
        in[i].template tail<3>() += rotated[p].cross(out[p]).template cast<InReal>();
      });
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    Arm const& r = rotated[std::size_t(point)];
    Mat<Real, 3, 6> j = Mat<Real, 3, 6>::Identity();
    j(0, 4) = r[2], j(0, 5) = -r[1];
    j(1, 3) = -r[2], j(1, 5) = r[0];
    j(2, 3) = r[1], j(2, 4) = -r[0];
    f(point / nbPointsOnEachCircle, j);
  }

 private:
  template <class F>
  void forCircle(std::size_t frame, F&& f) const {
    const std::size_t n = std::size_t(nbPointsOnEachCircle);
    for (std::size_t p = frame * n; p < (frame + 1) * n; ++p) f(p);
  }
};

}  // namespace sinew
