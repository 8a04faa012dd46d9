// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/cross_matrix.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace sinew {

/// Points carried by beams between frames, each at a place t of the length L of its beam, 0 to 1. With c_k,
/// T_k the centres of the two frames and the axes of the beam that rotate with them,
///   x = (1 - f) c_0 + f c_1 + L ((t - 2t^2 + t^3) T_0 e_x + (t^3 - t^2) T_1 e_x) + R s,   f = 3t^2 - 2t^3
/// The middle line is Hermite's cubic, as bent beams have it; the section, with s in it, rotates by R, the
/// mean of T_0 and T_1 as quaternions with weights 1 - t and t.
template <class I, class O>
struct BeamCarriers {
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  using Vec3 = Vec<Real, 3>;

  struct Carrier {
    std::array<int, 2> frames;
    Real place, length;                // t, L
    std::array<Quat<Real>, 2> toBeam;  // from the axes of the frames to those of the beam
    Vec3 offset;                       // s
  };

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
  std::vector<Carrier> carriers{};
  std::vector<std::array<Mat<Real, 3>, 2>>
      rotationJacobians{};  // derivatives of x by the rotations of the two frames, at the last apply

  /// Makes room when all carriers are there.
  void prepare() { rotationJacobians.resize(carriers.size()); }

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
        const Mat<Real, 3> spin =
            weight * (part.w() * Mat<Real, 3>::Identity() - cross_matrix(Vec3(part.vec())));
        rotationJacobians[i][k] = -cross_matrix(section.tangents[k]) - cross_matrix(arm) * spin;
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
  static Real weightOf(Carrier const& c, std::size_t k) {
    const Real f = c.place * c.place * (3 - 2 * c.place);
    return k == 0 ? 1 - f : f;
  }
};

}  // namespace sinew
