// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/cross_matrix.hpp>
#include <sinew/mapping/carried_points.hpp>

#include <Eigen/SVD>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sinew {

/// The loops of a mapping whose frames are carried by tetrahedra and hexahedra of the parent, as
/// CarriedPoints has them for points. The centre is a weighted sum, and the orientation turns with the
/// rotation R of the element where the frame is:
///   x = sum_k w_k X_k,  o = R o_0,  F = sum_k X_k g_k' = R S      (g_k: gradient of w_k at rest)
///   v = sum_k w_k V_k,  w = sum_k A_k V_k,  A_k = R (tr(S) I - S)^-1 [g_k]x R'
///   F_k += w_k f + A_k' torque
/// since [w]x F is the part of F' that turns. About axes for which tr(S) I - S is zero, as in an element that
/// is flat, nothing turns.
template <class In, class Out>
struct CarriedFrames {
  using Real = typename Out::Real;
  using Weight = typename In::Real;
  using Matrix = Eigen::Matrix3d;
  using Carriers = std::vector<Carrier<Weight>>;
  static constexpr bool possible = false;  // as lanes

  struct Frame {
    std::array<Eigen::Vector3d, 8> gradients;
    int corners;  // 4 or 8
    Eigen::Quaterniond local;
    Matrix rotation, turning;  // R and R (tr(S) I - S)^-1 at the last apply
  };
  std::vector<Frame> frames{};

  void init(std::size_t /*parents*/, Carriers const& /*carriers*/, Carriers const& /*others*/) {}
  /// `points`: where the elements rest; orientations of the frames there.
  template <class Coords>
  void place(std::vector<Eigen::Vector3d> const& points, Coords const& at, Carriers const& carriers,
             Carriers const& others) {
    frames.clear();
    for (std::size_t i = 0; i < carriers.size(); ++i) {
      Frame frame{{}, 4, at[i].orientation.template cast<double>(), Matrix::Identity(), Matrix::Identity()};
      // elements with fewer corners repeat their first
      if (!others.empty() && others[i].points[1] != others[i].points[0]) frame.corners = 8;
      std::array<Eigen::Vector3d, 8> slopes;
      if (frame.corners == 4) {
        slopes[0] = {-1, -1, -1};
        for (int k = 0; k < 3; ++k) slopes[std::size_t(k) + 1] = Eigen::Vector3d::Unit(k);
      } else {
        slopes = slopesOf(i, carriers, others);
      }
      // slopes are by the coordinates of the element, gradients by places
      Matrix j = Matrix::Zero();
      for (int k = 0; k < frame.corners; ++k)
        j += points[std::size_t(corner(i, k, carriers, others))] * slopes[std::size_t(k)].transpose();
      const Matrix back = j.inverse().transpose();
      for (int k = 0; k < frame.corners; ++k) frame.gradients[std::size_t(k)] = back * slopes[std::size_t(k)];
      frames.push_back(frame);
    }
  }

