// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_problem.hpp>
#include <sinew/lagrangian/jacobian_rows.hpp>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <array>
#include <vector>

/// Blocks of linear elastic tetrahedra on a plane or on each other: one step of the implicit Euler method.
namespace soft_block {

struct Settings {
  int nx = 9, ny = 9, nz = 4, count = 1;  // cells of each block, blocks above each other
  double size = 0.1 / 9;                  // of a cell, m
  double young = 1e4, density = 1000, step = 0.01, mu = 0.5;
  double press = 0.1, slide = 0.5;  // velocity of the free motion towards the plane and along it, m/s
  double gap = 0;                   // at the start, m
};

struct Problem {
  int points = 0;
  Eigen::SparseMatrix<double, Eigen::RowMajor> A{};
  std::vector<Eigen::Matrix3d> diagonal{};
  Eigen::VectorXd free{};  // v*
  sinew::JacobianRows rows{};
  std::vector<sinew::ConstraintBlock> blocks{};
  Eigen::VectorXd start{};  // g / h
};

inline Eigen::Matrix<double, 6, 6> elasticity(double young, double poisson) {
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)),
               shear = young / (2 * (1 + poisson));
  C.topLeftCorner<3, 3>().setConstant(lambda);
  for (int i = 0; i < 3; ++i) C(i, i) += 2 * shear, C(3 + i, 3 + i) = shear;
  return C;
}

inline Problem make(Settings const& s) {
  Problem p;
  const int px = s.nx + 1, py = s.ny + 1, pz = s.nz + 1, each = px * py * pz;
  p.points = each * s.count;
  std::vector<Eigen::Vector3d> x;
  for (int b = 0; b < s.count; ++b)
    for (int k = 0; k < pz; ++k)
      for (int j = 0; j < py; ++j)
        for (int i = 0; i < px; ++i)
          // blocks above are shifted and turned, so that their points are above triangles
          x.push_back(s.size * Eigen::Vector3d(
                                   i + 0.31 * b + 0.05 * b * j, j + 0.23 * b - 0.05 * b * i, k + b * s.nz));
  std::vector<Eigen::Triplet<double>> entries;
  const auto C = elasticity(s.young, 0.3);
  const int ways[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  const int stride[3] = {1, px, px * py};
  for (int b = 0; b < s.count; ++b)
    for (int k = 0; k < s.nz; ++k)
      for (int j = 0; j < s.ny; ++j)
        for (int i = 0; i < s.nx; ++i)
          for (auto const& way : ways) {
            int id[4];
            id[0] = b * each + i + px * (j + py * k);
            for (int c = 0; c < 3; ++c) id[c + 1] = id[c] + stride[way[c]];
            Eigen::Matrix4d shape;
            for (int c = 0; c < 4; ++c) shape.row(c) << 1, x[std::size_t(id[c])].transpose();
            const double volume = std::abs(shape.determinant()) / 6;
            const Eigen::Matrix4d inverse = shape.inverse();
            Eigen::Matrix<double, 6, 12> strain = Eigen::Matrix<double, 6, 12>::Zero();
            for (int c = 0; c < 4; ++c) {
              const Eigen::Vector3d g = inverse.col(c).tail<3>();
              auto of = strain.middleCols<3>(3 * c);
              of.diagonal<0>() = g;
              of.row(3) << g[1], g[0], 0;
              of.row(4) << 0, g[2], g[1];
              of.row(5) << g[2], 0, g[0];
            }
            const Eigen::Matrix<double, 12, 12> K = volume * strain.transpose() * C * strain;
            for (int r = 0; r < 12; ++r)
              for (int c = 0; c < 12; ++c)
                entries.emplace_back(3 * id[r / 3] + r % 3,
                                     3 * id[c / 3] + c % 3,
                                     s.step * s.step * K(r, c) + (r == c ? s.density * volume / 4 : 0));
          }
  p.A.resize(3 * p.points, 3 * p.points);
  p.A.setFromTriplets(entries.begin(), entries.end());
  p.diagonal.resize(std::size_t(p.points));
  for (int i = 0; i < p.points; ++i)
    p.diagonal[std::size_t(i)] = Eigen::MatrixXd(p.A.block(3 * i, 3 * i, 3, 3));
  p.free.resize(3 * p.points);
  for (int i = 0; i < p.points; ++i)
    p.free.segment<3>(3 * i) << s.slide + 2 * x[std::size_t(i)][1], -2 * x[std::size_t(i)][0],
        -s.press - 0.3 * x[std::size_t(i)][0];
  auto contact = [&](std::array<int, 4> const& points, std::array<double, 4> const& weights) {
    for (const int axis : {2, 0, 1}) {
      for (std::size_t c = 0; c < 4; ++c)
        if (points[c] >= 0) p.rows.add(3 * points[c] + axis, weights[c]);
      p.rows.endRow();
    }
    p.blocks.push_back(sinew::ConstraintBlock::contact(p.rows.rows() - 3, s.mu));
  };
  for (int j = 0; j < py; ++j)
    for (int i = 0; i < px; ++i) contact({i + px * j, -1, -1, -1}, {1, 0, 0, 0});
  for (int b = 1; b < s.count; ++b)
    for (int j = 0; j < py; ++j)
      for (int i = 0; i < px; ++i) {
        const int above = b * each + i + px * j;
        // in the frame of the block below
        const double bx = 0.31 * b + 0.05 * b * j + i, by = 0.23 * b - 0.05 * b * i + j, m = b - 1;
        Eigen::Matrix2d frame;
        frame << 1, 0.05 * m, -0.05 * m, 1;
        const Eigen::Vector2d at = frame.inverse() * Eigen::Vector2d(bx - 0.31 * m, by - 0.23 * m);
        const int ci = int(std::floor(at[0])), cj = int(std::floor(at[1]));
        if (ci < 0 || cj < 0 || ci >= s.nx || cj >= s.ny) continue;
        const double u = at[0] - ci, v = at[1] - cj;
        const int corner = (b - 1) * each + s.nz * px * py + ci + px * cj;
        if (u > v)
          contact({above, corner, corner + 1, corner + 1 + px}, {1, u - 1, v - u, -v});
        else
          contact({above, corner, corner + px, corner + 1 + px}, {1, v - 1, u - v, -u});
      }
  p.start.setZero(p.rows.rows());
  for (int c = 0; c < p.rows.rows(); c += 3) p.start[c] = s.gap / s.step;
  return p;
}

inline Eigen::SparseMatrix<double> jacobian(Problem const& p) {
  Eigen::SparseMatrix<double> J(p.rows.rows(), p.free.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < p.rows.rows(); ++i)
    p.rows.forEachInRow(i, [&](int dof, double value) { entries.emplace_back(i, dof, value); });
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

}  // namespace soft_block
