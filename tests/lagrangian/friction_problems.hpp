// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_problem.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <random>
#include <vector>

// Contacts of bodies and of soft blocks as friction problems of a step: d = J v [m/s], multipliers are
// impulses [N s].
namespace friction_problems {

using namespace sinew;

/// Rows J and A^-1 of contacts, whose velocities without multipliers are v.
struct Contacts {
  Eigen::MatrixXd J, inverseMass;
  Eigen::VectorXd v;
  std::vector<double> mu;

  ConstraintProblem problem() const {
    ConstraintProblem p;
    p.compliance = J * inverseMass * J.transpose();
    p.freeViolation = J * v;
    p.multipliers.setZero(J.rows());
    for (std::size_t c = 0; c < mu.size(); ++c)
      p.blocks.push_back(ConstraintBlock::contact(3 * int(c), mu[c]));
    return p;
  }
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  // the same on all machines, which std's distributions are not
  double between(double low, double high) { return low + (high - low) * double(engine_()) / 4294967296.; }
  Eigen::Vector3d vector(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }

 private:
  std::mt19937 engine_;
};

/// Orthonormal, its first row along n, the others turned about it by an angle.
inline Eigen::Matrix3d frame(Eigen::Vector3d const& n, double angle) {
  const Eigen::Vector3d u = n.unitOrthogonal(), w = n.cross(u);
  Eigen::Matrix3d rows;
  rows.row(0) = n;
  rows.row(1) = std::cos(angle) * u + std::sin(angle) * w;
  rows.row(2) = rows.row(0).cross(rows.row(1));
  return rows;
}

/// Rigid bodies, of six velocities each; body -1 is the ground.
struct RigidBodies {
  std::vector<Eigen::Vector3d> centers;
  std::vector<double> masses;
  std::vector<Eigen::Vector3d> inertias;  // about axes of the world
  std::vector<Eigen::Matrix<double, 3, 3>> frames;
  std::vector<std::pair<int, int>> bodies;
  std::vector<Eigen::Vector3d> points;

  void contact(int a, int b, Eigen::Vector3d const& point, Eigen::Vector3d const& fromBToA, double angle) {
    bodies.push_back({a, b});
    points.push_back(point);
    frames.push_back(frame(fromBToA, angle));
  }
  Contacts contacts(Random& random, double speed, double muLow, double muHigh) const {
    Contacts c;
    const auto n = Eigen::Index(6 * centers.size());
    c.J.setZero(Eigen::Index(3 * bodies.size()), n);
    c.inverseMass.setZero(n, n);
    c.v.setZero(n);
    for (std::size_t i = 0; i < centers.size(); ++i) {
      const auto at = Eigen::Index(6 * i);
      c.inverseMass.diagonal().segment<3>(at).setConstant(1 / masses[i]);
      c.inverseMass.diagonal().segment<3>(at + 3) = inertias[i].cwiseInverse();
      c.v.segment<3>(at) = random.vector(speed) + Eigen::Vector3d(0, 0, -9.81 * 0.01);
      c.v.segment<3>(at + 3) = random.vector(speed);
    }
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      for (auto const& [body, sign] : {std::pair(bodies[k].first, 1.), std::pair(bodies[k].second, -1.)})
        if (body >= 0) {
          const Eigen::Vector3d r = points[k] - centers[std::size_t(body)];
          auto rows = c.J.block<3, 6>(Eigen::Index(3 * k), 6 * body);
          rows.leftCols<3>() = sign * frames[k];
          for (int i = 0; i < 3; ++i)
            rows.row(i).tail<3>() = sign * r.cross(Eigen::Vector3d(frames[k].row(i).transpose())).transpose();
        }
      c.mu.push_back(random.between(muLow, muHigh));
    }
    return c;
  }
};

