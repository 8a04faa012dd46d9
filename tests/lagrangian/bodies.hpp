// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constrained_block_jacobi.hpp>
#include <sinew/lagrangian/convex_step.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

/// Bodies that constraints alone join: points (B = 3) and rigid bodies (6), with the free motion of a step.
namespace rigid_bodies {

struct Solution {
  Eigen::VectorXd velocity{}, multipliers{};
  sinew::ConvexStepResult result{};
};

template <int B>
struct Bodies {
  std::vector<Eigen::Matrix<double, B, B>> mass{};
  Eigen::VectorXd free{}, start{};
  sinew::JacobianRows rows{};
  std::vector<sinew::ConstraintBlock> blocks{};

  /// A contact of points: rows of `frames` are the normal and two tangents, with the sign of the body.
  void contact(std::vector<int> const& bodies, std::vector<Eigen::Matrix3d> const& frames, double mu,
               double gap) {
    for (int r = 0; r < 3; ++r) {
      for (std::size_t i = 0; i < bodies.size(); ++i)
        for (int k = 0; k < 3; ++k) rows.add(B * bodies[i] + k, frames[i](r, k));
      rows.endRow();
    }
    end(mu, gap);
  }
  void end(double mu, double gap) {
    blocks.push_back(sinew::ConstraintBlock::contact(rows.rows() - 3, mu));
    start.conservativeResize(rows.rows());
    start.tail<3>() << gap, 0, 0;
  }

  void multiply(Eigen::VectorXd const& p, Eigen::VectorXd& q) const {
    for (std::size_t i = 0; i < mass.size(); ++i)
      q.segment<B>(B * Eigen::Index(i)) = mass[i] * p.segment<B>(B * Eigen::Index(i));
  }
  double energy(Eigen::VectorXd const& v) const { return v.dot(massMatrix() * v) / 2; }
  Eigen::MatrixXd massMatrix() const {
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(free.size(), free.size());
    for (std::size_t i = 0; i < mass.size(); ++i)
      M.block<B, B>(B * Eigen::Index(i), B * Eigen::Index(i)) = mass[i];
    return M;
  }
  Eigen::MatrixXd jacobian() const {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows.rows(), free.size());
    for (int i = 0; i < rows.rows(); ++i)
      rows.forEachInRow(i, [&](int dof, double value) { J(i, dof) += value; });
    return J;
  }
  sinew::ConstraintProblem problem() const {
    const Eigen::MatrixXd J = jacobian();
    return {J * massMatrix().inverse() * J.transpose(),
            J * free + start,
            Eigen::VectorXd::Zero(start.size()),
            blocks};
  }
  Solution cold() const { return {free, Eigen::VectorXd::Zero(start.size())}; }
};

template <int B>
sinew::ConvexStepResult solve(sinew::ConvexStep& step, Bodies<B> const& p, Solution& s,
                              sinew::ConvexStepSettings const& settings) {
  sinew::ConstrainedBlockJacobi<B> preconditioner;
  preconditioner.system = p.mass;
  Eigen::VectorXd b = p.free;
  p.multiply(p.free, b);
  return s.result = step.solve([&](Eigen::VectorXd const& x, Eigen::VectorXd& y) { p.multiply(x, y); },
                               preconditioner,
                               b,
                               p.rows,
                               p.blocks,
                               p.start,
                               s.velocity,
                               s.multipliers,
                               settings,
                               "test");
}
template <int B>
Solution solve(Bodies<B> const& p, sinew::ConvexStepSettings const& settings) {
  sinew::ConvexStep step;
  Solution s = p.cold();
  solve(step, p, s, settings);
  return s;
}

/// Points that penetrate, each in contact with one before it: the rows of J are independent.
inline Bodies<3> tree_of_points(int contacts, double mu, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Bodies<3> p;
  p.mass.assign(std::size_t(contacts) + 1, Eigen::Matrix3d::Identity());
  p.free.setZero(3 * contacts + 3);
  for (int c = 0; c < contacts; ++c) {
    Eigen::Matrix3d frame;
    for (double& entry : frame.reshaped()) entry = normal(random);
    frame = Eigen::Matrix3d(frame.householderQr().householderQ());
    p.contact({std::uniform_int_distribution<int>(0, c)(random), c + 1}, {frame, -frame}, mu, 0);
    for (int k = 0; k < 3; ++k) p.start[3 * c + k] = 0.1 * normal(random);
    p.start[3 * c] = -std::abs(p.start[3 * c]);
  }
  return p;
}

