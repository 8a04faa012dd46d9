// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>
#include <sinew/topology/hexahedra.hpp>

#include <Eigen/LU>
#include <limits>
#include <span>

namespace sinew {

// How an element carries a point p: with weights w that sum to 1 and sum_k w_k x_k = p (for surfaces and
// edges, its projection), so that any affine motion of the element moves p along. Outside they go on
// linearly. A kind of element offers
//   Points       the numbers of its points
//   low, high    the box around it
//   fit(p)       the weights, and how well it holds p: 0 inside, else negative; minus infinity for a flat
//   element isDistance   whether that is minus the distance from p

template <int N>
struct ElementFit {
  double score;
  Eigen::Matrix<double, N, 1> weights;
};

struct ElementBox {
  Eigen::Vector3d low, high;

  template <class Points>
  ElementBox(std::span<Eigen::Vector3d const> x, Points const& points)
      : low(x[std::size_t(points[0])]), high(low) {
    for (const Index i : points) {
      low = min_of(low, x[std::size_t(i)]);
      high = max_of(high, x[std::size_t(i)]);
    }
  }
  double squaredDistance(Eigen::Vector3d const& p) const {
    return max_of(max_of(low - p, p - high), Eigen::Vector3d(0, 0, 0)).squaredNorm();
  }
};

/// Barycentric coordinates; the score outside is the smallest of them, as a length.
struct TetrahedronFit : ElementBox {
  using Points = Tetrahedron;
  static constexpr bool isDistance = false;
  Eigen::Vector3d origin;
  Eigen::Matrix3d inverse;
  double size;

  TetrahedronFit(std::span<Eigen::Vector3d const> x, Tetrahedron const& t);
  ElementFit<4> fit(Eigen::Vector3d const& p) const;
};

/// Barycentric coordinates of the projection on the plane.
struct TriangleFit : ElementBox {
  using Points = Triangle;
  static constexpr bool isDistance = true;
  Eigen::Vector3d corner[3];
  Eigen::Vector3d along[2];  // their dot products with a place are its coordinates along edges 01 and 02

  TriangleFit(std::span<Eigen::Vector3d const> x, Triangle const& t);
  ElementFit<3> fit(Eigen::Vector3d const& p) const;
};

/// Edges, quads and hexahedra: x(t) = sum_k w_k(t) x_k with multilinear w. The place t is found by
/// Gauss-Newton steps; from its nearest place inside, weights go on linearly: w(t) + w'(t) d with x'(t) d = p
/// - x(t), so that affine motion is reproduced even where Newton's method has not converged.
template <int Dim>
struct MultilinearFit : ElementBox {
  using Points = std::array<Index, std::size_t(1) << Dim>;
  using Place = Eigen::Matrix<double, Dim, 1>;
  static constexpr bool isDistance = true;
  Eigen::Matrix<double, 3, 1 << Dim> corners;
  Place most = Place::Ones();  // where corners coincide at 1, places are below

  MultilinearFit(std::span<Eigen::Vector3d const> x, Points const& points) : ElementBox(x, points) {
    for (int k = 0; k < 1 << Dim; ++k) corners.col(k) = x[std::size_t(points[std::size_t(k)])];
  }
  ElementFit<(1 << Dim)> fit(Eigen::Vector3d const& p) const {
    Place t = Place::Constant(0.5);
    for (int iteration = 0; iteration < 16; ++iteration) {
      const Place step = along(MultilinearShape<Dim>(t), p);
      if (!all_finite(step)) break;
      const Place next = (t + step).cwiseMax(-0.5).cwiseMin((most.array() < 1).select(most, 1.5));
      const bool settled = (next - t).cwiseAbs().maxCoeff() < 1e-14;
      t = next;
      if (settled) break;
    }
    t = t.cwiseMax(0).cwiseMin(most);
    const MultilinearShape<Dim> shape(t);
    const Place rest = along(shape, p);
    const auto weights = (shape.weights + shape.derivatives * rest).eval();
    const double distance = (p - corners * shape.weights).norm();
    if (!all_finite(weights)) return {-std::numeric_limits<double>::infinity(), weights};
    return {distance < 1e-12 * (high - low).norm() ? 0 : -distance, weights};
  }

