// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/rotations.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sinew {

/// How each point of a system has rotated since a moment, from positions and the pattern of the matrix alone.
/// A rigid body rotates by its orientation; a point as its neighbours j do, the points that its row of the
/// matrix has blocks with:
///   R_i = the rotation nearest to A_i,  A_i = sum_j (x_j - x_i) (x0_j - x0_i)'
/// (Mueller et al. 2005, of each neighbourhood). What A_i leaves open, as the twist of a wire, stays as it
/// was.
struct PointRotations {
  struct Point {
    int dof, size,
        vectors;      // first scalar, scalars of a vector, and how many of them rotate: two of a rigid body
    int first, last;  // of the neighbours
  };
  std::vector<Point> points{};
  std::vector<int> neighbours{};
  std::vector<Eigen::Vector3d> start{}, now{};       // places
  std::vector<Eigen::Quaterniond> posture{}, own{};  // of rigid bodies: at the start, now
  std::vector<Eigen::Matrix3d> rotation{};

  template <class Operations, class Matrix>
  void init(Operations& operations, Matrix const& matrix) {
    points.clear();
    neighbours.clear();
    operations.forEachIndependent([&](auto& s) {
      using D = typename std::decay_t<decltype(s)>::DataTypes;
      const int begin = int(points.size()), n = int(s.size());
      constexpr int vectors = D::spatial == 1 || (!D::rigid && D::size > 3) ? 0
                              : D::rigid && D::spatial == 3                 ? 2
                                                                            : 1;
      for (int i = 0; i < n; ++i) {
        const int dof = s.dofOffset + i * D::size, row = dof / Matrix::blockSize;
        const std::size_t before = neighbours.size();
        if (!D::rigid)
          matrix.forEachInRow(row, [&](int column, int, bool) {
            for (int c = 0; c < Matrix::blockSize; ++c) {
              const int otherDof = column * Matrix::blockSize + c, other = (otherDof - s.dofOffset) / D::size;
              if (otherDof < s.dofOffset || other >= n || other == i) continue;
              if (neighbours.size() == before || neighbours.back() != begin + other)
                neighbours.push_back(begin + other);
            }
          });
        points.push_back({dof, D::spatial, vectors, int(before), int(neighbours.size())});
      }
    });
    start.assign(points.size(), Eigen::Vector3d::Zero());
    now = start;
    posture.assign(points.size(), Eigen::Quaterniond::Identity());
    own = posture;
    rotation.assign(points.size(), Eigen::Matrix3d::Identity());
  }

  /// From now on.
  template <class Operations>
  void reset(Operations& operations) {
    look(operations);
    start = now;
    posture = own;
    for (auto& r : rotation) r.setIdentity();
  }

  template <class Operations>
  void update(Operations& operations) {
    look(operations);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Point const& p = points[i];
      if (p.vectors == 0) continue;
      if (p.first == p.last) {
        rotation[i] = (own[i] * posture[i].conjugate()).toRotationMatrix();
        continue;
      }
      Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
      for (int k = p.first; k < p.last; ++k) {
        const std::size_t j = std::size_t(neighbours[std::size_t(k)]);
        a += (now[j] - now[i]) * (start[j] - start[i]).transpose();
      }
      rotation[i] = nearest_rotation(Eigen::Matrix3d(a + 1e-6 * a.norm() * rotation[i]));
    }
  }

  /// v = R v, or R' v.
  template <class Vector>
  void apply(Vector& v, bool back) const {
    using Real = typename Vector::Scalar;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int k = 0; k < points[i].vectors; ++k) {
        Real* const at = v.data() + points[i].dof + 3 * k;
        if (points[i].size == 3)
          rotate<3>(at, rotation[i], back);
        else
          rotate<2>(at, rotation[i], back);
      }
  }

 private:
  template <int N, class Real>
  static void rotate(Real* at, Eigen::Matrix3d const& rotation, bool back) {
    Eigen::Map<Vec<Real, N>> v(at);
    const Mat<Real, N> r = rotation.topLeftCorner<N, N>().template cast<Real>();
    v = back ? Vec<Real, N>(r.transpose() * v) : Vec<Real, N>(r * v);
  }
  template <class Operations>
  void look(Operations& operations) {
    std::size_t at = 0;
    operations.forEachIndependent([&](auto& s) {
      using D = typename std::decay_t<decltype(s)>::DataTypes;
      for (auto const& x : s.position) {
        now[at].template head<D::spatial>() = D::center(x).template cast<double>();
        if constexpr (D::rigid && D::spatial == 3)
          own[at] =
              Eigen::Quaterniond(x.orientation.w(), x.orientation.x(), x.orientation.y(), x.orientation.z());
        else if constexpr (D::rigid)
          own[at] = Eigen::AngleAxisd(double(x.orientation), Eigen::Vector3d::UnitZ());
        ++at;
      }
    });
  }
};

}  // namespace sinew