/// A contact at a point between two rigid bodies with centres xa and xb, the normal from a to b; a < 0: the
/// ground.
inline void contact_at(Bodies<6>& p, int a, int b, Eigen::Vector3d const& at, Eigen::Vector3d const& xa,
                       Eigen::Vector3d const& xb, Eigen::Vector3d const& n, double mu, double gap) {
  const Eigen::Vector3d t = n.unitOrthogonal(), s = n.cross(t);
  for (Eigen::Vector3d const& axis : {n, t, s}) {
    for (const int body : {a, b}) {
      if (body < 0) continue;
      const double sign = body == b ? 1 : -1;
      const Eigen::Vector3d moment = (at - (body == b ? xb : xa)).cross(axis);
      for (int k = 0; k < 3; ++k) p.rows.add(6 * body + k, sign * axis[k]);
      for (int k = 0; k < 3; ++k) p.rows.add(6 * body + 3 + k, sign * moment[k]);
    }
    p.rows.endRow();
  }
  p.end(mu, gap);
}

inline Eigen::Matrix<double, 6, 6> box_mass(double mass, Eigen::Vector3d const& size) {
  Eigen::Matrix<double, 6, 1> m;
  const Eigen::Vector3d s = size.cwiseAbs2();
  m << mass, mass, mass, mass / 12 * (s[1] + s[2]), mass / 12 * (s[0] + s[2]), mass / 12 * (s[0] + s[1]);
  return m.asDiagonal();
}

/// A wall of bricks after a step of 0.01 s of gravity, one in the middle pushed out at a velocity, m/s.
inline Bodies<6> wall(int height, int width, double mu, double push = 0) {
  Bodies<6> p;
  const Eigen::Vector3d size(0.2, 0.1, 0.1), up = Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Vector3d> x;
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c) {
      x.emplace_back(0.2 * c + 0.1 * (r % 2), 0, 0.05 + 0.1 * r);
      p.mass.push_back(box_mass(2 + 0.1 * ((r * 7 + c * 3) % 5), size));
    }
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c) {
      const int b = r * width + c;
      const Eigen::Vector3d xb = x[std::size_t(b)];
      for (int k = 0; k < (r == 0 ? 1 : 2); ++k) {
        const int under = c + k - (r % 2 ? 0 : 1), a = r == 0 ? -1 : (r - 1) * width + under;
        if (r > 0 && (under < 0 || under >= width)) continue;
        const Eigen::Vector3d xa = a < 0 ? xb : x[std::size_t(a)];
        for (const double at : {std::max(xa[0], xb[0]) - 0.1, std::min(xa[0], xb[0]) + 0.1})
          for (const double y : {-0.05, 0.05}) contact_at(p, a, b, {at, y, 0.1 * r}, xa, xb, up, mu, 0);
      }
    }
  p.free.setZero(6 * height * width);
  for (int b = 0; b < height * width; ++b) p.free[6 * b + 2] = -9.81 * 0.01;
  p.free[6 * (height * width / 2) + 1] = push;
  return p;
}

/// A rod of 1 kg and 1 m at an angle to the ground, which its lower end strikes and slides on.
inline Bodies<6> rod(double angle, double mu, double slip) {
  Bodies<6> p;
  Eigen::Matrix<double, 6, 1> mass;
  mass << 1, 1, 1, Eigen::Vector3d::Constant(1. / 12);
  p.mass = {Eigen::Matrix<double, 6, 6>(mass.asDiagonal())};
  p.free.setZero(6);
  p.free[0] = slip;
  p.free[2] = -0.1;
  contact_at(p,
             -1,
             0,
             {0, 0, 0},
             {0, 0, 0},
             Eigen::Vector3d(std::cos(angle), 0, std::sin(angle)) / 2,
             Eigen::Vector3d::UnitZ(),
             mu,
             0);
  return p;
}

}  // namespace rigid_bodies