 private:
  // d with x'(t) d = p - x(t), by least squares where the element has fewer dimensions than space
  Place along(MultilinearShape<Dim> const& shape, Eigen::Vector3d const& p) const {
    const Eigen::Matrix<double, 3, Dim> slope = corners * shape.derivatives;
    const Eigen::Vector3d gap = p - corners * shape.weights;
    if constexpr (Dim == 3)
      return slope.inverse() * gap;
    else
      return (slope.transpose() * slope).inverse() * (slope.transpose() * gap);
  }
};

/// Pyramids and prisms, as hexahedra of which corners coincide.
template <class Element>
struct CollapsedFit : MultilinearFit<3> {
  using Points = Element;

  CollapsedFit(std::span<Eigen::Vector3d const> x, Points const& points)
      : MultilinearFit<3>(x, as_hexahedron(points)) {
    this->most[points.size() == 5 ? 2 : 1] = 1 - 1e-4;
  }
  ElementFit<int(std::tuple_size_v<Element>)> fit(Eigen::Vector3d const& p) const {
    constexpr int nodes = int(std::tuple_size_v<Element>);
    const ElementFit<8> whole = MultilinearFit<3>::fit(p);
    constexpr Hexahedron nodeOf = [] {
      Element numbers{};
      for (int i = 0; i < nodes; ++i) numbers[std::size_t(i)] = i;
      return as_hexahedron(numbers);
    }();
    ElementFit<nodes> result{whole.score, {}};
    result.weights.setZero();
    for (int k = 0; k < 8; ++k) result.weights[nodeOf[std::size_t(k)]] += whole.weights[k];
    return result;
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <cmath>

namespace sinew {

SINEW_ONCE TetrahedronFit::TetrahedronFit(std::span<Eigen::Vector3d const> x, Tetrahedron const& t)
    : ElementBox(x, t), origin(x[std::size_t(t[0])]) {
  Eigen::Matrix3d edges;
  for (int c = 0; c < 3; ++c) edges.col(c) = x[std::size_t(t[std::size_t(c) + 1])] - origin;
  inverse = edges.inverse();
  size = std::cbrt(std::abs(edges.determinant()));
}

SINEW_ONCE ElementFit<4> TetrahedronFit::fit(Eigen::Vector3d const& p) const {
  const Eigen::Vector3d w = inverse * (p - origin);
  const Eigen::Vector4d weights(1 - w.sum(), w[0], w[1], w[2]);
  if (!all_finite(weights)) return {-std::numeric_limits<double>::infinity(), weights};
  const double minimum = weights.minCoeff();
  return {minimum < 0 ? minimum * size : 0, weights};
}

SINEW_ONCE TriangleFit::TriangleFit(std::span<Eigen::Vector3d const> x, Triangle const& t)
    : ElementBox(x, t) {
  for (std::size_t k = 0; k < 3; ++k) corner[k] = x[std::size_t(t[k])];
  const Eigen::Vector3d a = corner[1] - corner[0], b = corner[2] - corner[0];
  const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), det = aa * bb - ab * ab;
  along[0] = (bb / det) * a - (ab / det) * b;
  along[1] = (aa / det) * b - (ab / det) * a;
}

SINEW_ONCE ElementFit<3> TriangleFit::fit(Eigen::Vector3d const& p) const {
  const double u = along[0].dot(p - corner[0]), v = along[1].dot(p - corner[0]);
  const Eigen::Vector3d weights(1 - (u + v), u, v);
  if (!all_finite(weights)) return {-std::numeric_limits<double>::infinity(), weights};
  Eigen::Vector3d nearest = weights[0] * corner[0] + weights[1] * corner[1] + weights[2] * corner[2];
  if (weights.minCoeff() < 0) {  // outside: on the nearest of the sides
    double minimum = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d side = corner[(k + 1) % 3] - corner[k];
      const double part = std::clamp((p - corner[k]).dot(side) / side.squaredNorm(), 0.0, 1.0);
      const Eigen::Vector3d place = corner[k] + part * side;
      if (const double d = (p - place).squaredNorm(); d < minimum) minimum = d, nearest = place;
    }
  }
  return {-(p - nearest).norm(), weights};
}

}  // namespace sinew
#endif