/// Boxes on each other, each turned and pushed a little, with four contacts a face.
inline Contacts box_stack(int boxes, unsigned seed, double muLow = 0.1, double muHigh = 1) {
  Random random(seed);
  RigidBodies bodies;
  const double a = 0.5;
  for (int i = 0; i < boxes; ++i) {
    const double m = random.between(0.5, 2);
    bodies.centers.push_back({random.between(-0.1, 0.1), random.between(-0.1, 0.1), a + 2 * a * i});
    bodies.masses.push_back(m);
    bodies.inertias.push_back(Eigen::Vector3d::Constant(m * 2 * a * a / 3));
    const double turned = random.between(-0.2, 0.2);
    for (int corner = 0; corner < 4; ++corner) {
      const double angle = turned + 3.14159265358979 * (0.25 + 0.5 * corner);
      const Eigen::Vector3d below =
          bodies.centers.back() + Eigen::Vector3d(0.6 * std::cos(angle), 0.6 * std::sin(angle), -a);
      bodies.contact(i, i - 1, below, {0, 0, 1}, random.between(0, 6));
    }
  }
  return bodies.contacts(random, 0.1, muLow, muHigh);
}

/// Balls of one radius, dropped at random over each other into a square box: each lies on what is below it,
/// or the ground, and all that touch to a tenth of the radius are in contact.
inline Contacts ball_pile(int balls, unsigned seed, double muLow = 0.1, double muHigh = 1) {
  Random random(seed);
  RigidBodies bodies;
  const double r = 0.1, side = 0.15 * std::cbrt(double(balls));
  for (int i = 0; i < balls; ++i) {
    Eigen::Vector3d x(random.between(-side, side), random.between(-side, side), r);
    for (Eigen::Vector3d const& other : bodies.centers) {
      const double across = (x - other).head<2>().squaredNorm();
      if (across < 4 * r * r) x[2] = std::max(x[2], other[2] + std::sqrt(4 * r * r - across));
    }
    bodies.centers.push_back(x);
    const double m = random.between(0.5, 2);
    bodies.masses.push_back(m);
    bodies.inertias.push_back(Eigen::Vector3d::Constant(0.4 * m * r * r));
  }
  for (int i = 0; i < balls; ++i) {
    Eigen::Vector3d const& x = bodies.centers[std::size_t(i)];
    if (x[2] < 1.1 * r) bodies.contact(i, -1, {x[0], x[1], 0}, {0, 0, 1}, random.between(0, 6));
    for (int j = 0; j < i; ++j) {
      const Eigen::Vector3d d = x - bodies.centers[std::size_t(j)];
      if (d.norm() < 2.1 * r) bodies.contact(i, j, x - d / 2, d.normalized(), random.between(0, 6));
    }
  }
  return bodies.contacts(random, 0.1, muLow, muHigh);
}

/// A grid of masses and springs, side x side x 3 points, under the implicit Euler method, A = M + h D + h^2
/// K; its lowest points touch uneven ground.
inline Contacts soft_grid(int side, unsigned seed, double muLow = 0.1, double muHigh = 1) {
  Random random(seed);
  const int layers = 3, points = side * side * layers;
  const double h = 0.01, k = std::pow(10, random.between(2, 5)), mass = 0.01;
  auto place = [&](int p) { return Eigen::Vector3d(p % side, p / side % side, p / (side * side)); };
  Contacts c;
  Eigen::MatrixXd A = mass * Eigen::MatrixXd::Identity(3 * points, 3 * points);
  for (int p = 0; p < points; ++p)
    for (int q = 0; q < p; ++q) {
      const Eigen::Vector3d d = place(p) - place(q);
      if (d.squaredNorm() > 3.5) continue;
      const Eigen::Matrix3d block = (h * h * k + h * 0.01 * k) * d * d.transpose() / d.squaredNorm();
      A.block<3, 3>(3 * p, 3 * p) += block;
      A.block<3, 3>(3 * q, 3 * q) += block;
      A.block<3, 3>(3 * p, 3 * q) -= block;
      A.block<3, 3>(3 * q, 3 * p) -= block;
    }
  c.inverseMass = A.llt().solve(Eigen::MatrixXd::Identity(3 * points, 3 * points));
  c.v.resize(3 * points);
  const Eigen::Vector3d push(random.between(-0.5, 0.5), random.between(-0.5, 0.5), -0.2);
  for (int p = 0; p < points; ++p) c.v.segment<3>(3 * p) = push + random.vector(0.1);
  c.J.setZero(3 * side * side, 3 * points);
  for (int p = 0; p < side * side; ++p) {
    const Eigen::Vector3d up = (Eigen::Vector3d(0, 0, 1) + random.vector(0.3)).normalized();
    c.J.block<3, 3>(3 * p, 3 * p) = frame(up, random.between(0, 6));
    c.mu.push_back(random.between(muLow, muHigh));
  }
  return c;
}

}  // namespace friction_problems
