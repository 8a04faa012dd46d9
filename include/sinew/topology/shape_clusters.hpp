// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Points that do not move, which hold clusters: where they belong at rest, where they are [m], and what they
/// weigh, in the mean mass of a point.
struct HeldPoints {
  std::span<Eigen::Vector3d const> rest{}, now{};
  double weight = 1;
};

/// Meshless deformations by matching of shapes (Mueller, Heidelberger, Teschner, Gross 2005). Points are in
/// clusters that may overlap; each cluster has the rigid motion of its rest shape that is nearest to where
/// its points are, or the affine map, and the goal of a point is the mean of what its clusters ask of it:
///   A = sum w (x - c) (X - C)',   R = the rotation nearest to A,   T = (1 - b) R + b A (sum w (X - C) (X -
///   C)')^-1 goal of cluster: c + T (X - C)
/// with c and C the centres of the cluster now and at rest. A point weighs w = m / (number of its clusters)
/// (Rivers, James 2007): so the goals keep the centre of mass and the angular momentum of all.
class ShapeClusters {
 public:
  /// Throws Error where a cluster is empty, or has a point twice or one that is missing. Points are counted
  /// from 0, held ones behind those of the state. `masses` may be empty: all are 1 then.
  void init(std::string_view where, std::vector<std::vector<int>> const& clusters,
            std::span<Eigen::Vector3d const> rest, std::span<double const> masses, HeldPoints const& held,
            double affineRatio);
  /// Takes the points x to their goals, `iterations` times. Allocates nothing.
  void match(std::vector<Eigen::Vector3d>& x, int iterations);

 private:
  struct Member {
    int point;
    double weight;
    Eigen::Vector3d fromCenter;  // at rest
  };
  struct Cluster {
    std::size_t first, end;  // of its members
    double weight;
    Eigen::Matrix3d inverse;  // of sum w (X - C) (X - C)', where the map is affine
  };

  std::vector<Cluster> clusters_{};
  std::vector<Member> members_{};
  std::vector<double> share_{};  // of each point: 1 / the number of its clusters, 0 where it is in none
  std::vector<Eigen::Vector3d> held_{};
  double affineRatio_ = 0;
  std::vector<Eigen::Vector3d> goals_{};

  Eigen::Vector3d const& now(std::vector<Eigen::Vector3d> const& x, int point) const {
    const auto i = std::size_t(point);
    return i < x.size() ? x[i] : held_[i - x.size()];
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>

namespace sinew {

SINEW_ONCE void ShapeClusters::init(std::string_view where, std::vector<std::vector<int>> const& clusters,
                                    std::span<Eigen::Vector3d const> rest, std::span<double const> masses,
                                    HeldPoints const& held, double affineRatio) {
  const std::size_t n = rest.size();
  if (held.rest.size() != held.now.size())
    throw Error(where,
                text("fixedPosition0 has ",
                     held.rest.size(),
                     " points and fixedPosition ",
                     held.now.size(),
                     "; give each both, where it rests and where it is"));
  std::vector<double> count(n, 0.0);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    if (clusters[c].empty()) throw Error(where, text("cluster ", c, " is empty; leave it out"));
    std::vector<int> sorted = clusters[c];
    std::sort(sorted.begin(), sorted.end());
    if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
      throw Error(where, text("cluster ", c, " has point ", *twice, " twice; leave one out"));
    if (sorted.front() < 0 || std::size_t(sorted.back()) >= n + held.rest.size())
      throw Error(where,
                  text("cluster ",
                       c,
                       " has point ",
                       sorted.front() < 0 ? sorted.front() : sorted.back(),
                       ", but there are ",
                       n,
                       " points and ",
                       held.rest.size(),
                       " fixed ones behind them, numbered from 0; correct the number"));
    for (const int i : clusters[c])
      if (std::size_t(i) < n) ++count[std::size_t(i)];
  }
  double mean = 1;
  if (!masses.empty()) {
    mean = 0;
    for (const double m : masses) mean += m / double(n);
  }
  clusters_.clear(), members_.clear(), share_.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    if (count[i] > 0) share_[i] = 1 / count[i];
  held_.assign(held.now.begin(), held.now.end());
  affineRatio_ = affineRatio;
  goals_.assign(n, Eigen::Vector3d::Zero());
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    Cluster cluster{members_.size(), 0, 0, Eigen::Matrix3d::Zero()};
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const int point : clusters[c]) {
      const auto i = std::size_t(point);
      const double w = i < n ? (masses.empty() ? 1 : masses[i]) * share_[i] : held.weight * mean;
      const Eigen::Vector3d x = i < n ? rest[i] : held.rest[i - n];
      members_.push_back({point, w, x});
      center += w * x;
      cluster.weight += w;
    }
    cluster.end = members_.size();
    center /= cluster.weight;
    Eigen::Matrix3d q = Eigen::Matrix3d::Zero();
    for (std::size_t k = cluster.first; k < cluster.end; ++k) {
      members_[k].fromCenter -= center;
      q += members_[k].weight * members_[k].fromCenter * members_[k].fromCenter.transpose();
    }
    if (affineRatio > 0) {
      // flat where its thickness is below the rounding of its length
      const Eigen::Vector3d axes = Eigen::JacobiSVD<Eigen::Matrix3d>(q).singularValues();
      if (!(axes[2] > 1e-12 * axes[0]))
        throw Error(
            where,
            text("cluster ",
                 c,
                 " is flat, so that no affine map follows from its points; give it points around it, or "
                 "affineRatio=0"));
      cluster.inverse = q.inverse();
    }
    clusters_.push_back(cluster);
  }
}

SINEW_ONCE void ShapeClusters::match(std::vector<Eigen::Vector3d>& x, int iterations) {
  for (int iteration = 0; iteration < iterations; ++iteration) {
    std::fill(goals_.begin(), goals_.end(), Eigen::Vector3d::Zero());
    for (Cluster const& cluster : clusters_) {
      Eigen::Vector3d center = Eigen::Vector3d::Zero();
      for (std::size_t k = cluster.first; k < cluster.end; ++k)
        center += members_[k].weight * now(x, members_[k].point);
      center /= cluster.weight;
      Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
      for (std::size_t k = cluster.first; k < cluster.end; ++k)
        a += members_[k].weight * (now(x, members_[k].point) - center) * members_[k].fromCenter.transpose();
      // a reflection is turned about the axis in which the points lie closest
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
      Eigen::Matrix3d u = svd.matrixU();
      if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
      Eigen::Matrix3d map = u * svd.matrixV().transpose();
      if (affineRatio_ > 0) map = ((1 - affineRatio_) * map + affineRatio_ * a * cluster.inverse).eval();
      for (std::size_t k = cluster.first; k < cluster.end; ++k)
        if (const auto i = std::size_t(members_[k].point); i < x.size())
          goals_[i] += share_[i] * (center + map * members_[k].fromCenter);
    }
    for (std::size_t i = 0; i < x.size(); ++i)
      if (share_[i] > 0) x[i] = goals_[i];
  }
}

}  // namespace sinew
#endif
