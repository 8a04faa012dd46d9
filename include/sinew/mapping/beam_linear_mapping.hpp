// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/follow.hpp>
#include <sinew/topology/beam_section.hpp>
#include <sinew/topology/point_location.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace sinew {

/// Points carried by beams between frames: the edges of the parent's topology, or where it has none, frames
/// that follow one another. Each point belongs to the beam nearest to it at rest, at a place t of its length
/// L, 0 to 1. With c_k, T_k the centres of the two frames and the axes of the beam that rotate with them,
///   x = (1 - f) c_0 + f c_1 + L ((t - 2t^2 + t^3) T_0 e_x + (t^3 - t^2) T_1 e_x) + R s,   f = 3t^2 - 2t^3
/// The middle line is Hermite's cubic, as bent beams have it; the section, with s in it, rotates by R, the
/// mean of T_0 and T_1 as quaternions with weights 1 - t and t. (In SOFA points are the mean of those that
/// the two frames would carry, with weights 1 - f and f: halfway its line bends out twice as far.)
template <class I, class O>
struct BeamLinearMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  using Vec3 = Vec<Real, 3>;
  static_assert(In::rigid && In::spatial == 3 && !Out::rigid && Out::size == 3,
                "BeamLinearMapping carries points by frames in space");
  static constexpr std::string_view className = "BeamLinearMapping";

  bool localCoord = true;

  static constexpr auto fields() {
    return field_list(
        field("localCoord",
              &BeamLinearMapping::localCoord,
              "",
              "the positions of the child are given in the beams: x is the number of the beam plus "
              "the part of its length, y and z are across, in lengths of the beam"));
  }

  /// Throws Error where positions count beams: those of the others would have to change.
  void follow(Followed const&) const {
    if (localCoord)
      throw Error(component_name<BeamLinearMapping>(),
                  "with localCoord positions count the beams, and none of these can be removed; give the "
                  "positions in the world");
  }

  struct Carrier {
    std::array<int, 2> frames;
    Real place, length;                // t, L
    std::array<Quat<Real>, 2> toBeam;  // from the axes of the frames to those of the beam
    Vec3 offset;                       // s
  };
  std::vector<Carrier> carriers{};
  std::vector<std::array<Mat<Real, 3>, 2>>
      rotationJacobians{};  // derivatives of x by the rotations of the two frames, at the last apply

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<BeamLinearMapping>());
    detail::check_indices(where, "edge", parent.topology.edges, parent.rest.size());
    std::vector<Edge> beams(parent.topology.edges.begin(), parent.topology.edges.end());
    if (beams.empty())
      for (int i = 0; i + 1 < int(parent.rest.size()); ++i) beams.push_back({i, i + 1});
    if (beams.empty())
      throw Error(where,
                  text(parent.where, " has no beam; give it two frames or more, or a topology with edges"));
    std::vector<Eigen::Vector3d> centers;
    for (auto const& x : parent.rest) centers.push_back(x.center.template cast<double>());
    const ElementLocator<MultilinearFit<1>> locator(centers, beams);

    carriers.clear();
    for (auto const& position : positions) {
      Eigen::Vector3d p = position.template cast<double>();
      int beam = int(std::clamp(std::floor(p[0]), 0.0, double(beams.size() - 1)));
      double along = p[0] - beam;
      if (!localCoord) {
        const auto located = locator.locate(p);
        if (located.element < 0)
          throw Error(where, text("the beams of ", parent.where, " have no length; move its frames apart"));
        beam = located.element;
        along = located.fit.weights[1];
      }
      carriers.push_back(carrierAt(parent.rest, beams[std::size_t(beam)], std::clamp(along, 0.0, 1.0)));
      Carrier& c = carriers.back();
      if (localCoord)
        c.offset = c.length * Vec3(Real(along) - c.place, Real(p[1]), Real(p[2]));
      else
        c.offset = Section(c, parent.rest).placeOf(p.template cast<Real>());
    }
    rotationJacobians.resize(carriers.size());
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    for (std::size_t i = 0; i < carriers.size(); ++i) {
      Carrier const& c = carriers[i];
      const Section section(c, in);
      const Vec3 arm = section.rotation * c.offset;
      out[i] = (section.middle + arm).template cast<typename Out::Real>();
      const Quat<Real> inverse = section.sum.inverse();
      for (std::size_t k = 0; k < 2; ++k) {
        // the section spins by l (q_w - [q]x) w, q = q_k / sum, when frame k, which has the weight l, spins
        // by w
        const Quat<Real> part = section.sides[k] * inverse;
        const Real weight = k == 0 ? 1 - c.place : c.place;
        const Mat<Real, 3> spin = weight * (part.w() * Mat<Real, 3>::Identity() - cross(part.vec()));
        rotationJacobians[i][k] = -cross(section.tangents[k]) - cross(arm) * spin;
      }
    }
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t i = 0; i < carriers.size(); ++i) {
      Vec3 v = Vec3::Zero();
      for (std::size_t k = 0; k < 2; ++k) {
        auto const& frame = in[std::size_t(carriers[i].frames[k])];
        v += weightOf(carriers[i], k) * frame.template head<3>() +
             rotationJacobians[i][k] * frame.template tail<3>();
      }
      out[i] = v.template cast<typename Out::Real>();
    }
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    for (std::size_t i = 0; i < carriers.size(); ++i) {
      const Vec3 f = out[i].template cast<Real>();
      for (std::size_t k = 0; k < 2; ++k) {
        auto& frame = in[std::size_t(carriers[i].frames[k])];
        frame.template head<3>() += weightOf(carriers[i], k) * f;
        frame.template tail<3>() += rotationJacobians[i][k].transpose() * f;
      }
    }
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    Carrier const& c = carriers[std::size_t(point)];
    for (std::size_t k = 0; k < 2; ++k) {
      Mat<Real, 3, 6> j;
      j << weightOf(c, k) * Mat<Real, 3>::Identity(), rotationJacobians[std::size_t(point)][k];
      f(c.frames[k], Mat<typename Out::Real, 3, 6>(j.template cast<typename Out::Real>()));
    }
  }

 private:
  static Carrier carrierAt(typename In::VecCoord const& rest, Edge const& beam, double along) {
    auto const &x0 = rest[std::size_t(beam[0])], &x1 = rest[std::size_t(beam[1])];
    const Eigen::Vector3d chord = (x1.center - x0.center).template cast<double>();
    const Eigen::Quaterniond node[2]{x0.orientation.template cast<double>(),
                                     x1.orientation.template cast<double>()};
    const Eigen::Quaterniond axes = beam_axes(chord, node[0], node[1]);
    return {.frames = beam,
            .place = Real(along),
            .length = Real(chord.norm()),
            .toBeam = {Quat<Real>((node[0].conjugate() * axes).template cast<Real>()),
                       Quat<Real>((node[1].conjugate() * axes).template cast<Real>())},
            .offset = Vec3::Zero()};
  }
  static Real weightOf(Carrier const& c, std::size_t k) {
    const Real f = c.place * c.place * (3 - 2 * c.place);
    return k == 0 ? 1 - f : f;
  }
  /// Where a point's section of its beam is.
  struct Section {
    std::array<Quat<Real>, 2> sides;  // q_k, of the two quaternions of T_k those on one side
    std::array<Vec3, 2> tangents;     // L (t - 2t^2 + t^3) T_0 e_x, L (t^3 - t^2) T_1 e_x
    Quat<Real> sum, rotation;         // (1 - t) q_0 + t q_1, and R
    Vec3 middle;                      // on the middle line

    Section(Carrier const& c, typename In::VecCoord const& x) : middle(Vec3::Zero()) {
      const Real t = c.place, factors[2]{t * (1 - t) * (1 - t), t * t * (t - 1)};
      for (std::size_t k = 0; k < 2; ++k) {
        auto const& frame = x[std::size_t(c.frames[k])];
        Quat<Real>& q = sides[k] = frame.orientation * c.toBeam[k];
        tangents[k] = factors[k] * c.length *
                      Vec3(1 - 2 * (q.y() * q.y() + q.z() * q.z()),
                           2 * (q.x() * q.y() + q.w() * q.z()),
                           2 * (q.x() * q.z() - q.w() * q.y()));
        middle += weightOf(c, k) * frame.center + tangents[k];
      }
      if (sides[1].dot(sides[0]) < 0) sides[1].coeffs() = -sides[1].coeffs();
      sum.coeffs() = (1 - t) * sides[0].coeffs() + t * sides[1].coeffs();
      rotation = sum.normalized();
    }
    /// s of a point in the world.
    Vec3 placeOf(Vec3 const& p) const { return rotation.conjugate() * (p - middle); }
  };
  static Mat<Real, 3> cross(Vec3 const& a) {
    return (Mat<Real, 3>() << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0).finished();
  }
};

}  // namespace sinew