  void ask(typename Out::VecDeriv const&, typename In::VecDeriv const&) const {}
  void ask(typename Out::VecCoord const&, typename In::VecCoord const&) const {}

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in, Carriers const& carriers,
             Carriers const& others) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      Frame& frame = frames[i];
      Eigen::Vector3d center = Eigen::Vector3d::Zero();
      Matrix gradient = Matrix::Zero();
      for (int k = 0; k < frame.corners; ++k) {
        const Eigen::Vector3d x = in[std::size_t(corner(i, k, carriers, others))].template cast<double>();
        center += double(weight(i, k, carriers, others)) * x;
        gradient += x * frame.gradients[std::size_t(k)].transpose();
      }
      turn(frame, gradient);
      out[i].center = center.template cast<Real>();
      out[i].orientation =
          (Eigen::Quaterniond(frame.rotation) * frame.local).normalized().template cast<Real>();
    }
  }
  void apply(typename Out::VecDeriv& out, typename In::VecDeriv const& in, Carriers const& carriers,
             Carriers const& others) const {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      out[i].setZero();
      for (int k = 0; k < frames[i].corners; ++k)
        out[i] += jacobian(i, k, carriers, others) *
                  in[std::size_t(corner(i, k, carriers, others))].template cast<Real>();
    }
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out, Carriers const& carriers,
               Carriers const& others) const {
    for (std::size_t i = 0; i < frames.size(); ++i)
      for (int k = 0; k < frames[i].corners; ++k)
        in[std::size_t(corner(i, k, carriers, others))] +=
            (jacobian(i, k, carriers, others).transpose() * out[i]).template cast<typename In::Real>();
  }
  template <class F>
  void forEachJacobianBlock(int point, Carriers const& carriers, Carriers const& others, F&& f) const {
    const std::size_t i = std::size_t(point);
    for (int k = 0; k < frames[i].corners; ++k)
      f(corner(i, k, carriers, others), jacobian(i, k, carriers, others));
  }

 private:
  static Index corner(std::size_t i, int k, Carriers const& carriers, Carriers const& others) {
    return (k < 4 ? carriers : others)[i].points[std::size_t(k % 4)];
  }
  static Weight weight(std::size_t i, int k, Carriers const& carriers, Carriers const& others) {
    return (k < 4 ? carriers : others)[i].weights[std::size_t(k % 4)];
  }
  // of the weights of a hexahedron by its coordinates, which are sums of weights
  static std::array<Eigen::Vector3d, 8> slopesOf(std::size_t i, Carriers const& carriers,
                                                 Carriers const& others) {
    constexpr std::array<std::array<int, 3>, 8> at{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (int k = 0; k < 8; ++k)
      for (int c = 0; c < 3; ++c)
        place[c] += at[std::size_t(k)][std::size_t(c)] * double(weight(i, k, carriers, others));
    std::array<Eigen::Vector3d, 8> slopes;
    for (int k = 0; k < 8; ++k)
      for (int c = 0; c < 3; ++c) {
        double product = at[std::size_t(k)][std::size_t(c)] == 1 ? 1 : -1;
        for (int d = 0; d < 3; ++d)
          if (d != c) product *= at[std::size_t(k)][std::size_t(d)] == 1 ? place[d] : 1 - place[d];
        slopes[std::size_t(k)][c] = product;
      }
    return slopes;
  }
  // R of F = R S by singular values, the least of which takes the sign of an element that is turned over
  static void turn(Frame& frame, Matrix const& gradient) {
    const Eigen::JacobiSVD<Matrix> svd(gradient, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Matrix u = svd.matrixU();
    Matrix const& v = svd.matrixV();
    Eigen::Vector3d s = svd.singularValues();
    if (u.determinant() * v.determinant() < 0) {
      u.col(2) *= -1;
      s[2] *= -1;
    }
    frame.rotation = u * v.transpose();
    Eigen::Vector3d inverse(s[1] + s[2], s[0] + s[2], s[0] + s[1]);
    for (int c = 0; c < 3; ++c) inverse[c] = std::abs(inverse[c]) > 1e-12 * s[0] ? 1 / inverse[c] : 0.0;
    frame.turning = u * inverse.asDiagonal() * v.transpose();
  }
  Mat<Real, 6, 3> jacobian(std::size_t i, int k, Carriers const& carriers, Carriers const& others) const {
    Frame const& frame = frames[i];
    Eigen::Vector3d const& g = frame.gradients[std::size_t(k)];
    Mat<Real, 6, 3> j;
    j.template topRows<3>() = Mat<Real, 3>::Identity() * Real(weight(i, k, carriers, others));
    j.template bottomRows<3>() =
        (frame.turning * cross_matrix(g) * frame.rotation.transpose()).template cast<Real>();
    return j;
  }
};

}  // namespace sinew
